"""The Envs of gymnasium.make and make_vec: over the simulator, and over a live game on the virtual client."""

import gc
import subprocess
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv

import mc_nested  # noqa: F401 - importing it registers the Env
from mc_nested.arena.action import Action
from mc_nested.arena.builder import build
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.errors import LiveError, ProfileError, RecordingError, ScenarioError, UserError
from mc_nested.live.recording.replayed_run import replay
from mc_nested.live.session import Opening
from sim.client.client import VirtualClient
from sim.grid import GridGame, GridVectorEnv
from tests.arena.env_contract import check_env_contract
from tests.arena.game_contract import BUMPS
from tests.design_files.written import HUT, picture, sponge
from tests.live.virtual_session import ARENA, live_on, profile_in
from tests.sim.client.playing import FONT

ID = "mc_nested/Arena-v0"
LINE = load_scenario("line")
ROOT = Path(__file__).resolve().parent.parent


def live_env(client: VirtualClient, folder: Path, **options: Any) -> gymnasium.Env[Any, Any]:
    return gymnasium.make(
        ID, backend="live", profile=profile_in(folder), open_live=live_on(client), **{"record": "off", **options}
    )


class Opened:
    """A live game that is the simulator's, and whether it is open."""

    def __init__(self) -> None:
        self.is_open = False
        self.asked: tuple[object, ...] = ()

    @contextmanager
    def open(self, scenario: Any, opening: Opening) -> Iterator[tuple[Any, None]]:
        self.asked = (scenario.name, opening.profile, opening.is_server_allowed)
        self.is_open = True
        try:
            yield GridGame(scenario), None
        finally:
            self.is_open = False


@pytest.mark.parametrize("render_mode", ["rgb_array", "ansi"])
@pytest.mark.parametrize("scenario", ["line", "zigzag", "diamond"])
def test_gymnasiums_checker_passes_without_a_warning(scenario: str, render_mode: str) -> None:
    env = gymnasium.make(ID, scenario=scenario, render_mode=render_mode)
    check_env(env.unwrapped)


def test_the_simulated_env_keeps_the_contract() -> None:
    check_env_contract(gymnasium.make(ID), LINE, BUMPS)


@pytest.mark.slow
def test_a_live_env_keeps_the_contract_and_gymnasiums_checker_passes(tmp_path: Path) -> None:
    client = VirtualClient(seed=1)
    env = live_env(client, tmp_path)
    check_env_contract(env, LINE, BUMPS)
    check_env(env.unwrapped, skip_render_check=True)
    env.close()
    assert client.window.down == set()
    assert client.window.strays == []


def test_a_live_env_builds_in_the_window_and_draws_the_placed_blocks(tmp_path: Path) -> None:
    client = VirtualClient()
    env = live_env(client, tmp_path, scenario="line", render_mode="rgb_array")
    env.reset(options={"material": "stone"})
    before = env.render()
    assert env.step(Action.BD)[0].tolist() == [7, 13, 10]
    assert client.placed(ARENA) == {(7, 14)}
    assert set(client.built.values()) == {"stone"}
    assert (np.asarray(env.render()) != before).any()
    env.close()
    assert client.window.down == set()


def test_a_live_game_that_breaks_down_raises_and_goes_on_after_a_reset(tmp_path: Path) -> None:
    client = VirtualClient()
    env = live_env(client, tmp_path)
    env.reset()
    client.set_front(is_in_front=False)
    with pytest.raises(LiveError, match="not in front"):
        env.step(Action.B)
    assert client.window.down == set()
    with pytest.raises(ResetNeeded):
        env.step(Action.B)
    client.set_front(is_in_front=True)
    env.reset()
    assert env.step(Action.B)[0].tolist() == [7, 13, 11]
    env.close()


def test_a_live_env_keeps_a_recording_that_replays(tmp_path: Path) -> None:
    kept = tmp_path / "recording"
    env = live_env(VirtualClient(), tmp_path, scenario="line", record=kept)
    env.reset()
    for action in (Action.BD, Action.L):
        env.step(action)
    env.close()
    replayed = replay(kept, FONT)
    assert (replayed.actions, replayed.followed, replayed.differences) == (2, 2, [])
    with pytest.raises(RecordingError, match="holds something already"):
        live_env(VirtualClient(), tmp_path, record=kept)


def test_make_passes_the_scenario_the_profile_and_server_allowed_to_the_live_game() -> None:
    game = Opened()
    env = gymnasium.make(
        ID, scenario="diamond", backend="live", profile="mine", server_allowed=True, open_live=game.open
    )
    assert game.asked == ("diamond", "mine", True)
    env.close()


def test_closing_an_env_closes_its_game_and_closing_again_does_nothing() -> None:
    game = Opened()
    env = gymnasium.make(ID, backend="live", open_live=game.open)
    env.reset()
    assert game.is_open
    env.close()
    assert not game.is_open
    env.close()
    with pytest.raises(ResetNeeded):
        env.step(0)


