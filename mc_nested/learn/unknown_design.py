"""The agent with objectives where nobody tells it the design: what it believes takes the design's place.

Beliefs come from what the real steps were paid (learn/imagination/). Whenever a block has landed, they say which cells
the next ones are for (beliefs.py), and the two networks that come with the package get there. Nothing is trained
between two episodes: the agent is what it has seen.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.vector import NO_ACTION
from mc_nested.arrays import Arrays, Bools, Float64s, Int64s, named_parts, part_of
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.exploration.schedules import NEVER
from mc_nested.learn.imagination.beliefs import Belief, Beliefs, believe, candidates, count_try
from mc_nested.learn.imagination.experience import Experience, RealStep
from mc_nested.learn.imagination.imagination import GivenFacts
from mc_nested.learn.imagination.known_arena import KnownArena, known_arena
from mc_nested.learn.imagination.material_choice import scores_of_materials
from mc_nested.learn.objectives.arenas import framed, framed_cells, outside, reached_from, side_for
from mc_nested.learn.objectives.decide import ObjectiveAgent, Plan
from mc_nested.learn.objectives.weights import Weights, agent_for_cells
from mc_nested.learn.practice import Practice, Step
from mc_nested.learn.preset import Preset

ANY_DESIGN = "any-design"
"""The preset by which the networks that come with the package were trained."""

EPISODES = 200
"""Episodes of a training, at most, unless their number is given."""

LANDS = (0, 1)
"""Where a block lands, seen from the agent: its networks have learnt that in the simulator."""


@dataclass
class _Episode:
    """Where one run is in its episode: the blocks and steps that are left, what is built, and what it is about."""

    left: int
    steps: int
    placed: frozenset[Cell] = frozenset()
    builder: ObjectiveAgent | None = None
    plan: Plan = field(default_factory=Plan)


class UnknownDesigns(Agent):
    """The agent with objectives in R runs, each of which finds its design. It has no learners.

    Its policy, what it keeps, is the cells that it knows to pay, and what it thinks that each material brings.

    Args:
        weights: of both networks.
        given: of each run; all arenas are of one size, with the same number of materials.
    """

    def __init__(self, weights: Weights, given: Sequence[GivenFacts]) -> None:
        self.runs, self.builders, self.spec = tuple(range(len(given))), 1, AGENT_SPECS["nested"]
        self.size, self.main = given[0].size, None
        self._sees, self._numbered, self._team = "numbers", False, None
        self._weights, self._given_facts = weights, given
        self.networks, self.parameters = len(weights), sum(map(len, weights))
        self.seen = [Experience() for _ in given]
        # What every try so far has shown, and what it had before the episode that runs.
        self.evidence = np.zeros((len(given), 2, self.size, self.size))
        self.before = self.evidence.copy()
        self._materials_now = np.zeros(len(given), dtype=np.int64)
        self._episodes = [_Episode(each.start[2], each.step_limit) for each in given]
        self._given: Arrays = {}

    def _learners(self) -> dict[str, Any]:
        return {}

    def begin_episodes(self, runs: Int64s) -> Int64s:
        for run in runs.tolist():
            self._begin(run)
            self._materials_now[run] = self._worth(run).argmax()
        chosen: Int64s = self._materials_now[runs]
        return chosen

    def chosen_materials(self, observations: NDArray[Any]) -> Int64s:  # noqa: ARG002 - it remembers what it chose
        now: Int64s = self._materials_now.copy()
        return now

    def act(self, states: NDArray[Any], materials: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:  # noqa: ARG002 - no chance
        """Return what every run does next, (runs,); each call is a step of its episode."""
        actions = [self._next(run, row, self._episodes[run]) for run, row in enumerate(states.tolist())]
        return np.array(actions, dtype=np.int64)

    def foretold(self, states: NDArray[Any], materials: Int64s, epsilon: Float64s, uniforms: Float64s) -> Int64s:  # noqa: ARG002 - no chance
        """Return what ``act`` will; NO_ACTION where that depends on what the block before it is paid."""
        actions = np.full(len(states), NO_ACTION)
        for run, row in enumerate(states.tolist()):
            now = self._episodes[run]
            if row[2] == now.left or not self.beliefs(run).explores:
                actions[run] = self._next(run, row, replace(now))
        return actions

    def see(self, run: int, step: RealStep) -> None:
        """See what the last action did, and whether it was paid."""
        self.seen[run].add(step)
        if step.next_blocks < step.blocks:
            count_try(self.evidence[run], (step.next_x + LANDS[0], step.next_y + LANDS[1]), step.paid)

    def beliefs(self, run: int) -> Beliefs:
        """Return what that run thinks of every cell."""
        if self._given:
            pays = self._given["pays"][run].reshape(self.size, self.size)
            cells = np.where(pays, Belief.PAYS, Belief.PAYS_NOT).astype(np.int8)
            return Beliefs(cells, pays.astype(np.float32), False, float(pays.sum()))
        return believe(self.evidence[run], LANDS, self._given_facts[run].start[2])

    def episodes(self, run: int) -> int:
        return self.seen[run].episodes

    def known_arena(self, run: int) -> KnownArena:
        return known_arena(self.seen[run], LANDS, self.beliefs(run))

    def online(self) -> Arrays:
        """Return the cells that are known to pay, (runs, cells), and what each material brings, (runs, materials)."""
        pays = [(self.beliefs(run).cells == Belief.PAYS).ravel() for run in self.runs]
        return {"pays": np.array(pays), "worth": np.array([self._worth(run) for run in self.runs])}

    def load_online(self, online: Mapping[str, NDArray[Any]]) -> None:
        times = len(self.runs) // max(len(online["pays"]), 1)
        self._given = {name: np.tile(online[name], (times, 1)) for name in ("pays", "worth")}

    def rows_of(self, run: int) -> dict[str, slice]:
        return dict.fromkeys(("pays", "worth"), slice(run, run + 1))

    def state(self) -> Arrays:
        """Return what each run has seen, and the material that it has in hand, by name."""
        seen = named_parts({str(run): seen.state() for run, seen in enumerate(self.seen)})
        return {"materials": self._materials_now, "before": self.before, **seen}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Continue from what ``state`` returned: the steps of an episode that runs lead to where it is."""
        self.before[:] = self.evidence[:] = state["before"]
        self._materials_now[:] = state["materials"]
        for run, seen in enumerate(self.seen):
            kept = part_of(state, str(run))
            first = int(kept["first_of_episode"][-1]) if len(kept["first_of_episode"]) else 0
            seen.load({**kept, "steps": kept["steps"][:first]})
            self._begin(run)
            for step in (RealStep(*row) for row in kept["steps"][first:].tolist()):
                self._next(run, step[:3], self._episodes[run])
                self.see(run, step)

    def _begin(self, run: int) -> None:
        here = self._given_facts[run]
        self._episodes[run] = _Episode(here.start[2], here.step_limit)

    def _worth(self, run: int) -> Float64s:
        """Return what an episode of each material would bring that run, (materials,)."""
        if self._given:
            worth: Float64s = self._given["worth"][run]
            return worth
        here = self._given_facts[run]
        return scores_of_materials(self.seen[run].extras, here.materials, here.start[2], self.beliefs(run).most)

    def _next(self, run: int, state: Sequence[int], now: _Episode) -> int:
        """Return what that run does in a state (x, y, b, …) of its episode, which goes on to there."""
        cell, left = (state[0], state[1]), state[2]
        if left < now.left:
            now.left, now.placed, now.builder = left, now.placed | {(cell[0] + LANDS[0], cell[1] + LANDS[1])}, None
        if now.builder is None and left:
            buildable = self._buildable(cell, now.placed)
            in_time = buildable & (self._steps_to(cell) <= now.steps)
            wanted = candidates(self.beliefs(run), in_time if in_time.any() else buildable, cell, left)
            if wanted:
                now.builder = agent_for_cells(self._weights, wanted, self.size)
                now.plan = Plan(blocks=len(now.placed))
        now.steps -= 1
        if now.builder is None:
            return int(Action.F)
        decision, now.plan = now.builder.decide(now.plan, cell, now.placed)
        return int(decision.action)

    def _steps_to(self, cell: Cell) -> Int64s:
        """Return the steps from there until a block lands in each cell, (size, size), if nothing stands in the way."""
        stands = np.array(cell) + LANDS
        steps: Int64s = np.abs(np.indices((self.size, self.size)) - stands[:, None, None]).sum(0) + 1
        return steps

    def _buildable(self, cell: Cell, placed: frozenset[Cell]) -> Bools:
        """Return where a block can land now, (size, size)."""
        side = side_for(self.size)
        stands = outside(self.size, side) | framed_cells(placed, side)
        reached = reached_from(stands, *framed(cell), np.empty((side * side, 2), np.int64))
        return ~stands[1:-1, 1:-1] & reached[1:-1, :-2]


