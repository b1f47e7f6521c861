"""The camera's and the hand-eye's sections: figures, tables and charts from camera.yaml, H_CB.yaml and handeye.yaml."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import NAMES
from lpcal.report import charts
from lpcal.report.rig_report import RigReport, array, board_points, items, origin_sigmas, sigmas
from lpcal.report.wording import NOTHING, Document, fixed, number, plural, with_sigma

type Section = dict[str, Any]

CELLS = (9, 6)
FEWEST_CORNERS = 8


def camera_section(report: RigReport) -> Section | None:
    """Intrinsics with their sigmas, residuals a view, coverage of the image, the board's shape."""
    document = report.camera
    if not document:
        return None
    views = items(document, "views")
    points_B = board_points(report)
    names = list(document.get("parameters") or [])
    return {
        "rows": _intrinsics(document),
        "parameters": [
            (name, with_sigma(value, sigma))
            for name, value, sigma in zip(names, _values(document, names), sigmas(document.get("covariance"), len(names)), strict=True)
        ],
        "residuals": _view_bars(views, "rms_px", "px", "views in order; amber: left out") if views else None,
        "coverage": _coverage(report, points_B, document),
        **_histogram(report, points_B, document),
        "choice": _choice(document),
        "warp": _warp(points_B),
        "warp_mm": None if points_B is None else fixed(1000 * float(np.ptp(points_B[:, 2])), 2, "mm"),
        "views": plural(len(views), "view"),
        "left_out": _left_out(views),
        "warnings": document.get("warnings") or [],
    }


def handeye_section(report: RigReport) -> Section | None:
    """H_PC as a matrix, a quaternion and millimetres, its sigmas, the views used and why not, the clock."""
    document = report.get("handeye")
    if not document:
        return None
    views = items(document, "views")
    used = [view for view in views if view.get("used")]
    offset, std = document.get("clock_offset_s"), document.get("clock_offset_std_s")
    measures = (("residual_px", "px", 1.0), ("residual_m", "mm", 1000.0), ("residual_deg", "°", 1.0))
    return {
        "transforms": [_transform(name, document) for names in NAMES.values() for name in names if document.get(name)],
        "board_carried": bool(document.get("H_OC")),
        "clock": with_sigma(1000 * offset, None if std is None else 1000 * std, "ms") if offset is not None else None,
        "used": f"{len(used)} of {plural(len(views), 'view')}",
        "evidence": _evidence(document.get("evidence") or {}),
        "rms": [(name, number(_rms(used, key, scale), 3, unit)) for (key, unit, scale), name in zip(measures, _MEASURES, strict=True)],
        "residuals": [
            (name, _view_bars(views, key, unit, "views in order; amber: left out", scale))
            for (key, unit, scale), name in zip(measures, _MEASURES, strict=True)
            if any(isinstance(view.get(key), (int, float)) for view in views)
        ],
        "left_out": _left_out(views),
        "warnings": document.get("warnings") or [],
    }


_MEASURES = ("corners", "the board misses its place", "the board is turned")


def _evidence(evidence: Document) -> list[tuple[str, str]]:
    """What the solve rests on, as far as it is said."""
    spread = evidence.get("rotation_spread_deg") or []
    named = (
        ("the panel turned by, rms about three axes", ", ".join(fixed(angle, 1, "°") for angle in spread)),
        ("mocap noise, rotation", fixed(evidence.get("mocap_sigma_deg"), 3, "°")),
        ("mocap noise, position", fixed(_scale(evidence.get("mocap_sigma_m"), 1000), 2, "mm")),
        ("corner noise", number(evidence.get("corner_sigma_px"), 2, "px")),
        ("moved from the closed form by", fixed(_scale(evidence.get("moved_from_closed_form_m"), 1000), 2, "mm")),
        ("turned from the closed form by", fixed(evidence.get("moved_from_closed_form_deg"), 3, "°")),
    )
    return [(label, value) for label, value in named if value not in {"", NOTHING}]


def _scale(value: Any, factor: float) -> float | None:
    return factor * float(value) if isinstance(value, (int, float)) else None


def _rms(views: list[dict[str, Any]], key: str, scale: float) -> float:
    values = [scale * float(view[key]) for view in views if isinstance(view.get(key), (int, float))]
    return float(np.sqrt(np.mean(np.square(values)))) if values else float("nan")


