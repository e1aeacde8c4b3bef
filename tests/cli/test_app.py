"""The command: which verbs it loads, and what becomes of an error."""

import pytest
import typer

from mc_nested.cli import app as app_module
from mc_nested.cli.app import VERBS, app_for, main
from mc_nested.cli.interrupt import Stopped
from mc_nested.errors import PresetError


def test_only_the_verb_that_is_named_is_loaded() -> None:
    assert len(app_for(["scenarios", "line"]).registered_commands) == 1
    every = app_for(["--help"])
    assert len(every.registered_commands) + len(every.registered_groups) == len(VERBS)


@pytest.mark.parametrize(
    ("error", "code", "said"),
    [
        (PresetError("no preset:\nname one"), 2, "no preset: name one"),
        (Stopped("stopped and saved"), 130, "stopped and saved"),
        (KeyboardInterrupt(), 130, "stopped"),
        (MemoryError(), 2, "not enough memory"),
        (OSError(28, "No space left on device", "/x"), 2, "/x: No space left on device: name another path"),
        (OSError("odd"), 2, "the system: odd: name another path"),
    ],
)
def test_an_error_is_one_line_and_its_exit_code(
    error: BaseException, code: int, said: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def app_that_fails(_: object) -> typer.Typer:
        app = typer.Typer()

        @app.command()
        def verb() -> None:
            raise error

        return app

    monkeypatch.setattr(app_module, "app_for", app_that_fails)
    with pytest.raises(SystemExit) as ended:
        main(["--"])
    assert ended.value.code == code
    shown = capsys.readouterr().err
    assert shown.startswith(f"mc-nested: {said}")
    assert shown.count("\n") == 1
