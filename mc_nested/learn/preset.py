"""Preset: all hyper-parameters of a training, as a TOML file that pydantic checks."""

from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, model_validator

from mc_nested.arena.action import LARGEST_SIZE, SMALLEST_SIZE
from mc_nested.errors import PresetError
from mc_nested.learn.dqn.engine import CNN, MLP, ORDER, REACH
from mc_nested.learn.dqn.engines import COMPILED, NUMBERS, OBJECTIVES
from mc_nested.learn.dqn.states import Sees
from mc_nested.toml_file import TomlTable, parse_toml, read_shipped_or_named

MOST = 1_000_000_000
"""The highest count of anything: it fits 32 bits, and no training comes near it."""

WIDEST, DEEPEST, LARGEST_BATCH = 4096, 16, 4096
"""The largest networks and batches: beyond them, a typo would fill the memory before anything else fails."""

MOST_UPDATES_A_STEP = 1000
"""More would take longer than a step of the slowest game."""

MOST_TABLE_STEPS, MOST_STEPS_OF_A_RETURN = 100_000_000, 1000
"""More imagined steps would take minutes; a return of more steps is longer than an episode."""

MOST_ARENAS = 1024
"""Arenas of a training side by side."""

MOST_BEFORE_PRACTICE = 250_000
"""Imagined transitions before the first update: as many as a practice keeps."""

Count = Annotated[int, Field(ge=1, le=MOST)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(gt=0, le=1)]
Probability = Annotated[float, Field(ge=0, le=1)]


class Exploration(TomlTable):
    """ε from ``start`` to ``floor`` over the first ``share`` of the episodes."""

    start: Probability = Field(description="ε in the first episode")
    floor: Probability = Field(description="ε at the end of its way, and from then on")
    share: Share = Field(description="the share of all episodes that its way takes")


class ExcursionRule(TomlTable):
    """Exploration from the best episode so far (return_then_explore.py), instead of ε."""

    at_end: Probability = Field(
        description="the share of excursions that follow the best episode to its end; the others leave it at a random "
        "step"
    )
    wander: Count = Field(description="the most steps that an excursion then wanders")
    rejoin: Probability = Field(
        description="the probability to follow the best episode's path again, each time it is met"
    )
    repeat: Probability = Field(description="the probability to place a block where that is known to be on the design")


class Imitation(TomlTable):
    """Self-imitation (self_imitation.py): a part of each batch comes from the best episode so far."""

    batch: Count = Field(description="how many transitions of a batch come from the best episode")
    margin: Positive = Field(description="by how much the value of its actions must exceed that of any other")
    td_weight: Probability = Field(
        default=1.0, description="what the batch's TD errors count for beside it: at 0 nothing is left but imitation"
    )


class Prioritized(TomlTable):
    """Prioritized replay (prioritized.py): transitions with large TD errors are drawn more often."""

    alpha: Probability = Field(description="how much priorities count; at 0 all transitions are drawn alike")
    beta: Probability = Field(description="how much of their bias is corrected; 1 is all of it")


class Update(TomlTable):
    """What an update of any agent does, and how many transitions there must be before the first."""

    batch: Annotated[int, Field(ge=1, le=LARGEST_BATCH)] = Field(description="transitions of an update")
    learning_starts: Count = Field(description="transitions that there must be before the first update")
    learning_rate: Positive = Field(description="Adam's")
    gamma: Probability = Field(description="γ: what a reward is worth a step later")
    target_period: Count = Field(description="updates from one renewal of the target network to the next")
    huber_delta: Positive = Field(description="Huber's δ: a TD error beyond it counts linearly, not by its square")


class MainUpdates(TomlTable):
    """When the main agent learns from its one transition an episode, and how many updates follow each of them."""

    learning_starts: Count = Field(description="its transitions that there must be before its first update")
    updates_an_episode: Annotated[int, Field(ge=1, le=MOST_UPDATES_A_STEP)] = Field(
        description="updates that follow each of its transitions"
    )


