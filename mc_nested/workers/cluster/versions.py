"""The versions that decide what a training computes: a worker needs the same as the machine that sends it jobs."""

import hashlib
import importlib.metadata
from collections.abc import Mapping
from functools import cache
from pathlib import Path

from mc_nested.compiled import ROOT

PACKAGES = ("mc_nested", "sim")
"""Whose files a job's results depend on."""

LIBRARIES = ("numpy", "numba", "llvmlite", "torch", "distributed")
"""Whose versions they depend on, or the messages between the machines."""

BESIDE_ANOTHER = ("gymnasium",)
"""What an agent of another library also depends on."""

MISSING = "missing"

Versions = Mapping[str, str]


@cache
def own_versions(library: str | None = None) -> Versions:
    """Return this machine's versions, by name: this project's with a hash of its files, and any build's libraries'.

    With those that decide what an agent of another library learns, if one is named.
    """
    own = f"{importlib.metadata.version('mc-nested')} ({_hash_of_files(ROOT)})"
    others = (library, *BESIDE_ANOTHER) if library else ()
    return {"mc-nested": own, **{name: _version_of(name) for name in (*LIBRARIES, *others)}}


def differences(wanted: Versions, own: Versions) -> str:
    """Return what differs, in words; empty if nothing does."""
    differing = [name for name in wanted if wanted[name] != own.get(name)]
    return ", ".join(f"{name} {own.get(name, MISSING)} instead of {wanted[name]}" for name in differing)


def _version_of(library: str) -> str:
    try:
        return importlib.metadata.version(library).partition("+")[0]
    except importlib.metadata.PackageNotFoundError:
        return MISSING


def _hash_of_files(root: Path) -> str:
    """Return a short hash of all that is computed with.

    A file's line ends, which differ between systems, don't count.
    """
    digest = hashlib.sha256()
    for package in PACKAGES:
        for path in sorted((root / package).rglob("*.py")):
            digest.update(path.relative_to(root).as_posix().encode())
            digest.update(path.read_bytes().replace(b"\r\n", b"\n"))
    return digest.hexdigest()[:8]
