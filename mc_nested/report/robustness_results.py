"""The claims as they were judged under each of the paper's open choices."""

import csv
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from mc_nested.atomic_file import atomic_write
from mc_nested.report.claims.judge import judge
from mc_nested.report.results import Results
from mc_nested.report.verdicts import Finding, JudgedClaim, Verdict

LEFT_OUT = ("f", "i1", "i2")
"""Claims that are not judged again: of a longer training, and of seconds, which a batch of many choices shares."""

HEADER = ("choice", "value", "claim", "line", "measured", "p", "p_opposite", "p_opposite_holm", "verdict")


@dataclass(frozen=True)
class JudgedChoice:
    """The claims under one choice; an empty choice is the base."""

    choice: str
    value: str
    results: Results
    claims: tuple[JudgedClaim, ...]

    @property
    def name(self) -> str:
        """A name that no other choice has."""
        return f"{self.choice}: {self.value}" if self.choice else "as it is"

    @property
    def verdicts(self) -> Mapping[str, Verdict]:
        """By the claim's letter."""
        return {judged.claim.letter: judged.verdict for judged in self.claims}


def judged_under(choice: str, value: str, results: Results) -> JudgedChoice:
    """The results under a choice, judged."""
    claims = tuple(judged for judged in judge(results) if judged.claim.letter not in LEFT_OUT)
    return JudgedChoice(choice, value, results, claims)


def write_findings(path: Path, choices: Sequence[JudgedChoice]) -> None:
    """Every line of every claim under every choice as CSV, atomically; OSError if the disk refuses."""
    with atomic_write(path) as unfinished, unfinished.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(HEADER)
        for each in choices:
            for judged in each.claims:
                for finding in judged.findings:
                    writer.writerow((each.choice, each.value, judged.claim.letter, *_cells(finding)))


def _cells(finding: Finding) -> tuple[object, ...]:
    evidence, tails = finding.evidence, finding.evidence.tails
    measured = evidence.figures[-1][1] if evidence.figures else ""
    own = (tails.claim, tails.against, finding.against) if tails else ("", "", "")
    return (evidence.what, measured, *own, finding.verdict.value)
