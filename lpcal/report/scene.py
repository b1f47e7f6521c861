"""The rig and the room as line drawings in space, for the page's turning view.

Positions are metres in the scene's own frame: C for the rig, O for the room. Of the rig also what fills space: where each light's rays come
from and how sure that is, the working volume, and the lights' field over a plane.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import TABLED
from lpcal.records.calibration import Light, Lobe, Wings
from lpcal.records.camera import Camera
from lpcal.report.rig_report import RigReport, designed
from lpcal.report.scene_items import FIELD_CELLS, FieldPlane, LineItem, LineScene

CONE_M = 0.06
DISTANT_M = (0.05, 0.3)
"""Metres from the focus between which the line of a distant light is drawn: it has a direction only, this is about a rig's size."""
PLAIN_K = np.array([[1.2, 0, 0.5], [0, 1.2, 0.5], [0, 0, 1]])
"""Matrix of a camera that nothing is known of, drawn as one of about 45 degrees; its image is 1 by 1."""
HALF = 0.5
"""Share of the peak to which a lobe falls at its half angle."""
FINELY = 9001
"""Angles from the axis to 90 degrees at which a formula is looked at: hundredths of a degree."""
WIDE_RAD = float(np.radians(60))
"""Half angle of the cone of a lobe that never falls to half."""
BOARDS_SHOWN = 48
MANY = 30


def rig_scene(report: RigReport) -> LineScene | None:
    """The rig in C: camera, lights with axis and cone, where they were designed, panel frame, focus, the board's stations."""
    lights, camera = report.shown_lights, report.lens
    if not lights:
        return None
    focus = report.focus_C
    drawn = _camera(np.eye(4), camera, 0.05, "camera", "camera") if camera is not None else []
    reach = [np.zeros(3)]
    for light in lights:
        drawn += _light(light, focus)
        where = _place(light)
        reach.append(_towards(light, focus)[0] if where is None else where)
    drawn += _designed(report) + _struts(report.wings) + _beam(report, focus)
    H_CD = report.lights.H_CD if report.lights is not None and report.lights.H_CD is not None else None
    H_CD = report.wings.H_CD if H_CD is None and report.wings is not None else H_CD
    if H_CD is not None:
        drawn += _triad(H_CD, 0.055, "D", "frames")
    drawn += _triad(np.eye(4), 0.035, "C", "frames") if camera is not None else []
    if report.handeye is not None and report.handeye.carries == "camera":
        drawn += _triad(se3.inv(report.handeye.H_PC), 0.075, "P", "frames")
    if focus is not None:
        text = f"focus, {1000 * np.linalg.norm(focus):.0f} mm"
        drawn.append(LineItem(kind="point", points=focus[None], tone="focus", r=4, layer="rig"))
        drawn.append(LineItem(kind="label", points=focus[None], text=text, tone="focus", layer="rig"))
        reach.append(focus)
    drawn += [*_boards(report), *sources(report), *ellipsoids(report), *working_volume(report)]
    scene, field = _scene(drawn, np.array(reach), up=np.array([0, -1.0, 0]), yaw=-0.75, pitch=0.35), field_plane(report)
    return replace(scene, field=field)


def _beam(report: RigReport, focus: Array | None) -> list[LineItem]:
    """The distance sensor's beam, as far as the focus' depth."""
    sensor = report.distance.sensor if report.distance is not None else report.calibration.distance_sensor if report.calibration else None
    if sensor is None:
        return []
    depth_m = DISTANT_M[1] if focus is None else float(focus[2])
    end = sensor.position_C + (depth_m - sensor.position_C[2]) / max(float(sensor.direction_C[2]), 0.1) * sensor.direction_C
    return [
        LineItem(kind="line", points=np.stack([sensor.position_C, end]), tone="poor", layer="beam", dash=True),
        LineItem(kind="point", points=sensor.position_C[None], tone="poor", r=3, layer="beam"),
        LineItem(kind="label", points=end[None], text="distance sensor", tone="poor", layer="beam"),
    ]


LAYERS = {
    "beam": "distance sensor",
    "sources": "sources",
    "sigma": "sigma of place",
    "volume": "working volume",
    "axes": "axes",
    "wings": "wings",
    "designed": "as designed",
    "frames": "frames",
    "boards": "board views",
}
"""What of the rig can be shown or hidden, and its name on the page."""


def layers_of(scene: LineScene | None) -> list[tuple[str, str, bool]]:
    """Layers that the scene has, their names, and whether they show at first."""
    found = {item.layer for item in scene.items} if scene is not None else set()
    return [(layer, name, layer not in {"boards", "volume"}) for layer, name in LAYERS.items() if layer in found]


def rig_caption(report: RigReport) -> str:
    """From where the rig is seen, and what of it is drawn to scale."""
    placed = any(_place(light) is not None for light in report.shown_lights)
    camera = report.lens is not None
    view = "seen from behind the camera" if camera else "directions to the lights, x right and y down as in the images"
    return f"{view}, at true scale" if placed else f"{view}, lights drawn where they come from, not how far" if camera else view


