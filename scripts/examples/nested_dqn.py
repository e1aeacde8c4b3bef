"""Deep nested agents on one page: torch and gymnasium, and nothing else.

    python scripts/examples/nested_dqn.py
    python scripts/examples/nested_dqn.py --agent single --design diamond --trials 10

An agent builds a design of blocks on a floor of 15 x 15 cells (Brittain and Wei, 2018). It chooses a material, then it
lays block after block. The paper has three agents, which differ in who decides what:

nested        a main agent sees (x, y, b) and chooses; one nested agent sees (x, y, b, choice) and builds
hierarchical  a top agent sees (x, y, b) and chooses, and with the material one of two low-level agents, which builds
single        one agent does all of it: two of its ten actions choose, the others build

b is how many blocks are left. Read it from the top: the task, the learner, the agents, Algorithm 1. Several trials
train side by side and share nothing: an array has a row for each of them.
"""

import argparse
import sys
import time
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
import torch
from gymnasium.spaces import Discrete, MultiDiscrete
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray
from torch import Tensor
from torch.nn.functional import huber_loss

Bools, Floats, Ints = NDArray[np.bool_], NDArray[np.float64], NDArray[np.int64]

# ---------------------------------------------------------------------------------------------------------- the task

SIZE, STEP_LIMIT, START = 15, 60, (7, 14)
"""Cells along a side; the steps of the longest episode; the cell (x, y) where each begins, at the far edge."""

WORTH = {"wood": -5.0, "stone": 10.0}
"""What each material adds to the score of an episode: p. Each block on the design adds 1."""

MOVES = np.array([(0, 1), (0, -1), (-1, 0), (1, 0), (0, 1), (-1, 0), (1, 0), (0, -1)])
"""Where each action goes, (right, forward): F, B, L, R; then F+D, L+D, R+D, B+D, which place a block afterwards."""

FIRST_TO_PLACE = 4
NO_MATERIAL = -1

DESIGNS: dict[str, list[tuple[int, int]]] = {
    "line": [(7, y) for y in range(2, 13)],
    "zigzag": list(zip((7, 8, 9, 8, 7, 6, 5, 6, 7, 8, 9), range(2, 13), strict=True)),
    "diamond": [(x, y) for x in range(SIZE) for y in range(SIZE) if abs(x - 7) + abs(y - 7) == 4],
}
"""The cells to build on."""


