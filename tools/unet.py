"""The network of lpcal.view.network in PyTorch, to be fitted (``uv run --with torch``), and what a file keeps of it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import torch
from torch import nn
from torch.nn import functional


def _step(before: int, after: int) -> nn.Module:
    return nn.Sequential(nn.Conv2d(before, after, 3, padding=1, bias=False), nn.BatchNorm2d(after), nn.ReLU())


class Unet(nn.Module):
    """Some channels and their places in, some answers out."""

    def __init__(self, channels: int, widths: Sequence[int], answers: int) -> None:
        """`widths` are the channels of the four scales, and of the last one."""
        super().__init__()
        zero, one, two, three, last = widths
        pairs = {"in": (channels + 2, zero), "up 2": (two + 2 * three, two), "up 1": (one + two, one), "up 0": (zero + one, last)}
        for level, (before, after) in enumerate(((zero, one), (one, two), (two, three)), 1):
            pairs |= {f"down {level}": (before, after), f"down {level}, again": (after, after)}
        self.steps = nn.ModuleDict({name: _step(*pair) for name, pair in pairs.items()})
        self.out = nn.Conv2d(last, answers, 1)

    def forward(self, x: torch.Tensor) -> torch.Tensor:
        """Answers (N, answers, rows, columns) by channels and places (N, channels + 2, rows, columns)."""
        x, seen = self.steps["in"](x), []
        for level in (1, 2, 3):
            seen.append(x)
            half = functional.avg_pool2d(x, 2, ceil_mode=True, count_include_pad=False)
            x = self.steps[f"down {level}, again"](self.steps[f"down {level}"](half))
        x = torch.cat([x, x.mean((2, 3), keepdim=True).expand_as(x)], 1)
        for level in (2, 1, 0):
            before = seen.pop()
            wide = functional.interpolate(x, scale_factor=2, mode="nearest")[..., : before.shape[2], : before.shape[3]]
            x = self.steps[f"up {level}"](torch.cat([before, wide], 1))
        return self.out(x)


def arrays(net: Unet, names: Sequence[str], mirrored: Sequence[str], middle: np.ndarray, spread: np.ndarray) -> dict[str, np.ndarray]:
    """What lpcal.view.network reads: the normalisation of each batch has become a part of the convolution before it.

    `names` are the channels, `mirrored` those that change their sign in a mirror, `middle` and `spread` their mean and standard deviation.
    """
    state = {name: value.detach().numpy() for name, value in net.state_dict().items()}
    sign = np.where(np.isin(names, mirrored), -1, 1)
    found = {"channels": np.array(names), "mirrored": sign, "middle": middle, "spread": spread}
    for name in net.steps:
        at = f"steps.{name}"
        gain = state[f"{at}.1.weight"] / np.sqrt(state[f"{at}.1.running_var"] + net.steps[name][1].eps)
        weight = state[f"{at}.0.weight"] * gain[:, None, None, None]
        found[f"{name}.weight"] = np.moveaxis(weight.reshape(*weight.shape[:2], 9), 2, 0)
        found[f"{name}.offset"] = state[f"{at}.1.bias"] - gain * state[f"{at}.1.running_mean"]
    found |= {"out.weight": state["out.weight"][:, :, 0, 0], "out.offset": state["out.bias"]}
    return {
        name: value if name == "channels" else np.asarray(value, np.float16 if name.endswith(".weight") else np.float32)
        for name, value in found.items()
    }
