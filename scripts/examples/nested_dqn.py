"""Deep nested agents on one page: torch and gymnasium, and nothing else.

    python scripts/examples/nested_dqn.py
    python scripts/examples/nested_dqn.py --agent single --design diamond --trials 10

An agent builds a design of blocks on a floor of 15 x 15 cells (Brittain and Wei, 2018). It chooses a material, then it
lays block after block. The paper has three agents, which differ in who decides what:

nested        a main agent sees (x, y, b) and chooses; one nested agent sees (x, y, b, choice) and builds
hierarchical  a top agent sees (x, y, b) and chooses, and with the material one of two low-level agents, which builds
single        one agent sees (x, y, b, choice) and does both: two of its ten actions choose, the others build

b is how many blocks are left. Read it from the top: the task, the learner, the agents, Algorithm 1. Several trials
train side by side and share nothing: an array has a row for each of them.
"""

import argparse
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Any

import numpy as np
import torch
from gymnasium.spaces import Discrete, MultiDiscrete
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space
from numpy.typing import NDArray
from torch import Tensor
from torch.nn.functional import huber_loss

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# ---------------------------------------------------------------------------------------------------------- The task
SIZE = 15  # cells along a side of the floor: x to the right, y forward, from 0
START = (7, 14)  # where an episode begins: the middle of the far edge. The agent looks forward all the time
STEP_LIMIT = 60  # steps of the longest episode
WORTH = np.array([-5.0, 10.0])  # what wood and stone add to an episode's score; a block on the design adds 1
# F, B, L, R, then F+D, L+D, R+D, B+D, which place a block in front after the move.
MOVES = np.array([(0, 1), (0, -1), (-1, 0), (1, 0), (0, 1), (-1, 0), (1, 0), (0, -1)])
FIRST_TO_PLACE, NOTHING_CHOSEN = 4, -1
DESIGNS = {  # the cells to build on; there are as many blocks
    "line": [(7, y) for y in range(2, 13)],
    "zigzag": list(zip((7, 8, 9, 8, 7, 6, 5, 6, 7, 8, 9), range(2, 13), strict=True)),
    "diamond": [(x, y) for x in range(SIZE) for y in range(SIZE) if abs(x - 7) + abs(y - 7) == 4],
}


class Arenas(VectorEnv[Ints, Ints, Any]):
    """Arenas side by side. A block on the design is rewarded by 1; ``info["score"]`` is the episode's so far.

    With ``chooses`` they are the single agent's: actions 0 and 1 choose a material and earn what it is worth, 2 to 9
    build, and an observation (x, y, b, m) has m = 0 until the choice, then 1 or 2.
    """

    def __init__(self, design: str, count: int, chooses: bool = False) -> None:
        self.metadata = {"autoreset_mode": AutoresetMode.DISABLED}
        self.num_envs, self.chooses, self.blocks = count, chooses, len(DESIGNS[design])
        self.highest = np.array([SIZE - 1, SIZE - 1, self.blocks, len(WORTH)])[: 3 + chooses]
        self.single_observation_space: Any = MultiDiscrete(self.highest + 1)
        self.single_action_space: Any = Discrete(len(MOVES) + len(WORTH) * chooses)
        self.observation_space = batch_space(self.single_observation_space, count)
        self.action_space = batch_space(self.single_action_space, count)
        # Blocks, and a rim around the floor, since an edge stops whatever a block stops: cells count from 1 in here.
        self.solid = np.ones((count, SIZE + 2, SIZE + 2), np.bool_)
        self._design = np.zeros((SIZE + 2, SIZE + 2), np.bool_)
        self._design[tuple(np.transpose(DESIGNS[design]) + 1)] = True
        self._x, self._y, self._left, self._steps, self._material = np.ones((5, count), np.int64)
        self._score, self._running, self._all = np.zeros(count), np.zeros(count, np.bool_), np.arange(count)

    def reset(self, *, seed: Any = None, options: dict[str, Any] | None = None) -> tuple[Ints, dict[str, Any]]:  # noqa: ARG002
        """Begin episodes where ``options["reset_mask"]`` says so, with what is chosen in ``options["material"]``."""
        best = np.full(self.num_envs, WORTH.argmax())
        mask, material = ({"reset_mask": best >= 0, "material": best} | (options or {})).values()
        self.solid[mask, 1:-1, 1:-1] = False
        self._x[mask], self._y[mask] = START[0] + 1, START[1] + 1
        self._left[mask], self._steps[mask], self._running[mask] = self.blocks, 0, True
        self._material[mask] = NOTHING_CHOSEN if self.chooses else material[mask]
        self._score[mask] = 0 if self.chooses else WORTH[material[mask]]
        return self._seen(), {}

    def step(self, actions: Ints) -> tuple[Ints, Floats, Bools, Bools, dict[str, Floats]]:
        """Move, then place a block in front, wherever an episode is running."""
        building = actions - len(WORTH) * self.chooses  # below 0: a material
        first = self._running & (self._material == NOTHING_CHOSEN)
        choosing, acting = first & (building < 0), self._running & ~first & (building >= 0)
        self._material[choosing] = actions[choosing]
        x, y = self._x + MOVES[building, 0], self._y + MOVES[building, 1]
        moves = acting & ~self.solid[self._all, x, y]
        self._x[moves], self._y[moves] = x[moves], y[moves]
        x, y = self._x, self._y + 1
        lands = acting & (building >= FIRST_TO_PLACE) & ~self.solid[self._all, x, y]
        self.solid[self._all[lands], x[lands], y[lands]] = True
        rewards = WORTH[self._material] * choosing + (lands & self._design[x, y])
        self._score += rewards
        self._left -= lands
        self._steps += self._running
        terminated = self._running & ((self._left == 0) | (first & ~choosing))
        truncated = self._running & ~terminated & (self._steps >= STEP_LIMIT)
        self._running &= ~(terminated | truncated)
        return self._seen(), rewards, terminated, truncated, {"score": self._score.copy()}

    def _seen(self) -> Ints:
        return np.stack((self._x - 1, self._y - 1, self._left, self._material + 1)[: 3 + self.chooses], axis=1)


