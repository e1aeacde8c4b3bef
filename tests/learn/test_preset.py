"""Presets: ``paper`` holds docs/explanation/task.md's table, and a mistake is refused in one line."""

import re
from pathlib import Path

import pytest
import tomlkit

from mc_nested.errors import PresetError
from mc_nested.learn.preset import Exploration, Preset, Update, load_preset, parse_preset, shipped_presets


def test_the_preset_paper_has_the_papers_hyper_parameters() -> None:
    assert load_preset("paper") == Preset(
        episodes=3000,
        evaluate_every=30,
        hidden=[32, 32],
        replay_capacity=1_000_000,
        update=Update(batch=32, learning_starts=32, learning_rate=1e-3, gamma=0.95, target_period=500, huber_delta=1.0),
        explore_main=Exploration(start=1.0, floor=0.01, share=0.18),
        explore_nested=Exploration(start=1.0, floor=0.001, share=0.6),
    )


@pytest.mark.parametrize("name", shipped_presets())
def test_every_shipped_preset_loads(name: str) -> None:
    assert load_preset(name).episodes > 0


PAPER = (Path(__file__).parents[2] / "mc_nested/learn/presets/paper.toml").read_text()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("batch = 32", "batch = 0"), "update.batch"),
        (("batch = 32", "batches = 32"), "update.batch"),
        (("evaluate_every", "momentum = 1\nevaluate_every"), "momentum"),
        (("share = 0.6", "share = 1.5"), "explore_nested.share"),
        (("hidden = [32, 32]", "hidden = []"), "hidden"),
        (("hidden = [32, 32]", "hidden = [1_000_000]"), "hidden.0"),
        (("replay_capacity = 1_000_000", f"replay_capacity = {10**30}"), "replay_capacity"),
        (("batch = 32", "batch = 1_000_000_000"), "update.batch"),
        (("learning_rate = 1e-3", "learning_rate = inf"), "update.learning_rate"),
        (("huber_delta = 1.0", "huber_delta = inf"), "update.huber_delta"),
        (("gamma = 0.95", "gamma = nan"), "update.gamma"),
        (("floor = 0.001", "floor = nan"), "explore_nested.floor"),
        (("episodes = 3000", "episodes = "), "not TOML"),
        (("[explore_nested]", "[excursions]"), "excursions."),
        (("[update]", 'encoding = "binary"\n[update]'), "encoding"),
        (
            ("[explore_nested]", "[imitation]\nbatch = 4\nmargin = 0.5\n[explore_nested]"),
            "[imitation] needs a best episode",
        ),
    ],
)
def test_a_mistake_is_refused_with_the_file_and_the_key(change: tuple[str, str], says: str) -> None:
    with pytest.raises(PresetError) as caught:
        parse_preset(PAPER.replace(*change, 1), "mine.toml")
    assert str(caught.value).startswith("mine.toml: ")
    assert says in str(caught.value)


def check_refused(text: str, change: tuple[str, str], says: str) -> None:
    """Raise AssertionError unless that preset, with this change, is refused in one line that holds ``says``."""
    assert change[0] in text
    with pytest.raises(PresetError) as caught:
        parse_preset(text.replace(*change, 1), "mine.toml")
    assert says in str(caught.value)
    assert "\n" not in str(caught.value)


TUNED = (Path(__file__).parents[2] / "mc_nested/learn/presets/tuned.toml").read_text()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (
            ("[imitation]", "[explore_nested]\nstart = 1.0\nfloor = 0.1\nshare = 0.5\n[imitation]"),
            "name one way to explore",
        ),
        (("[imitation]\nbatch = 8", "[imitation]\nbatch = 33"), "no more than that"),
        (("wander = 12", "wander = 0"), "excursions.wander"),
        (("updates_an_episode = 50", "updates_an_episode = 0"), "main.updates_an_episode"),
        (("updates_an_episode = 50", ""), "main.updates_an_episode"),
    ],
)
def test_mistakes_in_a_preset_with_excursions_are_refused_in_one_line(change: tuple[str, str], says: str) -> None:
    check_refused(TUNED, change, says)


