"""The rig and the room as line drawings in space, for the page's turning view.

A scene is plain data: polylines, points and labels with a tone and a layer. Positions are metres in the scene's own frame: C for the rig,
O for the room. An item with ``from`` and ``by`` is an arrow whose length the page may exaggerate: ``from + k by``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.report.rig_report import RigReport, array, board_points, items, poses

type Scene = dict[str, Any]
type Item = dict[str, Any]

CONE_M = 0.06
DISTANT_M = (0.05, 0.3)
"""Metres from the focus between which the line of a distant light is drawn: it has a direction only, this is about a rig's size."""
BOARDS_SHOWN = 48
MANY = 30


def rig_scene(report: RigReport) -> Scene | None:
    """The rig in C: camera, lights with axis and cone, where they were designed, panel frame, focus, the board's stations."""
    document = report.lights or report.get("wings")
    lights = items(document, "lights")
    camera = report.camera
    if not lights:
        return None
    focus = array(document["focus_m"]) if document.get("focus_m") else None
    drawn: list[Item] = _camera(np.eye(4), camera, 0.05, "camera", "camera") if camera else []
    reach = [np.zeros(3)]
    for light in lights:
        drawn += _light(light, focus)
        where = _place(light)
        reach.append(_towards(light, focus)[0] if where is None else where)
    drawn += _designed(report, lights) + _struts(report)
    H_CD = document.get("H_CD") or report.get("wings").get("H_CD")
    if H_CD:
        drawn += _triad(array(H_CD), 0.055, "D", "frames")
    drawn += _triad(np.eye(4), 0.035, "C", "frames") if camera else []
    H_PC = report.get("handeye").get("H_PC")
    if H_PC:
        drawn += _triad(se3.inv(array(H_PC)), 0.075, "P", "frames")
    if focus is not None:
        drawn.append({"kind": "point", "p": [focus], "tone": "focus", "r": 4, "layer": "rig"})
        drawn.append(
            {"kind": "label", "p": [focus], "text": f"focus, {1000 * np.linalg.norm(focus):.0f} mm", "tone": "focus", "layer": "rig"}
        )
        reach.append(focus)
    drawn += _boards(report)
    return _scene(drawn, np.array(reach), up=[0, -1, 0], yaw=-0.75, pitch=0.35)


LAYERS = {"axes": "axes", "wings": "wings", "designed": "as designed", "frames": "frames", "boards": "board views"}
"""What of the rig can be shown or hidden, and its name on the page."""


def layers_of(scene: Scene | None) -> list[tuple[str, str, bool]]:
    """Layers that the scene has, their names, and whether they show at first."""
    found = {item["layer"] for item in (scene or {"items": []})["items"]}
    return [(layer, name, layer != "boards") for layer, name in LAYERS.items() if layer in found]


def rig_caption(report: RigReport) -> str:
    """From where the rig is seen, and what of it is drawn to scale."""
    placed = any(_place(light) is not None for light in items(report.lights or report.get("wings"), "lights"))
    view = "seen from behind the camera" if report.camera else "directions to the lights, x right and y down as in the images"
    return f"{view}, at true scale" if placed else view if not report.camera else f"{view}, lights drawn where they come from, not how far"


def room_scene(report: RigReport) -> Scene | None:
    """The room in O: the board, and the camera wherever a view was taken."""
    document = report.get("handeye")
    found = poses(report.get("H_OP"), "H_OP")
    if not document.get("H_PC") or not found:
        return None
    H_PC = array(document["H_PC"])
    verdict = {str(view.get("image")): view for view in items(document, "views")}
    drawn: list[Item] = []
    H_OC = {image: H_OP @ H_PC for image, H_OP in found.items() if image in verdict}
    for image, pose in H_OC.items():
        used = bool(verdict[image].get("used"))
        drawn += _camera(pose, report.get("camera"), 0.05, "accent" if used else "fair", "used" if used else "left out")
    reach = [pose[:3, 3] for image, pose in H_OC.items() if verdict[image].get("used")]
    points_B, H_OB = board_points(report), document.get("H_OB")
    if points_B is not None and H_OB:
        outline = se3.apply(array(H_OB), _outline(points_B))
        drawn.append({"kind": "line", "p": outline, "tone": "board", "closed": True, "fill": 0.25, "layer": "board"})
        drawn += _triad(array(H_OB), 0.08, "B", "board")
        reach += list(outline)
    if not reach:
        return None
    up = -np.mean([pose[:3, 1] for pose in H_OC.values()], axis=0) if H_OC else np.array([0, 0, 1.0])
    return _scene(drawn, np.array(reach), up=up / max(float(np.linalg.norm(up)), 1e-9), yaw=0.6, pitch=0.4)