class Arenas(VectorEnv[Ints, Ints, Any]):
    """Arenas side by side. The reward is 1 for a block on the design; ``info["score"]`` is the episode's so far.

    Args:
        design: the cells to build on.
        count: how many arenas.
        chooses: for the single agent: actions 0 and 1 choose a material, and earn what it is worth; 2 to 9 build. Its
            observation (x, y, b, m) has m = 0 until it has chosen, then 1 or 2.
    """

    def __init__(self, design: list[tuple[int, int]], count: int, chooses: bool = False) -> None:
        self.metadata = {"autoreset_mode": AutoresetMode.DISABLED}
        self.num_envs, self.chooses, self.blocks = count, chooses, len(design)
        self.choices = len(WORTH) if chooses else 0
        self.highest = np.array([SIZE - 1, SIZE - 1, self.blocks, *[len(WORTH)] * chooses])
        self.single_observation_space: Any = MultiDiscrete(self.highest + 1)
        self.single_action_space: Any = Discrete(self.choices + len(MOVES))
        self.observation_space = batch_space(self.single_observation_space, count)
        self.action_space = batch_space(self.single_action_space, count)
        self._arena = np.arange(count)
        self._design = np.zeros((SIZE + 2, SIZE + 2), np.bool_)  # cells from 1 on, as in ``solid``
        self._design[tuple(np.array(design).T + 1)] = True
        self.solid = np.ones((count, SIZE + 2, SIZE + 2), np.bool_)  # blocks, and a rim: an edge stops as a block does
        self._cell = np.ones((count, 2), np.int64)
        self._left, self._steps = np.zeros((2, count), np.int64)
        self._material = np.full(count, NO_MATERIAL)
        self._score, self._running = np.zeros(count), np.zeros(count, np.bool_)

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> tuple[Ints, dict[str, Any]]:  # noqa: ARG002
        """Begin an episode in the arenas of ``options["reset_mask"]``; ``options["material"]`` is every arena's."""
        begins = options["reset_mask"] if options else np.ones(self.num_envs, np.bool_)
        self.solid[begins, 1:-1, 1:-1] = False
        self._cell[begins] = np.array(START) + 1
        self._left[begins], self._steps[begins], self._running[begins] = self.blocks, 0, True
        self._material[begins], self._score[begins] = NO_MATERIAL, 0.0
        if options and not self.chooses:
            self._take(begins, options["material"])
        return self._seen(), {}

    def step(self, actions: Ints) -> tuple[Ints, Floats, Bools, Bools, dict[str, Any]]:
        """Move, then place a block in front: where an episode is running."""
        running, builds = self._running.copy(), actions - self.choices
        first = running & (self._material == NO_MATERIAL) & self.chooses
        takes, builds_now = first & (builds < 0), running & ~first & (builds >= 0)
        rewards = self._take(takes, actions)

        ahead = self._cell + MOVES[builds]
        moves = builds_now & ~self.solid[self._arena, ahead[:, 0], ahead[:, 1]]
        self._cell[moves] = ahead[moves]
        x, y = self._cell.T + [[0], [1]]  # the cell in front: the agent always looks forward
        lands = builds_now & (builds >= FIRST_TO_PLACE) & ~self.solid[self._arena, x, y]
        self.solid[self._arena[lands], x[lands], y[lands]] = True
        pays = lands & self._design[x, y]

        self._left -= lands
        self._steps += running
        self._score += pays
        terminated = running & ((self._left == 0) | (first & ~takes))
        truncated = running & ~terminated & (self._steps >= STEP_LIMIT)
        self._running &= ~(terminated | truncated)
        return self._seen(), rewards + pays, terminated, truncated, {"score": self._score.copy()}

    def _take(self, where: Bools, materials: Ints) -> Floats:
        self._material[where] = materials[where]
        worth = np.array(list(WORTH.values()))[self._material] * where
        self._score += worth
        return worth

    def _seen(self) -> Ints:
        material = [self._material + 1] * self.chooses
        return np.column_stack((self._cell - 1, self._left, *material))


# ------------------------------------------------------------------------------------------------------ the learner


@dataclass(frozen=True)
class Settings:
    """What is trained, and how. P: of the paper; the others are chosen."""

    agent: str = "nested"  # or hierarchical, or single
    design: str = "line"  # or zigzag, or diamond
    trials: int = 1  # independent trainings, side by side
    seed: int = 0  # of all random choices
    episodes: int = 3000  # of each trial's training, P
    evaluate_every: int = 30  # episodes from one greedy episode to the next, P
    hidden: int = 32  # nodes in each of two hidden layers with tanh, P
    batch: int = 32  # transitions of an update, P; also those that there must be before the first
    replay: int = 1_000_000  # transitions kept at most, P
    learning_rate: float = 1e-3
    gamma: float = 0.95  # what a reward is worth a step later
    target_period: int = 500  # updates from one renewal of the target network to the next
    main_floor: float = 0.01  # ε falls from 1 (P) to its floor: the main agent's is higher than the builder's (P),
    main_share: float = 0.18  # and reached sooner (P): within this share of the episodes
    floor: float = 0.001  # P
    share: float = 0.6