class ImaginationRule(TomlTable):
    """Practice in the learnt game between real episodes (imagination/), instead of exploring the real one by chance.

    A practice ends when the greedy policy scores ``enough`` of the best that is imaginable while cells are still to be
    found, or all of it afterwards; or after so many updates. The last four keys are parts that an ablation turns off.
    """

    highest_epsilon: Share = Field(description="an imagined episode has an ε of its own: at most this")
    lowest_epsilon: Share = Field(description="and at least this")
    enough: Share = Field(
        description="the share of the best imaginable score that ends a practice while cells are still to be found"
    )
    updates_exploring: Count = Field(description="the most updates of a practice while cells are still to be found")
    updates_building: Count = Field(description="the most updates of a practice afterwards")
    table_steps_exploring: Annotated[int, Field(ge=0, le=MOST_TABLE_STEPS)] = Field(
        description="before the networks, tables learn where to go: the most imagined steps of that while cells are "
        "still to be found; at 0 there are no tables"
    )
    table_steps_building: Annotated[int, Field(ge=0, le=MOST_TABLE_STEPS)] = Field(
        description="the most imagined steps of the tables afterwards"
    )
    n_steps: Annotated[int, Field(ge=1, le=MOST_STEPS_OF_A_RETURN)] = Field(
        description="how many rewards in a row a network's target adds up"
    )
    optimism: bool = Field(default=True, description="whether unknown cells are taken to pay")
    neighbours: bool = Field(default=True, description="whether those beside a paying one are taken to pay first")
    real_transitions: bool = Field(
        default=True, description="whether what happened is in the replay, beside what was imagined"
    )
    double: bool = Field(
        default=True, description="whether the online network chooses the action that the target network values"
    )

    @model_validator(mode="after")
    def _check(self) -> "ImaginationRule":
        if self.lowest_epsilon > self.highest_epsilon:
            raise ValueError("lowest_epsilon is above highest_epsilon: swap them")
        if self.neighbours and not self.optimism:
            raise ValueError("neighbours are a part of optimism: turn them off, too")
        return self


class ObjectivesRule(TomlTable):
    """The agent with objectives (learn/objectives/): trained on designs drawn at random, for any design.

    The nested agent learns first, from objectives drawn at random, until it has had ``nested_updates``. Then the main
    agent learns, for the training's episodes: a design is one of them.
    """

    largest: Annotated[int, Field(ge=SMALLEST_SIZE, le=LARGEST_SIZE)] = Field(
        description="cells a side of the largest arena that is trained in; the networks play in arenas of any size"
    )
    most_blocks: Count = Field(description="the most blocks of a design, but for one in five: as many as fit")
    nested_arenas: Annotated[int, Field(ge=1, le=MOST_ARENAS)] = Field(
        description="arenas side by side in which the nested agent learns"
    )
    main_arenas: Annotated[int, Field(ge=1, le=MOST_ARENAS)] = Field(description="and the main agent")
    nested_updates: Count = Field(description="updates of the nested agent, before the main agent begins")
    updates_a_round: Annotated[int, Field(ge=1, le=MOST_UPDATES_A_STEP)] = Field(
        description="updates after each round: a step of the nested agent in every arena, or an objective of the main "
        "agent in each"
    )
    step_cost: Probability = Field(description="what a step costs the main agent")
    highest_epsilon: Probability = Field(description="the main agent's ε has a floor in each arena: from 0 to this")
    any_start: Probability = Field(
        description="the share of designs that begin anywhere; the others in the middle of an edge"
    )
    main_update: Update = Field(description="what an update of the main agent does; [update] is the nested agent's")
    hindsight: bool = Field(
        default=True, description="whether the cell where a block landed instead was the objective, too"
    )
    nested_sees: Sees = Field(
        default="everything",
        description='what the nested agent sees beside where it is: "everything"; the "objective" without what stands; '
        'or the "surroundings" without the objective, as in the paper: then hindsight must be false',
    )

    @model_validator(mode="after")
    def _check(self) -> "ObjectivesRule":
        if self.hindsight and self.nested_sees == "surroundings":
            raise ValueError('hindsight changes the objective, and "surroundings" show none: add hindsight = false')
        return self


