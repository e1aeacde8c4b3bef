"""Names for NumPy arrays, by dtype."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

Bools = NDArray[np.bool_]
Float32s = NDArray[np.float32]
Float64s = NDArray[np.float64]
Bytes = NDArray[np.uint8]
Int8s = NDArray[np.int8]
Int32s = NDArray[np.int32]
Int64s = NDArray[np.int64]
Integers = NDArray[np.integer[Any]]
"""Whole numbers of any width: a replay keeps small ones."""

Arrays = dict[str, NDArray[Any]]
"""Arrays by name: a saved state, or a part of one."""
