"""Data sets of signals with known truth, made of a study's runs."""
