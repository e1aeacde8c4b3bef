"""Every claim of the paper about its three agents, with its verdict."""

from mc_nested.studies.claims.costs import fewer_parts, smaller_replays
from mc_nested.studies.claims.scores import (
    above_single,
    ahead_of_single_early,
    ahead_on_the_line,
    alike_on_the_unsolved,
    solved_in_the_end,
    steadier,
)
from mc_nested.studies.results import Results
from mc_nested.studies.verdicts import JudgedClaim, judged


def judge(results: Results, longer: Results | None = None) -> tuple[JudgedClaim, ...]:
    """Judge every claim; ``longer`` is the same experiment with ten times the episodes, for claim (f)."""
    curves, costs = results.curves, results.costs
    claims = (
        *ahead_on_the_line(curves),
        alike_on_the_unsolved(curves),
        *above_single(curves, results.scenarios),
        *steadier(curves, results.scenarios),
        *fewer_parts(costs, results.scenarios),
        solved_in_the_end(results, longer),
        ahead_of_single_early(curves, results.scenarios),
        smaller_replays(costs, results.scenarios),
    )
    return tuple(judged(claim) for claim in claims)
