"""Tables of double row cylindrical roller bearings, as CSV files like those of all bearings."""