# ------------------------------------------------------------------------------------------------------- The learner
@dataclass(frozen=True)
class Settings:
    """What is trained, and how. P: the paper's; all else is chosen."""

    agent: str = "nested"  # or hierarchical, or single
    design: str = "line"  # or zigzag, or diamond
    trials: int = 1  # independent trainings, side by side
    seed: int = 0  # of all random choices
    episodes: int = 3000  # P: of each trial
    evaluate_every: int = 30  # P: episodes from one greedy episode to the next
    hidden: int = 32  # P: nodes of each of two hidden layers, tanh
    batch: int = 32  # P: transitions of an update; the first is made when there are so many
    replay: int = 1_000_000  # P: transitions that are kept
    learning_rate: float = 1e-3
    gamma: float = 0.95  # a reward is worth so much a step earlier
    target_period: int = 500  # updates from one renewal of the target network to the next
    floor: float = 0.001  # P: ε falls from 1 to so little,
    share: float = 0.6  # within this share of the episodes;
    main_floor: float = 0.01  # the main agent's stays higher
    main_share: float = 0.18  # and falls faster (P)


class Learners:
    """Double deep Q-learners in rows that share nothing; a state is whole numbers from 0 to ``highest``."""

    def __init__(self, rows: int, highest: Ints, actions: int, settings: Settings, random: torch.Generator) -> None:
        self.settings, self.actions, self.highest, self.random = settings, actions, torch.as_tensor(highest), random
        self.widths = (len(highest), settings.hidden, settings.hidden, actions)
        layers = [(2 * torch.rand(rows, (n + 1) * m, generator=random) - 1) / n**0.5 for n, m in pairwise(self.widths)]
        self.sizes, self.online = [layer.shape[1] for layer in layers], torch.cat(layers, dim=1)
        self.target, self.mean, self.square = self.online.clone(), *torch.zeros(2, *self.online.shape)
        self.updates, self.stored = torch.zeros(2, rows, dtype=torch.int64)
        self.parts = [len(highest), 1, 1, len(highest), 1]  # s, action, reward, s', whether the episode terminated
        self.replay = torch.empty(rows, min(settings.replay, settings.episodes * STEP_LIMIT), sum(self.parts))

    def values(self, parameters: Tensor, states: Tensor) -> Tensor:
        """Return Q (k, batch, actions) of networks (k, parameters) in states (k, batch, width), which are scaled."""
        nodes = 2 * states / self.highest - 1
        for layer, flat in enumerate(parameters.split_with_sizes(self.sizes, dim=1)):
            weights = flat.view(len(flat), -1, self.widths[layer + 1])  # the last row is the bias
            nodes = torch.baddbmm(weights[:, -1:], nodes.tanh() if layer else nodes, weights[:, :-1])
        return nodes

    def act(self, rows: Tensor, states: Ints, epsilon: Floats) -> Ints:
        """Return ε-greedy actions (k,) of the named rows (k,)."""
        with torch.no_grad():
            greedy = self.values(self.online[rows], torch.as_tensor(states)[:, None])[:, 0].argmax(1)
        explores = torch.rand(len(rows), generator=self.random) < torch.as_tensor(epsilon)
        return torch.where(explores, torch.randint(self.actions, greedy.shape, generator=self.random), greedy).numpy()

    def store(self, rows: Tensor, *transition: NDArray[Any]) -> None:
        """Store s, action, reward, s' and whether the episode terminated, each (k, …), in the named rows (k,)."""
        numbers = torch.cat([torch.as_tensor(part).view(len(rows), -1).float() for part in transition], dim=1)
        self.replay[rows, self.stored[rows] % self.replay.shape[1]] = numbers  # the oldest makes room
        self.stored[rows] += 1

    def learn(self, rows: Tensor) -> None:
        """Update each of the named rows once, from a batch of its own, where there is one."""
        rows = rows[self.stored[rows] >= self.settings.batch]
        if not len(rows):
            return
        held = self.stored[rows, None].clamp(max=self.replay.shape[1])
        drawn = (torch.rand(len(rows), self.settings.batch, generator=self.random) * held).long()
        states, actions, rewards, following, over = self.replay[rows[:, None], drawn].split_with_sizes(self.parts, -1)
        parameters = self.online[rows].requires_grad_()
        with torch.no_grad():
            online, target = self.values(parameters, following), self.values(self.target[rows], following)
            aims = ddqn_target(rewards, over, online, target, self.settings.gamma)
        losses = huber_loss(self.values(parameters, states).gather(-1, actions.long()), aims, reduction="none")
        (gradient,) = torch.autograd.grad(losses.mean(1).sum(), parameters)
        # Adam, by hand: rows that learn at different times have made different numbers of updates.
        self.updates[rows] += 1
        count = self.updates[rows, None]
        self.mean[rows] = mean = self.mean[rows].lerp(gradient, 0.1)
        self.square[rows] = square = self.square[rows].lerp(gradient**2, 0.001)
        step = mean / (1 - 0.9**count) / ((square / (1 - 0.999**count)).sqrt() + 1e-8)
        self.online[rows] -= self.settings.learning_rate * step
        due = rows[self.updates[rows] % self.settings.target_period == 0]
        self.target[due] = self.online[due]