def playing(preset: Preset) -> Preset:
    """Return the preset of a training in which nothing is trained: no ε, and the best policy is kept."""
    changes = {"episodes": EPISODES, "keep": "best", "explore_main": NEVER, "explore_nested": NEVER}
    return preset.model_copy(update=changes)


class Tries(Practice):
    """What a run sees of its episodes is all that it learns. It is evaluated once it knows enough cells."""

    evaluate_every = 1

    def __init__(self, agent: UnknownDesigns, preset: Preset) -> None:
        super().__init__(agent, preset)
        self.known = self._player = agent

    def before_episode(self, runs: Int64s, materials: Int64s, reset: Callable[[], None]) -> Bools:  # noqa: ARG002 - no chance
        reset()
        return np.array([not self._player.beliefs(run).explores for run in runs.tolist()])

    def is_settled(self, run: int) -> bool:  # noqa: ARG002 - it always does what it foretells
        return True

    def begin(self, runs: Int64s, numbers: Float64s) -> None:  # noqa: ARG002 - nothing is drawn
        for run in runs.tolist():
            self._player.seen[run].begin()
            self._player.before[run] = self._player.evidence[run]

    def learn(self, step: Step) -> None:
        for run in step.running.nonzero()[0].tolist():
            before, after = step.observations[run].tolist(), step.next_observations[run].tolist()
            done = [*before, int(step.actions[run]), *after, int(step.rewards[run] > 0), int(step.materials[run])]
            self._player.see(run, RealStep(*done))

    def end(self, runs: Int64s, materials: Int64s, scores: Float64s) -> None:
        for run in runs.tolist():
            self._player.seen[run].end(int(materials[run]), float(scores[run]))
