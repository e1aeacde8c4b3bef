"""The game's font is found on the screen of virtual clients, among jars, packs and wrong fonts.

Why no font reads the screen, from frames painted for the test.
"""

import dataclasses
import zipfile
from pathlib import Path

import numpy as np
import pytest

from calibration.font.find import Candidate, calibrate_font, find_font, fits_in_part, nothing_fits
from calibration.font.sources import FontSources
from mc_nested.errors import ClipboardError, FontError, LiveError, NotInFrontError, UnreadableError
from mc_nested.live.devices import Frame
from mc_nested.live.profile.store import load_profile
from mc_nested.live.profile.tables import Profile
from mc_nested.live.vision.font import ENTRY, Font, decoded
from scripts.benches.painted_screen import paint
from sim.client.client import VirtualClient
from sim.client.game.f3_screen import F3Screen
from tests.calibration.contexts import SPANISH, context_of, context_over, font_file_in, started
from tests.sim.client.playing import FONT


def sources_in(folder: Path) -> FontSources:
    return FontSources((font_file_in(folder),))


def flipped() -> Font:
    """Return another font: every glyph upside down."""
    return Font({char: bytes(int(f"{byte:08b}"[::-1], 2) for byte in columns) for char, columns in FONT.glyphs.items()})


def jar(path: Path, picture: Path | None) -> Path:
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("META-INF/MANIFEST.MF", "")
        if picture:
            archive.write(picture, ENTRY)
    return path


@pytest.mark.parametrize(
    ("version", "scale", "size"),
    [
        ("1.12.2", 1, (854, 480)),
        ("1.16.5", 2, (1024, 768)),
        ("1.20.1", 3, (1366, 768)),
        ("26.1", 4, (2560, 1440)),
    ],
)
def test_scale_colour_and_phase_are_found_and_every_line_is_read_back(
    version: str, scale: int, size: tuple[int, int], tmp_path: Path
) -> None:
    client = started(VirtualClient(version=version, scale=scale, size=size, pitch=65.0))
    found = find_font(context_over(client), Profile(), sources_in(tmp_path))
    assert found.profile.screen.font == str(tmp_path / "ascii.png")
    assert f"GUI scale {scale}, text (224, 224, 224), a line every 9 dots, dots from the corner on" in found.lines
    assert f"read back: {found.samples} of {found.samples} lines without an unknown glyph" in found.lines
    assert found.samples >= 10
    assert (client.game.screen, client.window.down, client.window.strays) == ("world", set(), [])


@pytest.mark.parametrize(("version", "line"), [("1.20.1", "F3+C agrees"), ("1.12.2", "it came with 1.13")])
def test_the_font_is_checked_with_f3_and_c_where_the_version_has_that(version: str, line: str, tmp_path: Path) -> None:
    client = started(VirtualClient(version=version))
    client.clipboard.write("mine")
    assert line in find_font(context_over(client), Profile(), sources_in(tmp_path)).lines[-1]
    assert client.clipboard.read() == "mine"


def test_the_font_is_found_among_jars_of_other_versions_and_broken_ones(tmp_path: Path) -> None:
    own = font_file_in(tmp_path)
    broken = tmp_path / "broken.jar"
    broken.write_bytes(b"PK\3\4 and no more")
    paths = (broken, jar(tmp_path / "empty.jar", None), jar(tmp_path / "1.20.1.jar", own), own)
    found = find_font(context_over(started(VirtualClient())), Profile(), FontSources(paths))
    assert found.profile.screen.font == str(tmp_path / "1.20.1.jar")
    assert [line for line in found.lines if line.startswith("not used:")] == [
        line for line in found.lines if "broken.jar" in line or "empty.jar" in line
    ]


def test_letters_that_fit_no_jar_are_reported_with_the_jars_that_were_tried(tmp_path: Path) -> None:
    client = started(VirtualClient(font=flipped()))
    one = jar(tmp_path / "1.20.1.jar", font_file_in(tmp_path))
    with pytest.raises(FontError, match=r"fit none of these fonts: \S*1\.20\.1\.jar: .* Force Unicode Font off$"):
        find_font(context_over(client), Profile(), FontSources((one,)))
    client.clock.sleep(0.3)
    assert client.game.has_f3, "the debug screen that was on is on again"
    assert client.window.down == set()


def test_error_names_another_language_that_options_txt_gives(tmp_path: Path) -> None:
    client = started(VirtualClient(font=flipped()))
    sources = dataclasses.replace(sources_in(tmp_path), options={"lang": "ja_jp"})
    with pytest.raises(FontError, match=r"set the language to English \(it is ja_jp\)"):
        find_font(context_over(client), Profile(), sources)


