import pytest

from tests.sim.client.game.commands.commanded import answer_to, realm


def test_a_fill_covers_both_corners_in_any_order() -> None:
    played = realm()
    assert answer_to("/fill 1 65 0 0 64 0 stone", played) == ("Successfully filled 4 block(s)", False)
    assert sorted(played.world.built()) == [(0, 64, 0), (0, 65, 0), (1, 64, 0), (1, 65, 0)]


@pytest.mark.parametrize(("version", "data"), [("1.12.2", "0 "), ("1.13", "")])
def test_a_fill_that_keeps_fills_air_alone(version: str, data: str) -> None:
    played = realm(version)
    played.world.put((0, 63, 0), "air")
    played.world.put((1, 63, 0), "sand")
    _, is_error = answer_to(f"/fill 0 63 0 2 63 0 stone {data}keep", played)
    assert not is_error
    assert played.world.built() == {(0, 63, 0): "stone", (1, 63, 0): "sand"}
    assert answer_to(f"/fill 0 63 0 2 63 0 stone {data}hollow", played)[1]


@pytest.mark.parametrize(("version", "answer"), [("1.12.2", "No blocks filled"), ("1.13", "No blocks were filled")])
def test_a_fill_that_changes_nothing_is_refused(version: str, answer: str) -> None:
    assert answer_to("/fill 0 64 0 1 64 0 air", realm(version)) == (answer, True)


def test_a_fill_of_32768_blocks_is_the_largest() -> None:
    assert answer_to("/fill 0 64 0 31 95 31 stone", realm()) == ("Successfully filled 32768 block(s)", False)
    text, is_error = answer_to("/fill 0 64 0 31 95 32 stone", realm())
    assert (text, is_error) == (
        "Too many blocks in the specified area (maximum 32768, specified 33792)",
        True,
    )


@pytest.mark.parametrize(
    ("version", "answer"), [("1.12.2", "The block couldn't be placed"), ("1.13", "Could not set the block")]
)
def test_a_block_that_is_there_already_is_refused(version: str, answer: str) -> None:
    assert answer_to("/setblock 0 63 0 dirt", realm(version)) == (answer, True)


def test_a_block_is_put_relative_to_the_player() -> None:
    played = realm()
    assert answer_to("/setblock ~1 ~ ~ stone", played) == ("Changed the block at 9, 64, 8", False)
    assert played.world.built() == {(9, 64, 8): "stone"}