def _intrinsics(document: Document) -> list[tuple[str, str]]:
    w, h = document.get("image_size") or (0, 0)
    names = list(document.get("parameters") or [])
    sigma = dict(zip(names, sigmas(document.get("covariance"), len(names)), strict=True))
    K = array(document["K"]) if document.get("K") else np.full((3, 3), np.nan)
    field = 2 * np.degrees(np.arctan2(np.array([w, h]) / 2, [K[0, 0], K[1, 1]]))
    rows = [
        ("model", str(document.get("model", "–"))),
        ("image", f"{w} × {h} px, {field[0]:.1f}° × {field[1]:.1f}°"),
        ("focal length x", with_sigma(float(K[0, 0]), sigma.get("fx"), "px")),
        ("focal length y", with_sigma(float(K[1, 1]), sigma.get("fy"), "px")),
        ("principal point x", with_sigma(float(K[0, 2]), sigma.get("cx"), "px")),
        ("principal point y", with_sigma(float(K[1, 2]), sigma.get("cy"), "px")),
    ]
    rows += [("rms a coordinate", number(document["rms_px"], 3, "px"))] if document.get("rms_px") else []
    rows += [("corner noise", number(document["corner_sigma_px"], 3, "px"))] if document.get("corner_sigma_px") else []
    note = (document.get("evidence") or {}).get("solver_note")
    rows += [("solver", f"{document['solver']}{f' ({note})' if note else ''}")] if document.get("solver") else []
    return rows


def _values(document: Document, names: list[str]) -> list[float | None]:
    K = document.get("K") or [[None] * 3] * 3
    known = {"fx": K[0][0], "fy": K[1][1], "cx": K[0][2], "cy": K[1][2]}
    known |= dict(zip(("k1", "k2", "p1", "p2", "k3", "k4", "k5", "k6"), document.get("distortion") or [], strict=False))
    return [known.get(name) for name in names]


def _view_bars(views: list[dict[str, Any]], key: str, unit: str, across: str, scale: float = 1.0) -> str:
    drawn = []
    for view in views:
        value = scale * float(view[key]) if isinstance(view.get(key), (int, float)) else None
        label = f"{view.get('image')}: {number(value, 3, unit)}" + (
            "" if view.get("used") else f" left out, {view.get('why') or 'no reason given'}"
        )
        drawn.append(charts.Bar(value, label, "accent" if view.get("used") else "fair"))
    return charts.bars(drawn, unit=unit, across=across)


def _left_out(views: list[dict[str, Any]]) -> list[tuple[str, str]]:
    return [(str(view.get("image")), str(view.get("why") or "no reason given")) for view in views if not view.get("used")]


def _coverage(report: RigReport, points_B: Array | None, document: Document) -> Section | None:
    """The corners of the views that the intrinsics used, over the image, and the mean of what is left over in each cell."""
    seen = _corners(report, points_B, document)
    if seen is None:
        return None
    pixels, left = seen
    w, h = (int(side) for side in document["image_size"])
    arrows, noise = _cell_means(pixels, left, w, h)
    if not len(arrows):
        return {"svg": charts.over_image(pixels, (w, h)), "note": "where the board's corners fell"}
    longest = float(np.linalg.norm(arrows[:, 2:], axis=1).max())
    factor = _round_down(0.8 * w / CELLS[0] / max(longest, 1e-9))
    note = f"where the board's corners fell; arrows: mean of what is left over in a cell, × {factor:g}"
    note += f"; the longest is {number(longest, 2, 'px')}"
    note += f", noise alone leaves {number(noise, 2, 'px')}" if np.isfinite(noise) else ""
    return {"svg": charts.over_image(pixels, (w, h), arrows * [1, 1, factor, factor]), "note": note}


def _histogram(report: RigReport, points_B: Array | None, document: Document) -> Section:
    """What is left over of every corner's coordinates, against the normal curve of the same rms."""
    seen = _corners(report, points_B, document)
    left = np.zeros(0) if seen is None else seen[1][np.isfinite(seen[1])]
    if left.size < FEWEST_CORNERS:
        return {"histogram": None, "histogram_note": ""}
    sigma = float(np.sqrt(np.mean(left**2)))
    beyond = 100 * float(np.mean(np.abs(left) > 3 * sigma))
    note = f"what is left over of {left.size} coordinates, and the normal curve; {fixed(beyond, 1, '%')} are beyond 3 sigma, 0.3% expected"
    return {"histogram": charts.histogram(left, unit="px", sigma=sigma), "histogram_note": note}


