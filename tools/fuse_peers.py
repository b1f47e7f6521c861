"""The same placed surfaces fused in other ways, and photogrammetry of the ambient images, for `fuse_shapes.py`.

- the tracked poses alone: lpcal's surface of the depth maps where they were placed, nothing aligned;
- small_gicp (``uv sync --group peers``): every view aligned with all others together, by its GICP from the tracked poses, some rounds;
  the same surface of them;
- COLMAP (pycolmap) on the ambient images, brightened to full scale, with the calibrated intrinsics and masks of the object (the screen
  behind it stands with the camera): sparse points, put into the room by the tracked cameras; and its triangulation at the tracked poses.
  Its dense stereo needs CUDA, which pycolmap's wheels lack.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np

from lpcal.fusion.align import POINTS, SHARED, Aligned, sampled
from lpcal.fusion.correspondences import Placed
from lpcal.fusion.deformation import bending_of
from lpcal.fusion.factor import BlockMatrix, Factor
from lpcal.fusion.pair_selection import everyone
from lpcal.fusion.vertices import on_the_views
from lpcal.fusion.views import PlacedView, view_of
from lpcal.fusion.volume import surface_of
from lpcal.geometry import se3
from lpcal.records.surface import Surface

ROUNDS = 4
"""How often every view is aligned with all others: they move under a tenth of a millimetre in the last."""
REACH_M = 0.004
"""How far apart points of two views may be to be taken for one, metres: some sigmas of the single views."""
KNOTS_PX = 48
SURE = 1e12
"""Information of every parameter where nothing is aligned: standard deviations of a thousandth of a millimetre."""


@dataclass(frozen=True)
class Peer:
    """Another way to a model: its points in the room, None where it failed, and a remark."""

    name: str
    points_O: np.ndarray | None
    note: str = ""


def peers(rig: Path, surfaces: Sequence[Surface]) -> Iterator[Peer]:
    """All of them."""
    views = [view_of(surface, surface.placement) for surface in surfaces]
    placed = [view.placement.H_AC for view in views]
    yield Peer("tracked poses alone", surface_at(views, placed))
    try:
        import small_gicp  # noqa: F401
    except ImportError:
        yield Peer("small_gicp", None, "not installed")
    else:
        yield Peer("small_gicp from the tracked poses", surface_at(views, gicp(views, placed)))
    yield from colmap(rig, views, surfaces)


def surface_at(views: Sequence[PlacedView], H_OC: Sequence[np.ndarray]) -> np.ndarray:
    """Vertices of the surface of views where poses put them, their depths as they are."""
    state = []
    for view, H in zip(views, H_OC, strict=True):
        bending = bending_of(view, KNOTS_PX)
        state.append(Placed(view, bending, H, np.zeros(bending.size), *sampled(view, POINTS)))
    sizes = [6 + one.bending.size for one in state]
    starts = SHARED + np.concatenate([[0], np.cumsum(sizes)])[:-1]
    size = SHARED + sum(sizes)
    sure = BlockMatrix(np.array([0, *starts, size]))
    for block in range(len(starts) + 1):
        sure.add(sure.rows(block), np.diag(np.full(len(sure.rows(block)), SURE)))
    still = Aligned(tuple(state), np.zeros(size), Factor.of(sure), starts, {}, everyone(len(state)), 1e-4, 0.0, 0.0, np.zeros((6, 6)))
    return on_the_views(still, surface_of(state)).triangles.vertices_A


def gicp(views: Sequence[PlacedView], placed: Sequence[np.ndarray]) -> list[np.ndarray]:
    """Poses by small_gicp: each view against the points of all others."""
    import small_gicp

    points_C = [view.points_C(*np.nonzero(view.witness)) for view in views]
    H_OC = [H.copy() for H in placed]
    for _ in range(ROUNDS):
        for k, mine in enumerate(points_C):
            others = np.concatenate([se3.apply(H_OC[j], x) for j, x in enumerate(points_C) if j != k])
            found = small_gicp.align(
                others,
                mine,
                H_OC[k],
                registration_type="GICP",
                downsampling_resolution=2 * views[k].footprint_m,
                max_correspondence_distance=REACH_M,
                num_threads=1,
            )
            H_OC[k] = np.asarray(found.T_target_source)
    return H_OC


def colmap(rig: Path, views: Sequence[PlacedView], surfaces: Sequence[Surface]) -> Iterator[Peer]:
    """COLMAP's points of the ambient images, with its own poses and with the tracked ones."""
    import pycolmap

    pycolmap.logging.minloglevel = 3
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        images, masks = folder / "images", folder / "masks"
        images.mkdir()
        masks.mkdir()
        for surface in surfaces:
            dark = cv2.imread(str(rig / "session" / surface.name / "ambient.png"), cv2.IMREAD_GRAYSCALE).astype(float)
            bright = 255 * (dark - dark.min()) / max(float(np.percentile(dark[surface.mask], 99.5)) - dark.min(), 1)
            cv2.imwrite(str(images / f"{surface.name}.png"), np.clip(bright, 0, 255).astype(np.uint8))
            cv2.imwrite(str(masks / f"{surface.name}.png.png"), 255 * surface.mask.astype(np.uint8))
        camera = intrinsics(rig)
        reader = pycolmap.ImageReaderOptions()
        reader.mask_path = masks
        reader.camera_model, reader.camera_params = camera.model.name, ",".join(f"{value:.9g}" for value in camera.params)
        extraction = pycolmap.FeatureExtractionOptions()
        extraction.num_threads = 1
        database = folder / "database.db"
        pycolmap.extract_features(
            database, images, camera_mode=pycolmap.CameraMode.SINGLE, reader_options=reader, extraction_options=extraction
        )
        matching = pycolmap.FeatureMatchingOptions()
        matching.num_threads = 1
        pycolmap.match_exhaustive(database, matching_options=matching)
        yield sparse(folder, views)
        yield triangulated(folder, camera, views)