def test_error_names_force_unicode_font_that_options_txt_has_on(tmp_path: Path) -> None:
    client = started(VirtualClient(font=flipped()))
    sources = dataclasses.replace(sources_in(tmp_path), options={"forceUnicodeFont": "true"})
    with pytest.raises(FontError, match="Force Unicode Font is on"):
        find_font(context_over(client), Profile(), sources)


@pytest.mark.slow
def test_a_gui_scale_that_is_too_large_is_named(tmp_path: Path) -> None:
    client = started(VirtualClient(size=(2880, 2160), scale=9))
    with pytest.raises(UnreadableError, match="the GUI scale is 9: choose 1 to 8"):
        find_font(context_over(client), Profile(), sources_in(tmp_path))


@pytest.mark.parametrize("screen", ["pause", "chat", "inventory", "death", "title", "worlds"])
def test_a_menu_that_is_open_is_left_first(screen: str, tmp_path: Path) -> None:
    client = started(VirtualClient())
    if screen == "death":
        client.game.die()
    else:
        client.game.open(screen)  # type: ignore[arg-type]  # these are names of screens
    client.clock.sleep(0.3)
    assert find_font(context_over(client), Profile(), sources_in(tmp_path)).profile.screen.font
    assert client.game.screen == "world"


def test_a_debug_screen_that_is_off_is_switched_on(tmp_path: Path) -> None:
    client = started(VirtualClient(has_f3=False))
    assert find_font(context_over(client), Profile(), sources_in(tmp_path)).samples > 10
    assert client.game.has_f3


def test_a_missing_debug_screen_is_reported_and_nothing_stays_pressed(tmp_path: Path) -> None:
    client = started(VirtualClient(has_f3=False, words=SPANISH))
    client.game.hides_hud = True
    with pytest.raises(UnreadableError, match="no debug screen is to be seen, even after its key was pressed"):
        find_font(context_over(client), Profile(), sources_in(tmp_path))
    client.clock.sleep(0.3)
    assert not client.game.has_f3
    assert client.game.screen == "world"
    assert client.window.down == set()


def test_a_reduced_debug_screen_is_reported(tmp_path: Path) -> None:
    client = started(VirtualClient())
    client.realm.rules["reducedDebugInfo"] = "true"
    with pytest.raises(UnreadableError, match="Reduced Debug Info"):
        find_font(context_over(client), Profile(), sources_in(tmp_path))


def test_a_game_that_stays_behind_another_window_is_reported(tmp_path: Path) -> None:
    client = started(VirtualClient())
    client.set_front(is_in_front=False)
    with pytest.raises(NotInFrontError, match="didn't come to the front"):
        find_font(context_over(client), Profile(), sources_in(tmp_path))
    assert client.window.strays == []


def test_without_any_font_nothing_is_pressed(tmp_path: Path) -> None:
    client = VirtualClient()
    missing = tmp_path / "gone.jar"
    with pytest.raises(FontError, match=r"name it with --font .*gone\.jar"):
        find_font(context_over(client), Profile(), FontSources((missing,)))
    assert client.game.ticks == 0


def test_profile_and_picture_are_written_for_the_version_in_the_window_title(tmp_path: Path) -> None:
    file, asked = tmp_path / "mine.toml", list[str | None]()

    def sources(version: str | None) -> FontSources:
        asked.append(version)
        return sources_in(tmp_path)

    found, picture = calibrate_font(file, context_of(started(VirtualClient(version="1.21.11"))), sources=sources)
    assert asked == ["1.21.11"]
    assert load_profile(file) == found.profile
    assert np.array_equal(decoded(picture.read_bytes()), found.pictures[0].frame)
    assert picture == tmp_path / "mine-font.png"


def test_unusable_clipboard_only_omits_the_comparison_with_f3_c(tmp_path: Path) -> None:
    client = started(VirtualClient())

    def refuse() -> str:
        raise ClipboardError("the clipboard holds something else than text")

    client.clipboard.read = refuse  # type: ignore[method-assign]
    found = find_font(context_over(client), Profile(), sources_in(tmp_path))
    assert found.lines[-1] == "not compared with F3+C: the clipboard holds something else than text"


def test_a_jar_that_is_named_is_the_only_one_tried(tmp_path: Path) -> None:
    def never(_: str | None) -> FontSources:
        raise AssertionError

    client = started(VirtualClient())
    found, _ = calibrate_font(tmp_path / "mine.toml", context_of(client), font_file_in(tmp_path), never)
    assert found.profile.screen.font == str(tmp_path / "ascii.png")


