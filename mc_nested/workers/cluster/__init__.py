"""Workers on other computers, through a Dask scheduler."""
