"""A sum of products whose order is the same on every processor: eight sums side by side, then the sum of those."""

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite import ir
from numba.core import cgutils, types
from numba.extending import intrinsic

from mc_nested.arrays import Float32s
from mc_nested.compiled import IN_PYTHON
from mc_nested.learn.dqn.compiled_engine.vectors import FUSED, INDEX, Vectors

LANES = 8
"""Sums side by side."""

SumInLanes = Callable[[Float32s, int, Float32s, int], np.float32]
"""``sum_in_lanes(a, row, b, terms)``: the sum of that many products of a row of ``a`` and the first of ``b``.

``terms`` is a multiple of LANES. A row of either lies in one piece. The bounds are checked in plain Python only.
"""


def _in_python(a: Float32s, row: int, b: Float32s, terms: int) -> np.float32:
    places = range(terms)
    products = a[row].take(places) * b[0].take(places)
    total: np.float32 = products.sum()
    return total


def _compiled(_: Any, a: Any, row: Any, b: Any, terms: Any) -> Any:
    return types.float32(a, row, b, terms), _generate


def _generate(context: Any, builder: Any, signature: Any, given: Any) -> Any:
    kind_a, _, kind_b, _ = signature.args
    a, row, b, terms = given
    rows, factors = Vectors(context, builder, kind_a, a, LANES), Vectors(context, builder, kind_b, b, LANES)
    total = cgutils.alloca_once(builder, ir.VectorType(ir.FloatType(), LANES), zfill=True)  # type: ignore[no-untyped-call]
    none, step = terms.type(0), terms.type(LANES)
    with cgutils.for_range_slice(builder, none, terms, step, inc=True) as (term, _):
        product = builder.fmul(rows.load(row, term), factors.load(none, term), flags=FUSED)
        builder.store(builder.fadd(builder.load(total), product, flags=FUSED), total)
    lanes = builder.load(total)
    half = LANES
    while half > 1:
        half //= 2
        others = ir.Constant(ir.VectorType(INDEX, LANES), [(lane + half) % LANES for lane in range(LANES)])
        lanes = builder.fadd(lanes, builder.shuffle_vector(lanes, lanes, others))
    return builder.extract_element(lanes, INDEX(0))


_sum: Any = _in_python if IN_PYTHON else intrinsic(_compiled)
sum_in_lanes: SumInLanes = _sum
