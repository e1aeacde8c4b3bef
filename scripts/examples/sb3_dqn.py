"""stable-baselines3's DQN learns a design: the Env goes in as gymnasium.make returns it.

    pip install -c constraints.txt -e '.[bench]'
    python scripts/examples/sb3_dqn.py --scenario line --steps 30000
    python scripts/examples/sb3_dqn.py --scenario line --steps 2000 --backend live    # in the running game

Only Gymnasium and stable-baselines3 are used; importing mc_nested registers the Env. An observation (x, y, b) counts
cells and blocks, so it is shown as a MultiDiscrete, which the library encodes as one-hot. Exit code 2, and one line,
where the library isn't installed or the Env can't be made.
"""

import argparse
import sys
from collections.abc import Sequence
from typing import Any

import gymnasium
from gymnasium.spaces import MultiDiscrete
from gymnasium.wrappers import TransformObservation

import mc_nested  # noqa: F401 - registers mc_nested/Arena-v0
from mc_nested.errors import McNestedError


def main(arguments: Sequence[str] | None = None) -> int:
    """Train, and print what a greedy episode scores; returns the exit code."""
    parser = argparse.ArgumentParser(description="stable-baselines3's DQN on mc_nested/Arena-v0.")
    parser.add_argument("--scenario", default="line", help="a shipped design, or a file [line]")
    parser.add_argument("--steps", type=int, default=30_000, help="steps of training [30000]")
    parser.add_argument("--seed", type=int, default=1, help="of all random choices [1]")
    parser.add_argument("--backend", choices=["sim", "live"], default="sim", help="the simulator, or the running game")
    wanted = parser.parse_args(arguments)
    try:
        from stable_baselines3 import DQN
    except ImportError:
        return failed("stable-baselines3 isn't installed: pip install -c constraints.txt -e '.[bench]'")
    try:
        made: gymnasium.Env[Any, Any] = gymnasium.make(
            "mc_nested/Arena-v0", scenario=wanted.scenario, backend=wanted.backend
        )
        counts: Any = made.observation_space
        env = TransformObservation(made, lambda seen: seen, MultiDiscrete(counts.high + 1))
        model = DQN(
            "MlpPolicy",
            env,
            learning_rate=1e-3,
            learning_starts=500,
            train_freq=1,
            target_update_interval=500,
            gamma=0.9,
            exploration_fraction=0.5,
            policy_kwargs={"net_arch": [64, 64]},
            seed=wanted.seed,
            device="cpu",
            verbose=1,
        )
        model.learn(wanted.steps, log_interval=50)
        print(f"greedy: score {greedy_score(env, model):g} of {env.get_wrapper_attr('scenario').optimum:g}")
        env.close()
    except McNestedError as error:
        return failed(str(error))
    return 0


def greedy_score(env: gymnasium.Env[Any, Any], model: Any) -> float:
    """Return the score of a greedy episode."""
    observation, _ = env.reset()
    while True:
        action, _ = model.predict(observation, deterministic=True)
        observation, _, terminated, truncated, info = env.step(action)
        if terminated or truncated:
            return float(info["score"])


def failed(why: str) -> int:
    """Say why, in one line; returns the exit code."""
    print(f"sb3_dqn: {why}", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
