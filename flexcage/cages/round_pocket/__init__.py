"""Round pockets, which machined, crown and ribbon cages share."""
