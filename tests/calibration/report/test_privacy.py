"""Home folders and user names are removed from texts that others will read."""

import re
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from calibration.report.privacy import Names, names_here

ANN = Names("/home/ann", ("ann",))
LEE = Names(r"C:\Users\Ann Lee", ("Ann Lee",))

NAMES = st.text("abcdefghijklmnopqrstuvwxyzäßñ0123456789-_.", min_size=2, max_size=12).filter(
    lambda name: name[0] != "."
)
SPACED = st.lists(st.text("abcdxyzÄé'", min_size=2, max_size=6), min_size=1, max_size=3).map(" ".join)
SENTENCES = st.text(st.sampled_from("abn /\\:.\"'~<>\n,_-C1"), max_size=40)


@pytest.mark.parametrize(
    ("text", "left"),
    [
        ("/home/ann/.minecraft/versions", "~/.minecraft/versions"),
        ("font = '/home/ann'", "font = '~'"),
        ("file:///home/ann/a b.png", "file:/~/a b.png"),
        ("/home/annabel/saves", "/home/<user>/saves"),
        ("/home/bob/saves and /Users/bob", "/home/<user>/saves and /Users/<user>"),
        ("saved by ann, in ann_2", "saved by <user>, in <user>_2"),
        ("ANN can't plan an annex", "<user> can't plan an annex"),
        (r"C:\Users\Bob Ross\AppData", r"C:\Users\<user>\AppData"),
        (r'{"font": "C:\\Users\\bob\\1.jar"}', r'{"font": "C:\\Users\\<user>\\1.jar"}'),
        ("/mnt/c/users/bob/x", "/mnt/c/users/<user>/x"),
        ("a world of 15 x 15 cells", "a world of 15 x 15 cells"),
    ],
)
def test_the_name_ann_is_removed_from_a_text(text: str, left: str) -> None:
    assert ANN.removed_from(text) == left


@pytest.mark.parametrize(
    ("text", "left"),
    [
        (r"C:\Users\Ann Lee\.minecraft", r"~\.minecraft"),
        (r"c:\\users\\ann lee\\.minecraft", r"~\\.minecraft"),
        ("C:/Users/Ann Lee/x", "~/x"),
        ("by Ann Lee.", "by <user>."),
    ],
)
def test_windows_home_folder_and_user_name_are_replaced_in_every_spelling(text: str, left: str) -> None:
    assert LEE.removed_from(text) == left


@given(NAMES, SENTENCES, SENTENCES)
def test_account_name_is_removed_from_any_text(name: str, before: str, behind: str) -> None:
    names = Names(f"/home/{name}", (name,))
    left = names.removed_from(f"{before} {name} {behind} /home/{name}/x '{name}'")
    letter = r"[^\W\d_]"
    found = re.findall(rf"(?<!{letter}){re.escape(name)}(?!{letter})", left.replace("<user>", ""), re.IGNORECASE)
    assert not found


@given(SPACED, st.sampled_from(["C:\\Users\\", "C:\\\\Users\\\\", "D:/users/", "/Users/", "/c/Users/"]), SENTENCES)
def test_user_name_in_somebody_elses_home_folder_is_replaced(name: str, folder: str, before: str) -> None:
    left = ANN.removed_from(f"{before}\n{folder}{name}/saves")
    assert left.endswith(f"{folder}<user>/saves")


@given(NAMES, st.sampled_from(["/", "\\", "\\\\"]), st.text("abc.", min_size=1, max_size=5))
def test_home_folder_becomes_a_tilde_with_any_kind_of_slash(name: str, slash: str, inside: str) -> None:
    names = Names(f"/srv/{name}", ())
    assert names.removed_from(f"{slash}srv{slash}{name}{slash}{inside}") == f"~{slash}{inside}"


@given(NAMES, SENTENCES)
def test_removing_names_twice_changes_nothing_more(name: str, text: str) -> None:
    assume("~" not in name)
    names = Names(f"/home/{name}", (name, "user"))
    once = names.removed_from(text)
    assert names.removed_from(once) == once


@given(st.text("defgh -:'\n.,#=[]1234567890", max_size=60))
def test_a_text_that_names_nobody_stays_as_it_is(text: str) -> None:
    assert ANN.removed_from(text) == text


def test_a_home_folder_at_the_root_of_a_disk_replaces_nothing() -> None:
    assert Names("/", ()).removed_from("/etc/x /") == "/etc/x /"


def test_a_one_letter_name_is_not_removed_from_a_text() -> None:
    assert Names("/root", ("x",)).removed_from("1024 x 768") == "1024 x 768"


def test_names_to_remove_come_from_the_environment_and_the_home_folder() -> None:
    names = names_here({"USER": "ann", "USERNAME": "Ann Lee", "LOGNAME": ""})
    assert {"ann", "Ann Lee", Path.home().name} <= set(names.users)
    assert names.home == str(Path.home())
    assert names.removed_from(str(Path.home() / "x")) == f"~{Path('/x')}"


def test_account_named_minecraft_is_not_removed() -> None:
    assert "minecraft" not in {name.lower() for name in names_here({"USER": "Minecraft", "LOGNAME": "minecraft"}).users}
