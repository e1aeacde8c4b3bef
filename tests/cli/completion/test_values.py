"""What a value can be, from what is typed so far."""

from pathlib import Path

import platformdirs
import pytest

from mc_nested.cli.completion.values import of, profiles, runs


@pytest.fixture
def here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with runs/a, runs/b, other/c, and what is none."""
    monkeypatch.chdir(tmp_path)
    for name in ("runs/a", "runs/b", "other/c"):
        (tmp_path / name).mkdir(parents=True)
        (tmp_path / name / "config.toml").touch()
    (tmp_path / "runs" / "empty").mkdir()
    (tmp_path / "runs" / "file").touch()
    return tmp_path


@pytest.mark.parametrize("typed", ["", "r", "runs", "runs/"])
def test_runs_are_those_in_runs(typed: str, here: Path) -> None:
    assert [Path(name) for name in runs(typed)] == [Path("runs/a"), Path("runs/b")]
    assert here.exists()


def test_runs_are_also_those_where_the_path_leads(here: Path) -> None:
    assert runs("runs/b") == [str(Path("runs/b"))]
    assert runs(f"{here}/other/") == [f"{here}/other/c"]
    assert runs(f"{here}/other/c") == [f"{here}/other/c"]
    assert runs("other/x") == []


def test_where_nothing_is_there_is_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path / "missing")
    assert runs("") == runs("a/b/c") == profiles("") == []


def test_profiles_are_the_named_ones(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(platformdirs, "user_config_path", lambda *_args, **_kwargs: tmp_path)
    (tmp_path / "profiles" / "laptop-points").mkdir(parents=True)
    for name in ("laptop.toml", "laptop.toml.before", "pc.toml"):
        (tmp_path / "profiles" / name).touch()
    assert profiles("") == ["laptop", "pc"]
    assert profiles("l") == ["laptop"]


def test_of_several_names_the_last_one_is_completed() -> None:
    names = of(["live", "paper", "tuned"])
    assert names("") == ["live", "paper", "tuned"]
    assert names("t") == ["tuned"]
    assert names("live,p") == ["live,paper"]
    assert names("x") == []
