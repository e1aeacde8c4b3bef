"""The compiled engine: small dense networks over numbered states, by Numba; the fast path for the paper's task."""
