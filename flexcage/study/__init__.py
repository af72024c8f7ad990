"""Studies: many cases planned, run on Dask and gathered; two runs put side by side."""
