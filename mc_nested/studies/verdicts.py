"""From the evidence on a claim to its verdict.

A claim has the weakest answer of its lines. To hold wrongly, a false line has to pass its test, which each allows with
a probability below α: an intersection-union test (Berger, 1982), which needs no correction. A claim does not hold where
the opposite of any line is shown. For that verdict to be wrong, one error among all its lines is enough. So the tests
of the opposites are corrected by Holm's method, within the claim; and so are those of which lines are small.

No line's opposite is shown where the line is: what is tested for and against excludes each other. So two samples of one
truth seldom give opposite verdicts (tests/studies/claims/test_rates.py).

Each claim is a question of its own, and none is an alternative to another: nothing is corrected across claims.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from mc_nested.studies.inference import ALPHA, Interval, Tails, holm
from mc_nested.studies.power import TestedEffect


class Verdict(Enum):
    """What the trials say about a claim."""

    HOLDS = "holds"
    SLIGHTLY = "holds by less than a block"
    UNDECIDED = "undecided"
    FAILS = "does not hold"
    NOT_JUDGED = "not judged"


@dataclass(frozen=True)
class Evidence:
    """One comparison that a claim rests on.

    Args:
        what: what is compared.
        figures: what was measured, by name.
        interval: the interval of the last figure.
        tails: the p-values of the test; None if there was none.
        counted: the verdict, if the figures are counted and need no test.
        missing: why there is neither, for the reader.
        effect: how large it is, where it is asked how many trials would decide it.
        coverage: how often such an interval holds the mean, simulated from these trials; None for an exact one.
    """

    what: str
    figures: tuple[tuple[str, float], ...] = ()
    interval: Interval | None = None
    tails: Tails | None = None
    counted: Verdict | None = None
    missing: str = ""
    effect: TestedEffect | None = None
    coverage: float | None = None


@dataclass(frozen=True)
class Claim:
    """What the paper says and where, how it is tested, and what was measured."""

    letter: str
    title: str
    paper: str
    section: str
    rule: str
    evidence: tuple[Evidence, ...]


@dataclass(frozen=True)
class Finding:
    """An evidence, its verdict, and two p after Holm's correction within the claim: of its opposite, of being small."""

    evidence: Evidence
    against: float | None
    small: float | None
    verdict: Verdict

    @property
    def words(self) -> str:
        """The verdict, and what is shown beside where it is undecided."""
        is_within = self.verdict is Verdict.UNDECIDED and self.small is not None and self.small < ALPHA
        return f"{self.verdict.value}, within a block" if is_within else self.verdict.value


@dataclass(frozen=True)
class JudgedClaim:
    """A claim, its findings, and the verdict on it."""

    claim: Claim
    findings: tuple[Finding, ...]
    verdict: Verdict

    @property
    def words(self) -> str:
        """The verdict, and what is shown beside by all lines that leave it undecided."""
        found = {finding.words for finding in self.findings if finding.verdict is self.verdict}
        return found.pop() if len(found) == 1 and self.verdict is Verdict.UNDECIDED else self.verdict.value


def judged(claim: Claim) -> JudgedClaim:
    """Judge the claim."""
    opposites = _corrected([each.tails.against if each.tails else None for each in claim.evidence])
    smalls = _corrected([each.tails.small if each.tails else None for each in claim.evidence])
    findings = [Finding(*each, verdict_of(*each)) for each in zip(claim.evidence, opposites, smalls, strict=True)]
    return JudgedClaim(claim, tuple(findings), verdict_on_all([finding.verdict for finding in findings]))


def _corrected(p_values: Sequence[float | None]) -> list[float | None]:
    corrected = iter(holm([p for p in p_values if p is not None]))
    return [None if p is None else next(corrected) for p in p_values]


def verdict_of(evidence: Evidence, against: float | None, small: float | None = None) -> Verdict:
    """Judge one line: it holds if its own test says so, else it fails if its opposite's corrected p does."""
    if evidence.counted:
        return evidence.counted
    if evidence.tails is None or against is None:
        return Verdict.NOT_JUDGED
    if evidence.tails.claim < ALPHA:
        return Verdict.SLIGHTLY if small is not None and small < ALPHA else Verdict.HOLDS
    return Verdict.FAILS if against < ALPHA else Verdict.UNDECIDED


def verdict_on_all(verdicts: Sequence[Verdict]) -> Verdict:
    """Judge a claim by the weakest of its lines: it does not hold if any of them doesn't."""
    if Verdict.FAILS in verdicts:
        return Verdict.FAILS
    if all(verdict is Verdict.NOT_JUDGED for verdict in verdicts):
        return Verdict.NOT_JUDGED
    if Verdict.UNDECIDED in verdicts or Verdict.NOT_JUDGED in verdicts:
        return Verdict.UNDECIDED
    return Verdict.SLIGHTLY if Verdict.SLIGHTLY in verdicts else Verdict.HOLDS
