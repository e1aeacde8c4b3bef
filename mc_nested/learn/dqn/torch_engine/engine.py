"""Double deep Q-learning (paper, section 2.4) for rows of torch networks.

By hand: the slopes of the loss in the values Q(s, a), and Adam's step for rows of parameters. Autograd does the rest:
it begins at the network's output. Adam (Kingma and Ba, 2015) is as the compiled engine's.
"""

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import Tensor, nn

from mc_nested.arrays import Arrays, Float32s, Int64s
from mc_nested.errors import PresetError
from mc_nested.learn.dqn.compiled_engine.adam import BETA_1, BETA_2, EPSILON
from mc_nested.learn.dqn.engine import MLP, Batch, LastBatches, NetworkForm, UpdateRule, diverged
from mc_nested.learn.dqn.states import States
from mc_nested.learn.dqn.torch_engine.networks import input_shape, inputs_of
from mc_nested.learn.dqn.torch_engine.rows import NetworkRows, can_be_stacked


class TorchEngine:
    """The Engine of any torch module.

    Args:
        states: what the rows see and do.
        form: what each network is.
        make: makes one network.
        rule: what an update does.
        online: initial parameters, (rows, parameters).
        device: where it computes.
    """

    def __init__(
        self,
        states: States,
        form: NetworkForm,
        make: Callable[[], nn.Module],
        rule: UpdateRule,
        online: Float32s,
        device: torch.device,
    ) -> None:
        if device.type == "cpu":
            # For networks this small a second thread only waits for the first, and sums would depend on the cores.
            torch.set_num_threads(1)
        self.form = form
        self.rule = rule
        self.updates: Int64s = np.zeros(len(online), dtype=np.int64)
        self._device = device
        with _enough_memory(device):
            self._online = torch.from_numpy(online.copy()).to(device)
            self._target = self._online.clone()
            self._first, self._second = torch.zeros_like(self._online), torch.zeros_like(self._online)
            self._inputs = inputs_of(states, device)
            # On a processor, stacked convolutions are slower than one after the other.
            tried = make()
            stacks = device.type != "cpu" or not any(isinstance(part, nn.Conv2d) for part in tried.modules())
            stacks = stacks and can_be_stacked(tried, input_shape(states))
            self._values = NetworkRows(lambda: make().to(device), self._online, stacks)
            self._target_values = NetworkRows(lambda: make().to(device), self._target, stacks)
        moments = {"first_moment": self._first, "second_moment": self._second}
        self._tensors = {"online": self._online, "target": self._target, **moments}
        self.last = LastBatches(len(online), rule)
        self._every_row = np.arange(len(online))

    @property
    def online(self) -> Float32s:
        return _array(self._online)

    @property
    def target(self) -> Float32s:
        return _array(self._target)

    def q_values(self, states: NDArray[Any], rows: Int64s | None = None) -> Float32s:
        named = self._every_row if rows is None else rows
        if not len(named):
            return np.empty((0, self.form.numbers[-1]), np.float32)
        with _enough_memory(self._device), torch.no_grad():
            inputs = self._inputs(states[None, :, None], named)[0]
            return _array(self._values.values(named, inputs).values[:, 0])

    def update(self, rows: Int64s, batch: Batch) -> Float32s:
        self.updates[rows] += 1
        with _enough_memory(self._device):
            states = self._inputs(batch.states, rows)
            actions, rewards, discounts, weights = (
                self._tensor(part) for part in (batch.actions, batch.rewards, batch.discounts, batch.weights)
            )
            taken = actions.unsqueeze(-1)
            values, following_values, leaves = self._both_values(rows, states)
            with torch.no_grad():
                best = following_values.argmax(-1, keepdim=True)
                bootstrap = self._target_values.values(rows, states[1]).values.gather(-1, best).squeeze(-1)
                chosen = values.gather(-1, taken).squeeze(-1)
                errors = torch.addcmul(rewards, discounts, bootstrap).neg_().add_(chosen)
                slopes = huber_slopes(values, taken, errors, weights, self.rule)
                if batch.imitated.any():
                    slopes += margin_slopes(values, taken, self._tensor(batch.imitated), self.rule)
            self._step(rows, self._values.gradient(values, slopes, leaves, len(rows)))
            found = _array(errors)
            self.last.values[rows], self.last.errors[rows] = _array(chosen), found
        due = rows[self.updates[rows] % self.rule.target_period == 0]
        if len(due):
            self._target[due] = self._online[due]
        return found

    def _both_values(self, rows: Int64s, states: Tensor) -> tuple[Tensor, Tensor, Sequence[Tensor]]:
        """Return the online networks' values of s and s', (k, batch, actions), and the leaves behind those of s.

        ``states`` are every s and every s', (2, k, batch, …).
        """
        if self.form.network == MLP:  # a second pass takes longer than a slope of zero through twice the batch
            both, leaves = self._values.values(rows, states.transpose(0, 1).flatten(1, 2))
            batch = self.rule.batch
            return both.narrow(1, 0, batch), both.detach().narrow(1, batch, batch), leaves
        with torch.no_grad():
            following_values = self._values.values(rows, states[1]).values
        values, leaves = self._values.values(rows, states[0])
        return values, following_values, leaves

    def _step(self, rows: Int64s, gradient: Tensor) -> None:
        """Take one step of Adam in the named rows; DivergedError if a parameter is no number afterwards."""
        steps, rate = self.updates[rows], self.rule.learning_rate
        if np.array_equal(rows, self._every_row):
            adam_step(self._online, self._first, self._second, gradient, steps, rate)
            after = self._online
        else:
            named = torch.from_numpy(rows).to(self._device)
            own = self._online[named], self._first[named], self._second[named]
            adam_step(*own, gradient, steps, rate)
            for whole, part in zip((self._online, self._first, self._second), own, strict=True):
                whole[named] = part
            after = own[0]
        # A sum is nan or infinite if any of its terms is.
        if not math.isfinite(float(after.sum())):
            raise diverged(self.rule, self.updates[rows])

    def load_online(self, online: Float32s) -> None:
        if online.shape != tuple(self._online.shape):
            raise ValueError(f"networks of {online.shape}, not {tuple(self._online.shape)}")
        for own in (self._online, self._target):
            own.copy_(torch.from_numpy(online))

    def state(self) -> Arrays:
        return {**{name: _array(own) for name, own in self._tensors.items()}, "updates": self.updates}

    def load(self, state: Mapping[str, NDArray[Any]]) -> None:
        for name, own in self._tensors.items():
            if state[name].shape != tuple(own.shape):
                raise ValueError(f"{name} is {state[name].shape}, it should be {tuple(own.shape)}")
            own.copy_(torch.from_numpy(np.ascontiguousarray(state[name])))
        self.updates[:] = state["updates"]

    def _tensor(self, array: NDArray[Any]) -> Tensor:
        return torch.from_numpy(array).to(self._device)


