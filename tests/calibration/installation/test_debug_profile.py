"""debug-profile.json is read in every version's form, and mended."""

import json
import zipfile
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.installation.debug_profile import (
    DebugProfile,
    data_version_in,
    load_debug_profile,
    version_of_data,
)
from mc_nested.errors import ProfileError

WORDS = {
    "1.21.9": "inF3",
    "1.21.10": "inF3",
    "1.21.11": "inOverlay",
    "26.1": "inOverlay",
    "26.4-snapshot-1": "inOverlay",
}
TARGETS = {"1.21.10": "looking_at_block", "1.21.11": "looking_at_block", "26.1": "looking_at_block_state"}
DEFAULT = {
    *("3d_crosshair", "game_version", "tps", "fps", "memory", "system_specs", "player_position"),
    *("player_section_position", "simple_performance_impactors"),
}


def loaded(folder: Path, text: str | None, version: str = "26.3") -> DebugProfile:
    if text is not None:
        (folder / "debug-profile.json").write_text(text, "utf-8")
    return load_debug_profile(folder, version)


def custom(version: int | None, **words: str) -> str:
    known = {"DataVersion": version} if version is not None else {}
    return json.dumps({**known, "custom": {f"minecraft:{name}": word for name, word in words.items()}})


def mended(profile: DebugProfile, data_version: int | None = None) -> dict[str, object]:
    known: dict[str, object] = json.loads(profile.mended(data_version))
    return known


@pytest.mark.parametrize("version", WORDS)
@pytest.mark.parametrize("text", [None, '{"profile":"default"}'])
def test_without_a_file_or_with_the_default_profile_only_the_block_entry_is_off(
    version: str, text: str | None, tmp_path: Path
) -> None:
    profile = loaded(tmp_path, text, version)
    assert profile.off == [profile.needed[1]]
    assert profile.problem is None
    written = mended(profile)["custom"]
    assert written == {f"minecraft:{name}": WORDS[version] for name in {*DEFAULT, profile.needed[1]}}


@pytest.mark.parametrize(("version", "target"), TARGETS.items())
def test_block_entry_is_named_as_in_each_version(version: str, target: str, tmp_path: Path) -> None:
    assert loaded(tmp_path, None, version).needed == ("player_position", target)


def test_performance_profile_has_both_entries_off_and_is_written_out_as_custom_entries(tmp_path: Path) -> None:
    profile = loaded(tmp_path, '{"DataVersion":5023,"profile":"performance"}')
    assert profile.off == ["player_position", "looking_at_block_state"]
    written = mended(profile)
    assert written["DataVersion"] == 5023
    assert written["custom"] == {
        "minecraft:fps": "alwaysOn",
        **{
            f"minecraft:{name}": "inOverlay"
            for name in (
                *("gpu_utilization", "memory", "simple_performance_impactors", "tps"),
                *("player_position", "looking_at_block_state"),
            )
        },
    }


def test_needed_entry_counts_as_on_if_it_is_always_on_or_in_the_overlay(tmp_path: Path) -> None:
    words = {"player_position": "inOverlay", "looking_at_block_state": "alwaysOn"}
    assert loaded(tmp_path, custom(5023, **words)).off == []
    assert loaded(tmp_path, custom(5023, **{**words, "player_position": "never"})).off == ["player_position"]
    assert loaded(tmp_path, '{"custom":{"player_position":"inOverlay","looking_at_block_state":"inOverlay"}}').off == []


def test_other_entries_and_those_of_mods_stay_as_they_are(tmp_path: Path) -> None:
    text = '{"DataVersion":5023,"custom":{"minecraft:biome":"alwaysOn","mymod:speed":"never","minecraft:fps":"never"}}'
    assert mended(loaded(tmp_path, text))["custom"] == {
        "minecraft:biome": "alwaysOn",
        "mymod:speed": "never",
        "minecraft:fps": "never",
        "minecraft:player_position": "inOverlay",
        "minecraft:looking_at_block_state": "inOverlay",
    }


def test_former_name_of_the_block_entry_counts_only_in_an_older_file(tmp_path: Path) -> None:
    words = {"player_position": "inOverlay", "looking_at_block": "inOverlay"}
    assert loaded(tmp_path, custom(4671, **words), "26.1").off == []
    assert loaded(tmp_path, custom(None, **words), "26.1").off == []
    assert loaded(tmp_path, custom(4790, **words), "26.1").off == ["looking_at_block_state"]
    # Both names in one file: the game would make one of them, so the former one isn't written again.
    off = loaded(tmp_path, custom(4671, **{**words, "looking_at_block": "never"}), "26.1")
    assert off.off == ["looking_at_block_state"]
    assert "minecraft:looking_at_block" not in str(mended(off)).replace("looking_at_block_state", "")


