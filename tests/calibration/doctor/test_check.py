"""Checks: how a message becomes one, and their names."""

import json

from calibration.doctor.check import Check, CheckName, check_from_message


def test_an_error_is_what_is_wrong_and_what_to_do() -> None:
    assert check_from_message(CheckName.INPUT, "fail", "it broke: mend it: now") == Check(
        CheckName.INPUT, "fail", "it broke", "mend it: now"
    )
    assert check_from_message(CheckName.INPUT, "fail", "it broke").fix == ""


def test_no_row_has_the_name_of_another() -> None:
    assert len(CheckName.__members__) == len(set(CheckName)) == 31


def test_a_name_is_shown_and_written_as_its_value() -> None:
    assert f"{CheckName.WINDOW}" == str(CheckName.WINDOW) == "game's window"
    assert json.dumps(CheckName.SIZE_AND_SCALE) == '"size and GUI scale"'
