"""bcryptprimitives.dll for Wine 8, which has none: a DLL with one export and no code. Standard library only.

Programs in Rust take their random seed from its ``ProcessPrng``. Here that is forwarded to ADVAPI32's
``SystemFunction036`` (RtlGenRandom), which fills memory in the same way.
"""

import struct

NAME = b"bcryptprimitives.dll\0"
EXPORT = b"ProcessPrng\0"
FORWARD = b"ADVAPI32.SystemFunction036\0"

_RVA = 0x1000  # where the only section is loaded
_FILE_ALIGNMENT = 0x200
_DIRECTORY = 40  # bytes of an export directory's header


def stub_dll() -> bytes:
    """Return the whole file: a 64-bit PE image whose only section is its export directory."""
    exports = _export_directory()
    dos = b"MZ".ljust(0x3C, b"\0") + struct.pack("<I", 0x40)
    coff = b"PE\0\0" + struct.pack("<HHIIIHH", 0x8664, 1, 0, 0, 0, 240, 0x2022)
    section = struct.pack("<8sIIIIIIHHI", b".rdata", len(exports), _RVA, 0x200, 0x200, 0, 0, 0, 0, 0x40000040)
    head = dos + coff + _optional_header(len(exports)) + section
    return head.ljust(_FILE_ALIGNMENT, b"\0") + exports.ljust(_FILE_ALIGNMENT, b"\0")


def _export_directory() -> bytes:
    functions, names, ordinals = _DIRECTORY, _DIRECTORY + 4, _DIRECTORY + 8
    dll = _DIRECTORY + 12
    export = dll + len(NAME)
    forward = export + len(EXPORT)
    # Characteristics, time, version (2 + 2), name, first ordinal, how many functions and names, and their tables.
    header = struct.pack("<IIHHIIIII", 0, 0, 0, 0, _RVA + dll, 1, 1, 1, _RVA + functions)
    header += struct.pack("<II", _RVA + names, _RVA + ordinals)
    # A function's address that lies inside the export directory is that of a forwarder's name.
    tables = struct.pack("<IIHH", _RVA + forward, _RVA + export, 0, 0)
    return header + tables + NAME + EXPORT + FORWARD


def _optional_header(size: int) -> bytes:
    start = struct.pack("<HBBIIIII", 0x20B, 14, 0, 0, 0x200, 0, 0, _RVA)
    image = struct.pack("<QII", 0x180000000, 0x1000, _FILE_ALIGNMENT)
    versions = struct.pack("<HHHHHHI", 6, 0, 0, 0, 6, 0, 0)
    sizes = struct.pack("<IIIHH", 0x2000, _FILE_ALIGNMENT, 0, 3, 0x0160)
    stacks = struct.pack("<QQQQII", 0x100000, 0x1000, 0x100000, 0x1000, 0, 16)
    directories = struct.pack("<II", _RVA, size) + b"\0" * 8 * 15
    return start + image + versions + sizes + stacks + directories