class Learners:
    """Rows of double deep Q-learners that share nothing: parameters, optimiser and replay have a row for each.

    Args:
        rows: how many learners.
        highest: of each number of a state; the lowest is 0.
        actions: how many actions there are.
        capacity: transitions that each keeps.
        settings: the hyper-parameters.
        random: makes all random choices.
    """

    def __init__(
        self, rows: int, highest: Ints, actions: int, capacity: int, settings: Settings, random: torch.Generator
    ) -> None:
        self.settings, self.random, self.actions = settings, random, actions
        self.highest = torch.as_tensor(highest)
        self.sizes = list(pairwise((len(highest), settings.hidden, settings.hidden, actions)))
        layers = [(torch.rand(rows, (i + 1) * o, generator=random) * 2 - 1) / i**0.5 for i, o in self.sizes]
        self.online = torch.cat(layers, dim=1)
        self.target = self.online.clone()
        self.moments = torch.zeros(2, *self.online.shape)  # Adam's: of the gradient, and of its square
        self.updates, self.stored = torch.zeros(rows, dtype=torch.int64), torch.zeros(rows, dtype=torch.int64)
        self.widths = [len(highest), len(highest), 1, 1, 1]  # s, s', action, reward, terminated
        self.replay = torch.empty(rows, capacity, sum(self.widths))

    def q_values(self, parameters: Tensor, states: Tensor) -> Tensor:
        """Return what the networks (k, parameters) say of states (k, batch, width): (k, batch, actions)."""
        values, start = states, 0
        for i, o in self.sizes:
            weights = parameters[:, start : start + i * o].view(-1, i, o)
            bias = parameters[:, None, start + i * o : start + (i + 1) * o]
            values = torch.baddbmm(bias, values.tanh() if start else values, weights)
            start += (i + 1) * o
        return values

    def scaled(self, states: Ints) -> Tensor:
        """Return each number of the states (k, width) scaled to [-1, 1]."""
        return 2 * torch.as_tensor(states) / self.highest - 1

    def act(self, rows: Tensor, states: Ints, epsilon: Floats) -> Ints:
        """Return ε-greedy actions (k,) of the named rows (k,) in states (k, width)."""
        greedy = self.q_values(self.online[rows], self.scaled(states)[:, None]).argmax(-1)[:, 0]
        explored = torch.randint(self.actions, greedy.shape, generator=self.random)
        explores = torch.rand(len(rows), generator=self.random) < torch.as_tensor(epsilon)
        return torch.where(explores, explored, greedy).numpy()

    def store(self, rows: Tensor, states: Ints, actions: Ints, rewards: Floats, following: Ints, over: Bools) -> None:
        """Store a transition of each of the named rows (k,); the oldest is overwritten."""
        parts = [self.scaled(states), self.scaled(following), *map(torch.as_tensor, (actions, rewards, over))]
        together = torch.cat([part.view(len(rows), -1).float() for part in parts], dim=1)
        self.replay[rows, self.stored[rows] % self.replay.shape[1]] = together
        self.stored[rows] += 1

    def learn(self, rows: Tensor) -> None:
        """Update each of the named rows once, from a batch of its own, if it has one."""
        rows = rows[self.stored[rows] >= self.settings.batch]
        if not len(rows):
            return
        kept = self.stored[rows].clamp(max=self.replay.shape[1])
        drawn = (torch.rand(len(rows), self.settings.batch, generator=self.random) * kept[:, None]).long()
        states, following, actions, rewards, over = self.replay[rows[:, None], drawn].split(self.widths, dim=-1)
        online = self.online[rows].requires_grad_()
        with torch.no_grad():
            aim = ddqn_target(
                rewards,
                over,
                self.q_values(online, following),
                self.q_values(self.target[rows], following),
                self.settings.gamma,
            )
        chosen = self.q_values(online, states).gather(-1, actions.long())
        loss = huber_loss(chosen, aim, reduction="none").mean((1, 2)).sum()  # a row's gradient is of its own loss
        (gradient,) = torch.autograd.grad(loss, online)
        self._step(rows, gradient)

    def _step(self, rows: Tensor, gradient: Tensor) -> None:
        """Take one step of Adam; rows that learn at different times have counts of their own."""
        self.updates[rows] += 1
        count = self.updates[rows, None]
        first = self.moments[0, rows].lerp(gradient, 1 - 0.9)
        second = self.moments[1, rows].lerp(gradient**2, 1 - 0.999)
        self.moments[0, rows], self.moments[1, rows] = first, second
        scale = self.settings.learning_rate / (1 - 0.9**count)
        self.online[rows] -= scale * first / ((second / (1 - 0.999**count)).sqrt() + 1e-8)
        due = rows[self.updates[rows] % self.settings.target_period == 0]
        self.target[due] = self.online[due]


