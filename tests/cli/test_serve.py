"""``mc-nested train keys``: a folder for each machine, which its --keys takes."""

from pathlib import Path

import pytest

from mc_nested.workers.cluster.address import scheduler_address
from tests.cli.running import run


def test_train_keys_makes_a_folder_for_each_machine_that_the_keys_option_accepts(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "keys", tmp_path / "keys", "learner", "pc1") == 0
    printed = capsys.readouterr().out.splitlines()
    assert [line.split(":")[0] for line in printed[:2]] == [
        str(tmp_path / "keys" / name) for name in ("learner", "pc1")
    ]
    assert "keep it here" in printed[2]
    for name in ("learner", "pc1"):
        assert scheduler_address("10.0.0.1", tmp_path / "keys" / name).url == "tls://10.0.0.1:8786"


def test_a_machine_that_already_has_keys_is_refused_in_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("train", "keys", tmp_path, "pc") == 0
    capsys.readouterr()
    assert run("train", "keys", tmp_path, "pc") == 2
    said = capsys.readouterr().err
    assert "is there already: delete it to make new keys" in said
    assert said.count("\n") == 1
