"""Sensors: what a measuring chain would show of a run, as signals and in files."""