class Preset(TomlTable):
    """A training's hyper-parameters; ``paper`` is docs/explanation/task.md's table.

    With ``imagination`` it is played without ε.
    Without ``main``, the main agent learns as the paper's: by one update an episode, from [update] ``learning_starts``
    transitions on, of which it has one an episode.
    """

    episodes: Count = Field(description="training episodes of a trial")
    evaluate_every: Count = Field(
        description="episodes from one greedy evaluation to the next; with [imagination] they come whenever a whole "
        "design is known and its practice has reached the optimum, and at the end"
    )
    hidden: Annotated[list[Annotated[int, Field(ge=1, le=WIDEST)]], Field(min_length=1, max_length=DEEPEST)] = Field(
        description="nodes of each hidden layer"
    )
    replay_capacity: Count = Field(description="transitions that are kept; not used with [imagination]")
    update: Update
    encoding: Literal["scaled", "one-hot", "cell"] = Field(
        default="scaled",
        description='the network\'s input: "scaled" numbers, "one-hot" inputs for each value of x, y, b and a_M, or '
        '"cell" inputs for each cell (x, y) and for each value of b and a_M',
    )
    states: Literal["numbers", "image", "screen", "objectives"] = Field(
        default="numbers",
        description='what the agent sees: "numbers" x, y, b and a_M; an "image" of the arena from above, as planes of '
        'bytes; the game\'s window itself, the "screen", as its last four pictures in 84 x 84 greys; or "objectives", '
        "and what stands around them. All but numbers need the torch engine, and the screen a backend with a window",
    )
    engine: Literal["compiled", "torch"] = Field(
        default="compiled",
        description='what computes: "compiled" is the fast one, for an "mlp" over numbers; "torch" takes any network',
    )
    device: Literal["cpu", "cuda", "mps"] = Field(
        default="cpu", description="where the torch engine computes: the processor, an NVIDIA GPU, or a Mac's GPU"
    )
    network: str = Field(
        default="mlp",
        description='"mlp" has dense layers alone, with tanh (paper); "cnn" convolutions before them, for images; '
        '"reach" is for objectives; or your own, "my_module:make", where make(shape, actions) gives a torch module '
        "without buffers",
    )
    updates_a_step: Annotated[int, Field(ge=1, le=MOST_UPDATES_A_STEP)] = Field(
        default=1, description="updates after each step"
    )
    keep: Literal["last", "best"] = Field(
        default="last", description="the policy kept: the last, or the one that was best at greedy evaluation"
    )
    explore_main: Exploration | None = None
    explore_nested: Exploration | None = None
    excursions: ExcursionRule | None = None
    imitation: Imitation | None = None
    prioritized: Prioritized | None = None
    main: MainUpdates | None = None
    imagination: ImaginationRule | None = None
    objectives: ObjectivesRule | None = None

    def changed(self, **keys: Any) -> "Preset":
        """Return the preset with those keys changed, where they aren't None.

        Raise PresetError, one line, if they don't fit it.
        """
        wanted = {key: value for key, value in keys.items() if value is not None}
        try:
            return Preset.model_validate({**self.model_dump(), **wanted})
        except ValidationError as error:
            mistake = error.errors()[0]
            expected = str(mistake.get("ctx", {}).get("expected", "")).replace("'", "")
            reason = f"must be {expected}" if expected else mistake["ctx"]["error"]
            raise PresetError(
                f"with {', '.join(f'--{key} {value}' for key, value in wanted.items())}: {reason}"
            ) from error

    def for_main(self) -> "Preset":
        """Return the main agent's, which may begin to learn earlier, and with objectives has another network."""
        if self.objectives:
            return self.model_copy(update={"network": ORDER, "update": self.objectives.main_update})
        if self.main is None:
            return self
        update = self.update.model_copy(update={"learning_starts": self.main.learning_starts})
        return self.model_copy(update={"update": update})

    @model_validator(mode="after")
    def _check_engine(self) -> "Preset":
        network, states, device, encoding = self.network, self.states, self.device, self.encoding
        compiled, numbers = self.engine == COMPILED, states == NUMBERS
        rules = {
            f'states "{states}" need engine "torch": the compiled engine takes numbers alone': compiled and not numbers,
            f'network "{network}" needs engine "torch": the compiled engine has "mlp" alone': (
                compiled and network != MLP
            ),
            f'device "{device}" needs engine "torch": the compiled engine is for the processor': (
                compiled and device != "cpu"
            ),
            'states "objectives" and network "reach" go together': (states == OBJECTIVES) != (network == REACH),
            'network "cnn" needs states "image" or "screen": numbers have no neighbours': network == CNN and numbers,
            '[imagination] needs engine "compiled" and states "numbers"': (
                self.imagination and not (compiled and numbers)
            ),
            f'[excursions] go by x and y: with states "{states}", write [explore_nested]': (
                self.excursions and not numbers
            ),
            f'encoding "{encoding}" is for states "numbers": leave it out': encoding != "scaled" and not numbers,
            f'network "{network}": write "mlp", "cnn", or a module and its function, "my_module:make"': (
                network not in (MLP, CNN, REACH) and ":" not in network
            ),
        }
        for says, is_broken in rules.items():
            if is_broken:
                raise ValueError(says)
        return self

    @model_validator(mode="after")
    def _check_exploration(self) -> "Preset":
        ways = [way is not None for way in (self.explore_nested, self.excursions, self.imagination)]
        if sum(ways) != 1:
            raise ValueError("name one way to explore: [explore_nested], [excursions] or [imagination]")
        if (self.explore_main is None) != (self.imagination is not None):
            raise ValueError("[explore_main] goes with [explore_nested] or [excursions], and not with [imagination]")
        if (self.imagination is not None) != (self.encoding == "cell") or (self.imagination and len(self.hidden) < 2):
            raise ValueError('[imagination] takes encoding "cell", which only it can, and two hidden layers or more')
        if self.imagination and (self.prioritized or self.main):
            raise ValueError("[imagination] has its own replay and lessons: leave out [prioritized] and [main]")
        if self.imagination and self.update.learning_starts > MOST_BEFORE_PRACTICE:
            raise ValueError(f"[imagination] takes an [update] learning_starts of at most {MOST_BEFORE_PRACTICE:,}")
        if (self.objectives is not None) != (self.states == OBJECTIVES):
            raise ValueError('[objectives] goes with states "objectives"')
        if self.objectives and (self.prioritized or self.main or self.imitation or not self.explore_nested):
            raise ValueError("[objectives] has its own lessons: it takes [explore_main] and [explore_nested] alone")
        if self.imitation and not self.excursions:
            raise ValueError("[imitation] needs a best episode: add [excursions], or leave it out")
        if self.imitation and self.imitation.batch > self.update.batch:
            raise ValueError("[imitation] batch is a part of the [update] batch: no more than that")
        return self


def shipped_presets() -> list[str]:
    """Return the names of the presets that come with the project."""
    folder = resources.files("mc_nested.learn") / "presets"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


def load_preset(name_or_file: str | Path) -> Preset:
    """Return the preset of a shipped name or of a TOML file; PresetError, one line if it can't be used."""
    shipped = shipped_presets()
    text = read_shipped_or_named(name_or_file, "preset", "mc_nested.learn.presets", shipped, PresetError)
    return parse_preset(text, str(name_or_file))


def parse_preset(text: str, source: str) -> Preset:
    """Return the preset that a TOML text describes; ``source`` names it in errors."""
    return parse_toml(Preset, text, source, PresetError)
