"""Scenarios with parts for tests: a small one that is worked by hand, and any."""

from dataclasses import replace

from hypothesis import strategies as st

from mc_nested.arena.action import Action
from mc_nested.arena.builder import order_of_parts
from mc_nested.arena.scenario import Material, Part, Scenario

WOOD, STONE = 0, 1

FAR, NEAR = frozenset({(1, 3), (2, 3)}), frozenset({(1, 2), (2, 2), (3, 2)})

STRIPES = Scenario(
    name="stripes",
    design=FAR | NEAR,
    start=(1, 1),
    step_limit=12,
    materials=(Material("wood", -5.0, "oak_planks"), Material("stone", 10.0, "stone")),
    size=5,
    parts=(Part(FAR, (-5.0, 10.0)), Part(NEAR, (6.0, -3.0))),
)
"""In an arena of 5: two blocks, where stone is worth 10, then three before them, where wood is worth 6."""

TO_FAR = (Action.FD, Action.RD)
"""From the start, both blocks of the far stripe: (1, 3), (2, 3). It ends in (2, 2)."""

TO_NEAR = (Action.B, Action.RD, Action.L, Action.LD, Action.RD)
"""From there the near one: (3, 2), (1, 2), (2, 2)."""


@st.composite
def scenarios_with_parts(draw: st.DrawFn, size: int = 6) -> Scenario:
    """Draw a design of a few cells, in one to three parts in an order that can be built, and materials or regions."""
    cells = st.tuples(st.integers(0, size - 1), st.integers(1, size - 1))
    design = draw(st.lists(cells, min_size=1, max_size=7, unique=True))
    ends = sorted(draw(st.sets(st.integers(1, len(design)), max_size=2)) | {len(design)})
    names = draw(st.sampled_from([("wood", "stone"), ("wood", "stone", "clay")]))
    worth = st.tuples(*[st.integers(-1, 12).map(float)] * len(names))
    begins = [0, *ends[:-1]]
    parts = tuple(Part(frozenset(design[begin:end]), draw(worth)) for begin, end in zip(begins, ends, strict=True))
    start = draw(st.tuples(st.integers(0, size - 1), st.integers(0, size - 1)))
    materials = tuple(Material(name, p, name) for name, p in zip(names, parts[0].worth, strict=True))
    scenario = Scenario("any", frozenset(design), start, size * size, materials, size, parts)
    every = draw(st.none() | st.integers(1, 4))
    in_one = replace(scenario, parts=(Part(scenario.design, parts[0].worth),))
    in_turn = in_one if order_of_parts(scenario) is None else scenario
    return replace(in_turn, choose_every=every, regions=draw(st.booleans()))
