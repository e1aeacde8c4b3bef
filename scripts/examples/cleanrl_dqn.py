"""DQN on one page, in the manner of CleanRL: torch, and arenas from gymnasium.make_vec.

    python scripts/examples/cleanrl_dqn.py --scenario line --steps 30000
    python scripts/examples/cleanrl_dqn.py --scenario line --steps 2000 --backend live    # in the running game

It shows what a learner of your own has to do: take several arenas at once, leave out the step at which an arena begins
its next episode, and encode an observation (x, y, b), here as one-hot. Exit code 2, and one line, where the arenas
can't be made.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
import torch
from gymnasium.wrappers.vector import RecordEpisodeStatistics
from numpy.typing import NDArray
from torch import nn
from torch.nn.functional import one_hot, smooth_l1_loss

import mc_nested  # noqa: F401 - registers mc_nested/Arena-v0
from mc_nested.errors import McNestedError

ARENAS = 4
GAMMA, LEARNING_RATE, BATCH, LEARNING_STARTS, TARGET_PERIOD = 0.9, 1e-3, 64, 500, 250
EPSILON_FLOOR, EPSILON_SHARE = 0.05, 0.5
"""ε falls from 1 to its floor within that share of the steps."""


class QNetwork(nn.Module):
    """Q-values (batch, actions) of observations (batch, 3) up to ``highest`` (3,), int64."""

    def __init__(self, highest: NDArray[np.int64], actions: int) -> None:
        super().__init__()
        self.widths = [int(value) + 1 for value in highest]
        self.layers = nn.Sequential(
            nn.Linear(sum(self.widths), 64), nn.ReLU(), nn.Linear(64, 64), nn.ReLU(), nn.Linear(64, actions)
        )

    def forward(self, observations: torch.Tensor) -> Any:
        parts = [one_hot(observations[:, part], width) for part, width in enumerate(self.widths)]
        return self.layers(torch.cat(parts, dim=1).float())

    def greedy(self, observations: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the best action (batch,) of each observation."""
        with torch.no_grad():
            best: NDArray[np.int64] = self(torch.as_tensor(observations)).argmax(1).numpy()
        return best


def train(envs: RecordEpisodeStatistics[Any, Any], steps: int, seed: int) -> QNetwork:
    """Learn for that many steps, those of all arenas counted, and print every episode's return."""
    random = np.random.default_rng(seed)
    torch.manual_seed(seed)
    counts: Any = envs.single_observation_space
    actions: Any = envs.single_action_space
    q, target = QNetwork(counts.high, actions.n), QNetwork(counts.high, actions.n)
    adam = torch.optim.Adam(q.parameters(), lr=LEARNING_RATE)
    replay: list[tuple[Any, ...]] = []
    arenas, began = envs.num_envs, time.monotonic()
    observations, _ = envs.reset(seed=seed)
    ended = np.zeros(arenas, dtype=np.bool_)
    for update, step in enumerate(range(0, steps, arenas)):
        epsilon = max(EPSILON_FLOOR, 1 - (1 - EPSILON_FLOOR) * step / (EPSILON_SHARE * steps))
        exploring = random.random(arenas) < epsilon
        chosen = np.where(exploring, random.integers(actions.n, size=arenas), q.greedy(observations))
        following, rewards, terminated, truncated, info = envs.step(chosen)
        # An arena whose episode had ended began the next one at this step, and didn't do the action: no transition.
        parts = observations, chosen, rewards, following, terminated
        replay.extend(tuple(part[arena] for part in parts) for arena in np.flatnonzero(~ended))
        observations, ended = following, terminated | truncated
        for arena in np.flatnonzero(ended):
            print(f"step {step}: return {info['episode']['r'][arena]:g}, length {info['episode']['l'][arena]}")
        if update % TARGET_PERIOD == 0:
            target.load_state_dict(q.state_dict())
            rate, mean = step / max(time.monotonic() - began, 1e-9), np.mean(envs.return_queue or [0.0])
            print(f"{step} of {steps} steps, {rate:.0f} a second, ε {epsilon:.2f}, mean return {mean:.2f}", flush=True)
        if len(replay) >= LEARNING_STARTS:
            batch = [replay[index] for index in random.integers(len(replay), size=BATCH)]
            seen, did, reward, then, over = (torch.as_tensor(np.array(part)) for part in zip(*batch, strict=True))
            with torch.no_grad():
                wanted = reward.float() + GAMMA * target(then).max(1).values * ~over
            loss = smooth_l1_loss(q(seen).gather(1, did[:, None])[:, 0], wanted)
            adam.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]  # torch's
            adam.step()
    return q


def greedy_score(envs: RecordEpisodeStatistics[Any, Any], q: QNetwork) -> float:
    """Return the score of a greedy episode of the first arena."""
    observations, _ = envs.reset()
    while True:
        observations, _, terminated, truncated, info = envs.step(q.greedy(observations))
        if terminated[0] or truncated[0]:
            return float(info["score"][0])


def main(arguments: Sequence[str] | None = None) -> int:
    """Train, and print what a greedy episode scores; returns the exit code."""
    parser = argparse.ArgumentParser(description="DQN on mc_nested/Arena-v0.")
    parser.add_argument("--scenario", default="line", help="a shipped design, or a file [line]")
    parser.add_argument("--steps", type=int, default=30_000, help="steps of training [30000]")
    parser.add_argument("--seed", type=int, default=1, help="of all random choices [1]")
    parser.add_argument("--backend", choices=["sim", "live"], default="sim", help="the simulator, or the running game")
    wanted = parser.parse_args(arguments)
    arenas = 1 if wanted.backend == "live" else ARENAS
    try:
        made = gymnasium.make_vec(
            "mc_nested/Arena-v0", num_envs=arenas, scenario=wanted.scenario, backend=wanted.backend
        )
        envs = RecordEpisodeStatistics(made)
        print(f"greedy: score {greedy_score(envs, train(envs, wanted.steps, wanted.seed)):g}")
        envs.close()
    except McNestedError as error:
        print(f"cleanrl_dqn: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