def ddqn_target(rewards: Tensor, over: Tensor, online: Tensor, target: Tensor, gamma: float) -> Tensor:
    """Return r + γ Q'(s', argmax Q(s', ·)), (…, 1): the online values Q choose, the target network's Q' are believed.

    Rewards and ``over``, 1 where the episode has terminated, are (…, 1); the values of s' are (…, actions).
    """
    best = online.argmax(-1, keepdim=True)
    return rewards + gamma * (1 - over) * target.gather(-1, best)


# ------------------------------------------------------------------------------------------------------- the agents


class Agent:
    """One of the paper's agents, in so many trials: which learner acts, and what it sees."""

    def __init__(self, settings: Settings, arenas: Arenas) -> None:
        random = torch.Generator().manual_seed(settings.seed)
        trials, steps = settings.trials, settings.episodes * STEP_LIMIT
        self.kind, self.trials = settings.agent, torch.arange(trials)
        self.start = np.tile([*START, arenas.blocks], (trials, 1))
        seen, more = arenas.highest, [len(WORTH) - 1] * (self.kind == "nested")
        rows = trials * (len(WORTH) if self.kind == "hierarchical" else 1)
        actions = int(arenas.single_action_space.n)
        self.main = Learners(trials, seen[:3], len(WORTH), min(settings.replay, settings.episodes), settings, random)
        self.builder = Learners(
            rows, np.append(seen, more).astype(np.int64), actions, min(settings.replay, steps), settings, random
        )

    def choose(self, epsilon: Floats) -> Ints:
        """Return the main agent's materials, (trials,); the single agent's doesn't count: it chooses by its actions."""
        return self.main.act(self.trials, self.start, epsilon)

    def states(self, observations: Ints, materials: Ints) -> Ints:
        """Return what the builder sees: to the nested agent's state the main agent's choice is appended."""
        return np.column_stack((observations, materials)) if self.kind == "nested" else observations

    def rows(self, materials: Ints) -> Tensor:
        """Return the builder's row that acts in each trial: a hierarchy has one for each material."""
        return self.trials * len(WORTH) + torch.as_tensor(materials) if self.kind == "hierarchical" else self.trials


class Greedy(NamedTuple):
    """A greedy episode of each trial: its score, its cells step by step (steps, trials, 2), and what was built."""

    scores: Floats
    path: Ints
    built: Bools


def play(agent: Agent, arenas: Arenas) -> Greedy:
    """Play an episode of each trial without exploration, and without learning from it."""
    never = np.zeros(arenas.num_envs)
    materials = agent.choose(never)
    observations, _ = arenas.reset(options={"reset_mask": never == 0, "material": materials})
    path = [observations[:, :2]]
    for _ in range(STEP_LIMIT):
        actions = agent.builder.act(agent.rows(materials), agent.states(observations, materials), never)
        observations, _, _, _, info = arenas.step(actions)
        path.append(observations[:, :2])
    return Greedy(info["score"], np.stack(path), arenas.solid[:, 1:-1, 1:-1].copy())


# ------------------------------------------------------------------------------------------------------ Algorithm 1


class Training(NamedTuple):
    """What came of a training: greedy scores (trials, evaluations) after so many episodes (evaluations,)."""

    episodes: Ints
    scores: Floats
    agent: Agent


