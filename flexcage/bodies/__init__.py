"""Bodies: rigid, and flexible in a floating frame."""
