"""Cage meshes: gmsh builders with named groups, defects by morphing, files, quality."""
