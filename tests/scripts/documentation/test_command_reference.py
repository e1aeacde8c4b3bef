"""The reference of the command line: every verb and option of the command as it is."""

from mc_nested.cli.app import VERBS
from scripts.documentation.command_reference import markdown, options_of, verbs


def section(words: str) -> str:
    page = markdown()
    begin = page.index(f"## {words}\n")
    end = page.find("\n## ", begin + 1)
    return page[begin : end if end > 0 else None]


def test_every_verb_is_there_in_the_order_of_the_help_and_those_below_calibrate() -> None:
    words = [each for each, _ in verbs()]
    assert words[0] == "mc-nested"
    assert [each.split()[1] for each in words[1:] if len(each.split()) == 2] == list(VERBS)
    assert "mc-nested calibrate all" in words


def test_an_option_has_its_value_its_meaning_its_default_and_its_limits() -> None:
    page = section("mc-nested rehearse")
    assert "```text\nmc-nested rehearse [OPTIONS]\n```" in page
    assert "| `--size WxH` | Width and height in pixels [854x480]. |" in page
    scale = "The GUI scale, if it fits; 0 is auto [what guiScale says]. From 0 to 100."
    assert f"| `--gui-scale NUMBER` | {scale} |" in page
    assert "| `--lag NUMBER` | Milliseconds that keys, and pictures, come late [0.0]. From 0 to 500. |" in page


def test_arguments_choices_and_flags_are_named_as_they_are_typed() -> None:
    page = section("mc-nested play")
    assert "mc-nested play RUN [OPTIONS]" in page
    assert "| `RUN` | The folder of a training (its --out). |" in page
    assert "`--backend sim|virtual|live`" in page
    assert "| `--screenshots` |" in page


def test_the_fields_of_json_are_below_the_verb_that_prints_them() -> None:
    assert "| `steps` | Of the episode. |" in section("mc-nested play")
    assert "| `files` | Names of its files. |" in section("mc-nested runs show")
    assert "it prints an object" not in section("mc-nested rehearse")


def test_help_is_no_option_of_its_own() -> None:
    assert not any("--help" in option.opts for _, command in verbs() for option in options_of(command))
