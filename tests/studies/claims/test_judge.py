"""The paper's claims on made-up results in which they hold, fail, or stay undecided: every verdict can be reached."""

from dataclasses import replace

import numpy as np
import pytest

from mc_nested.studies.claims.judge import judge
from mc_nested.studies.results import Results
from mc_nested.studies.verdicts import JudgedClaim, Verdict
from tests.studies.claims.made_results import Trial, level, made, scattered, the_papers

HOLDS, SLIGHTLY, UNDECIDED, FAILS, NOT_JUDGED = Verdict


TESTED = ("a1", "a2", "a3", "b", "c1", "c2", "c3", "c4", "d1", "d2", "g", "h")
"""The claims that rest on a test of the trials of one training."""


def verdicts(results: Results, longer: Results | None = None) -> dict[str, Verdict]:
    return {judged.claim.letter: judged.verdict for judged in judge(results, longer)}


def judged_claim(letter: str, results: Results, longer: Results | None = None) -> JudgedClaim:
    return next(judged for judged in judge(results, longer) if judged.claim.letter == letter)


def solved(*final_scores: float) -> list[Trial]:
    return [Trial(5, score) for score in final_scores]


def test_results_like_the_papers_confirm_its_claims_except_two_about_cost() -> None:
    assert verdicts(made(the_papers())) == {
        **dict.fromkeys(["a1", "a2", "a3", "b", "c1", "c2", "c3", "c4", "d1", "d2", "e1"], HOLDS),
        "e2": FAILS,  # the single agent has one network
        "f": NOT_JUDGED,
        "g": HOLDS,
        "h": HOLDS,
    }


@pytest.mark.parametrize(
    ("hierarchical", "early", "final"),
    [
        (level(17, early=7), HOLDS, HOLDS),
        (level(20, early=12), UNDECIDED, UNDECIDED),  # level with the nested agent
        (level(19.5, early=11.5), SLIGHTLY, SLIGHTLY),
        (level(17, early=15), FAILS, HOLDS),  # ahead of it early
        (level(21, early=7), HOLDS, FAILS),  # ahead of it at the end
        (scattered(19, early=11), UNDECIDED, UNDECIDED),
    ],
)
def test_early_and_final_leads_on_the_line_are_judged_separately(
    hierarchical: list[Trial], early: Verdict, final: Verdict
) -> None:
    found = verdicts(made({("nested", "line"): level(20, early=12), ("hierarchical", "line"): hierarchical}))
    assert (found["a1"], found["a2"], found["a3"]) == (early, final, final)


def test_the_last_evaluation_and_the_mean_of_the_last_ten_can_differ_in_verdict() -> None:
    results = made({("nested", "line"): level(20), ("hierarchical", "line"): level(17)})

    def ending(agent: str, last: float) -> Results:
        """Return the same results but for that agent's last evaluation."""
        curve = results.curves[agent, "line"]
        scores = curve.scores.copy()
        scores[:, -1] = last
        return replace(results, curves={**results.curves, (agent, "line"): replace(curve, scores=scores)})

    # The last three are about 20, 20 and 10: about as many as 17 in the mean, and far fewer in the last.
    found = verdicts(ending("nested", 10.0))
    assert (found["a2"], found["a3"]) == (FAILS, FAILS)
    found = verdicts(ending("hierarchical", 20.0))
    assert (found["a2"], found["a3"]) == (UNDECIDED, HOLDS)


@pytest.mark.parametrize(
    ("hierarchical", "verdict"),
    [
        (level(16), HOLDS),
        (solved(*[16.9] * 10), HOLDS),  # less than a block above
        (level(20), FAILS),
        (level(12), FAILS),
        (level(16, early=9), FAILS),
        (level(17), UNDECIDED),  # just a block above
        (scattered(16), UNDECIDED),
    ],
)
def test_agents_count_as_alike_within_a_block_both_early_and_at_the_end(
    hierarchical: list[Trial], verdict: Verdict
) -> None:
    results = made(
        {
            ("nested", "zigzag"): solved(*[16.0] * 10),
            ("hierarchical", "zigzag"): hierarchical,
            ("nested", "diamond"): level(18),
            ("hierarchical", "diamond"): level(18),
        }
    )
    assert verdicts(results)["b"] is verdict


