"""Other players of the same world: they are in each other's way, and in the way of blocks.

Here a player stops at another one. In the game players push each other apart. The live path never walks into one, since
the rules void that (arena/cooperative/team.py). A reset may put one into another, which is not as in the game.
"""

from collections.abc import Collection

from sim.client.game.physics import HALF_WIDTH, Vector

WIDTH = 2 * HALF_WIDTH


def touches(one: Vector, other: Vector, height: float) -> bool:
    """Whether players of that height whose feet are there are in each other's way."""
    return abs(one[0] - other[0]) < WIDTH and abs(one[2] - other[2]) < WIDTH and abs(one[1] - other[1]) < height


def kept_apart(before: Vector, after: Vector, others: Collection[Vector], height: float) -> Vector:
    """Where a step from ``before`` that blocks would let end at ``after`` ends, with others standing there.

    Each way is taken alone: one that leads into another player isn't gone at all. Who is in somebody already, as after
    a teleport, may go on.
    """
    around = [other for other in others if not touches(before, other, height)]

    def is_free(feet: Vector) -> bool:
        return not any(touches(feet, other, height) for other in around)

    if is_free(after):
        return after
    x = after[0] if is_free((after[0], after[1], before[2])) else before[0]
    z = after[2] if is_free((x, after[1], after[2])) else before[2]
    return x, after[1], z
