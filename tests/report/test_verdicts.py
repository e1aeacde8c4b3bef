"""Verdicts follow from the evidence: each can be reached, and Holm's correction is over all claims."""

import pytest

from mc_nested.report.inference import Tails
from mc_nested.report.verdicts import Claim, Evidence, Verdict, judged, verdict_of, verdict_on_all

HOLDS, FAILS, UNDECIDED, NOT_RUN = Verdict.HOLDS, Verdict.FAILS, Verdict.UNDECIDED, Verdict.NOT_RUN


def claim(*evidence: Evidence) -> Claim:
    return Claim("x", "title", "quoted", "5.2", "rule", evidence)


def p_of(for_it: float, against: float) -> Evidence:
    return Evidence("what", tails=Tails(for_it, against))


@pytest.mark.parametrize(
    ("adjusted", "verdict"),
    [
        (Tails(0.049, 1), HOLDS),
        (Tails(0.05, 1), UNDECIDED),
        (Tails(1, 0.049), FAILS),
        (Tails(0.01, 0.01), HOLDS),
        (None, UNDECIDED),
    ],
)
def test_a_test_decides_at_five_per_cent_and_the_one_for_the_claim_goes_first(
    adjusted: Tails | None, verdict: Verdict
) -> None:
    assert verdict_of(Evidence("what"), adjusted) is verdict


@pytest.mark.parametrize("verdict", list(Verdict))
def test_what_is_counted_needs_no_test(verdict: Verdict) -> None:
    assert verdict_of(Evidence("what", counted=verdict), None) is verdict


@pytest.mark.parametrize(
    ("verdicts", "verdict"),
    [
        ([HOLDS, HOLDS], HOLDS),
        ([HOLDS, UNDECIDED], UNDECIDED),
        ([HOLDS, UNDECIDED, FAILS], FAILS),
        ([HOLDS, NOT_RUN], UNDECIDED),
        ([FAILS, NOT_RUN], FAILS),
        ([NOT_RUN, NOT_RUN], NOT_RUN),
        ([], NOT_RUN),
    ],
)
def test_a_claim_holds_where_all_its_evidence_does(verdicts: list[Verdict], verdict: Verdict) -> None:
    assert verdict_on_all(verdicts) is verdict


def test_holm_counts_the_tests_of_all_claims_on_both_sides() -> None:
    # Six p: 0.004 x 6, 0.008 x 5, 0.02 x 4; the rest are 1.
    first, second = judged([claim(p_of(0.008, 1), Evidence("untested")), claim(p_of(0.004, 1), p_of(1, 0.02))])
    assert first.findings[0].adjusted == pytest.approx((0.040, 1))
    assert second.findings[0].adjusted == pytest.approx((0.024, 1))
    assert second.findings[1].adjusted == pytest.approx((1, 0.080))
    assert [finding.verdict for finding in first.findings] == [HOLDS, UNDECIDED]
    assert [finding.verdict for finding in second.findings] == [HOLDS, UNDECIDED]
