"""Rings on their seats: tolerances of seats, press fits, and the clearance that is left."""
