"""The claims of --beyond on arms whose every score is known: which way each verdict falls, and why."""

from collections.abc import Callable

import pytest

from mc_nested.studies.claims.beyond import equal_budget, judge_beyond, of_topic
from mc_nested.studies.verdicts import Verdict
from tests.studies.claims.made_arms import OPTIMUM, arm, trial_of, whole

TRIALS = 8
"""Enough for every verdict, and a fifteenth of the splits of ten that a test goes through."""

Means = Callable[[str, str, int], float]


def verdicts(means: Means, trials: int = TRIALS, image_trials: int = TRIALS) -> dict[str, Verdict]:
    judged = judge_beyond(whole(means, trials, image_trials))
    return {each.claim.letter: each.verdict for each in judged}


def as_the_paper_says(topic: str, name: str, count: int) -> float:
    """Return a mean like the paper's hopes; some lie above the optimum, so that every trial reaches it."""
    if (topic, name) in {("images", "images"), ("parts", "tuned"), ("cooperation", "shared")}:
        return OPTIMUM + 0.5
    if name == "own":
        return 18.0
    leads = {"nested": 10.0 + count, "hierarchical": 8.0, "single": 7.0, "numbers": 12.0, "alone": 12.0}
    return leads[name]


def test_every_claim_holds_on_arms_like_the_papers_hopes() -> None:
    found = verdicts(as_the_paper_says)
    numbers = {"j": 2, "k": 3, "l": 7, "m": 4}
    assert list(found) == [f"{letter}{number}" for letter, last in numbers.items() for number in range(1, last + 1)]
    assert set(found.values()) == {Verdict.HOLDS}


def test_claims_of_a_lead_stay_undecided_where_all_arms_are_alike() -> None:
    found = verdicts(lambda *_: 15.0)
    assert found["l7"] is Verdict.HOLDS
    assert found["j2"] is Verdict.HOLDS
    for letter in ("j1", "k1", "m1"):
        assert found[letter] is Verdict.FAILS, letter
    for letter in ("k2", "k3", "l1", "l2", "l3", "l4", "l5", "l6", "m2", "m3", "m4"):
        assert found[letter] is Verdict.UNDECIDED, letter


@pytest.mark.parametrize("other", ["hierarchical", "single"])
def test_a_shrinking_lead_fails_the_claims_about_that_agent_alone(other: str) -> None:
    def means(topic: str, name: str, count: int) -> float:
        return 10.0 + count if topic == "materials" and name == other else 10.0

    found = verdicts(means)
    letters = {"hierarchical": ("l1", "l2", "l5"), "single": ("l3", "l4", "l6")}
    for agent, own in letters.items():
        assert {found[letter] for letter in own} == {Verdict.FAILS if agent == other else Verdict.UNDECIDED}


def test_images_behind_by_more_than_a_block_on_one_design_fail_their_claim() -> None:
    arms = whole(trials=TRIALS, image_trials=TRIALS)
    low = arm("images", "images", [trial_of([12.0 + 0.1 * trial] * 3) for trial in range(TRIALS)], "zigzag")
    arms[low.key] = low
    claim = next(each for each in judge_beyond(arms) if each.claim.letter == "j2")
    assert claim.verdict is Verdict.FAILS
    assert [line.verdict for line in claim.findings] == [Verdict.HOLDS, Verdict.FAILS, Verdict.HOLDS]


def test_three_trials_of_images_leave_their_claim_undecided() -> None:
    assert verdicts(as_the_paper_says, image_trials=3)["j1"] is Verdict.UNDECIDED


def test_no_tested_claim_is_judged_by_a_single_trial() -> None:
    found = verdicts(as_the_paper_says, trials=1, image_trials=1)
    assert found.pop("l7") is Verdict.HOLDS
    assert set(found.values()) == {Verdict.NOT_JUDGED, Verdict.UNDECIDED}


def test_networks_that_do_not_grow_fail_their_claim() -> None:
    arms = whole(trials=TRIALS)
    for count in (2, 4, 8):
        same = arm("materials", "hierarchical", [trial_of([3.0] * 3)] * 2, f"line, {count} materials", count, 3)
        arms[same.key] = same
    assert next(each for each in judge_beyond(arms) if each.claim.letter == "l7").verdict is Verdict.FAILS


def test_the_equal_budget_is_that_of_the_poorest_trial_of_any_number_of_materials() -> None:
    arms = whole()
    assert equal_budget(of_topic(arms, "materials"), "steps") == 1200
    poor = arm("materials", "single", [trial_of([3.0] * 12), trial_of([3.0] * 7)], "line, 8 materials", 8, 1)
    arms[poor.key] = poor
    assert equal_budget(of_topic(arms, "materials"), "steps") == 700
    assert equal_budget(of_topic(arms, "materials"), "updates") == 630


def test_a_third_agents_budget_does_not_limit_the_contest_of_two_others() -> None:
    """Hierarchical falls behind only at the end, which counts however few steps the single agent had."""
    arms = whole(trials=TRIALS)
    for count in (2, 8):
        late = [trial_of([15.0] * 2 + [15.0 - count + 0.1 * trial] * 10) for trial in range(TRIALS)]
        poor = [trial_of([15.0 + 0.1 * trial] * 2) for trial in range(TRIALS)]
        for name, trials, networks in (("hierarchical", late, 1 + count), ("single", poor, 1)):
            own = arm("materials", name, trials, f"line, {count} materials", count, networks)
            arms[own.key] = own
    found = {each.claim.letter: each.verdict for each in judge_beyond(arms)}
    assert (found["l1"], found["l2"]) == (Verdict.HOLDS, Verdict.HOLDS)
    assert (found["l3"], found["l4"]) == (Verdict.UNDECIDED, Verdict.UNDECIDED)


def test_every_claim_but_the_counted_one_gives_an_effect() -> None:
    for judged in judge_beyond(whole(as_the_paper_says, TRIALS)):
        assert all(line.effect for line in judged.claim.evidence) == (judged.claim.letter != "l7")
