"""The report is one document that fetches nothing, names no user, has its listed contents, and escapes all text."""

import base64
import dataclasses
import re
from html.parser import HTMLParser

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from calibration.context import ReportPicture
from calibration.report.findings import CheckFinding, Findings, StepFindings
from calibration.report.page import SMALL_BYTES, CalibrationReport, contents, data_uri, report_html
from calibration.report.privacy import Names
from mc_nested.live.profile.tables import CalibratedTable, Profile

NOBODY = Names("/nowhere/at/all", ())
GREY = np.full((3, 4, 3), 99, np.uint8)
FONT = StepFindings(
    "font", "2026-11-21", ("GUI scale 2", "13 lines read"), 12, (ReportPicture("The debug screen", GREY, "F3"),)
)
WALK = StepFindings("walk", "2026-11-21", ("0.216 blocks a tick",), 96, (ReportPicture("The curve", GREY),))
CHECKS = (
    CheckFinding(name="session", status="pass", detail="X11"),
    CheckFinding(name="window", status="fail", detail="not found", fix="start the game"),
)
MADE = CalibrationReport(
    "mine",
    Profile(
        calibrated=CalibratedTable(
            date="2026-11-21", version="1.20.1", window=(854, 480), gui_scale=2, samples={"font": 12}
        )
    ),
    "[window]\n",
    Findings((WALK, FONT), CHECKS, "2026-11-21"),
    "0.1.0",
)
VOID = {"meta", "img", "br", "link", "input", "hr"}


class Page(HTMLParser):
    """The document as a browser sees it: tags with their attributes, texts, and the tags that are still open."""

    def __init__(self, html: str) -> None:
        super().__init__()
        self.tags: list[tuple[str, dict[str, str | None]]] = []
        self.texts: list[str] = []
        self.open: list[str] = []
        self.feed(html)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if data.strip() and "style" not in self.open:
            self.texts.append(data.strip())

    def of(self, tag: str) -> list[dict[str, str | None]]:
        return [attributes for name, attributes in self.tags if name == tag]


def page(report: CalibrationReport, names: Names = NOBODY) -> Page:
    return Page(report_html(report, names))


def test_the_report_is_one_whole_document_without_scripts() -> None:
    seen = page(MADE)
    assert seen.open == []
    names = {name for name, _ in seen.tags}
    assert {"html", "head", "body", "title"} <= names
    assert not names & {"script", "link", "iframe", "object", "embed", "form", "a", "base", "video", "audio"}


def test_the_report_fetches_nothing() -> None:
    html = report_html(MADE, NOBODY)
    assert not re.search(r"https?://|url\(|@import|//\w", html)
    seen = Page(html)
    attributes = [pair for _, each in seen.tags for pair in each.items()]
    assert all((value or "").startswith("data:image/") for name, value in attributes if name in ("src", "href"))
    assert not [name for name, _ in attributes if name.startswith("on") or name == "srcset"]
    policy = next(tag["content"] for tag in seen.of("meta") if tag.get("http-equiv") == "Content-Security-Policy")
    assert policy == "default-src 'none'; img-src data:; style-src 'unsafe-inline'"


def test_the_report_shows_the_fingerprint_the_checks_and_the_steps_in_the_order_of_the_run() -> None:
    texts = page(MADE).texts
    for text in ("1.20.1", "854 x 480", "2026-11-21", "not found", "start the game", "0.216 blocks a tick"):
        assert text in texts
    assert texts.index("Font and screen") < texts.index("Walk") < texts.index("Doctor") < texts.index("[window]")
    assert texts.index("window") < texts.index("session"), "what fails comes first"


def test_a_fix_is_shown_only_where_something_has_to_be_done() -> None:
    done = CheckFinding(name="game", status="pass", detail="found", fix="not needed")
    assert "not needed" not in page(dataclasses.replace(MADE, findings=Findings((), (done,)))).texts