def huber_slopes(values: Tensor, taken: Tensor, errors: Tensor, weights: Tensor, rule: UpdateRule) -> Tensor:
    """Return the slope of each value (k, batch, actions) in the mean Huber loss: the error, at most δ either way.

    ``taken`` (k, batch, 1) are the actions; ``errors`` (k, batch) are Q(s, a) less its goal, times ``weights``.
    """
    own = errors.clamp(-rule.huber_delta, rule.huber_delta).mul_(weights).mul_(1 / rule.batch)
    return torch.zeros_like(values).scatter_(-1, taken, own.unsqueeze(-1))


def margin_slopes(values: Tensor, taken: Tensor, imitated: Tensor, rule: UpdateRule) -> Tensor:
    """Return the slope of each value (k, batch, actions) in the mean large-margin loss of what is imitated (k, batch).

    The loss (self_imitation.py) rises with the rival's value, and falls with that of the action that was taken; where
    they are the same, it is flat.
    """
    share = (imitated / rule.batch).unsqueeze(-1)
    rival = (values + rule.margin).scatter_(-1, taken, values.gather(-1, taken)).argmax(-1, keepdim=True)
    return torch.zeros_like(values).scatter_add_(-1, rival, share).scatter_add_(-1, taken, -share)


def adam_step(parameters: Tensor, first: Tensor, second: Tensor, gradient: Tensor, steps: Int64s, rate: float) -> None:
    """Take one step by the gradient, in place; all (rows, parameters), but ``steps`` (rows,), which count this one."""
    first.lerp_(gradient, 1 - BETA_1)
    second.mul_(BETA_2).addcmul_(gradient, gradient, value=1 - BETA_2)
    if (steps == steps[0]).all():
        scale, epsilon = _scales(int(steps[0]), rate)
        parameters.addcdiv_(first, second.sqrt().add_(epsilon), value=-scale)
        return
    scales = np.array([_scales(int(own), rate) for own in steps], np.float32)
    own_scale, own_epsilon = torch.from_numpy(scales).to(parameters.device).T[..., None]
    parameters.addcdiv_(own_scale * first, second.sqrt().add_(own_epsilon), value=-1)


def _scales(step: int, rate: float) -> tuple[float, float]:
    """Return the rate and ε with the corrections of both moments in them."""
    correction = math.sqrt(1 - BETA_2**step)
    return rate * correction / (1 - BETA_1**step), EPSILON * correction


def device_named(name: str) -> torch.device:
    """Return the device of that name; PresetError if this torch finds none."""
    there = {"cpu": True, "cuda": torch.cuda.is_available(), "mps": torch.backends.mps.is_available()}
    if not there[name]:
        found = ", ".join(each for each, is_there in there.items() if is_there)
        raise PresetError(f"device {name!r}: torch finds no such device on this computer: take {found}")
    return torch.device(name)


@contextmanager
def _enough_memory(device: torch.device) -> Iterator[None]:
    """Raise PresetError, one line, where the device's memory is too small."""
    try:
        yield
    except torch.cuda.OutOfMemoryError as error:
        raise PresetError(
            f"device {device.type!r}: out of memory: lower the preset's batch or hidden, train fewer trials at once, "
            f"or take --device cpu"
        ) from error


def _array(tensor: Tensor) -> Float32s:
    return tensor.cpu().numpy()