def test_an_env_that_is_dropped_closes_its_game() -> None:
    game = Opened()
    env = gymnasium.make(ID, backend="live", open_live=game.open)
    del env
    gc.collect()
    assert not game.is_open


def test_an_env_left_open_is_closed_when_the_program_ends() -> None:
    program = (
        # Registered before anything else, it is asked after all that others have registered.
        "import atexit; atexit.register(lambda: print('open' if game.is_open else 'closed'))\n"
        "import gymnasium, mc_nested\nfrom tests.test_entry_point import Opened\ngame = Opened()\n"
        f"env = gymnasium.make('{ID}', backend='live', open_live=game.open)\nenv.reset()\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, cwd=ROOT)
    assert (done.stdout, done.stderr) == ("closed\n", "")


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
@pytest.mark.parametrize(
    ("options", "error", "says"),
    [
        ({"scenario": "castle"}, ScenarioError, "no scenario 'castle'"),
        ({"backend": "real"}, UserError, 'there is no backend \'real\': choose "sim" or "live"'),
        ({"backend": "live", "profile": "nobody"}, ProfileError, "no profile"),
    ],
)
def test_invalid_options_of_make_are_refused_in_one_line(
    make: Callable[..., object], options: dict[str, str], error: type[Exception], says: str
) -> None:
    with pytest.raises(error, match=says) as caught:
        make(ID, **options)
    assert "\n" not in str(caught.value)


@pytest.fixture
def hut(tmp_path: Path) -> Path:
    (tmp_path / "hut.schem").write_bytes(sponge(HUT))
    return tmp_path / "hut.schem"


def test_make_takes_a_layer_of_a_design_file(hut: Path, capsys: pytest.CaptureFixture[str]) -> None:
    env = gymnasium.make(ID, scenario=str(hut), layer=2)
    scenario = env.get_wrapper_attr("scenario")
    assert (scenario.name, env.reset()[0].tolist()) == ("hut-2", [7, 14, 2])
    for action in build(scenario):
        *_, info = env.step(action)
    assert info["score"] == scenario.optimum
    assert capsys.readouterr().err == ""


def test_the_lowest_layer_with_blocks_is_taken_and_reported_if_none_is_named(
    hut: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert gymnasium.make(ID, scenario=hut).get_wrapper_attr("scenario").name == "hut-0"
    assert capsys.readouterr().err.splitlines() == [
        "hut.schem, layer 0: the lowest of 3 layers with blocks, layer= takes another",
        "hut.schem, layer 0: its blocks are built of one material: 10 stone, 1 oak_stairs",
    ]


def test_make_takes_a_picture_as_a_design(tmp_path: Path) -> None:
    (tmp_path / "dot.png").write_bytes(picture(HUT[0]))
    assert gymnasium.make(ID, scenario=tmp_path / "dot.png").get_wrapper_attr("scenario").name == "dot"


@pytest.mark.parametrize("mode", [None, "sync"])
def test_every_vectorization_mode_takes_a_design_file(mode: str | None, hut: Path) -> None:
    envs = gymnasium.make_vec(ID, num_envs=2, vectorization_mode=mode, scenario=hut, layer=1)
    assert envs.reset()[0].tolist() == [[7, 14, 6]] * 2


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
def test_a_live_game_takes_a_design_file(make: Callable[..., Any], hut: Path) -> None:
    game = Opened()
    env = make(ID, scenario=hut, layer=1, backend="live", open_live=game.open)
    assert game.asked[0] == "hut-1"
    env.close()


@pytest.mark.parametrize("make", [gymnasium.make, gymnasium.make_vec])
@pytest.mark.parametrize(
    ("scenario", "layer", "says"),
    [
        ("HUT", 9, "HUT: layer 9 is above its highest: choose 0 to 2"),
        ("HUT.nbt", None, "HUT.nbt: there is no such file: check its name and folder"),
        ("line", 0, "line is a drawing of one layer: leave out layer="),
        (LINE, 0, "line is a Scenario, which has one layer: leave out layer="),
    ],
)
def test_an_unusable_design_file_or_layer_is_refused_in_one_line(
    make: Callable[..., object], scenario: Any, layer: int | None, says: str, hut: Path
) -> None:
    named = scenario.replace("HUT", str(hut)) if isinstance(scenario, str) else scenario
    with pytest.raises(ScenarioError) as caught:
        make(ID, scenario=named, layer=layer)
    assert str(caught.value) == says.replace("HUT", str(hut))


def test_make_vec_without_a_mode_makes_arrays_of_arenas_with_autoreset() -> None:
    envs = gymnasium.make_vec(ID, num_envs=3, scenario="diamond")
    assert isinstance(envs.unwrapped, GridVectorEnv)
    assert envs.metadata["autoreset_mode"] is AutoresetMode.NEXT_STEP
    assert envs.reset()[0].tolist() == [[7, 14, 16]] * 3


@pytest.mark.parametrize("mode", [None, "vector_entry_point", "sync", pytest.param("async", marks=pytest.mark.slow)])
def test_every_mode_of_make_vec_steps_as_single_envs_do(mode: str | None) -> None:
    envs = gymnasium.make_vec(ID, num_envs=3, scenario="line", vectorization_mode=mode)
    singles = [gymnasium.make(ID, scenario="line") for _ in range(3)]
    options = {"material": "wood"}
    seen, _ = envs.reset(seed=5, options=options)
    assert seen.tolist() == [env.reset(seed=5 + run, options=options)[0].tolist() for run, env in enumerate(singles)]
    again = [False] * 3
    random = np.random.default_rng(5)
    for _ in range(150):
        actions = random.choice(8, 3, p=[0.05, 0.2, 0.1, 0.1, 0.1, 0.1, 0.1, 0.25])
        observations, rewards, terminated, truncated, info = envs.step(actions)
        for run, env in enumerate(singles):
            expected: tuple[Any, ...] = (
                (env.reset()[0], 0.0, False, False, {}) if again[run] else env.step(actions[run])
            )
            assert observations[run].tolist() == expected[0].tolist()
            assert (rewards[run], terminated[run], truncated[run]) == expected[1:4]
            assert ("score" in info and bool(info["_score"][run])) == ("score" in expected[4])
            assert "score" not in expected[4] or info["score"][run] == expected[4]["score"]
            again[run] = expected[2] or expected[3]
    envs.close()


@pytest.mark.parametrize("mode", [None, "sync"])
def test_every_vectorization_mode_draws_each_arena(mode: str | None) -> None:
    envs = gymnasium.make_vec(ID, num_envs=2, vectorization_mode=mode, render_mode="rgb_array")
    envs.reset()
    envs.step(np.array([Action.BD, Action.B]))
    first, second = envs.render() or ()
    assert np.shape(first) == (240, 240, 3)
    assert (np.asarray(first) != second).any()
    assert envs.metadata["render_fps"] == 4


def test_arenas_without_a_render_mode_draw_nothing() -> None:
    assert gymnasium.make_vec(ID, num_envs=2).render() is None


def test_autoreset_can_be_turned_off() -> None:
    envs = gymnasium.make_vec(ID, num_envs=2, autoreset_mode="Disabled")
    assert envs.metadata["autoreset_mode"] is AutoresetMode.DISABLED
    envs.reset()
    for action in build(LINE):
        envs.step(np.array([action, Action.F]))
    observations, *_ = envs.step(np.array([Action.F, Action.B]))
    assert observations.tolist() == [[7, 1, 0], [7, 13, 11]]
    assert envs.reset(options={"reset_mask": np.array([True, False])})[0].tolist() == [[7, 14, 11], [7, 13, 11]]


def test_an_unsupported_autoreset_mode_is_refused_with_the_way_to_get_it() -> None:
    with pytest.raises(UserError, match='vectorization_mode="sync"'):
        gymnasium.make_vec(ID, num_envs=2, autoreset_mode="SameStep")
    envs = gymnasium.make_vec(ID, num_envs=2, vectorization_mode="sync", vector_kwargs={"autoreset_mode": "SameStep"})
    assert envs.metadata["autoreset_mode"] is AutoresetMode.SAME_STEP


@pytest.mark.parametrize("mode", [None, "sync"])
def test_a_live_game_runs_as_one_arena_of_a_vector_env_that_closes_the_game(mode: str | None) -> None:
    game = Opened()
    envs: VectorEnv[Any, Any, Any] = gymnasium.make_vec(
        ID, vectorization_mode=mode, scenario="line", backend="live", open_live=game.open
    )
    assert isinstance(envs, SyncVectorEnv) == (mode == "sync")
    envs.reset()
    for action in [*build(LINE), Action.F]:
        observations, *_ = envs.step(np.array([action]))
    assert observations.tolist() == [[7, 14, 11]]
    envs.close()
    assert not game.is_open


def test_several_live_arenas_are_refused() -> None:
    with pytest.raises(UserError, match="a live game is one arena, not 3"):
        gymnasium.make_vec(ID, num_envs=3, backend="live")


def test_making_a_simulated_env_imports_neither_torch_nor_code_that_reads_a_screen() -> None:
    program = (
        f"import sys, gymnasium, mc_nested; gymnasium.make('{ID}').reset(); "
        "print([name for name in ('torch', 'cv2', 'mss', 'matplotlib', 'mc_nested.live') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, cwd=ROOT)
    assert (done.stdout, done.stderr) == ("[]\n", "")
