"""Real schematics, and ours in every version, read block for block as two other projects' readers read them."""

from pathlib import Path

import pytest

from mc_nested.design_files.load import read_volume
from tests.design_files.other_readers import OtherReaders, other_readers
from tests.design_files.written import HUT, WRITERS

__all__ = ["other_readers"]

pytestmark = pytest.mark.slow

READERS = ("prismarine", "schematicjs")


def read(path: Path) -> tuple[list[int], list[str]]:
    volume = read_volume(path)
    height, length, width = volume.blocks.shape
    names = [volume.palette[number].rpartition(":")[2] for number in volume.blocks.reshape(-1).tolist()]
    return [width, height, length], names


@pytest.mark.parametrize("reader", READERS)
def test_real_schematics_are_read_as_two_other_readers_read_them(
    reader: str, other_readers: OtherReaders, tmp_path: Path
) -> None:
    files = other_readers.real_files
    assert {file.suffix for file in files} >= {".schem", ".schematic"}
    for file, (size, names) in zip(files, other_readers.read(reader, files, tmp_path / "found.json"), strict=True):
        assert len(set(names)) > 10
        assert read(file) == (size, names)


@pytest.mark.parametrize(
    "name", ["sponge1.schem", "sponge2.schem", "sponge3.schem", "mcedit.schematic", "structure.nbt"]
)
def test_files_written_by_our_tests_are_read_as_another_reader_reads_them(
    name: str, other_readers: OtherReaders, tmp_path: Path
) -> None:
    drawing = [[row.replace("c", "s") for row in layer] for layer in HUT]  # without the mod's block, unknown to one
    (tmp_path / name).write_bytes(WRITERS[name](drawing))
    assert other_readers.read("schematicjs", [tmp_path / name], tmp_path / "found.json") == [read(tmp_path / name)]
