"""``mc-nested build``: a known design in the simulator, in a live game that fails, and on the virtual client."""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

import sim.worlds
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario, shipped_scenarios
from mc_nested.cli.build import build
from mc_nested.cli.output import json_fields
from mc_nested.errors import LiveError, NotInFrontError, StoppedError
from mc_nested.live.devices import Display
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.arena import Arena
from mc_nested.live.profile.store import save_profile
from mc_nested.live.profile.tables import Profile, WorldTable
from sim.client.client import VirtualClient
from tests.arena.made_games import TakesAtItsWord
from tests.cli.fragile_game import open_live
from tests.cli.running import run
from tests.design_files.written import HUT, picture, sponge
from tests.sim.client.playing import arena_of, play

COPIED = Arena.around((0, 64, 0), "south").model_copy(update={"copied_to": (-1, 100, -1)})
UNCOPIED = {"arena": Arena.around((0, 64, 0), "south")}


@pytest.fixture
def profile(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a user's profile ``mine``, whose arena has a copy of what stood there."""
    monkeypatch.setattr("mc_nested.live.profile.store.profile_folder", lambda: tmp_path / "config")
    path = tmp_path / "config" / "mine.toml"
    save_profile(Profile(arena=COPIED), path)
    return path


def test_a_shipped_design_is_built_of_the_best_material_and_shown(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", "diamond") == 0
    printed = capsys.readouterr()
    assert "diamond: 16 of 16 blocks on the design" in printed.out
    assert printed.out.splitlines()[-1] == "  built 16 of 16 blocks, of stone, in 52 steps"
    assert printed.err == ""


@pytest.mark.parametrize("words", [[], ["--agent"]])
@pytest.mark.parametrize("material", [[], ["--material", "wood"]])
@pytest.mark.parametrize("name", shipped_scenarios())
def test_each_action_of_a_shipped_design_is_announced_with_its_material(
    name: str,
    material: list[str],
    words: list[str],
    opened_games: list[TakesAtItsWord],
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert run("build", name, *material, *words) == 0
    (game,) = opened_games
    assert f"in {game.acts} steps" in capsys.readouterr().out
    assert game.kept == game.acts - 1
    assert game.following is None


def test_a_layer_of_a_schematic_is_built_of_the_material_that_is_named(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    assert run("build", tmp_path / "hut.schem", "--layer", "2", "--material", "wood") == 0
    assert "  built 2 of 2 blocks, of wood, in " in capsys.readouterr().out


def test_a_drawing_is_built(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "hut.png").write_bytes(picture(HUT[0]))
    assert run("build", tmp_path / "hut.png") == 0
    assert "  built 11 of 11 blocks, of stone, in " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (
            ["hut.schem"],
            "hut.schem: 3 of its layers have blocks, and only one can be built: name it with --layer, 0 to",
        ),
        (["hut.schem", "--layer", "3"], "hut.schem: layer 3 has no block: choose 0 to 2"),
        (["line", "--material", "gold"], "scenario line has no material 'gold': choose one of wood, stone"),
        (["line", "--layer", "0"], "line is a drawing of one layer: leave out --layer"),
        (["castle"], "no scenario 'castle': name one of line, zigzag"),
        (["short.toml"], "scenario short: the scripted builder takes 13 steps, and its step_limit is 11: raise it"),
        (["line", "--backend", "live", "--profile", "none.toml"], "no profile 'none.toml'"),
    ],
)
def test_impossible_build_is_refused_in_one_line_with_exit_code_2(
    words: list[str], says: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    grid = "\n".join(["." * 15] * 2 + ["." * 7 + "#" + "." * 7] * 11 + ["." * 15] * 2)
    (tmp_path / "short.toml").write_text(
        f'name = "short"\nstart = [7, 14]\nstep_limit = 11\ndesign = """\n{grid}\n"""\n'
        '[[materials]]\nname = "stone"\np = 0\nblock = "stone"\n'
    )
    monkeypatch.chdir(tmp_path)
    assert run("build", *words) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.startswith(f"mc-nested: {says}")
    assert printed.err.count("\n") == 1


def test_json_gives_scenario_blocks_material_and_steps(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", "line", "--json") == 0
    printed = capsys.readouterr()
    found = json.loads(printed.out)
    assert found.keys() == json_fields(build).keys()
    assert found == {
        "scenario": "line",
        "blocks": 11,
        "built": 11,
        "material": "stone",
        "steps": 13,
        "film": None,
        "score": 21.0,
        "optimum": 21.0,
        "unreachable": [],
    }
    assert printed.err == ""


def test_quiet_prints_only_the_result(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("build", "line", "--quiet") == 0
    assert capsys.readouterr() == ("  built 11 of 11 blocks, of stone, in 13 steps\n", "")


@pytest.mark.usefixtures("profile")
def test_live_build_says_how_to_put_back_the_earlier_ground(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, float("inf"))
    assert run("build", "line", "--backend", "live", "--profile", "mine") == 0
    printed = capsys.readouterr()
    undo = "what stood there before the arena was made comes back with mc-nested calibrate arena --undo --profile mine"
    assert printed.err == f"  building clears the arena first; {undo}\n"
    assert printed.out.splitlines()[-2:] == [
        "  built 11 of 11 blocks, of stone, in 13 steps",
        f"  it stands until the arena is cleared for the next episode; {undo}",
    ]


@pytest.mark.parametrize(
    ("changes", "words", "says"),
    [
        (UNCOPIED, ["--yes"], "the profile knows no copy of what stood there"),
        (
            {"world": WorldTable(folder="~/saves/one", name="one", template="~/kept/one")},
            [],
            "the world comes back from ~/kept/one with the next episode",
        ),
    ],
)
def test_live_build_says_first_if_there_is_no_copy_of_the_ground(
    changes: dict[str, object],
    words: list[str],
    says: str,
    profile: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    save_profile(Profile(arena=COPIED).model_copy(update=changes), profile)
    open_live(monkeypatch, 0, LiveError("it lagged"))
    assert run("build", "line", "--backend", "live", "--profile", "mine", *words) == 2
    assert says in capsys.readouterr().err.splitlines()[0]


def test_live_build_without_a_copy_of_the_ground_is_refused_unless_yes_is_given(
    profile: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    save_profile(Profile(arena=COPIED).model_copy(update=UNCOPIED), profile)
    open_live(monkeypatch, float("inf"))
    assert run("build", "line", "--backend", "live", "--profile", "mine") == 2
    assert capsys.readouterr().err == (
        "mc-nested: building clears the arena, and the profile knows no copy of what stood there before: make one with "
        "mc-nested calibrate arena --profile mine, or build anyway with --yes\n"
    )
    assert run("build", "line", "--backend", "live", "--profile", "mine", "--yes") == 0


@pytest.mark.usefixtures("profile")
@pytest.mark.parametrize(("failures", "code"), [(1, 0), (2, 0), (3, 2)])
def test_after_a_mishap_a_build_starts_over_twice_at_most(
    failures: int, code: int, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 5, LiveError("it lagged"), failures)
    assert run("build", "line", "--backend", "live", "--profile", "mine") == code
    printed = capsys.readouterr()
    assert printed.err.splitlines().count("it lagged; the episode starts over") == min(failures, 2)
    assert ("mc-nested: it lagged" in printed.err) is (code == 2)
    assert ("built 11 of 11 blocks" in printed.out) is (code == 0)


@pytest.mark.usefixtures("profile")
@pytest.mark.parametrize("error", [StoppedError("stopped by f12"), NotInFrontError("another window")])
def test_a_build_that_a_person_stops_does_not_start_over(
    error: LiveError, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    open_live(monkeypatch, 5, error, 1)
    assert run("build", "line", "--backend", "live", "--profile", "mine") == 2
    assert capsys.readouterr().err.splitlines()[-1] == f"mc-nested: {error}"


@pytest.mark.usefixtures("profile")
@pytest.mark.parametrize("mishaps_a_second", [None, 0.15])
@pytest.mark.parametrize("agent", [[], ["--agent"]])
def test_a_layer_is_built_block_for_block_on_the_virtual_client(
    agent: list[str],
    mishaps_a_second: float | None,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    client = VirtualClient(seed=4)
    if mishaps_a_second:
        client.mishaps.every(mishaps_a_second)

    @contextmanager
    def opened(scenario: Scenario, *_: object, **__: object) -> Iterator[tuple[LiveGame, Display]]:
        with play(client, scenario) as game:
            yield game, client.display

    monkeypatch.setattr(sim.worlds, "open_live_game", opened)
    words = ["--layer", "0", *agent, "--backend", "live", "--profile", "mine"]
    assert run("build", tmp_path / "hut.schem", *words) == 0
    printed = capsys.readouterr()
    assert "built 11 of 11 blocks, of stone" in printed.out
    assert bool(client.mishaps.happened) is bool(mishaps_a_second)
    rows = {8: (5, 6, 7, 8), 7: (5, 7, 8), 6: (5, 6, 7, 8)}
    assert client.placed(arena_of(client)) == {(x, y) for y, across in rows.items() for x in across}
    assert set(client.built.values()) == {"stone"}
    assert client.window.down == set()
    assert client.window.strays == []


def test_the_shipped_designs_are_all_built(capsys: pytest.CaptureFixture[str]) -> None:
    for name in ("zigzag", "islands", "house", "square", "flag"):
        assert run("build", name) == 0
        blocks = load_scenario(name).blocks
        assert f"built {blocks} of {blocks} blocks" in capsys.readouterr().out
