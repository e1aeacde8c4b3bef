"""Any scenario by its name or file: a shipped one, a TOML file, or a layer of a design file."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from mc_nested.arena.scenario import Scenario
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.design_files.layer_scenario import scenario_of_layer
from mc_nested.design_files.litematic import is_litematic, read_litematic
from mc_nested.design_files.nbt import MOST_BYTES, Compound, check_stated_size, is_bedrock, root_of, unpacked
from mc_nested.design_files.schematic import is_mcedit, is_sponge, read_mcedit, read_sponge
from mc_nested.design_files.structure import is_structure, read_structure
from mc_nested.design_files.volume import Volume
from mc_nested.errors import ScenarioError

SCHEMATICS = (".schem", ".schematic", ".litematic", ".nbt")
PICTURE = ".png"
BEDROCK = ".mcstructure"

FORMATS: list[tuple[Callable[[Compound], bool], Callable[[Compound], Volume]]] = [
    (is_sponge, read_sponge),
    (is_litematic, read_litematic),
    (is_mcedit, read_mcedit),
    (is_structure, read_structure),
]
"""How each NBT format is known and read. The content decides, not the file's ending: programs mix them up."""

LAYER_OPTION = "--layer"
"""How a message names the way to choose a layer, unless told otherwise."""

MOST_RANGES = 6
"""Runs of numbers in a message."""


@dataclass(frozen=True)
class Loaded:
    """A scenario, and what a person should know about how it came about, a line each."""

    scenario: Scenario
    notes: tuple[str, ...] = ()


def is_design_file(name_or_file: str | Path) -> bool:
    """Return whether a name ends as a file of another program does.

    Anything else is a shipped scenario or a TOML file.
    """
    return Path(name_or_file).suffix.lower() in (*SCHEMATICS, PICTURE, BEDROCK)


def load_any_scenario(
    name_or_file: str | Path,
    layer: int | None = None,
    *,
    must_choose: bool = False,
    must_reach: bool = True,
    option: str = LAYER_OPTION,
) -> Loaded:
    """Return the scenario of a shipped name, of a TOML file, or of a layer of a design file.

    ``layer`` counts from 0, the lowest; default: the lowest that has blocks. With ``must_choose`` there is no default
    where several have blocks. Without ``must_reach``, a TOML file may draw cells that are out of reach. Messages call
    the way to name a layer ``option``. ScenarioError, one line, if it can't be used.
    """
    if not is_design_file(name_or_file):
        if layer is not None:
            raise ScenarioError(f"{name_or_file} is a drawing of one layer: leave out {option}")
        return Loaded(load_scenario(name_or_file, must_reach=must_reach))
    path = Path(name_or_file)
    return load_layer(path, read_volume(path), layer, must_choose=must_choose, option=option)


def load_layer(
    path: Path, volume: Volume, layer: int | None, *, must_choose: bool = False, option: str = LAYER_OPTION
) -> Loaded:
    """Return the scenario of a layer of the volume that was read from ``path``, as ``load_any_scenario`` makes it."""
    try:
        chosen = chosen_layer(volume, layer, must_choose=must_choose, option=option)
        scenario, notes = scenario_of_layer(path.stem, volume, chosen)
    except ScenarioError as error:
        raise ScenarioError(f"{path}: {error}") from None
    filled = volume.layers_with_blocks()
    if layer is None and len(filled) > 1:
        notes = [f"the lowest of {len(filled)} layers with blocks, {option} takes another", *notes]
    where = f"{path.name}, layer {chosen}" if volume.layers > 1 else path.name
    return Loaded(scenario, tuple(f"{where}: {note}" for note in notes))


def chosen_layer(volume: Volume, layer: int | None, *, must_choose: bool = False, option: str = LAYER_OPTION) -> int:
    """Return the layer asked for, or the lowest with blocks.

    Raise ScenarioError, without the file's name, if there is none.
    """
    filled = volume.layers_with_blocks()
    if not filled:
        raise ScenarioError("it has no block: save a part of the world that has some")
    if layer is None:
        if must_choose and len(filled) > 1:
            raise ScenarioError(
                f"{len(filled)} of its layers have blocks, and only one can be built: name it with {option}, "
                f"{ranges(filled)}"
            )
        return filled[0]
    if layer not in filled:
        which = "has no block" if layer < volume.layers else "is above its highest"
        raise ScenarioError(f"layer {layer} {which}: choose {ranges(filled)}")
    return layer


def ranges(numbers: list[int]) -> str:
    """Return ``0 to 3, 7 or 9 to 12``: ascending numbers in words."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    words = [f"{run[0]} to {run[-1]}" if len(run) > 1 else f"{run[0]}" for run in runs]
    if len(words) > MOST_RANGES:
        words = [*words[: MOST_RANGES - 1], f"others up to {numbers[-1]}"]
    return " or ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def read_volume(path: Path) -> Volume:
    """Return the blocks of a design file; ScenarioError, one line that names the file, if it can't be read."""
    try:
        data = _bytes_of(path)
        if path.suffix.lower() == PICTURE:
            # Imported here: only pictures need it.
            from mc_nested.design_files.png import read_picture

            return read_picture(data)
        if path.suffix.lower() == BEDROCK:
            raise bedrock_error()
        plain = unpacked(data)
        if is_bedrock(plain):
            raise bedrock_error()
        check_stated_size(plain)
        root = root_of(plain)
        for is_format, read in FORMATS:
            if is_format(root):
                return read(root)
        raise ScenarioError(f"it is NBT, but no schematic of a known kind: save it as {', '.join(SCHEMATICS)} or .png")
    except ScenarioError as error:
        raise ScenarioError(f"{path}: {error}") from error.__cause__


def bedrock_error() -> ScenarioError:
    """Return the error for a structure of the other edition."""
    return ScenarioError(
        "it is a structure of Minecraft Bedrock Edition: import it in the Amulet editor, and export it as Sponge .schem"
    )


def _bytes_of(path: Path) -> bytes:
    try:
        if not path.is_file():
            raise ScenarioError("there is no such file: check its name and folder")
        if path.stat().st_size > MOST_BYTES:
            raise ScenarioError(f"it is larger than {MOST_BYTES // 2**20} MB: save a smaller part of it")
        if data := path.read_bytes():
            return data
        raise ScenarioError("it is empty: save, or download, it again")
    except OSError as error:
        raise ScenarioError(f"it can't be read, {error.strerror or error}: name another file") from error
