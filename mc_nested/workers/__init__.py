"""Who does a study's work: processes of this computer, or the workers of a cluster (Dask)."""
