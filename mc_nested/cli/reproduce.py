"""``mc-nested reproduce``: the paper's experiment, a study with a verb of its own."""

from mc_nested.cli.study import command_of, declared

reproduce = command_of(declared("reproduce"))
