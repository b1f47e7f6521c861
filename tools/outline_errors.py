"""Outlines: errors and what they show of them: ``python tools/outline_errors.py [COUNT]``, the spheres of so many simulated rigs.

From the rigs of `light_sigmas`: the true outline is known, so each seen one's shift and radial bias are. Fitted, by maximum likelihood on
the even seeds and held against the odd ones, a kind each, with s the scatter of the points and r the radius in pixels::

    shift an axis      sigma^2 = (floor max(1, (25 / r)^2))^2 + (slope s^2)^2
    bias               of the rig: mean and sigma; a sphere's own: sigma^2 = floor^2 + (slope s^2)^2 + (small min(1, (25 / r)^3))^2

The mean that hangs on the radius (`outline_errors` of `lpcal.chain.refine_lights.measure`) is taken away first; what an outline that lacks
a part leaves open is weighed as there.

`lpcal.chain.refine_lights.measure` holds what this prints; for chrome, less the white part of the errors, which it adds. Scatter shows what
the edge met besides the sphere's rim: squared, as it takes part of the rays along and is itself seen only in the rest.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from scipy.optimize import minimize

sys.path.insert(0, str(Path(__file__).resolve().parent))

from light_rigs import rig_of
from light_sigmas import RIGS, drawn_as, plan
from lpcal.chain.refine_lights.measure import SMALL_PX, outline_errors
from lpcal.geometry import sphere
from lpcal.simulate.captures import place_spheres


def seen_and_true(seed: int) -> list[tuple[str, np.ndarray]]:
    """Kind, and (seed, radius, scatter, bias, shift x, shift y) in pixels, as if seen all round, of every sphere of a drawn rig."""
    one = plan(seed)
    seen, (rig, _, _) = drawn_as(one), rig_of("lightpanel-6", one.chrome, one.matte)
    spheres = {name: section.model_copy(update={"radius": one.radius_m}) for name, section in rig.spheres.items()}
    true = place_spheres(seen.built, rig.model_copy(update={"spheres": spheres}), np.random.default_rng([one.recipe.seed, 78]))
    found = []
    for view in seen.views:
        ball = true[view.name]
        drawn = seen.camera.project(sphere.outline(ball.centre_C, ball.radius_m, np.linspace(0, 2 * np.pi, 2000, endpoint=False)))
        middle = drawn.mean(axis=0)
        (away, angle), (true_away, true_angle) = _polar(view.outline_px - middle), _polar(drawn - middle)
        offset = away - np.interp(angle, true_angle, true_away, period=2 * np.pi)
        waves = np.column_stack([np.ones_like(angle), np.cos(angle), np.sin(angle)])
        bias, x, y = np.linalg.lstsq(waves, offset, rcond=None)[0]
        lacking = np.sqrt(np.diag(np.linalg.inv(waves.T @ waves / len(waves))) / [1, 2, 2])
        bias -= outline_errors(view.kind, true_away.mean(), view.outline_sigma_px).bias_px
        found.append((view.kind, np.array([seed, true_away.mean(), view.outline_sigma_px, *np.array([bias, x, y]) / lacking])))
    return found


def _polar(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return np.linalg.norm(points, axis=1), np.arctan2(points[:, 1], points[:, 0])


def shift_sd(p: np.ndarray, table: np.ndarray) -> np.ndarray:
    """Floor and slope (log) to a standard deviation an axis."""
    floor, slope = np.exp(p)
    return np.hypot(floor * np.maximum(1, (SMALL_PX / table[:, 1]) ** 2), slope * table[:, 2] ** 2)


def shift_cost(p: np.ndarray, table: np.ndarray) -> float:
    """Minus log likelihood of shifts."""
    sd = shift_sd(p, table)[:, None]
    return float(np.sum(0.5 * (table[:, 4:] / sd) ** 2 + np.log(sd)))


def bias_parts(p: np.ndarray, table: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Deviations from the mean and their covariance within one rig."""
    own2 = np.exp(2 * p[2]) + (np.exp(p[3]) * table[:, 2] ** 2) ** 2 + (np.exp(p[4]) * np.minimum(1, (SMALL_PX / table[:, 1]) ** 3)) ** 2
    return table[:, 3] - p[0], np.diag(own2) + np.exp(2 * p[1])


def bias_cost(p: np.ndarray, table: np.ndarray) -> float:
    """Minus log likelihood of biases, those of one rig together, and a weak prior on the logarithms."""
    total = float(np.sum((p[1:] + 3) ** 2) / 50)
    for seed in np.unique(table[:, 0]):
        off, covariance = bias_parts(p, table[table[:, 0] == seed])
        total += 0.5 * float(off @ np.linalg.solve(covariance, off)) + 0.5 * float(np.linalg.slogdet(covariance)[1])
    return total


def main(count: int) -> None:
    """Fit on even seeds, judge on odd ones."""
    spheres = [one for seed in range(count) for one in seen_and_true(seed)]
    for kind in ("chrome", "matte"):
        table = np.array([row for own, row in spheres if own == kind])
        even, odd = table[table[:, 0] % 2 == 0], table[table[:, 0] % 2 == 1]
        shift = minimize(shift_cost, np.log([0.03, 1.0]), args=(even,), method="Nelder-Mead").x
        bias = minimize(
            bias_cost, np.array([0.0, *np.log([0.1, 0.03, 1.0, 0.02])]), args=(even,), method="Nelder-Mead", options={"maxiter": 4000}
        ).x
        print(f"{kind}: {len(even)} outlines fitted, {len(odd)} held")
        print(f"  shift: floor {np.exp(shift[0]):.3f} px, slope {np.exp(shift[1]):.2f} / px;", end=" ")
        print("squares over sigma's: " + ", ".join(f"{np.mean((t[:, 4:] / shift_sd(shift, t)[:, None]) ** 2):.2f}" for t in (even, odd)))
        mean, (rig, floor, slope, small) = bias[0], np.exp(bias[1:])
        print(
            f"  bias: mean {mean:.3f}, of the rig {rig:.3f}, own floor {floor:.3f} px, slope {slope:.2f} / px, small {small:.3f} px;",
            end=" ",
        )
        print("squares over sigma's: " + ", ".join(f"{_bias_square(bias, t):.2f}" for t in (even, odd)))


def _bias_square(p: np.ndarray, table: np.ndarray) -> float:
    parts = [bias_parts(p, table[table[:, 0] == seed]) for seed in np.unique(table[:, 0])]
    return float(sum(off @ np.linalg.solve(covariance, off) for off, covariance in parts) / len(table))


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else RIGS)