def room_scene(report: RigReport) -> LineScene | None:
    """The room in O: the board, and the camera wherever a view was taken."""
    handeye, found = report.handeye, report.body_poses
    if handeye is None or handeye.carries == "board" or not found:
        return None
    used = {view.image: view.used for view in handeye.views}
    H_OC = {image: H_OP @ handeye.H_PC for image, H_OP in found.items() if image in used}
    drawn: list[LineItem] = []
    for image, pose in H_OC.items():
        drawn += _camera(pose, report.lens, 0.05, "accent" if used[image] else "fair", "used" if used[image] else "left out")
    reach = [pose[:3, 3] for image, pose in H_OC.items() if used[image]]
    if report.boards is not None and report.boards.points_B is not None:
        outline = se3.apply(handeye.H_OB, _outline(report.boards.points_B))
        drawn.append(LineItem(kind="line", points=outline, tone="board", closed=True, fill=0.25, layer="board"))
        reach += list(outline)
    if not reach:
        return None
    drawn += _triad(handeye.H_OB, 0.08, "B", "board")
    reach.append(handeye.H_OB[:3, 3])
    up = -np.mean([pose[:3, 1] for pose in H_OC.values()], axis=0) if H_OC else np.array([0, 0, 1.0])
    return _scene(drawn, np.array(reach), up=up / max(float(np.linalg.norm(up)), 1e-9), yaw=0.6, pitch=0.4)


def _scene(drawn: Sequence[LineItem], reach: Array, *, up: Array, yaw: float, pitch: float) -> LineScene:
    centre = (reach.min(axis=0) + reach.max(axis=0)) / 2 if len(reach) < MANY else np.median(reach, axis=0)
    away = np.linalg.norm(reach - centre, axis=1)
    radius = float(away.max()) if len(reach) < MANY else 1.2 * float(np.percentile(away, 90))
    return LineScene(tuple(drawn), centre, radius or 0.1, up, yaw, pitch)


def _camera(H_AC: Array, camera: Camera | None, length: float, tone: str, layer: str) -> list[LineItem]:
    """The frustum of a camera, from its image size and K where they are known."""
    K = PLAIN_K if camera is None else camera.K
    w, h = (1, 1) if camera is None else camera.image_size
    corners_px = np.array([[0, 0], [w, 0], [w, h], [0, h]], dtype=float)
    rays = np.column_stack([(corners_px - K[:2, 2]) / [K[0, 0], K[1, 1]], np.ones(4)]) * length
    far = se3.apply(H_AC, rays)
    eye, thin = H_AC[:3, 3], tone != "camera"
    sides = [LineItem(kind="line", points=np.stack([eye, corner]), tone=tone, thin=thin, layer=layer) for corner in far]
    return [*sides, LineItem(kind="line", points=far, closed=True, fill=0.12, tone=tone, thin=thin, layer=layer)]


def _place(light: Light) -> Array | None:
    return light.H_CL[:3, 3] if light.H_CL is not None else light.source_C


def _towards(light: Light, focus: Array | None) -> Array:
    """The line (2, 3) of a distant light, its far end first: towards the focus, or the origin."""
    centre = focus if focus is not None else np.zeros(3)
    return np.stack([centre + DISTANT_M[1] * light.direction_C, centre + DISTANT_M[0] * light.direction_C])


def _light(light: Light, focus: Array | None) -> list[LineItem]:
    where = _place(light)
    if where is None:
        line = _towards(light, focus)
        return [
            LineItem(kind="line", points=line, tone="light", layer="rig"),
            LineItem(kind="label", points=line[:1], text=light.name, tone="light", layer="rig"),
        ]
    drawn = [
        LineItem(kind="point", points=where[None], tone="light", r=5, layer="rig"),
        LineItem(kind="label", points=where[None], text=light.name, tone="light", layer="rig"),
    ]
    axis = light.axis_C if light.axis_C is not None else light.H_CL[:3, 2] if light.H_CL is not None else None
    if axis is None:
        return drawn
    side = np.cross(axis, [0, 0, 1.0] if abs(axis[2]) < 0.9 else [1.0, 0, 0])
    side /= np.linalg.norm(side)
    t = np.linspace(0, 2 * np.pi, 28, endpoint=False)[:, None]
    spread = CONE_M * np.tan(min(half_angle(light.lobe), 1.2))
    ring = where + CONE_M * axis + spread * (np.cos(t) * side + np.sin(t) * np.cross(axis, side))
    drawn.append(LineItem(kind="line", points=ring, closed=True, fill=0.1, tone="light", layer="rig"))
    drawn += [LineItem(kind="line", points=np.stack([where, ring[k]]), tone="light", thin=True, layer="rig") for k in (0, 7, 14, 21)]
    far = float(np.linalg.norm(focus - where)) if focus is not None else 4 * CONE_M
    drawn.append(LineItem(kind="line", points=np.stack([where, where + far * axis]), tone="light", dash=True, thin=True, layer="axes"))
    return drawn


