"""``mc-nested cluster-keys``: a private authority, and a certificate and key for each machine of a cluster."""

from pathlib import Path
from typing import Annotated

import typer

from mc_nested.workers.cluster.connection import check_installed
from mc_nested.workers.cluster.keys import AUTHORITY_KEY, make_keys


def cluster_keys(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="where to make them; an authority there is kept")],
    machines: Annotated[list[str], typer.Argument(metavar="MACHINE...", help="a name of your choice for each machine")],
) -> None:
    """Make keys with which your machines know each other: copy to each machine its own folder, and nothing else."""
    check_installed()
    for made in make_keys(folder, machines):
        typer.echo(f"{made}: copy this folder to {made.name}, and name it there with --keys")
    typer.echo(f"{folder / AUTHORITY_KEY}: keep it here: who has it can let any machine in")
