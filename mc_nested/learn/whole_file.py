"""Files that are there whole or not at all: what a kill, a full disk or an impatient Ctrl+C leaves is the old one."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """The path to write to inside the block; at its end the file takes the place of ``path``, after an error it goes.

    The old file stays untouched until then. OSError where the disk refuses.
    """
    unfinished = path.with_name(f"{path.name}.unfinished")
    try:
        yield unfinished
        unfinished.replace(path)
    except BaseException:
        # Room on a full disk, too: the last whole file may be what somebody needs to go on.
        unfinished.unlink(missing_ok=True)
        raise
