"""Contrast of the images at true depth discontinuities and on smooth surfaces of drawn scenes: the reason for `contrast.CONTRAST`.

``uv run python tools/break_contrast.py SCENES...``: a scene is a folder with calibration.yaml, capture/ and truth/surface.npz. The object's
true pixels are binned as in the solve. An edge is a discontinuity where log depth differs from the step of the true normals by STEP and
more, and smooth where none lies within three blocks. Quantiles are of all scenes' edges together, each scene of the same weight.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

import lpcal
from lpcal.detect.radiometry import Sensor, to_radiance
from lpcal.geometry import lambert, raster
from lpcal.geometry.arrays import Array
from lpcal.integration.integrate import Grid, steps
from lpcal.surface.contrast import CONTRAST, break_costs
from lpcal.surface.scales import Blocks
from lpcal.view import pixel_list

STEP = 0.01
"""Difference of log depth from the step of the normals, from which an edge is a discontinuity: several times what curvature makes of it."""
QUANTILES = (0.05, 0.1, 0.25, 0.5, 0.75, 0.95)
EVERY = 500
"""Edges that are drawn, with replacement, from each scene."""


def contrasts(scene: Path) -> tuple[Array, Array]:
    """Contrasts (N,) at the discontinuities of a scene, and on its smooth surfaces."""
    calibration, true = lpcal.read_calibration(scene / "calibration.yaml"), np.load(scene / "truth/surface.npz")
    radiance = to_radiance(lpcal.read_capture(scene / "capture", calibration), Sensor())
    maps = pixel_list.grey(radiance, pixel_list.lights_of(calibration, radiance))
    mask = true["mask"] & (true["depth"] > 0)
    seen = pixel_list.list_pixels(maps, pixel_list.ray_map(mask.shape, calibration.camera), mask, central=True)
    u, n, grid = np.log(true["depth"][mask].astype(float)), true["normals"][mask].astype(float), Grid.of(mask)
    if (blocks := Blocks.of(seen, grid)) is not None:
        u, n = blocks.means(u), lambert.unit(np.stack([blocks.means(one) for one in n.T], axis=1))[0]
        seen, grid = blocks.coarse, blocks.coarse_grid
    contrast = CONTRAST / np.sqrt(break_costs(seen, grid) - 1)
    broken = np.abs(steps(grid, n, seen.rays_C, central=True).residual(grid, u)) > STEP
    near = np.zeros(seen.mask.shape, bool)
    at = np.zeros(seen.pixels, bool)
    at[grid.a[broken]] = at[grid.b[broken]] = True
    near[seen.mask] = at
    near = raster.dilated(near, 3)
    smooth = ~(near[seen.mask][grid.a] | near[seen.mask][grid.b])
    return contrast[broken], contrast[smooth]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("scenes", nargs="+", type=Path, help="folders of scenes, or scenes")
    given = parser.parse_args().scenes
    rng = np.random.default_rng(0)
    drawn: tuple[list[Array], list[Array]] = ([], [])
    for folder in given:
        for scene in [folder] if (folder / "truth").exists() else sorted(one for one in folder.iterdir() if (one / "truth").exists()):
            for kind, found in zip(drawn, contrasts(scene), strict=True):
                if len(found):
                    kind.append(rng.choice(found, EVERY))
    print(f"{'quantile':>16}" + "".join(f"{q:8.2f}" for q in QUANTILES))
    for name, kind in zip(("discontinuities", "smooth surfaces"), drawn, strict=True):
        print(
            f"{name:>16}" + "".join(f"{value:8.3f}" for value in np.quantile(np.concatenate(kind), QUANTILES)) + f"  ({len(kind)} scenes)"
        )


if __name__ == "__main__":
    main()
