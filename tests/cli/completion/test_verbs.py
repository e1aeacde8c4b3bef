"""The list that shells complete from is that of the command as it is."""

from pathlib import Path

from mc_nested.cli.completion import verbs
from mc_nested.cli.completion.verbs import Parameter, Verb, shipped, text_of
from scripts.write_completions import written


def test_the_list_is_up_to_date() -> None:
    file = Path(verbs.__file__).with_name(verbs.FILE)
    assert file.read_text("utf-8") == written(), "after changing an option: python scripts/write_completions.py"


def test_what_is_written_is_read_back() -> None:
    assert text_of(shipped()) == Path(verbs.__file__).with_name(verbs.FILE).read_text("utf-8")


def test_an_option_is_listed_with_what_its_value_can_be() -> None:
    train = shipped().verbs["train"].parameters
    by_name = {name: parameter for parameter in train for name in parameter.names}
    assert by_name["--backend"] == Parameter(["--backend"], "where [sim]", choices=["sim", "virtual", "live"])
    assert by_name["-q"].words == 0
    assert by_name["--quiet"] is by_name["-q"]
    assert by_name["--resume"].ones_own == "runs"
    assert by_name["--profile"].ones_own == "profiles"
    assert by_name["--preset"].choices == ["image", "live", "paper", "tuned"]
    assert "--install-completion" not in by_name


def test_verbs_of_verbs_are_listed_too() -> None:
    assert {"all", "arena", "undo"} <= shipped().verbs["calibrate"].verbs.keys()
    (name, new_name) = shipped().verbs["runs"].verbs["rename"].parameters
    assert (name.names, name.ones_own, new_name.ones_own) == ((), "runs", "")
    assert shipped().verbs["read"].parameters[0] == Parameter(help="screenshots with the debug screen on", words=-1)
    assert isinstance(shipped().verbs["doctor"], Verb)
