"""Verdicts follow from the evidence: each can be reached, and only the opposites within a claim are corrected."""

import pytest

from mc_nested.studies.inference import Tails
from mc_nested.studies.verdicts import Claim, Evidence, Verdict, judged, verdict_of, verdict_on_all

HOLDS, FAILS, UNDECIDED, NOT_RUN = Verdict.HOLDS, Verdict.FAILS, Verdict.UNDECIDED, Verdict.NOT_RUN


def claim(*evidence: Evidence) -> Claim:
    return Claim("x", "title", "quoted", "5.2", "rule", evidence)


def p_of(for_it: float, against: float) -> Evidence:
    return Evidence("what", tails=Tails(for_it, against))


@pytest.mark.parametrize(
    ("own", "against", "verdict"),
    [
        (0.049, 1, HOLDS),
        (0.05, 1, UNDECIDED),
        (1, 0.049, FAILS),
        (1, 0.05, UNDECIDED),
        (0.01, 0.01, HOLDS),
    ],
)
def test_a_verdict_needs_p_below_five_per_cent_and_the_claims_own_test_comes_first(
    own: float, against: float, verdict: Verdict
) -> None:
    # The opposite's own p is in the tails, its corrected one decides.
    assert verdict_of(p_of(own, 0.001), against) is verdict


def test_evidence_without_a_test_is_undecided() -> None:
    assert verdict_of(Evidence("what"), None) is UNDECIDED


@pytest.mark.parametrize("verdict", list(Verdict))
def test_counted_evidence_needs_no_test(verdict: Verdict) -> None:
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
def test_a_claim_holds_only_if_all_its_evidence_holds(verdicts: list[Verdict], verdict: Verdict) -> None:
    assert verdict_on_all(verdicts) is verdict


def test_each_line_passes_by_its_own_p_value_in_a_claim_of_any_length() -> None:
    found = judged(claim(*(p_of(0.049, 1) for _ in range(20))))
    assert found.verdict is HOLDS
    assert judged(claim(p_of(0.049, 1), p_of(0.051, 1))).verdict is UNDECIDED


def test_one_opposite_fails_a_claim_after_correction_for_all_opposites_in_the_claim() -> None:
    # Three opposites: 0.01 x 3, 0.02 x 2, 0.9.
    found = judged(claim(p_of(1, 0.02), p_of(1, 0.01), Evidence("untested"), p_of(0.5, 0.9)))
    assert [finding.against for finding in found.findings] == pytest.approx([0.04, 0.03, None, 0.9])
    assert [finding.verdict for finding in found.findings] == [FAILS, FAILS, UNDECIDED, UNDECIDED]
    assert found.verdict is FAILS


def test_an_opposite_that_fails_a_short_claim_may_leave_a_longer_one_undecided() -> None:
    assert judged(claim(p_of(1, 0.03))).verdict is FAILS
    assert judged(claim(p_of(1, 0.03), p_of(1, 0.9))).verdict is UNDECIDED