def ddqn_target(rewards: Tensor, over: Tensor, online: Tensor, target: Tensor, gamma: float) -> Tensor:
    """Return r + γ Q'(s', argmax Q(s', ·)), (…, 1), of both networks' values of s', (…, actions); ``over``: 0 or 1."""
    best = online.argmax(-1, keepdim=True)  # the online network chooses,
    return rewards + gamma * (1 - over) * target.gather(-1, best)  # the target network says what that is worth


# -------------------------------------------------------------------------------------------------------- The agents
class Agent:
    """One of the paper's agents in every trial: who acts, and what it sees. A single agent has no use for its main."""

    def __init__(self, settings: Settings, arenas: Arenas) -> None:
        self.kind, self.trials = settings.agent, torch.arange(arenas.num_envs)
        self.start = np.tile([*START, arenas.blocks], (arenas.num_envs, 1))
        random = torch.Generator().manual_seed(settings.seed)
        self.main = Learners(arenas.num_envs, arenas.highest[:3], len(WORTH), settings, random)
        rows = arenas.num_envs * (len(WORTH) if self.kind == "hierarchical" else 1)
        highest = np.array([*arenas.highest, len(WORTH) - 1] if self.kind == "nested" else arenas.highest)
        self.builder = Learners(rows, highest, int(arenas.single_action_space.n), settings, random)

    def rows(self, materials: Ints) -> Tensor:
        """Return which of the builder's rows acts in each trial: a hierarchy has one for each material."""
        return self.trials * len(WORTH) + torch.as_tensor(materials) if self.kind == "hierarchical" else self.trials

    def states(self, observations: Ints, materials: Ints) -> Ints:
        """Return what the builder sees: the nested agent's state is s_N = [s_M, a_M]."""
        return np.column_stack((observations, materials)) if self.kind == "nested" else observations


def play(agent: Agent, arenas: Arenas) -> Floats:
    """Play one greedy episode of each trial, of which nothing is learnt; return the scores (trials,)."""
    greedily = np.zeros(arenas.num_envs)
    materials = agent.main.act(agent.trials, agent.start, greedily)
    seen, _ = arenas.reset(options={"material": materials})
    for _ in range(STEP_LIMIT):
        actions = agent.builder.act(agent.rows(materials), agent.states(seen, materials), greedily)
        seen, _, _, _, info = arenas.step(actions)
    return info["score"]