def test_word_in_f3_counts_only_in_an_older_file_and_is_written_as_in_overlay(tmp_path: Path) -> None:
    words = {"player_position": "inF3", "looking_at_block": "never"}
    profile = loaded(tmp_path, custom(4556, **words), "1.21.11")
    assert profile.problem is None
    assert profile.off == ["looking_at_block"]
    assert mended(profile) == {
        "DataVersion": 4556,
        "custom": {"minecraft:player_position": "inOverlay", "minecraft:looking_at_block": "inOverlay"},
    }
    assert loaded(tmp_path, custom(4671, **words), "1.21.11").problem is not None
    assert loaded(tmp_path, custom(4556, player_position="inOverlay"), "1.21.10").problem is not None


@pytest.mark.parametrize(
    ("version", "own", "of_jar", "written"),
    [
        ("26.3", 5000, 5023, 5000),
        ("26.3", None, 5023, 5023),
        ("26.3", None, None, 4671),
        ("1.21.11", None, None, 4671),
        ("1.21.10", None, None, 4649),
        ("1.21.10", None, 4556, 4556),
    ],
)
def test_data_version_comes_from_the_file_then_the_jar_then_a_known_one(
    version: str, own: int | None, of_jar: int | None, written: int, tmp_path: Path
) -> None:
    assert mended(loaded(tmp_path, custom(own, fps="never"), version), of_jar)["DataVersion"] == written


@pytest.mark.parametrize("number", [True, -1, 0, 4553, 10**9, "4671", 4671.0, None])
def test_an_invalid_data_version_counts_as_missing(number: object, tmp_path: Path) -> None:
    assert loaded(tmp_path, json.dumps({"DataVersion": number, "custom": {}})).data_version is None


@pytest.mark.parametrize(
    "text",
    [
        *("", "{", "[]", "null", '{"profile":"fast"}', '{"profile":3}', '{"custom":[]}', "[" * 5000),
        *('{"custom":{"minecraft:fps":"sometimes"}}', '{"custom":{"minecraft:fps":true}}', '{"custom":{"fps":{}}}'),
    ],
)
def test_file_that_the_game_cannot_read_is_damaged_and_mended_from_the_default_entries(
    text: str, tmp_path: Path
) -> None:
    profile = loaded(tmp_path, text)
    assert profile.problem is not None
    assert "\n" not in profile.problem
    assert {name.removeprefix("minecraft:") for name in json.loads(profile.mended(None))["custom"]} == {
        *DEFAULT,
        "looking_at_block_state",
    }


def test_file_that_is_not_text_is_damaged(tmp_path: Path) -> None:
    (tmp_path / "debug-profile.json").write_bytes(b"\xff\xfe\x00{")
    assert load_debug_profile(tmp_path, "26.3").problem == "it is no JSON"


def test_empty_json_object_has_both_entries_off(tmp_path: Path) -> None:
    assert loaded(tmp_path, "{}").off == ["player_position", "looking_at_block_state"]


def test_unreadable_file_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "debug-profile.json").mkdir()
    with pytest.raises(ProfileError, match="can't be read"):
        load_debug_profile(tmp_path, "26.3")


@given(
    version=st.sampled_from(sorted(WORDS)),
    entries=st.dictionaries(
        st.sampled_from(["player_position", "looking_at_block", "looking_at_block_state", "minecraft:fps", "m:x"]),
        st.sampled_from(["alwaysOn", "never", "inF3", "inOverlay", "often", 1]),
    ),
    data_version=st.one_of(st.none(), st.integers(4000, 6000)),
)
def test_mended_file_has_the_needed_entries_on_and_keeps_the_others(
    version: str, entries: dict[str, object], data_version: int | None, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("game")
    profile = loaded(folder, json.dumps({"DataVersion": data_version, "custom": entries}), version)
    after = loaded(folder, profile.mended(None).decode(), version)
    assert (after.problem, after.off) == (None, [])
    kept = {name: word for name, word in profile.statuses.items() if name.removeprefix("minecraft:") not in profile.off}
    assert kept.items() <= after.statuses.items()


@pytest.mark.parametrize(
    ("data_version", "version"),
    [(3465, "1.21.8"), (4553, "1.21.8"), (4554, "1.21.9"), (4670, "1.21.9"), (4671, "1.21.11"), (4672, "26.1")],
)
def test_data_version_tells_the_game_version_whose_entry_names_apply(data_version: int, version: str) -> None:
    assert version_of_data(data_version) == version


@pytest.mark.parametrize(
    ("text", "found"),
    [
        ('{"id":"26.3","world_version":5023}', 5023),
        ('{"world_version":true}', None),
        ('{"world_version":"5023"}', None),
        ('{"world_version":99}', None),
        ("[5023]", None),
        ("{", None),
        (None, None),
    ],
)
def test_data_version_is_read_from_a_jar_only_if_it_is_plausible(
    text: str | None, found: int | None, tmp_path: Path
) -> None:
    jar = tmp_path / "26.3.jar"
    with zipfile.ZipFile(jar, "w") as file:
        file.writestr("other.json" if text is None else "version.json", text or "")
    assert data_version_in(jar) == found


def test_broken_or_missing_jar_has_no_data_version(tmp_path: Path) -> None:
    (tmp_path / "x.jar").write_bytes(b"PK\x03\x04 and no more")
    assert data_version_in(tmp_path / "x.jar") is None
    assert data_version_in(tmp_path / "none.jar") is None
