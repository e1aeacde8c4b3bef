"""A training's bytes, which are the same on every x86-64 processor with fused multiply-adds, on Linux and Windows."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

import pytest
from llvmlite import binding

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.compiled import IN_PYTHON
from mc_nested.learn.agents import AGENT_SPECS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv

ROOT = Path(__file__).parents[1]
FUSES = binding.get_host_cpu_features().get("fma", False)
OF_FOUR = "+sse4.2,+avx,+fma,+prefer-128-bit"
"""Features of an x86-64 processor as a compiler may use them: fused multiply-adds, and vectors of four numbers in all
loops that it vectorises by itself. The tiles have vectors of eight there, too."""

TRAINED = "2bc05474fcc8afb5bf9d245fe1099aa09cf7b9666844afaf8f7ffc56aa24e9b0"
"""``trained()``, with vectors of eight. It changes with the arithmetic of an update, or where other random numbers are
drawn; the changelog says so then."""

pytestmark = pytest.mark.skipif(IN_PYTHON or not FUSES, reason="without fused multiply-adds it is rounded otherwise")


def trained() -> str:
    """Return a hash of three runs' networks after 1,500 ticks, with targets renewed and policies evaluated."""
    scenarios, preset = [load_scenario("line")] * 3, load_preset("paper")
    agent = Agent(AGENT_SPECS["nested"], scenarios, preset, seed=1)
    trainer = Trainer(agent.view_of(GridVectorEnv(scenarios), scenarios), scenarios, agent, preset, seed=1)
    for _ in range(1500):
        trainer.tick()
    assert agent.updates > 3000
    assert trainer.evaluation_rows
    return hashlib.sha256(b"".join(networks.tobytes() for networks in agent.online().values())).hexdigest()


def test_a_training_is_the_same_to_the_bit_on_this_processor_and_system() -> None:
    assert trained() == TRAINED


@pytest.mark.slow
def test_a_training_is_the_same_to_the_bit_where_the_compiler_makes_vectors_of_four_numbers(tmp_path: Path) -> None:
    as_there = {"NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": OF_FOUR, "NUMBA_CACHE_DIR": str(tmp_path)}
    code = f"import runpy; print(runpy.run_path({__file__!r})['trained']())"
    there = subprocess.run(
        [sys.executable, "-c", code],
        env={**os.environ, **as_there, "PYTHONPATH": str(ROOT)},
        stdout=subprocess.PIPE,
        text=True,
        check=True,
    )
    assert there.stdout.split() == [TRAINED]
