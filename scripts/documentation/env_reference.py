"""The reference of the Env, made from the registered environment: its keywords, spaces, actions, reward and info."""

import inspect
from collections.abc import Callable
from typing import get_type_hints

import gymnasium

from mc_nested.arena.action import Action
from mc_nested.arena.env import ArenaEnv, Info
from mc_nested.arena.rules import PLACES, STEP
from mc_nested.entry_point import MadeArenaEnv, made_vector_env
from scripts.documentation.attribute_docs import attribute_docs
from scripts.documentation.markdown_text import code, of_docstring, table

ID = "mc_nested/Arena-v0"

MADE_BY: dict[str, Callable[..., object]] = {
    f'gymnasium.make("{ID}", …)': MadeArenaEnv,
    f'gymnasium.make_vec("{ID}", …)': made_vector_env,
}
"""Each call, and what takes its keywords."""

WAYS = {(0, 1): "forward", (0, -1): "back", (-1, 0): "to the left", (1, 0): "to the right"}


def markdown() -> str:
    """Every part of what gymnasium.make and gymnasium.make_vec return."""
    env = gymnasium.make(ID)
    parts = ["## Making it\n"]
    for call, function in MADE_BY.items():
        keywords = inspect.signature(function).parameters.values()
        rows = [[code(each.name), code(_plain(each.annotation)), code(repr(each.default))] for each in keywords]
        parts += [f"`{call}` takes\n", table(["keyword", "type", "left out"], rows)]
    spaces = [["observation", code(str(env.observation_space))], ["action", code(str(env.action_space))]]
    parts += ["## Spaces\n", "Of the design `line`; x and y grow with the arena, b with the design's blocks.\n"]
    parts += [table(["", "space"], spaces), "An observation is x, y and b, the blocks left.\n"]
    actions = [[str(int(each)), code(_name(each)), _words(each)] for each in Action]
    parts += ["## Actions\n", table(["number", "name", "what it does"], actions)]
    parts += ["## Reward, end and reset\n", of_docstring(inspect.getdoc(ArenaEnv)) + "\n"]
    docs, hints = attribute_docs(Info), get_type_hints(Info)
    parts += ["## info\n", of_docstring(inspect.getdoc(Info)) + "\n"]
    parts += [table(["key", "type", "what it is"], ([code(key), code(_plain(hints[key])), docs[key]] for key in hints))]
    modes = ", ".join(code(mode) for mode in ArenaEnv.metadata["render_modes"])
    parts += ["## Pictures\n", f"Render modes: {modes}. {of_docstring(inspect.getdoc(ArenaEnv.render))}\n"]
    return "\n".join(parts)


def _name(action: Action) -> str:
    return f"{action.name[0]}+D" if action in PLACES else action.name


def _words(action: Action) -> str:
    return f"a cell {WAYS[STEP[action]]}" + (", then a block in front of the agent" if action in PLACES else "")


def _plain(kind: object) -> str:
    """A type as one reads it, without the modules' names."""
    text = kind if isinstance(kind, str) else kind.__name__ if isinstance(kind, type) else str(kind)
    return (
        text.rpartition(".")[2]
        if "[" not in text and "|" not in text
        else text.replace("mc_nested.arena.scenario.", "")
    )
