"""What a recording holds, at a glance: how long, how many actions, how large, and whether it is whole."""

from dataclasses import dataclass
from pathlib import Path

from mc_nested.live.recording.call_encoder import KeptPicture
from mc_nested.live.recording.recording_file import PartEnd, facts_of, parts_of, read_recording


@dataclass(frozen=True)
class Overview:
    """A recording at a glance; times are nanoseconds of the time of day, None if it holds no call."""

    what: str
    version: str
    began: int | None
    ended: int | None
    calls: int
    actions: int
    pictures: int
    size: int
    damage: tuple[str, ...]

    @property
    def seconds(self) -> float:
        """From its first call to its last."""
        return 0.0 if self.began is None or self.ended is None else (self.ended - self.began) / 1e9


def overview_of(path: Path) -> Overview:
    """Read a recording as a whole, its checksums too; RecordingError as for ``facts_of``."""
    facts = facts_of(path)
    began = ended = None
    calls = actions = pictures = 0
    damage = []
    for each in read_recording(path):
        if isinstance(each, KeptPicture):
            pictures += 1
        elif isinstance(each, PartEnd):
            if each.problem:
                damage.append(f"{each.path.name}: {each.problem}")
        else:
            began = each.at if began is None else began
            ended = each.at
            calls += 1
            actions += each.call[:2] == ["note", "acts"]
    size = sum(part.stat().st_size for part in parts_of(path))
    what, version = facts.get("what", "unknown"), facts.get("version", "unknown")
    return Overview(what, version, began, ended, calls, actions, pictures, size, tuple(damage))