def _scene(drawn: list[Item], reach: Array, *, up: Any, yaw: float, pitch: float) -> Scene:
    centre = (reach.min(axis=0) + reach.max(axis=0)) / 2 if len(reach) < MANY else np.median(reach, axis=0)
    away = np.linalg.norm(reach - centre, axis=1)
    radius = float(away.max()) if len(reach) < MANY else 1.2 * float(np.percentile(away, 90))
    for item in drawn:
        for key in ("p", "from", "by"):
            if key in item:
                item[key] = np.round(np.asarray(item[key], dtype=float), 5).tolist()
    return {
        "items": drawn,
        "centre": np.round(centre, 5).tolist(),
        "radius": round(radius or 0.1, 5),
        "up": np.round(np.asarray(up, dtype=float), 5).tolist(),
        "yaw": yaw,
        "pitch": pitch,
    }


def _camera(H_AC: Array, camera: Any, length: float, tone: str, layer: str) -> list[Item]:
    """The frustum of a camera, from its image size and K where they are known."""
    K = array(camera["K"]) if camera.get("K") else np.array([[1.2, 0, 0.5], [0, 1.2, 0.5], [0, 0, 1]])
    w, h = camera.get("image_size") or (1, 1)
    corners_px = np.array([[0, 0], [w, 0], [w, h], [0, h]], dtype=float)
    rays = np.column_stack([(corners_px - K[:2, 2]) / [K[0, 0], K[1, 1]], np.ones(4)]) * length
    far = se3.apply(H_AC, rays)
    eye = H_AC[:3, 3]
    thin = tone != "camera"
    sides: list[Item] = [{"kind": "line", "p": [eye, corner], "tone": tone, "thin": thin, "layer": layer} for corner in far]
    return [*sides, {"kind": "line", "p": far, "closed": True, "fill": 0.12, "tone": tone, "thin": thin, "layer": layer}]


def _place(light: dict[str, Any]) -> Array | None:
    if light.get("H_CL"):
        return array(light["H_CL"])[:3, 3]
    return array(light["source_m"]) if light.get("source_m") else None


def _towards(light: dict[str, Any], focus: Array | None) -> list[Array]:
    """The line of a distant light, its far end first: towards the focus, or the origin."""
    direction = array(light["direction"])
    centre = focus if focus is not None else np.zeros(3)
    return [centre + DISTANT_M[1] * direction, centre + DISTANT_M[0] * direction]


def _light(light: dict[str, Any], focus: Array | None) -> list[Item]:
    where = _place(light)
    if where is None:
        line = _towards(light, focus)
        return [
            {"kind": "line", "p": line, "tone": "light", "layer": "rig"},
            {"kind": "label", "p": [line[0]], "text": light["name"], "tone": "light", "layer": "rig"},
        ]
    drawn: list[Item] = [
        {"kind": "point", "p": [where], "tone": "light", "r": 5, "layer": "rig"},
        {"kind": "label", "p": [where], "text": light["name"], "tone": "light", "layer": "rig"},
    ]
    axis = array(light["axis"]) if light.get("axis") else array(light["H_CL"])[:3, 2] if light.get("H_CL") else None
    if axis is None:
        return drawn
    side = np.cross(axis, [0, 0, 1.0] if abs(axis[2]) < 0.9 else [1.0, 0, 0])
    side /= np.linalg.norm(side)
    t = np.linspace(0, 2 * np.pi, 28, endpoint=False)[:, None]
    spread = CONE_M * np.tan(min(half_angle(light.get("lobe") or {}), 1.2))
    ring = where + CONE_M * axis + spread * (np.cos(t) * side + np.sin(t) * np.cross(axis, side))
    drawn.append({"kind": "line", "p": ring, "closed": True, "fill": 0.1, "tone": "light", "layer": "rig"})
    drawn += [{"kind": "line", "p": [where, ring[k]], "tone": "light", "thin": True, "layer": "rig"} for k in (0, 7, 14, 21)]
    far = np.linalg.norm(focus - where) if focus is not None else 4 * CONE_M
    drawn.append({"kind": "line", "p": [where, where + far * axis], "tone": "light", "dash": True, "thin": True, "layer": "axes"})
    return drawn


