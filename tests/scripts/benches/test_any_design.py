"""The bench of the networks for any design: its topics, and what counts as right."""

import json
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mc_nested.arena.action import Action, Cell
from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.arrays import Bools
from mc_nested.learn.dqn.states import Sees
from mc_nested.learn.objectives.arenas import framed, framed_cells, order_planes, outside, side_for
from mc_nested.learn.objectives.decide import ObjectiveAgent, Plan
from mc_nested.learn.preset import Preset
from mc_nested.learn.runs.run_folder import RunFolder
from scripts.bench import main
from scripts.benches import any_design
from scripts.benches.any_design import Order, TopicFigures, by_chance, drawn, judged, nearest
from tests.learn.made_experiments import run_config
from tests.learn.objectives.made_objectives import both_by_chance, small, training_of

LINE = load_scenario("line")
SIDE = side_for(5)


def test_the_shipped_networks_are_judged_by_what_they_build(capsys: pytest.CaptureFixture[str]) -> None:
    main(["any-design", "--designs", "1", "--json"])
    figures = json.loads(capsys.readouterr().out)
    assert list(figures) == ["designs of seed 2026", "designs of seed 2027", "shipped", "arenas of 20", "arenas of 30"]
    assert figures["shipped"]["whole"] == figures["shipped"]["of"] == 7
    assert figures["designs of seed 2027"]["of"] == 3


def test_a_design_that_isnt_built_whole_is_named() -> None:
    main, nested = both_by_chance(1)
    found = judged("blind", [LINE], lambda scenario: ObjectiveAgent(main, 0 * nested, scenario))
    assert found["whole"] == 0
    assert found["failed"] == ["line 0 of 11"]
    assert found["steps_against_the_builder"] is None


