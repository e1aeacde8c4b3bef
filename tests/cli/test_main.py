"""The command's first and last lines, in this process: words that its streams can't write are lost without an error."""

import io
import os
import signal
import sys

import pytest

from mc_nested import cli


def test_stream_that_cannot_encode_epsilon_writes_a_question_mark(monkeypatch: pytest.MonkeyPatch) -> None:
    streams = {name: io.TextIOWrapper(io.BytesIO(), encoding="ascii") for name in ("stdout", "stderr")}
    for name, stream in streams.items():
        monkeypatch.setattr(sys, name, stream)
    before = signal.getsignal(signal.SIGINT)
    try:
        with pytest.raises(SystemExit) as ended:
            cli.main(["--version"])
        assert signal.getsignal(signal.SIGINT) is signal.SIG_IGN, "quiet while Python ends"
    finally:
        signal.signal(signal.SIGINT, before)
    assert not ended.value.code
    for stream in streams.values():
        stream.write("ε")
        stream.flush()
    assert streams["stderr"].buffer.getvalue() == b"?"


def test_output_to_a_closed_pipe_is_dropped_without_an_error() -> None:
    reads, writes = os.pipe()
    with os.fdopen(writes, "w", encoding="utf-8") as stream:
        stream.write("a last line")
        os.close(reads)
        cli._flush(stream)
        stream.flush()  # as Python does when it ends