def sparse(folder: Path, views: Sequence[PlacedView]) -> Peer:
    """The largest reconstruction of COLMAP's mapper, moved and scaled onto the tracked cameras."""
    import pycolmap

    options = pycolmap.IncrementalPipelineOptions()
    options.ba_refine_focal_length = options.ba_refine_extra_params = options.ba_refine_principal_point = False
    options.min_model_size, options.num_threads = 3, 1
    (folder / "sparse").mkdir()
    found = pycolmap.incremental_mapping(folder / "database.db", folder / "images", folder / "sparse", options)
    best = max(found.values(), key=lambda one: one.num_reg_images(), default=None)
    dense = "its dense stereo needs CUDA" if not pycolmap.has_cuda else ""
    if best is None or best.num_reg_images() < 3:
        return Peer("COLMAP, ambient images", None, f"no model of three images; {dense}")
    tracked = {f"{view.name}.png": view.placement.H_AC[:3, 3] for view in views}
    ours = [image for image in best.images.values() if image.has_pose]
    their = np.array([image.projection_center() for image in ours])
    moved = similarity(their, np.array([tracked[image.name] for image in ours]))
    points = np.array([point.xyz for point in best.points3D.values()])
    return Peer("COLMAP, ambient images", moved(points), f"{len(ours)} of {len(views)} images, {len(points)} points; {dense}")


def triangulated(folder: Path, camera: object, views: Sequence[PlacedView]) -> Peer:
    """COLMAP's matches triangulated at the tracked poses."""
    import pycolmap

    database = pycolmap.Database.open(str(folder / "database.db"))
    stored = {image.name: image for image in database.read_all_images()}
    start = folder / "start"
    start.mkdir()
    number = next(iter(stored.values())).camera_id
    (start / "cameras.txt").write_text(f"{number} {camera.model.name} {camera.width} {camera.height} {' '.join(map(str, camera.params))}\n")
    lines = []
    for view in views:
        image, H_CO = stored[f"{view.name}.png"], se3.inv(view.placement.H_AC)
        x, y, z, w = se3.quaternion(H_CO[:3, :3])
        lines += [f"{image.image_id} {w} {x} {y} {z} {' '.join(map(str, H_CO[:3, 3]))} {number} {image.name}", ""]
    (start / "images.txt").write_text("\n".join(lines) + "\n")
    (start / "points3D.txt").touch()
    database.close()
    (folder / "triangulated").mkdir()
    options = pycolmap.IncrementalPipelineOptions()
    options.num_threads = 1
    begun = pycolmap.Reconstruction(start)
    found = pycolmap.triangulate_points(begun, folder / "database.db", folder / "images", folder / "triangulated", options=options)
    points = np.array([point.xyz for point in found.points3D.values()])
    name = "COLMAP's points at the tracked poses"
    return Peer(name, points, f"{len(points)} points") if len(points) >= 10 else Peer(name, None, f"{len(points)} points")


def intrinsics(rig: Path) -> object:
    """The calibrated camera as COLMAP's."""
    import subprocess
    import sys

    import pycolmap

    target = rig / "colmap"
    words = ["export", str(rig), "--format", "colmap", "-o", str(target), "--quiet"]
    subprocess.run([sys.executable, "-m", "lpcal", *words], check=True, stdout=subprocess.DEVNULL)
    text = next(target.rglob("cameras.txt")).read_text(encoding="utf-8")
    _, model, width, height, *params = next(row for row in text.splitlines() if row and not row.startswith("#")).split()
    return pycolmap.Camera(model=model, width=int(width), height=int(height), params=[float(value) for value in params])


def similarity(x: np.ndarray, y: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """The motion and scale that takes points x (N, 3) nearest to y, least squares (Umeyama 1991)."""
    import pycolmap

    found = pycolmap.estimate_sim3d(x, y)
    assert found is not None
    matrix = found.matrix()
    return lambda points: points @ matrix[:, :3].T + matrix[:, 3]
