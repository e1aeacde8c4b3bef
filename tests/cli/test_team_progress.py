"""A team's progress: a line for who has no terminal, a bar in one."""

import io

from rich.console import Console

from mc_nested.cli.team_progress import TeamProgress
from tests.learn.cooperation.teams import finish, trainer_of


def shown(*, is_terminal: bool) -> str:
    trainer, out = trainer_of("shared", 2), io.StringIO()
    with TeamProgress(21.0, trainer, Console(file=out, force_terminal=is_terminal, width=120)) as progress:
        progress.show()
        finish(trainer)
    return out.getvalue()


def test_where_there_is_no_terminal_the_end_is_a_line() -> None:
    (line,) = shown(is_terminal=False).splitlines()
    assert line.startswith("episodes 40 of 40  mean score ")
    assert line.endswith("of 21  ε 0.01 0.00")


def test_in_a_terminal_there_is_a_bar() -> None:
    said = shown(is_terminal=True)
    assert "40/40" in said
    assert "of 21  ε 0.01 0.00" in said
