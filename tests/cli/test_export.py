"""``mc-nested recordings export`` and ``runs export``: whole or not at all, and one line for what can't be done."""

import json
import shutil
import sys
from pathlib import Path

import pytest
import yaml

from mc_nested.errors import with_extra
from mc_nested.learn.runs.run_folder import RunFolder
from tests.cli.running import TRAIN, run
from tests.recordings.test_recordings import VIRTUAL

LINE, OTHER = VIRTUAL / "rehearsal-window.mcap", VIRTUAL / "virtual-client-1.20.1.mcap"


def export(out: Path, *words: str | Path, form: str = "lerobot") -> int:
    return run("recordings", "export", *words, "--format", form, "--out", out)


@pytest.mark.parametrize("form", ["lerobot", "minari"])
def test_export_says_what_it_wrote(form: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert export(tmp_path / "out", LINE, form=form) == 0
    what = {"lerobot": "88 frames", "minari": "line-v0"}[form]
    assert capsys.readouterr() == (f"{tmp_path / 'out'}: {what}, 1 episodes, 13 actions\n", "")
    assert [each.name for each in tmp_path.iterdir()] == ["out"]


def test_what_a_torn_recording_lost_is_said_in_one_line(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    whole = OTHER.read_bytes()
    torn = tmp_path / "torn.mcap"
    torn.write_bytes(whole[: len(whole) * 3 // 4])
    assert export(tmp_path / "out", torn, form="minari") == 0
    said = capsys.readouterr().err
    assert (said.count("\n"), said.startswith(f"{torn}: left out: ")) == (1, True)
    assert "torn.mcap: it ends early" in said


@pytest.mark.parametrize(
    ("words", "form", "why"),
    [
        (["nothing"], "lerobot", "no recording 'nothing'"),
        ([__file__], "lerobot", "is no recording of mc-nested"),
        ([LINE], "zarr", "'zarr' is not one of 'lerobot', 'minari'"),
        ([LINE, OTHER], "minari", "different designs"),
    ],
)
def test_what_cannot_be_exported_is_refused_and_leaves_nothing(
    words: list[str | Path], form: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert export(tmp_path / "out", *words, form=form) == 2
    assert why in " ".join(capsys.readouterr().err.split())
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_is_there_is_left_alone(
    tmp_path: Path, trained: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mine").write_text("mine")
    assert export(tmp_path, LINE) == 2
    assert capsys.readouterr().err.endswith(": is there already: name a new folder, nothing was overwritten\n")
    assert run("runs", "export", trained, "--out", tmp_path) == 2
    assert [each.read_text() for each in tmp_path.iterdir()] == ["mine"]


@pytest.mark.parametrize(
    ("form", "package", "extra"),
    [("lerobot", "pyarrow", "share"), ("minari", "minari", "share"), ("lerobot", "imageio_ffmpeg", "video")],
)
def test_a_missing_package_is_named_with_its_extra(
    form: str,
    package: str,
    extra: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    ours = ("mc_nested.report.lerobot_dataset", "mc_nested.report.minari_dataset")
    for name in [each for each in sys.modules if each in ours or each.startswith(f"{package}.")]:
        monkeypatch.delitem(sys.modules, name)
    monkeypatch.setitem(sys.modules, package, None)
    assert export(tmp_path / "out", LINE, form=form) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1
    assert package.replace("_", "-") in said.replace("_", "-")
    assert with_extra(extra) in said
    assert list(tmp_path.iterdir()) == []


@pytest.fixture
def exported(trained: Path, tmp_path: Path) -> Path:
    """Return a training's model, whose run isn't there any more."""
    shutil.copytree(trained, tmp_path / "run")
    assert run("runs", "export", tmp_path / "run", "--out", tmp_path / "model") == 0
    shutil.rmtree(tmp_path / "run")
    return tmp_path / "model"


def test_an_exported_run_plays_as_the_run_does(
    exported: Path, trained: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    capsys.readouterr()
    for folder in (trained, exported):
        assert run("runs", "evaluate", folder, "--json") == 0
    run_s, models = (json.loads(line) for line in capsys.readouterr().out.splitlines())
    assert {**models, "folder": run_s["folder"]} == run_s
    assert run("play", exported, "--trial", "1", "--json") == 0
    assert json.loads(capsys.readouterr().out)["score"] == run_s["scores"][1]
    assert sorted(file.name for file in exported.iterdir()) == ["README.md", "config.toml", "model.safetensors"]


def test_the_card_has_the_runs_figures(exported: Path, trained: Path) -> None:
    front, text = (exported / "README.md").read_text().removeprefix("---\n").split("---\n", 1)
    card = yaml.safe_load(front)
    assert (card["license"], card["library_name"]) == ("mit", "mc-nested")
    assert "minecraft" in card["tags"]
    finals = json.loads((trained / "summary.json").read_text())["final_scores"]
    (metric,) = card["model-index"][0]["results"][0]["metrics"]
    assert metric["value"] == sum(finals) / 2
    for row in (
        f"| score of each trial's greedy episode | {finals[0]:g}, {finals[1]:g} |",
        "| highest score possible | 21 |",
        "| trials | 2 |",
        "| seed of all random choices | 3 |",
        "| training episodes, all trials | 80 of at most 80 |",
        "| of these, shown by a person | 0 |",
        "| training ends | after all episodes |",
    ):
        assert row in text
    assert "mc-nested play model" in text


def test_texts_of_others_are_shown_as_they_are_and_no_path_or_name_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("USER", "annemarie")
    scenario = (
        Path("mc_nested/arena/designs/line.toml")
        .read_text()
        .replace('name = "line"', 'name = "<b>*annemarie* | [x](y): \\"z\\""')
    )
    (tmp_path / "secret").mkdir()
    (tmp_path / "secret" / "design.toml").write_text(scenario)
    preset = tmp_path / "secret" / "annemarie-1.toml"
    preset.write_text(Path("mc_nested/learn/presets/paper.toml").read_text())
    words = ("--preset", preset, "--scenario", tmp_path / "secret" / "design.toml", "--out", tmp_path / "run")
    assert run(*TRAIN, *words) == 0
    assert run("runs", "export", tmp_path / "run", "--out", tmp_path / "model") == 0
    texts = [(tmp_path / "model" / name).read_text() for name in ("README.md", "config.toml")]
    assert not any(word in text for text in texts for word in ("annemarie", "secret", str(tmp_path)))
    _, front, text = texts[0].split("---\n", 2)
    assert yaml.safe_load(front)["model-index"][0]["name"].startswith('<b>*<user>* | [x](y): "z"')
    assert '\n# \\<b\\>\\*\\<user\\>\\* \\| \\[x\\]\\(y\\): "z"' in text
    assert run("play", tmp_path / "model", "--quiet") == 0


def test_an_exported_run_cannot_be_resumed(exported: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run("train", "--resume", exported) == 2
    assert capsys.readouterr().err == (
        f"mc-nested: {exported}: an exported model isn't resumed: begin from it with --from {exported}\n"
    )
    assert not (exported / "view").exists()


@pytest.mark.parametrize(
    ("change", "why"),
    [
        (lambda folder: (folder / "model.safetensors").write_bytes(b"torn"), "damaged or cut short"),
        (
            lambda folder: (folder / "config.toml").write_text(
                (folder / "config.toml").read_text().replace("seed = 3", "seed = 4")
            ),
            "belongs to another scenario, agent or preset",
        ),
    ],
    ids=["torn", "of another seed"],
)
def test_a_damaged_export_is_refused_in_one_line(
    change: object, why: str, exported: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert callable(change)
    change(exported)
    assert run("play", exported) == 2
    said = capsys.readouterr().err
    assert (why in said, said.count("\n")) == (True, 1)


def test_a_run_that_learnt_nothing_yet_is_not_exported(
    trained: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "run").mkdir()
    shutil.copy(trained / "config.toml", tmp_path / "run")
    assert run("runs", "export", tmp_path / "run", "--out", tmp_path / "model") == 2
    assert "checkpoint is gone" in capsys.readouterr().err
    assert not (tmp_path / "model").exists()


@pytest.mark.slow
@pytest.mark.parametrize("agent", ["optimal", "with_objectives"])
def test_every_kind_of_agent_is_exported(agent: str, tmp_path: Path, request: pytest.FixtureRequest) -> None:
    trained = request.getfixturevalue(agent)
    assert run("runs", "export", trained, "--out", tmp_path / "model") == 0
    theirs, ours = (RunFolder.open(folder).policies() for folder in (trained, tmp_path / "model"))
    assert theirs.keys() == ours.keys()
    assert all((theirs[name] == ours[name]).all() for name in theirs)
    assert run("play", tmp_path / "model", "--quiet") == 0
