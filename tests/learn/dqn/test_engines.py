"""Which settings of a preset go together, and the one-line refusals of those that don't."""

import pytest

from mc_nested.errors import PresetError
from mc_nested.learn.preset import load_preset


def test_the_preset_image_sets_engine_states_network_and_device() -> None:
    image = load_preset("image")
    assert (image.engine, image.states, image.network, image.device) == ("torch", "image", "cnn", "cpu")


@pytest.mark.parametrize("name", ["paper", "tuned"])
def test_presets_with_numeric_states_can_switch_to_the_torch_engine(name: str) -> None:
    preset = load_preset(name)
    changed = preset.changed(engine="torch", device="cuda")
    assert (changed.engine, changed.device, changed.update) == ("torch", "cuda", preset.update)
    assert preset.changed(engine=None) == preset


@pytest.mark.parametrize(
    ("name", "keys", "says"),
    [
        ("paper", {"states": "image"}, 'with --states image: states "image" need engine "torch"'),
        ("image", {"engine": "compiled"}, 'states "image" need engine "torch"'),
        ("paper", {"device": "cuda"}, 'device "cuda" needs engine "torch"'),
        ("paper", {"network": "my:make"}, 'network "my:make" needs engine "torch"'),
        ("paper", {"network": "cnn", "engine": "torch"}, 'network "cnn" needs states "image"'),
        ("model-based", {"engine": "torch"}, r'\[imagination\] needs engine "compiled"'),
        ("tuned", {"states": "image", "engine": "torch"}, r"\[excursions\] go by x and y"),
        ("image", {"encoding": "one-hot"}, 'encoding "one-hot" is for states "numbers"'),
        ("paper", {"network": "cnnn", "engine": "torch"}, 'network "cnnn": write "mlp", "cnn", or a module'),
        ("paper", {"engine": "fast"}, "with --engine fast: must be compiled or torch"),
        ("paper", {"device": "tpu", "engine": "torch"}, "must be cpu, cuda or mps"),
    ],
)
def test_invalid_or_incompatible_settings_are_refused_in_one_line(name: str, keys: dict[str, str], says: str) -> None:
    with pytest.raises(PresetError, match=says) as caught:
        load_preset(name).changed(**keys)
    assert "\n" not in str(caught.value)
