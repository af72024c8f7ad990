"""Tables of double row angular contact ball bearings, as CSV files like those of all bearings."""
