"""The DLL that Wine lacks: a PE image whose one export is forwarded."""

import struct

from scripts.windows_stub import stub_dll


def test_stub_dll_forwards_its_one_export_to_system_function_036() -> None:
    image = stub_dll()
    header = struct.unpack_from("<I", image, 0x3C)[0]
    assert image[:2] == b"MZ"
    assert image[header : header + 4] == b"PE\0\0"
    machine, sections = struct.unpack_from("<HH", image, header + 4)
    assert (machine, sections) == (0x8664, 1)
    optional = header + 24
    directory, size = struct.unpack_from("<II", image, optional + 112)
    address, _, offset = struct.unpack_from("<III", image, optional + 240 + 12)
    exports = image[offset : offset + size]
    functions, names = struct.unpack_from("<II", exports, 20)
    assert (functions, names) == (1, 1)

    def text(at: int) -> bytes:
        return exports[at - directory :].split(b"\0")[0]

    function = struct.unpack_from("<I", exports, struct.unpack_from("<I", exports, 28)[0] - directory)[0]
    name = struct.unpack_from("<I", exports, struct.unpack_from("<I", exports, 32)[0] - directory)[0]
    assert address == directory
    assert directory <= function < directory + size, "inside the directory: a forwarder"
    assert text(function) == b"ADVAPI32.SystemFunction036"
    assert text(name) == b"ProcessPrng"
    assert text(struct.unpack_from("<I", exports, 12)[0]) == b"bcryptprimitives.dll"