def _corners(report: RigReport, points_B: Array | None, document: Document) -> tuple[Array, Array] | None:
    """Corners (N, 2) of the used views and what is left over (N, 2), seen less expected; a splined lens is not projected here: NaN."""
    if points_B is None or not document.get("K") or not document.get("image_size"):
        return None
    used = {str(view.get("image")) for view in items(document, "views") if view.get("used")}
    found = [
        view for view in items(report.get("H_CB"), "views") if view.get("corners_px") and view.get("H_CB") and view.get("image") in used
    ]
    if not found:
        return None
    pixels = array([view["corners_px"] for view in found])
    points_C = np.stack([se3.apply(array(view["H_CB"]), points_B) for view in found])
    if document.get("model") == "splined":
        expected = np.full_like(pixels, np.nan)
    else:
        expected = central.project(points_C, array(document["K"]), array(document.get("distortion") or [0.0]))
    seen = np.isfinite(pixels).all(axis=-1)
    return pixels[seen], (pixels - expected)[seen]


def _cell_means(pixels: Array, left: Array, w: int, h: int) -> tuple[Array, float]:
    """Arrows (M, 4) at the cells' middles with the mean of what is left over, and the length that noise alone would give them."""
    cell = np.floor(pixels / [w, h] * CELLS).astype(int)
    arrows, counts = [], []
    for i, j in np.ndindex(*CELLS):
        inside = (cell == [i, j]).all(axis=1) & np.isfinite(left).all(axis=1)
        if inside.sum() >= FEWEST_CORNERS:
            arrows.append([(i + 0.5) * w / CELLS[0], (j + 0.5) * h / CELLS[1], *left[inside].mean(axis=0)])
            counts.append(int(inside.sum()))
    noise = float(np.nanstd(left) * np.sqrt(2 / np.median(counts))) if counts else float("nan")
    return np.array(arrows).reshape(-1, 4), noise


def _round_down(value: float) -> float:
    """1, 2 or 5 times a power of ten at or under a value."""
    power = 10 ** np.floor(np.log10(value))
    return float(max(step for step in (1, 2, 5) if step * power <= value * 1.0001) * power)


def _choice(document: Document) -> Section | None:
    """How the lens model was chosen: the difference between the halves of the views, for each model and each board that was tried."""
    evidence = document.get("evidence") or {}
    tried = evidence.get("cross_validation") or []
    boards = list(dict.fromkeys(str(entry.get("board")) for entry in tried))
    found: dict[str, dict[str, float]] = {}
    for entry in tried:
        found.setdefault(str(entry.get("model")), {})[str(entry.get("board"))] = entry.get("cross_validation_px")
    if not found:
        return None
    chosen = evidence.get("chosen") or {}
    taken = (chosen.get("model"), chosen.get("board"))
    return {
        "why": chosen.get("why"),
        "boards": boards,
        "rows": [(model, [(number(values.get(board), 3), (model, board) == taken) for board in boards]) for model, values in found.items()],
    }


def _warp(points_B: Array | None) -> str | None:
    if points_B is None or float(np.ptp(points_B[:, 2])) < 1e-7:
        return None
    return charts.signed_grid(points_B[:, :2], 1000 * points_B[:, 2], unit="mm")


def _transform(name: str, document: Document) -> Section:
    H = array(document[name])
    sigma = origin_sigmas(H, document.get(f"{name}_covariance"))
    return {
        "name": name,
        "matrix": [[fixed(value, 6 if column < 3 else 5) for column, value in enumerate(row)] for row in H],
        "quaternion": ", ".join(fixed(value, 6) for value in se3.quaternion(H[:3, :3])),
        "rotation": [
            with_sigma(value, spread, "°")
            for value, spread in zip(np.degrees(se3.rotation_vector(H[:3, :3])), np.degrees(sigma[:3]), strict=True)
        ],
        "position": [with_sigma(value, spread, "mm") for value, spread in zip(1000 * H[:3, 3], 1000 * sigma[3:], strict=True)],
    }
