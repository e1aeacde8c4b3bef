"""The part of a report that says what was judged: the claims, each claim's lines, and how it was judged."""

from collections.abc import Sequence

from mc_nested.studies.inference import ALPHA, RESAMPLES, SIMULATED
from mc_nested.studies.table import Cells, interval, markdown_of, probability, two
from mc_nested.studies.verdicts import Evidence, Finding, JudgedClaim

METHOD = """\
- A claim has the weakest answer of its lines. It holds if all of them do: each line's own p is below α = {alpha:g}. To
  hold wrongly, a line that isn't so would have to pass, which each alone does with a probability below α: no correction
  is needed (an intersection-union test).
- A claim does not hold if the opposite of any of its lines is shown. One error among its lines would be enough for
  that, so the p of the opposites are corrected by Holm's method, within the claim.
- No line can be shown together with its opposite. That a difference is less than a block is a third question: two
  one-sided tests, corrected within the claim likewise.
- Each claim is a question of its own, none is an alternative to another: nothing is corrected across claims. Of twenty
  claims that aren't so, one would be expected to hold by chance.
- Trials of one number are a pair: the seed that they share gives them the same random numbers, and nested and
  hierarchical the same first weights of the main network. So the differences within pairs are tested.
- Sign-flip tests take each difference to be as likely to have the other sign. Where one agent's trials are far more
  skewed than the other's, ten pairs are too few for that: in a simulation, α = 0.05 was then 0.12. They go through all
  choices of the signs where there are at most {splits:,}, else through as many drawn with a fixed seed, which makes
  {smallest} the smallest p.
- The intervals of means and differences are Student's t, those of a score cut at the optimum, which no mean exceeds.
  Beside each stands how often such an interval holds the mean, in {simulated:,} experiments of as many trials drawn
  from these. Where half of the trials or more are at the optimum there is no interval of the mean: they are counted.
  Intervals of shares are exact. None is corrected for being one of many: an interval without 0 can occur beside an
  undecided test. An interval without width says that no trial differed, not that no other would.
- A main agent that chooses once an episode sees the same state each time. So it is a bandit with an arm for each
  material, and once its ε is small, nested and hierarchical differ by one nearly constant input of the nested agent.
- Greedy episodes don't vary by chance: a final score is one episode. What varies is the training, so the unit is the
  trial.
- {kept}
- A small spread is no merit in an agent that is stuck: read it together with the final score.
- Undecided means that these trials don't show it, not that there is no difference."""

KEPT = {
    False: "A final score is that of the last evaluation. One evaluation later it may be another: the mean of the last "
    "ten varies less.",
    True: "A final score is that of the policy that is kept, the best at any evaluation. The mean of the last ten is "
    "over the last evaluations, whichever policy is kept.",
}
"""What the final score is, by whether a trial keeps its best policy."""

TOO_FEW_TRIALS = """
- With {trials} trials no sign-flip test can come below {smallest}: no claim that rests on one can hold, whatever was
  measured. Train more trials."""

TOO_FEW_AGAINST = """
- With {trials} trials no sign-flip test can come below {smallest}: a claim of {lines} tested lines or more can't be
  shown not to hold by one of them alone. Train more trials."""


def found_of(judged: JudgedClaim) -> dict[str, str]:
    """Return a claim and its verdict, for a program."""
    return {"letter": judged.claim.letter, "claim": judged.claim.title, "verdict": judged.verdict.value}


def row_of(judged: JudgedClaim) -> tuple[str, str, str]:
    """Return the same for a person, as cells of a table."""
    return f"({judged.claim.letter})", judged.claim.title, judged.words


def claim_section(judged: JudgedClaim) -> str:
    """Return what the paper says, what was measured, and the verdict."""
    claim = judged.claim
    rows = [
        (
            ("", finding.evidence.what),
            ("measured", _figures(finding.evidence)),
            ("95 % interval", interval(finding.evidence.interval, finding.evidence.coverage)),
            *_p_values(finding),
            ("verdict", _verdict(finding)),
        )
        for finding in judged.findings
    ]
    return (
        f"### ({claim.letter}) {claim.title}: {judged.words}\n\n"
        f'The paper, section {claim.section}: "{claim.paper}".\n\n'
        f"{markdown_of(rows)}\n\n{claim.rule}"
    )


def method(claims: Sequence[JudgedClaim], trials: int, keeps_best: bool) -> str:
    """Return how the claims were judged, and what so many trials can't show."""
    text = METHOD.format(
        alpha=ALPHA,
        splits=RESAMPLES + 1,
        simulated=SIMULATED,
        smallest=probability(1 / (RESAMPLES + 1)),
        kept=KEPT[keeps_best],
    )
    smallest = max(0.5**trials, 1 / (RESAMPLES + 1))  # p where no other choice of the signs is as extreme
    if trials < 2:
        return text
    if smallest >= ALPHA:
        return text + TOO_FEW_TRIALS.format(trials=trials, smallest=probability(smallest))
    lines = int(ALPHA / smallest) + 1
    tested = [sum(finding.evidence.tails is not None for finding in judged.findings) for judged in claims]
    if lines <= max(tested, default=0):
        return text + TOO_FEW_AGAINST.format(trials=trials, smallest=probability(smallest), lines=lines)
    return text


def _figures(evidence: Evidence) -> str:
    return ", ".join(
        f"{name} {value:,}" if isinstance(value, int) else f"{name} {two(value)}" for name, value in evidence.figures
    )


def _p_values(finding: Finding) -> Cells:
    tails = finding.evidence.tails
    own = (tails.claim, tails.against, finding.against, finding.small) if tails else (None,) * 4
    names = ("p", "p of the opposite", "after Holm", "p of less than a block, after Holm")
    return [(name, probability(p)) for name, p in zip(names, own, strict=True)]


def _verdict(finding: Finding) -> str:
    missing = finding.evidence.missing
    return f"{finding.words}: {missing}" if missing else finding.words