def half_angle(lobe: Lobe) -> float:
    """Angle from the axis (rad) at which a lobe falls to half; 60 degrees where it never does."""
    if lobe.kind in TABLED:
        below = np.flatnonzero(lobe.value < HALF)
        return float(lobe.angle_rad[below[0]]) if below.size else WIDE_RAD
    angle = np.linspace(0, np.pi / 2, FINELY)
    below = np.flatnonzero(lobe(angle) < HALF)
    return float(angle[below[0]]) if below.size else WIDE_RAD


def _designed(report: RigReport) -> list[LineItem]:
    """Where the drawing put each light, and the arrow from there to where it is."""
    if report.placed is None or report.wings is None:
        return []
    before = {light.name: light for light in designed(report.wings)}
    drawn: list[LineItem] = []
    for light in report.placed.lights:
        start, end = _place(before[light.name]) if light.name in before else None, _place(light)
        if start is None or end is None:
            continue
        drawn.append(LineItem(kind="point", points=start[None], tone="designed", r=5, hollow=True, layer="designed"))
        drawn.append(LineItem(kind="arrow", points=start[None], by=end - start, tone="designed", layer="designed"))
    return drawn


def _triad(H_AB: Array, length: float, name: str, layer: str) -> list[LineItem]:
    origin = H_AB[:3, 3]
    tips = [origin + length * H_AB[:3, k] for k in range(3)]
    drawn = [
        LineItem(kind="line", points=np.stack([origin, tip]), tone=tone, layer=layer, bold=True)
        for tip, tone in zip(tips, "xyz", strict=True)
    ]
    label = origin + 1.1 * length * H_AB[:3, 1]
    return [*drawn, LineItem(kind="label", points=label[None], text=name, tone="ink", layer=layer)]


def _struts(wings: Wings | None) -> list[LineItem]:
    """Each wing as designed, from the disc's centre over its joint to its blob."""
    if wings is None:
        return []
    drawn: list[LineItem] = []
    for wing, H_CL in zip(wings.wings, wings.H_CL, strict=True):
        joint_D = wing.d1_m * np.array([[np.cos(wing.azimuth_rad), np.sin(wing.azimuth_rad), 0]])
        joint_C = se3.apply(wings.H_CD, joint_D)
        drawn.append(LineItem(kind="line", points=np.stack([wings.H_CD[:3, 3], joint_C[0], H_CL[:3, 3]]), tone="board", layer="wings"))
        drawn.append(LineItem(kind="point", points=joint_C, tone="board", r=2.2, layer="wings"))
    return drawn


def _outline(points_B: Array) -> Array:
    """The board's outer corners (4, 3) of its inner ones (M, 3), one square outside them."""
    low, high = points_B[:, :2].min(axis=0), points_B[:, :2].max(axis=0)
    steps = np.diff(np.unique(np.round(points_B[:, 0], 5)))
    low, high = low - (square := float(steps.max(initial=0))), high + square
    return np.array([[low[0], low[1], 0], [high[0], low[1], 0], [high[0], high[1], 0], [low[0], high[1], 0]])


def _boards(report: RigReport) -> list[LineItem]:
    boards = report.boards
    if boards is None or boards.points_B is None or not len(boards.H_CB):
        return []
    solved = set() if report.camera is None else {view.image for view in report.camera.views if view.used}
    chosen = [pose for image, pose in zip(boards.images, boards.H_CB, strict=True) if not solved or image in solved]
    chosen = chosen[:: max(1, len(chosen) // BOARDS_SHOWN)]
    outline = _outline(boards.points_B)
    return [LineItem(kind="line", points=se3.apply(H_CB, outline), closed=True, tone="board", thin=True, layer="boards") for H_CB in chosen]


APART_M = 1e-4
"""A source nearer than this to its light's mechanical centre is not drawn: a tenth of a millimetre is less than a pixel."""
DEPTHS = (0.8, 1.2)
"""Shares of the focus' depth between which the camera's view is drawn as the working volume: the lights' axes meet within it."""
MOST_FIELDS = 24
"""Lights whose fields can be chosen: a longer list is too long to read."""


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
    focus, camera = report.focus_C, report.lens
    if camera is None or focus is None or focus[2] <= 0:
        return []
    near, far = (_view(camera, depth * focus[2]) for depth in DEPTHS)
    drawn = [LineItem(kind="line", points=face, closed=True, fill=0.05, tone="board", layer="volume") for face in (near, far)]
    return [*drawn, *(LineItem(kind="line", points=np.stack(side), tone="board", layer="volume") for side in zip(near, far, strict=True))]


def field_plane(report: RigReport) -> FieldPlane | None:
    """The lights' fields over the camera's view at the focus' depth; None without near lights, a camera or a focus before it."""
    focus, camera = report.focus_C, report.lens
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
