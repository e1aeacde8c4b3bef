"""The networks of the agents with objectives, for arenas of any size: how one is reached, and which comes next.

What is near, past all that stands in the way, spreads from cell to cell (learn/dqn/nearness.py): how well a cell
is passed is learnt. All other layers see a cell's surroundings, so the same weights do for every arena.
learn/objectives/networks.py computes the same without torch.
"""

from typing import Any

import torch
from torch import Tensor, nn
from torch.nn.functional import max_pool2d, pad

from mc_nested.learn.dqn import nearness
from mc_nested.learn.dqn.nearness import SMALL, TINY
from mc_nested.learn.dqn.states import AGENT, MANY, NONE, OCCUPIED, ORDER_PLANES, WANTED


class Spread(torch.autograd.Function):
    """``nearness.spread`` with its slopes; computed by the processor wherever the tensors are."""

    @staticmethod
    def forward(ctx: Any, sources: Tensor, passing: Tensor) -> Tensor:
        near, via = nearness.spread(sources.detach().cpu().numpy(), passing.detach().cpu().numpy())
        ctx.kept = passing.detach().cpu().numpy(), near, via
        return torch.from_numpy(near).to(sources.device)

    @staticmethod
    def backward(ctx: Any, *of_near: Tensor) -> tuple[Tensor, Tensor]:
        (slope,) = of_near
        passing, near, via = ctx.kept
        found = nearness.slopes(passing, near, via, slope.cpu().numpy())
        of_sources, of_passing = (torch.from_numpy(each).to(slope.device) for each in found)
        return of_sources, of_passing


def spread(sources: Tensor, passing: Tensor) -> Tensor:
    """Return how near each cell (B, side, side) is to the sources, by how well one passes each (B, side, side)."""
    near: Tensor = Spread.apply(sources.contiguous(), passing.contiguous())  # type: ignore[no-untyped-call]  # torch's
    return near


def around(planes: Tensor, cells: tuple[Tensor, Tensor, Tensor], reach: int) -> Tensor:
    """Return what the planes (B, planes, side, side) hold up to ``reach`` cells around some cells (n,), (n, values).

    ``cells`` are their places in the batch, and their x and y.
    """
    batch, x, y = cells
    window = torch.arange(2 * reach + 1, device=planes.device)
    wide = pad(planes, (reach, reach, reach, reach)).permute(0, 2, 3, 1)
    return wide[batch[:, None, None], x[:, None, None] + window[:, None], y[:, None, None] + window].flatten(1)


def framed_wide(planes: Tensor, reach: int) -> Tensor:
    """Return the planes with ``reach`` cells more on every side, which are occupied."""
    wide = pad(planes, (reach, reach, reach, reach))
    wide[:, OCCUPIED] = pad(planes[:, OCCUPIED], (reach, reach, reach, reach), value=1.0)
    return wide


def places_of(planes: Tensor) -> tuple[Tensor, Tensor, Tensor]:
    """Return where the agents are: their places in the batch, and their x and y, (B,) each."""
    batch, side = len(planes), planes.shape[-1]
    place = planes[:, AGENT].flatten(1).argmax(1)
    return torch.arange(batch, device=planes.device), place // side, place % side


class ReachModule(nn.Module):
    """The nested agent's: from planes (B, 3, side, side) the value of each action (B, actions).

    How near each cell is to where the objective can be placed from, which is beside it, spreads through the arena.
    Dense layers see that around the agent, as shares of the highest there, and what stands there.
    """

    WINDOW, NEAR = 2, 1

    def __init__(self, actions: int, channels: int = 12) -> None:
        super().__init__()
        self.seen = nn.Conv2d(2, channels, 3, padding=1)
        self.maps = nn.Conv2d(channels, 2, 1)
        self.first = nn.Linear(9 + 2 * 25, 64)
        self.second = nn.Linear(64, 32)
        self.last = nn.Linear(32, actions)
        self.maps.bias = nn.Parameter(torch.tensor([1.5, -2.0]))  # most cells can be passed, few are a source

    def forward(self, planes: Tensor) -> Tensor:
        maps = torch.sigmoid(self.maps(torch.relu(self.seen(planes[:, :AGENT]))))
        beside = max_pool2d(planes[:, WANTED : WANTED + 1], 3, 1, 1)[:, 0]
        near = spread(maps[:, 1] * beside, maps[:, 0] * (1 - planes[:, OCCUPIED]))
        agents = places_of(planes)
        around_agent = around(near[:, None], agents, self.NEAR)
        highest = around_agent.amax(1, keepdim=True).clamp_min(TINY)
        batch, x, y = agents
        wide = framed_wide(planes[:, :AGENT], self.WINDOW)
        window = around(wide, (batch, x + self.WINDOW, y + self.WINDOW), self.WINDOW)
        hidden = torch.relu(self.first(torch.cat((around_agent / highest, window), 1)))
        values: Tensor = highest * self.last(torch.relu(self.second(hidden)))
        return values


