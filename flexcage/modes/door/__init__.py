"""Reduced bodies from elsewhere, and to elsewhere: one value, its formats, its checks."""
