"""Experiments of many runs: divided into jobs, trained, collected; the paper's reproduction and the sweep."""
