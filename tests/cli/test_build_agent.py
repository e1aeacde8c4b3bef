"""``mc-nested build --agent``: what the shipped agent builds, what it can't reach, and where it fails."""

import json
from collections.abc import Callable, Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

import numpy as np
import pytest
from safetensors.numpy import save

import mc_nested.cli.build
import sim.worlds
from mc_nested.arena.action import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.errors import LiveError
from mc_nested.learn.evaluation import BuildStep
from mc_nested.learn.objectives import weights
from mc_nested.learn.objectives.weights import shipped_weights
from mc_nested.live.devices import Display
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile
from sim.client.client import VirtualClient
from tests.cli.fragile_game import open_live
from tests.cli.running import run
from tests.cli.shown import objectives_shown
from tests.design_files.written import HUT, picture, sponge
from tests.report.films import pictures_of
from tests.sim.client.playing import arena_of, connection_to

LOW = """
name = "low"
start = [3, 6]
step_limit = 60
design = '''
.......
.#####.
.#...#.
.#...#.
.#...#.
.#...#.
.##.##.
'''
[[materials]]
name = "stone"
p = 10.0
block = "stone"
"""
"""17 blocks, four of them in the nearest row."""


@pytest.fixture
def low(tmp_path: Path) -> Path:
    path = tmp_path / "low.toml"
    path.write_text(LOW)
    return path


