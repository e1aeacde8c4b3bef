"""Checks: how a message becomes one, and their names."""

import json

from calibration.doctor.check import Check, CheckName, check_from_message


def test_error_message_is_split_at_its_first_colon_into_detail_and_fix() -> None:
    assert check_from_message(CheckName.INPUT, "fail", "it broke: mend it: now") == Check(
        CheckName.INPUT, "fail", "it broke", "mend it: now"
    )
    assert check_from_message(CheckName.INPUT, "fail", "it broke").fix == ""


def test_check_names_are_unique() -> None:
    assert len(CheckName.__members__) == len(set(CheckName)) == 31


def test_check_name_is_printed_and_serialized_as_its_value() -> None:
    assert f"{CheckName.WINDOW}" == str(CheckName.WINDOW) == "game's window"
    assert json.dumps(CheckName.SIZE_AND_SCALE) == '"size and GUI scale"'