# ------------------------------------------------------------------------------------------------------- Algorithm 1
def epsilon_after(done: Ints, episodes: int, floor: float, share: float) -> Floats:
    """Return ε (trials,) after so many of all episodes: from 1 it falls to its floor within a share of them."""
    return 1 + (floor - 1) * np.minimum(done / (share * episodes), 1)


def train(settings: Settings, show: bool = False) -> tuple[Ints, Floats, Agent]:
    """Return after how many episodes (evaluations,) which greedy scores were (trials, evaluations), and the agent."""
    torch.set_num_threads(1)  # with networks this small a second one only waits for the first
    arenas, stage = (Arenas(settings.design, settings.trials, settings.agent == "single") for _ in range(2))
    agent = Agent(settings, arenas)
    scores = np.zeros((settings.trials, settings.episodes // settings.evaluate_every))
    done, materials = np.zeros((2, settings.trials), np.int64)
    begins = np.ones(settings.trials, np.bool_)
    while (training := done < settings.episodes).any():
        if begins.any():
            epsilon = epsilon_after(done, settings.episodes, settings.main_floor, settings.main_share)
            materials = np.where(begins, agent.main.act(agent.trials, agent.start, epsilon), materials)
            seen, _ = arenas.reset(options={"reset_mask": begins, "material": materials})
        rows, states = agent.rows(materials), agent.states(seen, materials)
        actions = agent.builder.act(
            rows, states, epsilon_after(done, settings.episodes, settings.floor, settings.share)
        )
        seen, rewards, terminated, truncated, info = arenas.step(actions)
        following = agent.states(seen, materials)
        step = states, actions, rewards, following, terminated
        agent.builder.store(rows[training], *(part[training] for part in step))
        agent.builder.learn(rows[training])

        ended = terminated | truncated
        if ended.any() and settings.agent != "single":  # to a main agent, an episode is one step and its score r_M
            episode = agent.start, materials, info["score"], seen[:, :3], ended
            agent.main.store(agent.trials[ended], *(part[ended] for part in episode))
            agent.main.learn(agent.trials[ended])
        done += ended
        begins = ended & (done < settings.episodes)
        evaluated = ended & (done % settings.evaluate_every == 0)
        if evaluated.any():
            scores[evaluated, done[evaluated] // settings.evaluate_every - 1] = play(agent, stage)[evaluated]
            if show and evaluated[0]:
                print(f"{done[0]} episodes: score {scores[0, done[0] // settings.evaluate_every - 1]:g}", flush=True)
    return (1 + np.arange(scores.shape[1])) * settings.evaluate_every, scores, agent


def interval(values: Floats) -> tuple[float, float]:
    """Return the mean of several trials' values (trials,), and how far its 95 % interval reaches (Student's t)."""
    trials = len(values)
    draws = np.random.default_rng(0).standard_t(max(trials - 1, 1), 1_000_000)
    spread = values.std(ddof=1) / trials**0.5 if trials > 1 else np.inf
    return float(values.mean()), float(np.quantile(np.abs(draws), 0.95) * spread)


def main() -> None:
    """Train, and print the scores."""
    parser = argparse.ArgumentParser(description="The paper's agents on one page. class Settings says more.")
    choices = {"agent": ["nested", "hierarchical", "single"], "design": list(DESIGNS)}
    for setting in fields(Settings):
        name, default, among = setting.name.replace("_", "-"), setting.default, choices.get(setting.name)
        parser.add_argument(f"--{name}", type=type(default), default=default, choices=among, help=f"[{default}]")
    settings = Settings(**vars(parser.parse_args()))
    counts = settings.trials, settings.batch, settings.hidden, settings.target_period, settings.evaluate_every
    if min(*counts, settings.replay) < 1 or settings.episodes < settings.evaluate_every:
        parser.error("whole numbers have to be 1 at least, and episodes no fewer than from one evaluation to the next")
    episodes, scores, _ = train(settings, show=True)
    early = episodes <= max(settings.evaluate_every, min(1000, settings.episodes // 3))
    print("early: {:.2f} ± {:.2f}".format(*interval(scores[:, early].mean(axis=1))))
    print("final: {:.2f} ± {:.2f}".format(*interval(scores[:, -1])))


if __name__ == "__main__":
    main()
