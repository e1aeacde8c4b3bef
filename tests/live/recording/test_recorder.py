"""The recorder: what a kill costs, what a full disk does, how much is kept, and that the chat is never on it."""

import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import cv2
import numpy as np
import pytest

from mc_nested.live.recording import recorder, recording_file
from mc_nested.live.recording.call_encoder import CallEncoder
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.recorder import Recorder
from mc_nested.live.recording.recording_file import TimedCall, overview_of, read_recording
from mc_nested.live.vision.chat_region import BLANK, chat_regions
from sim.client.client import VirtualClient

FACTS = {"format": str(FORMAT)}

WRITES = """
import sys, time
from pathlib import Path
import numpy as np
from mc_nested.live.recording import recorder
from mc_nested.live.recording.format import FORMAT
from mc_nested.live.recording.recorder import Recorder
recorder.PART_S = 0.25
rng = np.random.default_rng(0)
with Recorder(Path(sys.argv[1]), {"format": str(FORMAT)}, (320, 240), print) as recording:
    while True:
        recording.tape.add("now", time.time())
        if rng.random() < 0.02:
            recording.tape.add("grab", None, rng.integers(0, 256, (240, 320, 3), np.uint8))
        time.sleep(0.002)
"""
"""A run that never ends, with pictures of noise, four new files a second."""


def killed(folder: Path, after_s: float) -> float:
    """Kill a process that records without end, and return how many seconds of its end are lost."""
    process = subprocess.Popen([sys.executable, "-c", WRITES, str(folder)])
    try:
        # By what is there, not by the time: on a busy machine the first files come late.
        while len(list(folder.glob("*.mcap"))) < 2:
            time.sleep(0.01)
            assert process.poll() is None
        time.sleep(after_s)
    finally:
        process.send_signal(signal.SIGKILL if os.name == "posix" else signal.SIGTERM)
        killed_at = time.time()
        process.wait()
    read = list(read_recording(folder))
    assert any(each.pictures for each in read if isinstance(each, TimedCall))
    assert len(list(folder.glob("*.mcap"))) > 1
    return killed_at - [each for each in read if isinstance(each, TimedCall)][-1].at / 1e9


def test_a_killed_recorder_loses_less_than_the_last_second(tmp_path: Path) -> None:
    for trial, after_s in enumerate((0.6, 0.75, 0.9)):
        assert killed(tmp_path / str(trial), after_s) < 1.0


@pytest.mark.realtime
def test_two_hundred_killed_recorders_lose_less_than_a_second_each(tmp_path: Path) -> None:
    waits = np.random.default_rng(7).uniform(0.6, 1.1, 200).tolist()
    folders = [tmp_path / str(trial) for trial in range(len(waits))]
    with ThreadPoolExecutor(2) as two_at_once:
        assert max(two_at_once.map(killed, folders, waits)) < 1.0


def test_a_full_disk_ends_the_recording_and_not_the_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(recording_file.PartWriter, "write", full)
    said: list[str] = []
    with Recorder(tmp_path / "full", FACTS, (854, 480), said.append) as recording:
        for _ in range(5):
            recording.tape.add("now", 1.0)
            time.sleep(0.15)
    assert said == [f"the recording ends here, the run goes on: {tmp_path / 'full'}: No space left on device"]


def test_a_recorder_keeps_only_the_last_files_of_a_long_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(recorder, "PART_S", 0.0)
    monkeypatch.setattr(recorder, "KEPT_BYTES", 6000)
    monkeypatch.setattr(recorder, "WRITE_EVERY_S", 0.01)
    with Recorder(tmp_path / "long", FACTS, (854, 480), print) as recording:
        for number in range(100):
            recording.tape.add("now", float(number))
            time.sleep(0.012)
    parts = sorted((tmp_path / "long").glob("*.mcap"))
    assert 1 < len(parts) < 20
    assert sum(part.stat().st_size for part in parts[:-2]) <= 6000
    calls = [each for each in read_recording(tmp_path / "long") if isinstance(each, TimedCall)]
    assert calls[-1].call == ["now", 99.0]
    assert overview_of(tmp_path / "long").damage == ()


def test_a_release_by_another_thread_is_recorded_as_elsewhere(tmp_path: Path) -> None:
    import threading

    client = VirtualClient(seed=1)
    with Recorder(tmp_path / "two", FACTS, (854, 480), print) as recording:
        devices = recording.devices(client.devices)
        devices.keyboard.press("w")
        thread = threading.Thread(target=devices.keyboard.release, args=("w",))
        thread.start()
        thread.join()
    calls = [each.call for each in read_recording(tmp_path / "two") if isinstance(each, TimedCall)]
    assert calls == [["key", "press", "w"], ["elsewhere", "key", "release", "w"]]


def test_recorded_pictures_have_the_chat_blanked() -> None:
    client = VirtualClient(seed=1, size=(1280, 720))
    encoder = CallEncoder((1280, 720))
    _, (picture,) = encoder.encode(["grab", None, client.display.grab()])
    frame = cv2.imdecode(np.frombuffer(picture.png, np.uint8), cv2.IMREAD_COLOR)
    assert frame is not None
    for region in chat_regions((1280, 720), None):
        part = frame[max(0, region.top) : region.top + region.height, region.left : region.left + region.width]
        assert (part == BLANK).all()


def test_the_clipboards_text_is_never_recorded(tmp_path: Path) -> None:
    client = VirtualClient(seed=1)
    with Recorder(tmp_path / "clip", FACTS, (854, 480), print) as recording:
        devices = recording.devices(client.devices)
        devices.clipboard.write("a secret")
        assert devices.clipboard.read() == "a secret"
    calls = [each for each in read_recording(tmp_path / "clip") if isinstance(each, TimedCall)]
    assert [each.call for each in calls] == [["clipboard", "write"], ["clipboard", "read"]]
    assert not any(each.pictures for each in calls)
