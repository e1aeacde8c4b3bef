"""Which shell asks for its completions."""

import shellingham

from mc_nested.errors import UserError

SHELLS = ("bash", "zsh", "fish", "powershell", "pwsh")
"""Those that Typer writes a script for."""


def check_shell() -> None:
    """UserError if the shell that this was started from can't be told, or is none of SHELLS."""
    try:
        name, _ = shellingham.detect_shell()
    except (shellingham.ShellDetectionFailure, RuntimeError):
        name = "this shell, whose name can't be told"
    if name not in SHELLS:
        raise UserError(f"there are no completions for {name}: run this in bash, zsh, fish or PowerShell")
