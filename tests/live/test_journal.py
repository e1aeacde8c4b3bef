from mc_nested.arena.action import Action
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.live.journal import Journals
from mc_nested.live.live_game import LiveGame
from mc_nested.live.profile.tables import GameVersion, Profile
from sim.client.client import VirtualClient
from tests.live.notes import Notes
from tests.sim.client.playing import arena_of, connection_to


def test_the_journal_notes_an_action_from_its_beginning_to_its_outcome() -> None:
    client = VirtualClient(seed=3)
    scenario, notes = load_scenario("line"), Notes()
    connection = connection_to(client)
    connection.journal = notes
    profile = Profile(game=GameVersion(version=client.settings.version), arena=arena_of(client))
    with LiveGame(scenario, profile, connection) as game:
        game.reset(1)
        outcome = game.act(Action.L)
    known = {"placed": (), "pressed": (), "tick_phase": (0.0, 0.0, 0.0), "chat": ()}
    assert notes.of("resets") == [{"material": 1, **known}]
    assert notes.of("stands") == [{"cell": scenario.start}]
    assert str(notes.of("types")[0]["line"]).startswith("/")
    assert notes.of("acts") == [{"action": Action.L, "cell": scenario.start}]
    assert notes.of("plans")[0]["key"] == "a"
    (done,) = notes.of("done")
    assert (done["cell"], done["placed"]) == (outcome.cell, None)
    assert isinstance(done["seconds"], float)
    assert 0.1 < done["seconds"] < 1.0
    kinds = [kind for kind, _ in notes.taken]
    assert kinds.index("acts") < kinds.index("plans") < kinds.index("done")
    assert all("problem" in facts or facts["xyz"] is not None for facts in notes.of("reads"))


def test_several_journals_get_each_note() -> None:
    first, second = Notes(), Notes()
    Journals(first, Journals(), second).note("waits", on="the game")
    assert first.taken == second.taken == [("waits", {"on": "the game"})]
