"""A journal that keeps its notes."""

from mc_nested.live.journal import Fact, NoteKind


class Notes:
    """A journal that keeps its notes, in order."""

    def __init__(self) -> None:
        self.taken: list[tuple[NoteKind, dict[str, Fact]]] = []

    def note(self, kind: NoteKind, /, **facts: Fact) -> None:
        self.taken.append((kind, facts))

    def of(self, kind: NoteKind) -> list[dict[str, Fact]]:
        """Return the facts of each note of a kind."""
        return [facts for seen, facts in self.taken if seen == kind]
