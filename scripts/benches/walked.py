"""How far a hold of a key leads on open ground, by the game's rules of walking alone."""

from sim.client.game.physics import INPUT, SNEAKING, STANDSTILL, STONE, Gait, Ground


def displacement(ticks: int, gait: Gait, ground: Ground = STONE) -> float:
    """Return the blocks covered by holding forward for so many ticks from rest, then coasting to a stop."""
    push = INPUT * (SNEAKING if gait == "sneak" else 1.0) * ground.under(gait).acceleration
    covered = velocity = 0.0
    tick = 0
    while tick < ticks or velocity >= STANDSTILL:
        velocity = (velocity if velocity >= STANDSTILL else 0.0) + (push if tick < ticks else 0.0)
        covered += velocity
        velocity *= ground.inertia
        tick += 1
    return covered
