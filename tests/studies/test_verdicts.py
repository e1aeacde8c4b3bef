"""Verdicts follow from the evidence: each can be reached, and only the opposites within a claim are corrected."""

import pytest

from mc_nested.studies.inference import Tails
from mc_nested.studies.verdicts import Claim, Evidence, Verdict, judged, verdict_of, verdict_on_all

HOLDS, SLIGHTLY, UNDECIDED, FAILS, NOT_JUDGED = Verdict


def claim(*evidence: Evidence) -> Claim:
    return Claim("x", "title", "quoted", "5.2", "rule", evidence)


def p_of(for_it: float, against: float, small: float | None = None) -> Evidence:
    return Evidence("what", tails=Tails(for_it, against, small))


@pytest.mark.parametrize(
    ("own", "against", "small", "verdict"),
    [
        (0.049, 1, None, HOLDS),
        (0.049, 1, 0.05, HOLDS),
        (0.049, 1, 0.049, SLIGHTLY),
        (0.05, 1, 0.049, UNDECIDED),
        (1, 0.049, 0.049, FAILS),
        (1, 0.05, None, UNDECIDED),
    ],
)
def test_a_line_has_one_of_four_verdicts_by_three_p_values_below_five_per_cent(
    own: float, against: float, small: float | None, verdict: Verdict
) -> None:
    # The opposite's own p is in the tails, its corrected one decides; and so it is with that of a small difference.
    assert verdict_of(p_of(own, 0.001, 0.001), against, small) is verdict


def test_evidence_without_a_test_is_not_judged() -> None:
    assert verdict_of(Evidence("what"), None) is NOT_JUDGED


@pytest.mark.parametrize("verdict", list(Verdict))
def test_counted_evidence_needs_no_test(verdict: Verdict) -> None:
    assert verdict_of(Evidence("what", counted=verdict), None) is verdict


@pytest.mark.parametrize(
    ("verdicts", "verdict"),
    [
        ([HOLDS, HOLDS], HOLDS),
        ([HOLDS, SLIGHTLY], SLIGHTLY),
        ([SLIGHTLY, UNDECIDED], UNDECIDED),
        ([HOLDS, UNDECIDED, FAILS], FAILS),
        ([HOLDS, NOT_JUDGED], UNDECIDED),
        ([FAILS, NOT_JUDGED], FAILS),
        ([NOT_JUDGED, NOT_JUDGED], NOT_JUDGED),
        ([], NOT_JUDGED),
    ],
)
def test_a_claim_has_the_weakest_verdict_of_its_lines(verdicts: list[Verdict], verdict: Verdict) -> None:
    assert verdict_on_all(verdicts) is verdict


def test_each_line_passes_by_its_own_p_value_in_a_claim_of_any_length() -> None:
    found = judged(claim(*(p_of(0.049, 1) for _ in range(20))))
    assert found.verdict is HOLDS
    assert judged(claim(p_of(0.049, 1), p_of(0.051, 1))).verdict is UNDECIDED


def test_one_opposite_fails_a_claim_after_correction_for_all_opposites_in_the_claim() -> None:
    # Three opposites: 0.01 x 3, 0.02 x 2, 0.9.
    found = judged(claim(p_of(1, 0.02), p_of(1, 0.01), Evidence("untested"), p_of(0.5, 0.9)))
    assert [finding.against for finding in found.findings] == pytest.approx([0.04, 0.03, None, 0.9])
    assert [finding.verdict for finding in found.findings] == [FAILS, FAILS, NOT_JUDGED, UNDECIDED]
    assert found.verdict is FAILS


def test_an_opposite_that_fails_a_short_claim_may_leave_a_longer_one_undecided() -> None:
    assert judged(claim(p_of(1, 0.03))).verdict is FAILS
    assert judged(claim(p_of(1, 0.03), p_of(1, 0.9))).verdict is UNDECIDED


def test_which_lines_are_small_is_corrected_within_the_claim() -> None:
    found = judged(claim(p_of(0.01, 1, 0.03), p_of(0.01, 1, 0.02), p_of(0.01, 1)))
    assert [finding.small for finding in found.findings] == pytest.approx([0.04, 0.04, None])
    assert found.verdict is SLIGHTLY
    assert judged(claim(p_of(0.01, 1, 0.03), p_of(0.01, 1, 0.9))).verdict is HOLDS


def test_an_undecided_claim_is_within_a_block_where_all_its_undecided_lines_are() -> None:
    within, open_, held = p_of(0.5, 0.5, 0.001), p_of(0.5, 0.5, 0.5), p_of(0.01, 1, 1)
    assert judged(claim(within, held)).words == "undecided, within a block"
    assert judged(claim(within, open_)).words == "undecided"
    assert judged(claim(held)).words == "holds"