@pytest.mark.parametrize(
    ("single", "verdict"),
    [
        (level(9), HOLDS),
        (level(17.5), SLIGHTLY),
        (level(18), UNDECIDED),
        (level(23), FAILS),
        (scattered(17), UNDECIDED),
    ],
)
def test_claims_that_single_is_below_both_agents_follow_singles_scores(single: list[Trial], verdict: Verdict) -> None:
    found = verdicts(made({**the_papers("diamond"), ("single", "diamond"): single}))
    assert [found[letter] for letter in ("c1", "c2", "c3", "c4")] == [verdict] * 4


def test_one_agent_can_be_above_single_and_the_other_not() -> None:
    found = verdicts(made({**the_papers("diamond"), ("hierarchical", "diamond"): level(7)}))
    assert [found[letter] for letter in ("c1", "c2", "c3", "c4")] == [HOLDS, FAILS, HOLDS, FAILS]


@pytest.mark.parametrize(
    ("early", "verdict"),
    [(2.0, HOLDS), (11.5, SLIGHTLY), (12.0, UNDECIDED), (15.0, FAILS)],
    ids=["behind", "less than a block behind", "level", "ahead"],
)
def test_the_claim_of_an_early_lead_over_single_follows_singles_early_scores(early: float, verdict: Verdict) -> None:
    agents = {("nested", "line"): level(20, early=12), ("single", "line"): level(13, early=early)}
    assert verdicts(made(agents))["g"] is verdict


@pytest.mark.parametrize(
    ("nested", "verdict"),
    [
        (level(16, spread=0.5), HOLDS),
        (level(16, spread=3), FAILS),
        (level(16, spread=1.5), UNDECIDED),  # just as the hierarchical agent's
    ],
)
def test_the_claim_of_less_spread_than_hierarchical_follows_nesteds_spread(
    nested: list[Trial], verdict: Verdict
) -> None:
    assert verdicts(made({**the_papers("zigzag"), ("nested", "zigzag"): nested}))["d1"] is verdict


def test_nested_can_spread_less_than_single_but_not_less_than_hierarchical() -> None:
    found = verdicts(made({**the_papers("zigzag"), ("nested", "zigzag"): level(16, spread=1.75)}))
    assert (found["d1"], found["d2"]) == (FAILS, HOLDS)  # 1.5 of hierarchical, 2 of single


def test_findings_give_the_measured_figures_and_their_interval() -> None:
    results = made(the_papers("line"))
    (early,), (final,) = (judged_claim(letter, results).findings for letter in ("a1", "a2"))
    assert early.evidence.figures == (("nested", 12), ("hierarchical", 7), ("difference", 5))
    assert early.evidence.interval == (5, 5)
    assert final.evidence.figures == (("nested", 20), ("hierarchical", 17), ("difference", 3))
    assert final.evidence.interval == (3, 3)  # an eighth of a block more or less in turn, both alike


def test_each_line_of_a_claim_is_decided_by_its_own_p_value() -> None:
    # 1 of 1,024 choices of the signs each: nothing is multiplied, though there are six of (b) and many claims.
    held = judged_claim("b", made(the_papers()))
    assert len(held.findings) == 6
    assert all(finding.verdict is HOLDS for finding in held.findings)


def test_costs_are_counted_once_for_scenarios_that_cost_the_same() -> None:
    networks, parameters = judged_claim("e1", made(the_papers())).findings
    assert networks.evidence.figures == (("nested", 2), ("hierarchical", 3), ("ratio", 2 / 3))
    assert parameters.evidence.figures == (("nested", 3_000), ("hierarchical", 4_500), ("ratio", 2 / 3))
    assert networks.evidence.what == "line, zigzag, diamond, networks of a trial"


