"""Who does the work: processes of this computer, a cluster's workers (Dask), or games that play for one learner."""
