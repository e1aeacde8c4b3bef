"""Restoring a world's folder: only a marked one, whole or not at all, and the last one is kept."""

from pathlib import Path

import pytest

from mc_nested.errors import RunError
from mc_nested.live.menus.world_folder import KEPT, MARKER, restore_world


def _world(folder: Path, text: str, *, marked: bool = True) -> Path:
    (folder / "region").mkdir(parents=True)
    (folder / "region" / "r.0.0.mca").write_text(text)
    (folder / "level.dat").write_text(text)
    if marked:
        (folder / MARKER).write_text("may be replaced")
    return folder


def _texts(folder: Path) -> set[str]:
    return {path.read_text() for path in folder.rglob("*") if path.is_file() and path.name != MARKER}


def test_the_world_becomes_the_template_and_the_last_one_is_kept(tmp_path: Path) -> None:
    world, template = _world(tmp_path / "saves/arena", "played"), _world(tmp_path / "template", "fresh")
    (world / "extra.dat").write_text("played")
    for text in ("played", "played again"):
        restore_world(world, template)
        assert _texts(world) == {"fresh"}
        assert not (world / "extra.dat").exists()
        assert _texts(tmp_path / KEPT / "arena.last") == {text}
        (world / "level.dat").write_text("played again")
        (world / "region" / "r.0.0.mca").write_text("played again")
    assert _texts(template) == {"fresh"}
    assert [path.name for path in (tmp_path / "saves").iterdir()] == ["arena"]


@pytest.mark.parametrize("unmarked", ["world", "template"])
def test_without_the_marker_nothing_is_touched(tmp_path: Path, unmarked: str) -> None:
    world = _world(tmp_path / "saves/arena", "mine", marked=unmarked != "world")
    template = _world(tmp_path / "template", "fresh", marked=unmarked != "template")
    with pytest.raises(RunError, match=f"has no {MARKER}"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}
    assert not (tmp_path / KEPT).exists()


def test_a_link_to_a_world_is_not_followed(tmp_path: Path) -> None:
    world, template = _world(tmp_path / "elsewhere", "mine"), _world(tmp_path / "template", "fresh")
    (tmp_path / "saves").mkdir()
    (tmp_path / "saves/arena").symlink_to(world)
    with pytest.raises(RunError, match="never replaced"):
        restore_world(tmp_path / "saves/arena", template)
    assert _texts(world) == {"mine"}


def test_a_template_inside_the_world_is_refused(tmp_path: Path) -> None:
    world = _world(tmp_path / "saves/arena", "mine")
    template = _world(world / "template", "mine")
    with pytest.raises(RunError, match="is the world itself, or in it"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}


def test_a_disk_that_refuses_leaves_the_world_as_it_was(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world, template = _world(tmp_path / "saves/arena", "mine"), _world(tmp_path / "template", "fresh")
    rename = Path.rename

    def refuse(path: Path, target: Path) -> Path:
        if path.name == "arena.new":
            raise OSError("no")
        return rename(path, target)

    monkeypatch.setattr(Path, "rename", refuse)
    with pytest.raises(RunError, match="can't be restored"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}


def test_a_copy_that_differs_is_not_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    world, template = _world(tmp_path / "saves/arena", "mine"), _world(tmp_path / "template", "fresh")
    monkeypatch.setattr("mc_nested.live.menus.world_folder.filecmp.cmp", lambda *_, **__: False)
    with pytest.raises(RunError, match="differs"):
        restore_world(world, template)
    assert _texts(world) == {"mine"}