@pytest.mark.parametrize(("whole", "steps", "code"), [(100, 1.15, 0), (80, 1.0, 1), (100, 1.2, 1)])
def test_too_few_whole_designs_or_too_many_steps_are_a_failure(
    whole: int, steps: float, code: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    def figures(_: str, scenarios: Sequence[Scenario], __: object) -> TopicFigures:
        return TopicFigures(
            whole=len(scenarios) * whole // 100, of=len(scenarios), steps_against_the_builder=steps, failed=[]
        )

    monkeypatch.setattr(any_design, "judged", figures)
    monkeypatch.setattr(any_design, "drawn", lambda *_: [LINE] * 10)
    assert main(["any-design", "--json"]) == code


def test_large_designs_have_twenty_to_a_hundred_blocks_in_arenas_of_their_size() -> None:
    scenarios = drawn(5, 4, 20, any_design.MANY_BLOCKS)
    assert all(scenario.size == 20 and 20 <= scenario.blocks <= 100 for scenario in scenarios)
    assert scenarios[0].start == (10, 19)


def planes_of(wanted: set[Cell], stands: set[Cell], agent: Cell) -> Bools:
    """Return what the main agent sees of an arena of five cells a side."""
    occupied = outside(5, SIDE) | framed_cells(stands, SIDE)
    return order_planes(framed_cells(wanted, SIDE)[None], occupied[None], np.array([framed(agent)]))[0]


def chosen(order: Order, wanted: set[Cell], stands: set[Cell], agent: Cell) -> Cell:
    worth = order(planes_of(wanted, stands, agent))[0]
    x, y = np.unravel_index(worth.argmax(), worth.shape)
    return int(x) - 1, int(y) - 1


@pytest.mark.parametrize(
    ("wanted", "stands", "agent", "first"),
    [
        ({(0, 4), (2, 4)}, set(), (2, 0), (2, 4)),  # 3 steps to (2, 3), against 5 to (0, 3)
        ({(0, 2), (4, 1)}, set(), (2, 0), (4, 1)),  # 2 steps to (4, 0), against 3 to (0, 1)
        ({(1, 1), (2, 3)}, {(1, 0)}, (2, 0), (2, 3)),  # a block is where (1, 1) is built from
        (
            {(2, 3), (0, 2)},
            {(1, 1), (2, 1), (3, 1)},
            (2, 0),
            (0, 2),
        ),  # 6 steps round the wall to (2, 2), against 3 to (0, 1)
        ({(2, 3), (4, 4)}, {(x, 1) for x in range(5)}, (2, 2), (2, 3)),  # it stands before (2, 3) already
    ],
)
def test_the_nearest_is_the_cell_to_which_one_walks_the_fewest_steps_and_not_through_blocks(
    wanted: set[Cell], stands: set[Cell], agent: Cell, first: Cell
) -> None:
    assert chosen(nearest, wanted, stands, agent) == first


def test_the_nearest_is_found_at_the_end_of_the_longest_way() -> None:
    side = side_for(32)
    walls = {(x, y) for y in range(1, 31, 2) for x in range(32) if x != (31 if y % 4 == 1 else 0)}
    occupied = outside(32, side) | framed_cells(walls, side)
    planes, _ = order_planes(framed_cells({(4, 31), (5, 31)}, side)[None], occupied[None], np.array([framed((0, 0))]))
    assert nearest(planes)[0][framed((5, 31))] > nearest(planes)[0][framed((4, 31))] > 0


def test_chance_is_the_same_from_the_same_seed_and_takes_every_cell_to_build() -> None:
    wanted: set[Cell] = {(0, 1), (2, 3), (4, 4)}

    def choices(seed: int) -> list[Cell]:
        order = by_chance(seed)
        return [chosen(order, wanted, set(), (2, 0)) for _ in range(30)]

    assert choices(1) == choices(1) != choices(2)
    assert set(choices(1)) == wanted


@pytest.fixture
def a_run(tmp_path: Path) -> Callable[[Preset], str]:
    """Return what makes the folder of a training by a preset, whose networks learnt nothing."""

    def made(preset: Preset) -> str:
        training, (main, nested) = training_of(LINE, preset), both_by_chance(1)
        training.policies |= {"main": main[None], "low": nested[None]}
        folder = RunFolder.new(tmp_path / "run", run_config(LINE, preset=preset))
        folder.begin()
        folder.save(training, 0.0)
        return str(folder.path)

    return made


AgentFor = Callable[[Scenario], ObjectiveAgent]


@pytest.fixture
def judged_by(a_run: Callable[[Preset], str], monkeypatch: pytest.MonkeyPatch) -> Callable[..., AgentFor]:
    """Return what calls the bench with the run of a preset and options, and returns what makes the agents it judges."""
    made: list[AgentFor] = []

    def figures(_: str, __: Sequence[Scenario], agent_for: AgentFor) -> TopicFigures:
        made.append(agent_for)
        return TopicFigures(whole=0, of=1, steps_against_the_builder=1.0, failed=[])

    def judge(preset: Preset, *options: str) -> AgentFor:
        assert main(["any-design", "--run", a_run(preset), "--designs", "1", *options]) == 1
        return made[-1]

    monkeypatch.setattr(any_design, "judged", figures)
    return judge


@pytest.mark.parametrize("sees", ["everything", "objective"])
def test_a_training_is_judged_with_its_nested_agent_shown_what_it_was_then(
    sees: Sees, judged_by: Callable[..., AgentFor]
) -> None:
    agent = judged_by(small(nested_sees=sees))(replace(LINE, design=frozenset({(7, 7)})))
    blocks = frozenset((x, y) for x in range(0, 15, 2) for y in (4, 6))

    def actions(placed: frozenset[Cell]) -> list[Action]:
        return [agent.decide(Plan(), (x, y), placed)[0].action for x in range(15) for y in (3, 5)]

    assert (actions(blocks) == actions(frozenset())) == (sees == "objective")


def test_the_nearest_cell_takes_the_main_agents_place(judged_by: Callable[..., AgentFor]) -> None:
    assert judged_by(small(), "--main", "nearest")(LINE).order == nearest


def test_chance_in_the_main_agents_place_is_of_the_benchs_seed(judged_by: Callable[..., AgentFor]) -> None:
    planes = planes_of({(1, 1), (3, 3)}, set(), (0, 0))
    agent_for = judged_by(small(), "--main", "chance", "--seed", "4")
    for _ in range(2):  # of each design anew: it doesn't matter which ones came before
        assert np.array_equal(agent_for(LINE).order(planes), by_chance(4)(planes))


def test_networks_that_dont_see_everything_arent_shipped(
    a_run: Callable[[Preset], str], capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(any_design, "shipped_file", lambda: Path("/dev/null/nowhere"))
    run = a_run(small(nested_sees="objective"))
    with pytest.raises(SystemExit, match="2"):
        main(["any-design", "--run", run, "--designs", "1", "--ship"])
    assert f"--ship {run}: its nested agent sees the objective alone: ship one" in capsys.readouterr().err


def test_a_training_without_objectives_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    RunFolder.new(tmp_path / "run", run_config(LINE)).begin()
    with pytest.raises(SystemExit, match="2"):
        main(["any-design", "--run", str(tmp_path / "run")])
    assert "know no objectives: name a training with the preset any-design" in capsys.readouterr().err
