"""Readers of mesh files, one a format: each returns a ``RawMesh`` or refuses by name."""
