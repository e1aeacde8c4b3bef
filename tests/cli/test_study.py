"""``mc-nested study``: it lists the studies, and each has the options and defaults that it declares."""

import re

import pytest

from mc_nested.cli.study import EVERY_STUDY, declared
from mc_nested.studies.study import SHIPPED
from tests.cli.running import run


def test_study_without_a_name_lists_the_studies(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("study") == 0
    listed = re.findall(r"^  ([a-z]+)  ", capsys.readouterr().out, re.MULTILINE)
    assert listed == list(SHIPPED)


@pytest.mark.parametrize("name", SHIPPED)
def test_a_study_takes_the_options_that_it_declares_and_those_of_every_study(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run("study", name, "--help") == 0
    shown = re.findall(r"^ +(?:-q, )?--([a-z-]+)", capsys.readouterr().out, re.MULTILINE)
    options = {option.replace("-", "_") for option in shown if not option.startswith("json-")}
    assert options - {"help"} == {*declared(name).options, *EVERY_STUDY} - {"as_json"} | {"json"}


def test_help_names_the_defaults_of_each_study(capsys: pytest.CaptureFixture[str]) -> None:
    assert run("study", "sweep", "--help") == 0
    assert "1000; 1<=x" in capsys.readouterr().out