def test_the_reports_list_of_contents_stands_at_its_top_word_for_word() -> None:
    seen = page(MADE)
    assert seen.texts[seen.texts.index("In this file") + 1 :][: len(contents(MADE))] == contents(MADE)
    assert "2 checks" in contents(MADE)[0]
    assert contents(MADE)[1] == "what was found: 3 lines (Font and screen, Walk)"
    assert contents(MADE)[2].startswith("2 pictures of the game's window")


def test_small_picture_is_embedded_without_loss() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (20, 30, 3), np.uint8)
    step = dataclasses.replace(FONT, pictures=(ReportPicture("noise", noise),))
    (image,) = page(dataclasses.replace(MADE, findings=Findings((step,)))).of("img")
    kind, data = (image["src"] or "").split(",")
    assert kind == "data:image/png;base64"
    decoded = cv2.imdecode(np.frombuffer(base64.b64decode(data), np.uint8), cv2.IMREAD_COLOR)
    assert decoded is not None
    assert np.array_equal(decoded, noise)
    assert (image["width"], image["height"], image["alt"]) == ("30", "20", "noise")


def test_large_picture_is_embedded_as_a_small_jpeg() -> None:
    noise = np.random.default_rng(0).integers(0, 256, (540, 960, 3), np.uint8)
    assert data_uri(noise).startswith("data:image/jpeg;base64,")
    assert len(data_uri(noise)) < 2 * SMALL_BYTES


def test_report_without_pictures_says_how_many_were_left_out() -> None:
    bare = dataclasses.replace(MADE, with_pictures=False)
    seen = page(bare)
    assert seen.of("img") == []
    assert "no pictures: 2 left out" in seen.texts
    assert "The debug screen" not in seen.texts


def test_a_profile_that_was_never_calibrated_has_a_report_that_says_so() -> None:
    bare = dataclasses.replace(MADE, profile=Profile(), findings=Findings())
    assert {"not as a whole", "no doctor's table: none was kept", "no findings: none were kept"} <= set(
        page(bare).texts
    )


HTML = st.text(st.sampled_from("<>&\"'/={}%abim sx"), max_size=30)


@given(HTML)
def test_html_in_any_text_is_escaped(text: str) -> None:
    step = StepFindings(text, text, (text,), 1, (ReportPicture(text, GREY, text),))
    check = CheckFinding(name=text, status="warn", detail=text, fix=text)
    plain = page(MADE)
    seen = page(CalibrationReport(text, MADE.profile, text, Findings((FONT, step), (*CHECKS, check), text), text))
    assert seen.open == []
    assert {name for name, _ in seen.tags} == {name for name, _ in plain.tags}
    if text.strip():
        assert text.strip() in seen.texts


@given(st.text("bdfhjkqvwz", min_size=4, max_size=8), st.sampled_from(["", "'", " ", "/", ".", "_7"]))
def test_user_names_and_home_folders_are_removed_from_the_report(name: str, around: str) -> None:
    names = Names(f"/home/{name}", (name,))
    text = f"{around}{name}{around} in /home/{name}/x, C:\\Users\\{name}\\x"
    step = StepFindings("font", text, (text,), 1, (ReportPicture(text, GREY, text),))
    made = CalibrationReport(
        text,
        MADE.profile,
        text,
        Findings((step,), (CheckFinding(name=text, status="warn", detail=text, fix=text),)),
        "",
    )
    html = report_html(made, names)
    left = re.sub(r"data:image/\w+;base64,[^\"]*", "", html[html.index("</style>") :])
    assert name not in left


def test_a_picture_is_not_searched_for_names() -> None:
    # The letters of base64 may read like one.
    uri = data_uri(GREY)
    found = re.search(r"(?<![a-zA-Z])[a-zA-Z]{2,}(?![a-zA-Z])", uri.split(",")[1])
    assert found
    assert uri in report_html(MADE, Names("/x", (found[0],)))


@pytest.mark.parametrize("rule", ["prefers-color-scheme: dark", "@media print", "max-width"])
def test_the_report_fits_dark_screens_paper_and_phones(rule: str) -> None:
    assert rule in report_html(MADE, NOBODY)