def test_the_cost_claim_fails_where_nested_needs_as_many_parameters() -> None:
    results = made(the_papers())
    dear = {
        (agent, scenario): cost._replace(parameters=4_500) if scenario == "diamond" else cost
        for (agent, scenario), cost in results.costs.items()
    }
    assert verdicts(replace(results, costs=dear))["e1"] is FAILS


@pytest.mark.parametrize(
    ("diamond", "verdict"),
    [
        (solved(*[26.0] * 10), HOLDS),
        (solved(*[25.0] * 10), FAILS),
        (solved(*[26.0] * 6, *[25.0] * 4), UNDECIDED),
    ],
)
def test_the_claim_about_more_episodes_follows_the_share_of_trials_at_the_optimum(
    diamond: list[Trial], verdict: Verdict
) -> None:
    long = {
        ("nested", "zigzag"): solved(*[21.0] * 10),
        ("hierarchical", "zigzag"): solved(*[21.0] * 10),
        ("nested", "diamond"): diamond,
        ("hierarchical", "diamond"): solved(*[26.0] * 10),
    }
    short = made({key: level(16, trials=1) for key in long})
    judged = judged_claim("f", short, made(long, episodes=900))
    assert judged.verdict is verdict
    share = sum(trial.final == 26 for trial in diamond) / 10
    assert judged.findings[2].evidence.figures == (("share after 90 episodes", 0), ("share after 900 episodes", share))


def test_no_tested_claim_is_judged_by_a_single_trial() -> None:
    results = made({key: trials[:1] for key, trials in the_papers().items()})
    counted = {"e1": HOLDS, "e2": FAILS}
    found = verdicts(results, results)
    assert found.pop("f") is UNDECIDED  # a share is tested by itself
    assert found == {letter: counted.get(letter, NOT_JUDGED) for letter in (*TESTED, *counted)}


def test_two_trials_are_too_few_for_any_verdict() -> None:
    results = made({key: trials[:2] for key, trials in the_papers().items()})
    assert {verdicts(results)[letter] for letter in TESTED} == {UNDECIDED}


def test_one_scenario_alone_counts_in_the_claims_about_that_scenario() -> None:
    assert verdicts(made(the_papers("zigzag"))) == {
        **dict.fromkeys(["a1", "a2", "a3", "f"], NOT_JUDGED),
        "b": UNDECIDED,  # the diamond is missing
        **dict.fromkeys(["c1", "c2", "c3", "c4", "d1", "d2", "e1", "g", "h"], HOLDS),
        "e2": FAILS,
    }


def test_a_users_scenario_counts_in_the_claims_about_every_scenario() -> None:
    agents = {("nested", "hut"): 14.0, ("hierarchical", "hut"): 10.0, ("single", "hut"): 6.0}
    spreads = {"nested": 0.5, "hierarchical": 2.0, "single": 3.0}
    results = made({key: level(score, spread=spreads[key[0]]) for key, score in agents.items()})
    found = verdicts(results)
    assert {found[letter] for letter in ("a1", "a2", "a3", "b", "f")} == {NOT_JUDGED}
    assert {found[letter] for letter in ("c1", "c2", "c3", "c4", "d1", "d2", "e1")} == {HOLDS}


def test_one_agent_alone_counts_in_no_claim() -> None:
    results = made({key: trials for key, trials in the_papers().items() if key[0] == "nested"})
    assert set(verdicts(results).values()) == {NOT_JUDGED}


def test_no_claim_is_judged_by_a_training_without_evaluations() -> None:
    results = made(the_papers())
    nothing = {
        key: replace(curve, episodes=np.zeros(0, dtype=np.int64), scores=np.zeros((6, 0)))
        for key, curve in results.curves.items()
    }
    found = verdicts(replace(results, curves=nothing))
    assert {found[letter] for letter in TESTED if letter != "h"} == {NOT_JUDGED}
