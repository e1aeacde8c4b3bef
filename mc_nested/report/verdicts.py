"""From the evidence on a claim to its verdict: Holm's correction over the tests of all claims, then a rule."""

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum

from mc_nested.report.inference import ALPHA, Interval, Tails, holm


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
    """

    what: str
    figures: tuple[tuple[str, float], ...] = ()
    interval: Interval | None = None
    tails: Tails | None = None
    counted: Verdict | None = None
    missing: str = ""


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
    """An evidence with its test's p after Holm, and its verdict."""

    evidence: Evidence
    adjusted: Tails | None
    verdict: Verdict


@dataclass(frozen=True)
class JudgedClaim:
    """A claim, its findings, and the verdict on it."""

    claim: Claim
    findings: tuple[Finding, ...]
    verdict: Verdict


def judged(claims: Sequence[Claim]) -> tuple[JudgedClaim, ...]:
    """The claims with their verdicts. Every test counts in Holm's correction, those against a claim as those for it."""
    tested = [evidence.tails for claim in claims for evidence in claim.evidence if evidence.tails]
    adjusted = iter(holm([p for tails in tested for p in tails]))
    judgements = []
    for claim in claims:
        findings = []
        for evidence in claim.evidence:
            tails = Tails(next(adjusted), next(adjusted)) if evidence.tails else None
            findings.append(Finding(evidence, tails, verdict_of(evidence, tails)))
        verdict = verdict_on_all([finding.verdict for finding in findings])
        judgements.append(JudgedClaim(claim, tuple(findings), verdict))
    return tuple(judgements)


def verdict_of(evidence: Evidence, adjusted: Tails | None) -> Verdict:
    """A claim's evidence holds if its test says so; otherwise it fails if the opposite test says so."""
    if evidence.counted:
        return evidence.counted
    if adjusted is None:
        return Verdict.UNDECIDED
    if adjusted.claim < ALPHA:
        return Verdict.HOLDS
    return Verdict.FAILS if adjusted.against < ALPHA else Verdict.UNDECIDED


def verdict_on_all(verdicts: Sequence[Verdict]) -> Verdict:
    """A claim holds if all its evidence does, and does not hold if any of it doesn't."""
    if Verdict.FAILS in verdicts:
        return Verdict.FAILS
    if all(verdict is Verdict.NOT_RUN for verdict in verdicts):
        return Verdict.NOT_RUN
    return Verdict.HOLDS if all(verdict is Verdict.HOLDS for verdict in verdicts) else Verdict.UNDECIDED
