"""What of the rig fills space in the page's drawing: where each light's rays come from, how sure that is, the working volume, the field."""

from __future__ import annotations

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Light
from lpcal.records.camera import Camera
from lpcal.report.rig_report import RigReport
from lpcal.report.scene_items import FIELD_CELLS, FieldPlane, LineItem

APART_M = 1e-4
"""A source nearer than this to its light's mechanical centre is not drawn: a tenth of a millimetre is less than a pixel."""
DEPTHS = (0.8, 1.2)
"""Shares of the focus' depth between which the camera's view is drawn as the working volume: the lights' axes meet within it."""
MOST_FIELDS = 24
"""Lights whose fields can be chosen: more are a list that nobody reads."""


def sources(report: RigReport) -> list[LineItem]:
    """The points that the lights' rays come from, where they are not the mechanical centres, each with a line to its centre."""
    drawn: list[LineItem] = []
    for light in report.shown_lights:
        if light.source_C is None or light.H_CL is None or np.linalg.norm(light.source_C - light.H_CL[:3, 3]) < APART_M:
            continue
        drawn.append(LineItem(kind="point", points=light.source_C[None], tone="poor", r=3.5, layer="sources"))
        drawn.append(LineItem(kind="line", points=np.stack([light.H_CL[:3, 3], light.source_C]), tone="poor", thin=True, layer="sources"))
    return drawn


def ellipsoids(report: RigReport) -> list[LineItem]:
    """One standard deviation of each light's place, about its source; of the drawing's lights by the tolerances' covariance."""
    if report.placed is None and report.wings is not None:
        blocks = [report.wings.covariance[6 * k : 6 * k + 6, 6 * k : 6 * k + 6] for k in range(len(report.wings.wings))]
        return [_ellipsoid(H[:3, 3], se3.origin_covariance(H, block)) for H, block in zip(report.wings.H_CL, blocks, strict=True)]
    return [
        _ellipsoid(where, light.position_std_m**2 * np.eye(3))
        for light in report.shown_lights
        if (where := _source(light)) is not None and np.isfinite(light.position_std_m) and light.position_std_m > 0
    ]


def _source(light: Light) -> Array | None:
    return light.source_C if light.source_C is not None else None if light.H_CL is None else light.H_CL[:3, 3]


def _ellipsoid(centre: Array, covariance: Array) -> LineItem:
    value, vector = np.linalg.eigh(covariance)
    axes = (vector * np.sqrt(np.maximum(value, 0))).T
    return LineItem(kind="ellipsoid", points=centre[None], tone="accent", layer="sigma", axes=axes)


def working_volume(report: RigReport) -> list[LineItem]:
    """What the camera sees from `DEPTHS` of the focus' depth; nothing without a camera or a focus before it."""
    focus, camera = None if report.placed is None else report.placed.focus_C, report.lens
    if camera is None or focus is None or focus[2] <= 0:
        return []
    near, far = (_view(camera, depth * focus[2]) for depth in DEPTHS)
    drawn = [LineItem(kind="line", points=face, closed=True, fill=0.05, tone="board", layer="volume") for face in (near, far)]
    return [*drawn, *(LineItem(kind="line", points=np.stack(side), tone="board", layer="volume") for side in zip(near, far, strict=True))]


def field_plane(report: RigReport) -> FieldPlane | None:
    """The lights' fields over the camera's view at the focus' depth; None without near lights, a camera or a focus before it."""
    focus, camera = None if report.placed is None else report.placed.focus_C, report.lens
    near = [light for light in report.shown_lights if light.source_C is not None][:MOST_FIELDS]
    if camera is None or focus is None or focus[2] <= 0 or not near:
        return None
    corners = _view(camera, focus[2])
    s, t = np.meshgrid((np.arange(FIELD_CELLS) + 0.5) / FIELD_CELLS, (np.arange(FIELD_CELLS) + 0.5) / FIELD_CELLS)
    points = corners[0] + s[..., None] * (corners[1] - corners[0]) + t[..., None] * (corners[3] - corners[0])
    found = {light.name: light.field(points)[1].mean(axis=-1) for light in near}
    total = np.sum(list(found.values()), axis=0)
    shares = {name: value / max(float(value.max()), 1e-30) for name, value in {**found, "all": total}.items()}
    return FieldPlane(corners, shares)


def _view(camera: Camera, depth: float) -> Array:
    """The corners (4, 3) of what a camera sees at a depth, by its K."""
    w, h = camera.image_size
    corners_px = np.array([[0, 0], [w, 0], [w, h], [0, h]], dtype=float)
    return np.column_stack([(corners_px - camera.K[:2, 2]) / [camera.K[0, 0], camera.K[1, 1]], np.ones(4)]) * depth
