"""Studies: several runs put side by side."""