MODEL_BASED = (Path(__file__).parents[2] / "mc_nested/learn/presets/model-based.toml").read_text()


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("lowest_epsilon = 0.001", "lowest_epsilon = 0.0"), "imagination.lowest_epsilon"),
        (("highest_epsilon = 1.0", "highest_epsilon = 1.5"), "imagination.highest_epsilon"),
        (("highest_epsilon = 1.0", "highest_epsilon = 0.0001"), "lowest_epsilon is above highest_epsilon: swap them"),
        (("enough = 0.9", "enough = 1.1"), "imagination.enough"),
        (("enough = 0.9", "enough = 0.0"), "imagination.enough"),
        (("updates_exploring = 60_000", "updates_exploring = 0"), "imagination.updates_exploring"),
        (("updates_building = 100_000", ""), "imagination.updates_building"),
        (('encoding = "cell"', 'encoding = "one-hot"'), '[imagination] takes encoding "cell"'),
        (("hidden = [128, 64]", "hidden = [64]"), "two hidden layers or more"),
        (("learning_starts = 1000", "learning_starts = 250_001"), "an [update] learning_starts of at most 250,000"),
        (("[imagination]", "[prioritized]\nalpha = 0.6\nbeta = 0.5\n[imagination]"), "leave out [prioritized]"),
        (("[imagination]", "[main]\nlearning_starts = 2\nupdates_an_episode = 5\n[imagination]"), "and [main]"),
        (
            ("[imagination]", "[explore_main]\nstart = 1.0\nfloor = 0.1\nshare = 0.5\n[imagination]"),
            "[explore_main] goes with [explore_nested] or [excursions]",
        ),
        (
            ("[imagination]", "[explore_nested]\nstart = 1.0\nfloor = 0.1\nshare = 0.5\n[imagination]"),
            "name one way to explore",
        ),
        (("[imagination]", "[imitation]\nbatch = 4\nmargin = 0.5\n[imagination]"), "needs a best episode"),
    ],
)
def test_settings_that_do_not_fit_imagination_are_refused_in_one_line(change: tuple[str, str], says: str) -> None:
    check_refused(MODEL_BASED, change, says)


ANY_DESIGN = (Path(__file__).parents[2] / "mc_nested/learn/presets/any-design.toml").read_text()


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ('nested_sees = "nothing"', "objectives.nested_sees"),
        ('nested_sees = "surroundings"', '"surroundings" show none: add hindsight = false'),
        ('hindsight = "off"', "objectives.hindsight"),
    ],
)
def test_mistakes_in_what_the_nested_agent_sees_are_refused_in_one_line(keys: str, says: str) -> None:
    check_refused(ANY_DESIGN, ("[objectives]", f"[objectives]\n{keys}"), says)


def test_a_nested_agent_that_isnt_told_its_objective_learns_without_hindsight() -> None:
    rule = parse_preset(
        ANY_DESIGN.replace("[objectives]", '[objectives]\nnested_sees = "surroundings"\nhindsight = false', 1),
        "mine.toml",
    ).objectives
    assert rule
    assert (rule.nested_sees, rule.hindsight) == ("surroundings", False)


@pytest.mark.parametrize("text", [PAPER, TUNED], ids=["paper", "tuned"])
def test_the_cell_encoding_is_refused_without_imagination(text: str) -> None:
    other = re.sub(r'encoding = "[^"]*".*\n', "", text)
    with pytest.raises(PresetError, match="which only it can"):
        parse_preset(other.replace("[update]", 'encoding = "cell"\n[update]', 1), "mine.toml")


def test_a_preset_without_imagination_needs_explore_main() -> None:
    without = re.sub(r"\[explore_main\][^\[]*", "", PAPER)
    with pytest.raises(PresetError, match=r"\[explore_main\] goes with"):
        parse_preset(without, "mine.toml")


@pytest.mark.parametrize("name", shipped_presets())
def test_a_saved_preset_is_read_back_unchanged(name: str) -> None:
    preset = load_preset(name)
    saved = tomlkit.dumps(preset.model_dump(exclude_none=True))
    assert parse_preset(saved, "config.toml") == preset


def test_an_unknown_preset_name_is_refused_with_the_known_ones() -> None:
    with pytest.raises(PresetError, match="no preset 'papr': name one of any-design, image, model-based, paper, tuned"):
        load_preset("papr")


def test_a_binary_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "bad.toml").write_bytes(b"\xff\xfe\x00")
    with pytest.raises(PresetError, match="not UTF-8 text"):
        load_preset(tmp_path / "bad.toml")


def test_the_main_agent_may_begin_to_learn_before_the_others() -> None:
    tuned = load_preset("tuned")
    assert (tuned.for_main().update.learning_starts, tuned.update.learning_starts) == (2, 32)
    assert load_preset("paper").for_main() == load_preset("paper")


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("enough = 0.9", "enough = 0.9\noptimism = false"), "neighbours are a part of optimism: turn them off, too"),
        (("enough = 0.9", "enough = 0.9\ndouble = 1"), "imagination.double"),
        (("table_steps_building = 60_000_000", "table_steps_building = -1"), "imagination.table_steps_building"),
        (("n_steps = 20", "n_steps = 0"), "imagination.n_steps"),
        (("n_steps = 20", "n_stepz = 20"), "imagination.n_stepz: unknown key: did you mean n_steps?"),
        (("table_steps_exploring", "# table_steps_exploring"), "imagination.table_steps_exploring: missing: add it"),
        (("lowest_epsilon = 0.001", "lowest_epsilon = 0.001\nhighest = 1"), "imagination.highest"),
    ],
)
def test_mistakes_in_imagination_are_refused_in_one_line(change: tuple[str, str], says: str) -> None:
    check_refused(MODEL_BASED, change, says)
