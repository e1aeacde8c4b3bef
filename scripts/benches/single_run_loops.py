"""DDQN loops of a single run, with which learning.py compares this project: the same work."""

from collections.abc import Callable, Iterator

import numpy as np
import torch
from torch import nn

from mc_nested.arena.env import ArenaEnv
from mc_nested.arena.scenario_file import load_scenario
from mc_nested.learn.preset import load_preset
from sim.grid import GridGame

LINE, PAPER = load_scenario("line"), load_preset("paper")

Slices = Callable[[], int]
"""Does a little of the work and returns how many updates that was."""


def plain_loop() -> Slices:
    """Run a hand-written DDQN loop as one writes it: one run, torch modules, autograd, a replay in NumPy arrays."""
    updates = _plain_ddqn()

    def work() -> int:
        for _ in range(100):
            next(updates)
        return 100

    return work


def _plain_ddqn() -> Iterator[None]:
    """Yield after each update."""
    random = np.random.default_rng(0)
    env = ArenaEnv(GridGame(LINE), LINE)
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
            index = stored % room
            states[index], next_states[index] = state, following
            actions[index], rewards[index], ends[index] = action, reward, terminated
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
    """Run stable-baselines3's DQN on the same Env; single, not double, so a little less work."""
    from stable_baselines3 import DQN
    from stable_baselines3.common.logger import Logger

    update = PAPER.update
    model = DQN(
        "MlpPolicy",
        ArenaEnv(GridGame(LINE), LINE),
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
    model.set_logger(Logger(folder=None, output_formats=[]))  # its own makes a folder at each call of learn
    model.learn(200)

    def work() -> int:
        model.learn(200, reset_num_timesteps=False)
        return 200

    return work