def epsilon_after(episodes: Ints, of: int, floor: float, share: float) -> Floats:
    """Return ε after so many episodes: from 1 it falls to its floor over a share of them all."""
    return 1.0 + (floor - 1.0) * np.minimum(episodes / (share * of), 1.0)


def train(settings: Settings, show: bool = False) -> Training:
    """Train every trial for all its episodes; with the same settings, the same again."""
    torch.set_num_threads(1)  # networks this small gain nothing from a second one
    design, count = DESIGNS[settings.design], settings.trials
    arenas, arenas_of_play = (Arenas(design, count, settings.agent == "single") for _ in range(2))
    agent = Agent(settings, arenas)
    evaluations = settings.episodes // settings.evaluate_every
    scores, began = np.zeros((count, evaluations)), time.monotonic()
    done, materials, ended = np.zeros(count, np.int64), np.zeros(count, np.int64), np.ones(count, np.bool_)
    observations, _ = arenas.reset()
    while (training := done < settings.episodes).any():
        if ended.any():
            chosen = agent.choose(epsilon_after(done, settings.episodes, settings.main_floor, settings.main_share))
            materials = np.where(ended, chosen, materials)
            observations, _ = arenas.reset(options={"reset_mask": ended, "material": materials})
        states, rows = agent.states(observations, materials), agent.rows(materials)
        actions = agent.builder.act(
            rows, states, epsilon_after(done, settings.episodes, settings.floor, settings.share)
        )
        observations, rewards, terminated, truncated, info = arenas.step(actions)
        following, on = agent.states(observations, materials), training
        agent.builder.store(rows[on], states[on], actions[on], rewards[on], following[on], terminated[on])
        agent.builder.learn(rows[on])

        ended = (terminated | truncated) & training
        if not ended.any():
            continue
        if settings.agent != "single":  # the main agent's transition is a whole episode, and its reward the score
            over = agent.trials[ended]
            agent.main.store(
                over, agent.start[ended], materials[ended], info["score"][ended], observations[ended, :3], ended[ended]
            )
            agent.main.learn(over)
        done += ended
        due = ended & (done % settings.evaluate_every == 0)
        if due.any():
            scores[due, done[due] // settings.evaluate_every - 1] = play(agent, arenas_of_play).scores[due]
            if show and due[0]:
                took = time.monotonic() - began
                print(
                    f"{done[0]} episodes, {took:.0f} s: greedy score {scores[0, done[0] // settings.evaluate_every - 1]:g}",
                    flush=True,
                )
    return Training((np.arange(evaluations) + 1) * settings.evaluate_every, scores, agent)


def interval(scores: Floats) -> tuple[float, float]:
    """Return the mean of the trials' scores (trials,), and half of its 95 % interval by Student's t; nan for one."""
    n = len(scores)
    if n < 2:
        return float(scores.mean()), float("nan")
    t = np.quantile(np.abs(np.random.default_rng(0).standard_t(n - 1, 1_000_000)), 0.95)
    return float(scores.mean()), float(t * scores.std(ddof=1) / n**0.5)


def main() -> int:
    """Train, and print the scores; returns the exit code."""
    parser = argparse.ArgumentParser(description="The paper's agents on one page; the file says what each option is.")
    for setting in fields(Settings):
        choices = {"agent": ["nested", "hierarchical", "single"], "design": list(DESIGNS)}.get(setting.name)
        name, default = "--" + setting.name.replace("_", "-"), setting.default
        parser.add_argument(name, type=type(default), default=default, choices=choices, help=f"[{default}]")
    settings = Settings(**vars(parser.parse_args()))
    if min(settings.trials, settings.episodes // max(settings.evaluate_every, 1)) < 1:
        parser.error("it takes a trial, and as many episodes as there are to an evaluation")
    done = train(settings, show=True)
    early = done.scores[:, done.episodes <= min(1000, settings.episodes // 3)].mean(axis=1)
    for name, scores in (("early", early), ("final", done.scores[:, -1])):
        print("{}: mean score {:.2f} ± {:.2f}".format(name, *interval(scores)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
