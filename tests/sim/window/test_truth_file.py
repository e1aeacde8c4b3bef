import json
from pathlib import Path

from sim.client.client import VirtualClient
from sim.client.game.realm import Stack
from sim.window.rehearsal import TruthFile


def test_the_truth_file_holds_the_blocks_the_player_and_the_screen(tmp_path: Path) -> None:
    client = VirtualClient(yaw=90.0, pitch=65.0)
    truth = TruthFile(tmp_path / "truth.json", client)
    client.realm.world.put((1, 64, 2), "stone")
    client.realm.world.put((1, 63, 2), "air")
    client.realm.player.hotbar[0] = Stack("oak_planks", 64)
    client.keyboard.press("w")
    client.clock.sleep(0.1)
    client.game.open("pause")
    truth.write()
    said = json.loads((tmp_path / "truth.json").read_text())
    assert said["built"] == [[1, 63, 2, "air"], [1, 64, 2, "stone"]]
    assert said["feet"] == list(client.realm.player.feet)
    assert (said["yaw"], said["pitch"], said["screen"]) == (90.0, 65.0, "pause")
    assert (said["block_in_hand"], said["keys_down"], said["is_in_front"]) == ("oak_planks", ["w"], True)


def test_the_truth_file_is_written_only_when_something_has_changed(tmp_path: Path) -> None:
    path = tmp_path / "truth.json"
    client = VirtualClient()
    truth = TruthFile(path, client)
    truth.write()
    path.unlink()
    client.clock.sleep(0.2)
    truth.write()
    assert not path.exists()
    client.set_front(is_in_front=False)
    truth.write()
    assert json.loads(path.read_text())["is_in_front"] is False