def half_angle(lobe: dict[str, Any]) -> float:
    """Angle from the axis (rad) at which a lobe falls to half; 60 degrees where it never does."""
    if lobe.get("kind") == "cosine" and float(lobe.get("exponent") or 0) > 0:
        return float(np.arccos(0.5 ** (1 / float(lobe["exponent"]))))
    if lobe.get("kind") == "table":
        degrees = lobe.get("angle_deg")
        angle = np.radians(array(degrees)) if degrees is not None else array(lobe.get("angle_rad") or [])
        below = np.flatnonzero(array(lobe.get("value") or []) < 0.5)
        if below.size and angle.size > below[0]:
            return float(angle[below[0]])
    return float(np.radians(60))


def _designed(report: RigReport, lights: list[dict[str, Any]]) -> list[Item]:
    """Where the drawing put each light, and the arrow from there to where it is."""
    if not report.get("lights") and not report.get("calibration"):
        return []
    before = {entry.get("name"): entry for entry in items(report.get("wings"), "lights")}
    drawn: list[Item] = []
    for light in lights:
        start, end = _place(before.get(light.get("name"), {})), _place(light)
        if start is None or end is None:
            continue
        drawn.append({"kind": "point", "p": [start], "tone": "designed", "r": 5, "hollow": True, "layer": "designed"})
        drawn.append({"kind": "arrow", "from": start, "by": end - start, "tone": "designed", "layer": "designed"})
    return drawn


def _triad(H_AB: Array, length: float, name: str, layer: str) -> list[Item]:
    origin = H_AB[:3, 3]
    drawn: list[Item] = [
        {"kind": "line", "p": [origin, origin + length * H_AB[:3, k]], "tone": "xyz"[k], "layer": layer, "bold": True} for k in range(3)
    ]
    tip = origin + 1.1 * length * H_AB[:3, 1]
    return [*drawn, {"kind": "label", "p": [tip], "text": name, "tone": "ink", "layer": layer}]


def _struts(report: RigReport) -> list[Item]:
    """Each wing as designed, from the disc's centre over its joint to its blob."""
    wings = report.get("wings")
    if not wings.get("H_CD"):
        return []
    H_CD = array(wings["H_CD"])
    drawn: list[Item] = []
    for light in items(wings, "lights"):
        setting, end = light.get("setting") or {}, _place(light)
        if end is None or setting.get("d1_m") is None or setting.get("azimuth_deg") is None:
            continue
        azimuth = np.radians(float(setting["azimuth_deg"]))
        joint = se3.apply(H_CD, float(setting["d1_m"]) * np.array([[np.cos(azimuth), np.sin(azimuth), 0]]))[0]
        drawn.append({"kind": "line", "p": [H_CD[:3, 3], joint, end], "tone": "board", "layer": "wings"})
        drawn.append({"kind": "point", "p": [joint], "tone": "board", "r": 2.2, "layer": "wings"})
    return drawn


def _outline(points_B: Array) -> Array:
    """The board's outer corners (4, 3) of its inner ones (M, 3), one square outside them."""
    low, high = points_B[:, :2].min(axis=0), points_B[:, :2].max(axis=0)
    steps = np.diff(np.unique(np.round(points_B[:, 0], 5)))
    low, high = low - (square := float(steps.max(initial=0))), high + square
    return np.array([[low[0], low[1], 0], [high[0], low[1], 0], [high[0], high[1], 0], [low[0], high[1], 0]])


def _boards(report: RigReport) -> list[Item]:
    points_B, found = board_points(report), poses(report.get("H_CB"), "H_CB")
    if points_B is None or not found:
        return []
    solved = {str(view.get("image")) for view in items(report.get("camera"), "views") if view.get("used")}
    chosen = [pose for image, pose in found.items() if not solved or image in solved]
    chosen = chosen[:: max(1, len(chosen) // BOARDS_SHOWN)]
    outline = _outline(points_B)
    return [
        {"kind": "line", "p": se3.apply(H_CB, outline), "closed": True, "tone": "board", "thin": True, "layer": "boards"} for H_CB in chosen
    ]
