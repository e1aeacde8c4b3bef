"""``mc-nested reproduce``: the paper's experiment, a study with a verb of its own, and short ways to two others."""

from mc_nested.cli.study import command_of, declared

reproduce = command_of(
    declared("reproduce"),
    {
        "beyond": "try what the paper says it could do instead: images, several and many main actions, teams",
        "robustness": "judge the claims again under each of the paper's open choices instead",
    },
)
