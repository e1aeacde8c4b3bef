from sim.client.desktop.clipboard import VirtualClipboard


def test_what_was_written_is_read() -> None:
    clipboard = VirtualClipboard()
    assert clipboard.read() == ""
    clipboard.write("text")
    assert clipboard.read() == "text"
