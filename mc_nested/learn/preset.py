"""Preset: all hyper-parameters of a training, as a TOML file that pydantic checks."""

from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, SerializerFunctionWrapHandler, model_serializer, model_validator

from mc_nested.errors import PresetError
from mc_nested.toml_file import parse_toml, read_shipped_or_named

MOST = 1_000_000_000
"""The highest count of anything: it fits 32 bits, and no training comes near it."""

WIDEST, DEEPEST, LARGEST_BATCH = 4096, 16, 4096
"""The largest networks and batches: beyond them, a typo would fill the memory before anything else fails."""

MOST_UPDATES_A_STEP = 1000
"""More would take longer than a step of the slowest game."""

MOST_TABLE_STEPS, MOST_STEPS_OF_A_RETURN = 100_000_000, 1000
"""More imagined steps would take minutes; a return of more steps is longer than an episode."""

MOST_BEFORE_PRACTICE = 250_000
"""Imagined transitions before the first update: as many as a practice keeps."""

Count = Annotated[int, Field(ge=1, le=MOST)]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False)]
Share = Annotated[float, Field(gt=0, le=1)]
Probability = Annotated[float, Field(ge=0, le=1)]


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True, strict=True)


class _GrownTable(_Table):
    """A table that has got keys since it was first saved: with their defaults, it keeps its identity."""

    @model_serializer(mode="wrap")
    def _dumped(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        dumped: dict[str, Any] = dump(self)
        fields = type(self).model_fields
        return {
            key: value for key, value in dumped.items() if fields[key].is_required() or value != fields[key].default
        }


class Exploration(_Table):
    """ε from ``start`` to ``floor`` over the first ``share`` of the episodes."""

    start: Probability
    floor: Probability
    share: Share


class ExcursionRule(_Table):
    """Exploration from the best episode so far (return_then_explore.py), instead of ε.

    ``at_end`` is the share of excursions that follow it to its end. The others leave it at a random step and wander at
    most ``wander`` steps. ``rejoin`` is the probability to follow its path again each time it is met, ``repeat`` the
    probability to place a block where that is known to be on the design.
    """

    at_end: Probability
    wander: Count
    rejoin: Probability
    repeat: Probability


class Imitation(_GrownTable):
    """Self-imitation (self_imitation.py): how much of each batch is from the best episode, and its actions' margin.

    ``td_weight`` is what the batch's TD errors count for beside it: at 0 nothing is left but imitation.
    """

    batch: Count
    margin: Positive
    td_weight: Probability = 1.0


class Prioritized(_Table):
    """Prioritized replay (prioritized.py): how much priorities count, and how much of their bias is corrected."""

    alpha: Probability
    beta: Probability


class Update(_Table):
    """What an update of any agent does, and how many transitions there must be before the first."""

    batch: Annotated[int, Field(ge=1, le=LARGEST_BATCH)]
    learning_starts: Count
    learning_rate: Positive
    gamma: Probability
    target_period: Count
    huber_delta: Positive


class MainUpdates(_Table):
    """When the main agent learns from its one transition an episode, and how many updates follow each of them."""

    learning_starts: Count
    updates_an_episode: Annotated[int, Field(ge=1, le=MOST_UPDATES_A_STEP)]


class ImaginationRule(_GrownTable):
    """Practice in the learnt game between real episodes (imagination/), instead of exploring the real one by chance.

    An imagined episode has an ε of its own, between the two. A practice ends when the greedy policy scores ``enough``
    of the best that is imaginable while cells are still to be found, or all of it afterwards; or after so many updates.
    Before it, tables learn where to go, for at most so many imagined ``table_steps``; at 0 there are none.
    ``n_steps`` is how many rewards in a row a network's target adds up.

    Parts that an ablation turns off: ``optimism`` takes unknown cells to pay, ``neighbours`` those beside a paying one
    first; ``real_transitions`` puts what happened into the replay of what was imagined; ``double`` lets the online
    network choose the action that the target network values.
    """

    highest_epsilon: Share
    lowest_epsilon: Share
    enough: Share
    updates_exploring: Count
    updates_building: Count
    table_steps_exploring: Annotated[int, Field(ge=0, le=MOST_TABLE_STEPS)]
    table_steps_building: Annotated[int, Field(ge=0, le=MOST_TABLE_STEPS)]
    n_steps: Annotated[int, Field(ge=1, le=MOST_STEPS_OF_A_RETURN)]
    optimism: bool = True
    neighbours: bool = True
    real_transitions: bool = True
    double: bool = True

    @model_validator(mode="before")
    @classmethod
    def _check_version(cls, table: object) -> object:
        needed = {"table_steps_exploring", "table_steps_building", "n_steps"}
        if not isinstance(table, Mapping) or table.keys() >= needed:
            return table
        is_misspelt = table.keys() & needed and table.keys() - cls.model_fields.keys()
        if not is_misspelt:
            raise ValueError(
                f"lacks {', '.join(sorted(needed - table.keys()))}: copy what is missing from the preset live; a run "
                "of an earlier version has to be trained anew"
            )
        return table

    @model_validator(mode="after")
    def _check(self) -> "ImaginationRule":
        if self.lowest_epsilon > self.highest_epsilon:
            raise ValueError("lowest_epsilon is above highest_epsilon: swap them")
        if self.neighbours and not self.optimism:
            raise ValueError("neighbours are a part of optimism: turn them off, too")
        return self


class Preset(_Table):
    """A training's hyper-parameters; ``paper`` is TASK.md's table.

    With ``imagination`` it is played without ε, and ``replay_capacity`` isn't used.
    Without ``main``, the main agent learns as the paper's: by one update an episode, from [update] ``learning_starts``
    transitions on, of which it has one an episode.
    """

    episodes: Count
    evaluate_every: Count
    hidden: Annotated[list[Annotated[int, Field(ge=1, le=WIDEST)]], Field(min_length=1, max_length=DEEPEST)]
    replay_capacity: Count
    update: Update
    encoding: Literal["scaled", "one-hot", "cell"] = "scaled"
    updates_a_step: Annotated[int, Field(ge=1, le=MOST_UPDATES_A_STEP)] = 1
    keep: Literal["last", "best"] = "last"
    explore_main: Exploration | None = None
    explore_nested: Exploration | None = None
    excursions: ExcursionRule | None = None
    imitation: Imitation | None = None
    prioritized: Prioritized | None = None
    main: MainUpdates | None = None
    imagination: ImaginationRule | None = None

    @model_serializer(mode="wrap")
    def _dumped(self, dump: SerializerFunctionWrapHandler) -> dict[str, Any]:
        """What was saved before there were these tables keeps its identity: without one, it isn't named."""
        dumped: dict[str, Any] = dump(self)
        for later in ("main", "imagination"):
            if getattr(self, later) is None:
                dumped.pop(later, None)
        return dumped

    def for_main(self) -> "Preset":
        """The main agent's, which may begin to learn earlier."""
        if self.main is None:
            return self
        update = self.update.model_copy(update={"learning_starts": self.main.learning_starts})
        return self.model_copy(update={"update": update})

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
        if self.imitation and not self.excursions:
            raise ValueError("[imitation] needs a best episode: add [excursions], or leave it out")
        if self.imitation and self.imitation.batch > self.update.batch:
            raise ValueError("[imitation] batch is a part of the [update] batch: no more than that")
        return self


def shipped_presets() -> list[str]:
    """Names of the presets that come with the project."""
    folder = resources.files("mc_nested.learn") / "presets"
    return sorted(entry.name.removesuffix(".toml") for entry in folder.iterdir() if entry.name.endswith(".toml"))


def load_preset(name_or_file: str | Path) -> Preset:
    """The preset of a shipped name or of a TOML file; PresetError, one line if it can't be used."""
    shipped = shipped_presets()
    text = read_shipped_or_named(name_or_file, "preset", "mc_nested.learn.presets", shipped, PresetError)
    return parse_preset(text, str(name_or_file))


def parse_preset(text: str, source: str) -> Preset:
    """The preset that a TOML text describes; ``source`` names it in errors."""
    return parse_toml(Preset, text, source, PresetError)
