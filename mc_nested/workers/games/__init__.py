"""Games on other computers that play whole episodes for one learner (learn/games/), as workers of a Dask scheduler."""