@pytest.fixture
def profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have a profile ``mine``, whose arena has a copy of what stood there."""
    monkeypatch.setattr("mc_nested.live.profile.store.profile_folder", lambda: tmp_path / "config")
    copied = Arena.around((0, 64, 0), "south").model_copy(update={"copied_to": (-1, 100, -1)})
    save_profile(Profile(arena=copied), tmp_path / "config" / "mine.toml")


def acts(monkeypatch: pytest.MonkeyPatch, *actions: Action, material: int = 1) -> None:
    """Have the agent take these actions, and no others."""
    steps = [BuildStep((action, material), None, (7, 3)) for action in actions]
    monkeypatch.setattr(mc_nested.cli.build, "_by_the_agent", lambda *_: lambda _: iter(steps))


@pytest.mark.parametrize(("name", "score"), [("house", 50.0), ("flag", 36.0)])
def test_the_agent_builds_shipped_designs_whole(name: str, score: float, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", name, "--agent", "--json") == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert found["built"] == found["blocks"]
    assert (found["score"], found["optimum"], found["unreachable"]) == (score, score, [])
    assert printed.err == ""


def test_it_builds_otherwise_than_the_scripted_builder(capsys: pytest.CaptureFixture[str]) -> None:
    steps = []
    for words in ([], ["--agent"]):
        assert run("build", "house", "--json", *words) == 0
        steps.append(json.loads(capsys.readouterr().out)["steps"])
    assert steps[0] > steps[1]


@pytest.mark.parametrize(
    ("file", "content", "words", "blocks"),
    [("hut.schem", sponge(HUT), ["--layer", "0"], 11), ("hut.png", picture(HUT[0]), [], 11)],
)
def test_a_layer_and_a_picture_are_built(
    file: str, content: bytes, words: list[str], blocks: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / file).write_bytes(content)
    assert run("build", tmp_path / file, *words, "--agent", "--material", "wood", "--quiet") == 0
    assert capsys.readouterr().out.startswith(f"  built {blocks} of {blocks} blocks, of wood, in ")


def test_cells_out_of_reach_are_named_first_and_all_else_is_built(
    low: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("build", low, "--agent", "--json") == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert (found["blocks"], found["built"], found["score"], found["optimum"]) == (17, 13, 23.0, 23.0)
    assert found["unreachable"] == [[1, 0], [2, 0], [4, 0], [5, 0]]
    where = "(1, 0), (2, 0), (4, 0), (5, 0)"
    assert printed.err == f"  no block can land on {where}: out of the agent's reach; it builds the other 13\n"
    assert run("build", low, "--agent", "--quiet") == 0
    printed = capsys.readouterr()
    assert printed.out.startswith("  built 13 of 17 blocks")
    assert printed.err == ""


@pytest.mark.usefixtures("profile")
def test_in_a_game_it_is_said_before_the_first_block_what_is_out_of_reach(
    low: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 0, LiveError("it lagged"))
    assert run("build", low, "--agent", "--backend", "live", "--profile", "mine") == 2
    said = capsys.readouterr().err.splitlines()
    assert said[1].startswith("  no block can land on (1, 0)")
    assert said[2] == "it lagged; the episode starts over"


@pytest.mark.parametrize(
    ("change", "words", "says"),
    [
        (("", ""), [], "low.toml: design: cell (1, 0) can't be reached"),
        (("#", "."), ["--agent"], "low.toml: design: has no block"),
        ((".#####.\n.#...#.\n.#...#.\n.#...#.\n.#...#.", ".......\n" * 5), ["--agent"], "cell (1, 0) can't be reached"),
        (("step_limit = 60", "step_limit = 12"), ["--agent"], "12 steps can't place 13 blocks: raise it"),
        ((".......", "." * 33), ["--agent"], "row 1 has 33 characters: draw a square, 5 to 32 rows"),
        (("", ""), ["--agent", "--material", "gold"], "scenario low has no material 'gold': choose one of stone"),
        (("", ""), ["--agent", "--layer", "0"], "low.toml is a drawing of one layer: leave out --layer"),
    ],
)
def test_a_drawing_of_which_nothing_can_be_built_is_refused_in_one_line(
    change: tuple[str, str], words: list[str], says: str, low: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    low.write_text(LOW.replace(*change) if change[0] else LOW)
    assert run("build", low, *words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith("mc-nested: ")
    assert says in printed.err
    assert printed.err.count("\n") == 1


def of_another_version(path: Path) -> None:
    main, nested = shipped_weights()
    path.write_bytes(save({"main": main[:-1], "nested": nested}))


def without_a_number(path: Path) -> None:
    main, nested = shipped_weights()
    main[7] = np.nan
    path.write_bytes(save({"main": main, "nested": nested}))


@pytest.mark.parametrize(
    ("write", "says"),
    [
        (lambda _: None, "can't be read (No such file or directory): install the package again"),
        (lambda path: path.write_bytes(b"no weights"), "is broken ("),
        (lambda path: path.write_bytes(b""), "is broken ("),
        (of_another_version, "its weights are of another version ("),
        (without_a_number, "is broken (main: not all of it is finite): install the package again"),
    ],
)
def test_weights_that_cannot_be_used_are_an_error_before_anything_is_opened(
    write: Callable[[Path], None],
    says: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    file = tmp_path / weights.FILE
    write(file)
    monkeypatch.setattr(weights, "FILE", str(file))
    assert run("build", "line", "--agent") == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"mc-nested: {file}: {says}")
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize(
    ("actions", "built", "why"),
    [
        ([Action.B] * 60, 0, "its step_limit of 60 was reached: raise it, or build without --agent"),
        ([Action.B, Action.BD], 0, "it gave up the others: build without --agent"),
        ([Action.L, *[Action.BD] * 11], 0, "it laid the others off the design: build without --agent"),
        ([Action.B, Action.B, Action.BD], 1, "it gave up the others: build without --agent"),
    ],
)
def test_an_agent_that_fails_says_why_after_its_result_and_keeps_the_film(
    actions: list[Action],
    built: int,
    why: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    acts(monkeypatch, *actions)
    film = tmp_path / "film.gif"
    assert run("build", "line", "--agent", "--json", "--video", film) == 2
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert (found["built"], found["score"], found["steps"]) == (built, 10.0 + built, len(actions))
    assert printed.err == f"mc-nested: the agent built {built} of 11 blocks in reach, {why}\n"
    assert len(pictures_of(film)) > 1


@pytest.mark.parametrize(
    ("change", "says"),
    [
        (("step_limit = 60", "step_limit = 13"), "of 13 blocks in reach, its step_limit of 13 was reached: raise it\n"),
        (("", ""), "of 13 blocks in reach, it gave up the others\n"),
    ],
    ids=["too few steps", "given up"],
)
def test_a_remedy_is_named_only_where_it_would_help(
    change: tuple[str, str], says: str, low: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    low.write_text(LOW.replace(*change) if change[0] else LOW)
    acts(monkeypatch, *[Action.B] * (13 if change[0] else 2), material=0)
    assert run("build", low, "--agent", "--quiet") == 2
    assert capsys.readouterr().err.endswith(says), "the scripted builder can't build it either"


def test_the_arena_the_view_and_the_film_show_what_the_agent_is_after(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown = objectives_shown(monkeypatch)
    acts(monkeypatch, Action.B, Action.BD)
    assert run("build", "line", "--agent", "--video", tmp_path / "film.gif") == 2
    assert shown.drawn == shown.published == shown.filmed == [(7, 3), (7, 3), None]
    shown.drawn.clear()
    assert run("build", "line") == 0
    assert set(shown.drawn) == {None}
    assert "@" not in capsys.readouterr().out


def test_the_agent_builds_on_the_virtual_client(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", "line", "--agent", "--backend", "virtual", "--quiet") == 0
    said = capsys.readouterr().out.splitlines()
    assert said[0].startswith("  built 11 of 11 blocks, of stone, in ")
    assert "s an action (median); walking " in said[1]


@contextmanager
def left_standing(scenario: Scenario, cells: Collection[Cell]) -> Iterator[tuple[LiveGame, Display]]:
    """Open a game where a block hangs over each of these cells, at the head: too high for what a reset clears."""
    client = VirtualClient(seed=4)
    arena = Arena.around(arena_of(client).origin, "south", height=1)
    for x, y, z in map(arena.block_of, cells):
        client.realm.world.put((x, y + 1, z), "stone")
    with LiveGame(scenario, Profile(arena=arena), connection_to(client)) as game:
        yield game, client.display
    assert client.window.down == set()


@pytest.mark.usefixtures("profile")
@pytest.mark.parametrize(
    ("cells", "reached"),
    [([(7, 12)], (7, 12)), ([(7, 13), (6, 14), (8, 14)], (7, 13))],
    ids=["an obstacle", "a start that is walled in"],
)
def test_an_obstacle_in_a_game_that_a_reset_cannot_clear_is_an_error_and_what_was_filmed_is_kept(
    cells: list[Cell],
    reached: Cell,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.setattr(sim.worlds, "open_live_game", lambda scenario, _: left_standing(scenario, cells))
    acts(monkeypatch, Action.BD, Action.B)
    film = tmp_path / "film.gif"
    words: list[str | Path] = ["build", "line", "--agent", "--backend", "live", "--profile", "mine", "--video", film]
    assert run(*words) == 2
    said = capsys.readouterr().err.splitlines()
    why = f"cell {reached} was not reached in 8 tries, the agent is at "
    assert [line.startswith(why) for line in said].count(True) == 2  # it starts over twice
    assert said[-2] == f"film of what was played: {film}"
    assert said[-1].startswith(f"mc-nested: {why}")
    assert "is something in the way" in said[-1]
    assert pictures_of(film)
