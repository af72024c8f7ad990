"""A rotor that turns in several bearings: its motion, and that of all of them as one problem."""
