"""Tables of tapered roller bearings (ISO 355, ratings), as CSV files like those of all bearings."""
