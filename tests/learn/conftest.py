"""One thread: for networks this small, two threads only wait for each other."""

import torch

torch.set_num_threads(1)
