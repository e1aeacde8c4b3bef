"""How fast the agents learn: updates a second of many runs at once, beside plain single-run loops doing the same work.

The same work: the line in the simulator, one environment step and one DDQN update of batch 32 a step, two hidden layers
of 32, Adam. One core for each. All take turns in short slices, so that a machine whose speed drifts hits them alike;
quote the ratios.

Usage: python scripts/bench_learning.py [--runs 1 10 30] [--rounds 5] [--slice-s 3] [--json]
"""

import argparse
import importlib.util
import json
import statistics
import time
from collections.abc import Callable, Iterator, Sequence

import numpy as np
import torch
from rich.console import Console
from rich.progress import track
from rich.table import Table
from torch import nn

from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.agents import FORMS, Agent
from mc_nested.learn.preset import load_preset
from mc_nested.learn.trainer import Trainer
from sim.grid import GridVectorEnv, arena_env

LINE, PAPER = load_scenario("line"), load_preset("paper")
WARM_UP_S = 1.0

Slices = Callable[[], int]
"""Does a little of the work and says how many updates that were."""


def ours(runs: int) -> Slices:
    """This project's trainer with that many runs; the main agent's updates are left out of the count."""
    scenarios = [LINE] * runs
    agent = Agent(FORMS["nested"], scenarios, PAPER, seed=0)
    trainer = Trainer(GridVectorEnv(scenarios), scenarios, agent, PAPER, seed=0)

    def work() -> int:
        before = int(agent.low.ddqn.updates.sum())
        for _ in range(20):
            trainer.tick()
        return int(agent.low.ddqn.updates.sum()) - before

    return work


def plain_loop() -> Slices:
    """A hand-written DDQN loop as one writes it: one run, torch modules, autograd, a replay in NumPy arrays."""
    updates = _plain_ddqn()

    def work() -> int:
        for _ in range(100):
            next(updates)
        return 100

    return work


def _plain_ddqn() -> Iterator[None]:
    """Yields after each update."""
    random = np.random.default_rng(0)
    env = arena_env(LINE)
    online, target = _network(), _network()
    target.load_state_dict(online.state_dict())
    optimiser = torch.optim.Adam(online.parameters(), lr=PAPER.update.learning_rate)
    room, batch = 200_000, PAPER.update.batch
    states, next_states = np.zeros((room, 4), np.float32), np.zeros((room, 4), np.float32)
    actions, rewards, ends = np.zeros(room, np.int64), np.zeros(room, np.float32), np.zeros(room, np.float32)
    stored = updates = 0
    while True:
        observation, _ = env.reset(options={"material": "stone"})
        state, over = _features(observation), False
        while not over:
            if random.random() < 0.5:
                action = int(random.integers(8))
            else:
                with torch.no_grad():
                    action = int(online(torch.from_numpy(state)).argmax())
            observation, reward, terminated, truncated, _ = env.step(action)
            following, over = _features(observation), terminated or truncated
            place = stored % room
            states[place], next_states[place] = state, following
            actions[place], rewards[place], ends[place] = action, reward, terminated
            stored, state = stored + 1, following
            if stored < batch:
                continue
            drawn = random.integers(min(stored, room), size=batch)
            s, s2 = torch.from_numpy(states[drawn]), torch.from_numpy(next_states[drawn])
            with torch.no_grad():
                best = online(s2).argmax(1, keepdim=True)
                bootstrap = target(s2).gather(1, best)[:, 0]
                goal = torch.from_numpy(rewards[drawn]) + PAPER.update.gamma * bootstrap * (
                    1 - torch.from_numpy(ends[drawn])
                )
            chosen = online(s).gather(1, torch.from_numpy(actions[drawn])[:, None])[:, 0]
            loss = nn.functional.huber_loss(chosen, goal)
            optimiser.zero_grad()
            loss.backward()  # type: ignore[no-untyped-call]  # torch leaves it untyped
            optimiser.step()
            updates += 1
            if updates % PAPER.update.target_period == 0:
                target.load_state_dict(online.state_dict())
            yield


def _network() -> nn.Sequential:
    return nn.Sequential(nn.Linear(4, 32), nn.Tanh(), nn.Linear(32, 32), nn.Tanh(), nn.Linear(32, 8))


def _features(observation: np.ndarray) -> np.ndarray:
    x, y, b = observation
    return np.array([x / 7 - 1, y / 7 - 1, 2 * b / LINE.blocks - 1, 1.0], dtype=np.float32)


def sb3() -> Slices:
    """stable-baselines3's DQN on the same Env; single, not double, so a little less work."""
    from stable_baselines3 import DQN

    update = PAPER.update
    model = DQN(
        "MlpPolicy",
        arena_env(LINE),
        learning_rate=update.learning_rate,
        buffer_size=200_000,
        learning_starts=update.batch,
        batch_size=update.batch,
        gamma=update.gamma,
        train_freq=1,
        gradient_steps=1,
        target_update_interval=update.target_period,
        policy_kwargs={"net_arch": [32, 32], "activation_fn": nn.Tanh},
        device="cpu",
    )
    model.learn(200)

    def work() -> int:
        model.learn(200, reset_num_timesteps=False)
        return 200

    return work


def rate(work: Slices, seconds: float) -> float:
    """Updates a second over at least that long."""
    began, updates = time.perf_counter(), 0
    while (took := time.perf_counter() - began) < seconds:
        updates += work()
    return updates / took


def measure(runs: Sequence[int], rounds: int, slice_s: float) -> dict[str, list[float]]:
    """Updates a second of each contestant, a figure a round."""
    contestants = {f"{count} runs": ours(count) for count in runs} | {"plain loop": plain_loop()}
    if importlib.util.find_spec("stable_baselines3"):
        contestants["stable-baselines3"] = sb3()
    for work in contestants.values():
        rate(work, WARM_UP_S)
    rates: dict[str, list[float]] = {name: [] for name in contestants}
    for _ in track(range(rounds), "rounds", console=Console(stderr=True)):
        for name, work in contestants.items():
            rates[name].append(rate(work, slice_s))
    return rates


def main() -> None:
    """Measure and print a table, or one JSON object."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--runs", type=int, nargs="+", default=[1, 10, 30])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--slice-s", type=float, default=3.0)
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args()
    torch.set_num_threads(1)
    rates = measure(options.runs, options.rounds, options.slice_s)
    medians = {name: statistics.median(found) for name, found in rates.items()}
    ratios = {
        name: statistics.median(a / b for a, b in zip(found, rates["plain loop"], strict=True))
        for name, found in rates.items()
    }
    if options.json:
        print(
            json.dumps(
                {
                    "ours": {str(count): round(medians[f"{count} runs"]) for count in options.runs},
                    "plain_loop": round(medians["plain loop"]),
                    "sb3": round(medians["stable-baselines3"]) if "stable-baselines3" in medians else None,
                    "ratio_plain_loop": {str(c): round(ratios[f"{c} runs"], 2) for c in options.runs},
                }
            )
        )
        return
    table = Table("", "updates/s", "beside the plain loop", title="median over the rounds, one core")
    for name, median in medians.items():
        table.add_row(name, f"{median:,.0f}", f"{ratios[name]:.1f} times")
    Console().print(table)


if __name__ == "__main__":
    main()
