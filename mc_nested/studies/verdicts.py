"""From the evidence on a claim to its verdict.

A claim holds where all its lines do. That verdict is wrong only if a false line passes its test, which each line allows
with a probability below α: an intersection-union test (Berger, 1982), which needs no correction. A claim does not hold
where the opposite of any line is shown. For that verdict to be wrong, one error among all its lines is enough. So the
tests of the opposites are corrected by Holm's method, within the claim.

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
    FAILS = "does not hold"
    UNDECIDED = "undecided"
    NOT_RUN = "not run"


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
    """

    what: str
    figures: tuple[tuple[str, float], ...] = ()
    interval: Interval | None = None
    tails: Tails | None = None
    counted: Verdict | None = None
    missing: str = ""
    effect: TestedEffect | None = None


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
    """An evidence, the p of its opposite after Holm's correction within the claim, and its verdict."""

    evidence: Evidence
    against: float | None
    verdict: Verdict


@dataclass(frozen=True)
class JudgedClaim:
    """A claim, its findings, and the verdict on it."""

    claim: Claim
    findings: tuple[Finding, ...]
    verdict: Verdict


def judged(claim: Claim) -> JudgedClaim:
    """Judge the claim."""
    opposites = iter(holm([evidence.tails.against for evidence in claim.evidence if evidence.tails]))
    findings = []
    for evidence in claim.evidence:
        against = next(opposites) if evidence.tails else None
        findings.append(Finding(evidence, against, verdict_of(evidence, against)))
    return JudgedClaim(claim, tuple(findings), verdict_on_all([finding.verdict for finding in findings]))


def verdict_of(evidence: Evidence, against: float | None) -> Verdict:
    """Judge one line: it holds if its own test says so, else it fails if its opposite's corrected p does."""
    if evidence.counted:
        return evidence.counted
    if evidence.tails is None or against is None:
        return Verdict.UNDECIDED
    if evidence.tails.claim < ALPHA:
        return Verdict.HOLDS
    return Verdict.FAILS if against < ALPHA else Verdict.UNDECIDED


def verdict_on_all(verdicts: Sequence[Verdict]) -> Verdict:
    """Judge a claim: it holds if all its evidence does, and does not hold if any of it doesn't."""
    if Verdict.FAILS in verdicts:
        return Verdict.FAILS
    if all(verdict is Verdict.NOT_RUN for verdict in verdicts):
        return Verdict.NOT_RUN
    return Verdict.HOLDS if all(verdict is Verdict.HOLDS for verdict in verdicts) else Verdict.UNDECIDED
