"""Tables of spherical roller bearings, as CSV files like those of all bearings."""