def test_a_named_jar_that_can_not_be_read_is_reported_before_a_window_is_looked_for(tmp_path: Path) -> None:
    bad = tmp_path / "bad.jar"
    bad.write_bytes(b"PK\3\4")

    def never(_: Profile) -> None:
        raise AssertionError

    with pytest.raises(FontError, match=r"bad\.jar"):
        calibrate_font(tmp_path / "mine.toml", never, bad)  # type: ignore[arg-type]  # it is never called
    assert not (tmp_path / "mine.toml").exists()


def test_failed_font_calibration_leaves_the_old_profile_unchanged(tmp_path: Path) -> None:
    file = tmp_path / "mine.toml"
    file.write_text("# mine\n[keys]\nleft = 'd'\nright = 'a'\n", "utf-8")
    client = started(VirtualClient(font=flipped()))
    with pytest.raises((FontError, LiveError)):
        calibrate_font(file, context_of(client), font_file_in(tmp_path))
    assert file.read_text("utf-8") == "# mine\n[keys]\nleft = 'd'\nright = 'a'\n"
    assert not (tmp_path / "mine-font.png").exists()


MINE = Candidate(Path("mine.jar"), FONT)


def painted(scale: int) -> Frame:
    screen = F3Screen("1.16-1.19.2", scale, (8.5, 64.0, 3.5), 0.0, 65.0)
    return paint(np.full((800, 2600, 3), 120, np.uint8), screen, FONT)


def grey_with(share: float, shade: int) -> Frame:
    """Return a frame whose upper left, half as high and a third as wide, has that shade in a share of its pixels."""
    frame: Frame = np.full((200, 300, 3), 120, np.uint8)
    frame[:100, :100].reshape(-1, 3)[:] = 120
    frame[0, : round(share * 100 * 100)] = shade
    return frame


def test_error_names_force_unicode_font_whatever_the_picture_shows() -> None:
    error = nothing_fits([painted(2)], [MINE], {"forceUnicodeFont": "true"})
    assert isinstance(error, FontError)
    assert "Force Unicode Font is on" in str(error)


@pytest.mark.parametrize("scale", [9, 10])
def test_a_gui_scale_that_no_font_fits_is_named(scale: int) -> None:
    error = nothing_fits([grey_with(0, 0), painted(scale)], [MINE], {})
    assert isinstance(error, UnreadableError)
    assert f"the GUI scale is {scale}: choose 1 to 8 in" in str(error)


@pytest.mark.parametrize(("share", "shade"), [(0.0, 0), (0.002, 224), (0.005, 219), (0.005, 229)])
def test_a_picture_with_little_of_the_texts_colour_shows_no_debug_screen(share: float, shade: int) -> None:
    error = nothing_fits([grey_with(share, shade)], [MINE], {})
    assert isinstance(error, UnreadableError)
    assert "no debug screen is to be seen" in str(error)
    assert "mine.jar" in str(error)


def test_error_advises_to_take_off_a_pack_with_finer_letters() -> None:
    assert "take off a pack with finer letters" in str(nothing_fits([grey_with(0.003, 224)], [MINE], {}))


@pytest.mark.parametrize("shade", [220, 224, 228])
def test_text_that_no_font_reads_is_reported_as_a_wrong_font(shade: int) -> None:
    error = nothing_fits([grey_with(0.003, shade)], [MINE], {})
    assert isinstance(error, FontError)
    assert "fit none of these fonts: mine.jar" in str(error)
    assert "language" not in str(error)


@pytest.mark.parametrize(("language", "is_named"), [("en_us", False), ("EN_gb", False), ("de_de", True)])
def test_a_language_that_is_not_english_is_named(language: str, is_named: bool) -> None:
    error = nothing_fits([grey_with(0.003, 224)], [MINE], {"lang": language})
    assert (f"(it is {language})" in str(error)) is is_named


@pytest.mark.parametrize(("count", "end"), [(6, "5.jar"), (7, "5.jar and 1 more"), (9, "5.jar and 3 more")])
def test_six_fonts_are_named_and_the_rest_counted(count: int, end: str) -> None:
    candidates = [Candidate(Path(f"{number}.jar"), FONT) for number in range(count)]
    assert str(fits_in_part("no XYZ line", candidates)).endswith(end)
    assert str(fits_in_part("no XYZ line", candidates)).startswith("no XYZ line; ")
