"""Questions to the stand-in's oracle: its server's state, and what its page shows. Standard library only."""

import json
import urllib.error
import urllib.request
from typing import Any

ANSWER_S = 5.0

# A proxy of the environment must not be used for 127.0.0.1.
_DIRECT = urllib.request.build_opener(urllib.request.ProxyHandler({}))


class OracleError(Exception):
    """The oracle gave no answer, or refused the question; the message is one line."""


def ask(oracle: str, question: str) -> Any:
    """The answer to a question of standin/oracle.js, such as ``/player``; OracleError where there is none."""
    try:
        with _DIRECT.open(oracle + question, timeout=ANSWER_S) as answer:
            return json.load(answer)
    except urllib.error.HTTPError as error:
        with error:
            raise OracleError(f"{question}: {json.load(error)['error']}") from error
    except (OSError, ValueError) as error:
        raise OracleError(f"{oracle} does not answer {question} ({error})") from error


def answers(oracle: str) -> bool:
    """Whether there is an oracle, and a player in its world."""
    try:
        ask(oracle, "/player")
    except OracleError:
        return False
    return True


def blocks(oracle: str, low: tuple[int, int, int], high: tuple[int, int, int]) -> dict[tuple[int, int, int], str]:
    """The blocks other than air between two corners, which are included, by position."""
    corners = [",".join(map(str, corner)) for corner in (low, high)]
    found = ask(oracle, f"/blocks?from={corners[0]}&to={corners[1]}")
    return {(each["pos"][0], each["pos"][1], each["pos"][2]): each["name"] for each in found}
