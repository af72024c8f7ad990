"""Judging what a paper claims: findings, their shares over what the paper leaves open, verdicts."""