class OrderModule(nn.Module):
    """The main agent's: from planes (B, ORDER_PLANES, side, side) each cell's value as the next one (B, side * side).

    How near each cell is to the agent spreads twice: past what stands; and past what is still to be built, too. Cells
    that aren't to be built have the value NONE; so dense layers look at the others alone.
    """

    WINDOW, NEAR = 2, 1

    def __init__(self, channels: int = 12, hidden: int = 96) -> None:
        super().__init__()
        self.passing = nn.Conv2d(2, 2, 1)
        self.seen = nn.Conv2d(ORDER_PLANES + 6, channels, 3, padding=1)
        self.farther = nn.Conv2d(channels, channels, 3, padding=2, dilation=2)
        self.farthest = nn.Conv2d(channels, channels, 3, padding=4, dilation=4)
        self.axes = nn.Conv2d(4 * channels, channels, 1)
        self.first = nn.Linear(ORDER_PLANES * 25 + 4 * 9 + 5 * channels + 5, hidden)
        self.second = nn.Linear(hidden, hidden)
        self.last = nn.Linear(hidden, 1)
        # They begin where they should end: a block is in the way.
        self.passing.weight = nn.Parameter(torch.tensor([[0.0, -8.0], [-8.0, -8.0]])[:, :, None, None])
        self.passing.bias = nn.Parameter(torch.full((2,), 2.0))

    def forward(self, planes: Tensor) -> Tensor:
        agents = planes[:, AGENT : AGENT + 1].expand(-1, 2, -1, -1)
        # A block is placed from the cell before it.
        passing = torch.sigmoid(self.passing(planes[:, :AGENT]))
        near = spread(agents.flatten(0, 1), passing.flatten(0, 1)).view_as(agents).roll(1, 3)
        maps = torch.cat((near, -torch.log(near + SMALL) / 4), 1)
        across, along = self._away(planes)
        seen = torch.relu(self.seen(torch.cat((planes, maps, across, along), 1)))
        seen = seen + torch.relu(self.farther(seen))
        seen = seen + torch.relu(self.farthest(seen))
        seen = seen + torch.relu(self.axes(along_axes(seen)))
        batch, x, y = (planes[:, WANTED] > 0).nonzero(as_tuple=True)
        wide = framed_wide(planes, self.WINDOW)
        values = torch.full((len(planes), *planes.shape[2:]), NONE, device=planes.device)
        window = around(wide, (batch, x + self.WINDOW, y + self.WINDOW), self.WINDOW)
        away = torch.stack((across[batch, 0, x, y], along[batch, 0, x, y]), 1)
        left = planes[:, WANTED].sum((1, 2))[batch, None] / MANY
        of_cells = (window, around(maps, (batch, x, y), self.NEAR), cross(seen, (batch, x, y)), away, away.abs(), left)
        hidden = torch.relu(self.second(torch.relu(self.first(torch.cat(of_cells, 1)))))
        return values.index_put((batch, x, y), self.last(hidden)[:, 0]).flatten(1)

    def _away(self, planes: Tensor) -> tuple[Tensor, Tensor]:
        """Return how far each cell is from the agent, (B, 1, side, side), across and along, in eights of cells."""
        side = planes.shape[-1]
        _, x, y = places_of(planes)
        cells = torch.arange(side, device=planes.device)
        across = ((cells - x[:, None]) / 8)[:, None, :, None].expand(-1, 1, side, side)
        along = ((cells - y[:, None] - 1) / 8)[:, None, None, :].expand(-1, 1, side, side)
        return across, along


def along_axes(seen: Tensor) -> Tensor:
    """Return the most of each channel in the cell's row, in all rows beyond, in its column and in the arena."""
    row = seen.amax(2, keepdim=True)
    beyond = row.flip(3).cummax(3)[0].flip(3)
    beyond = torch.cat((beyond[..., 1:], torch.zeros_like(beyond[..., :1])), 3)
    every = row, beyond, seen.amax(3, keepdim=True), seen.amax((2, 3), keepdim=True)
    return torch.cat([each.expand_as(seen) for each in every], 1)


def cross(seen: Tensor, cells: tuple[Tensor, Tensor, Tensor]) -> Tensor:
    """Return the channels (B, channels, side, side) of some cells (n,) and their neighbours, (n, 5 * channels)."""
    batch, x, y = cells
    wide = pad(seen, (1, 1, 1, 1)).permute(0, 2, 3, 1)
    steps = ((1, 1), (0, 1), (2, 1), (1, 0), (1, 2))
    return torch.cat([wide[batch, x + across, y + along] for across, along in steps], 1)
