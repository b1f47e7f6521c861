"""The camera's and the hand-eye's sections: figures, tables and charts from camera.yaml, H_CB.yaml and handeye.yaml."""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.report import charts
from lpcal.report.rig_report import RigReport, array, board_points, items, origin_sigmas, poses, sigmas
from lpcal.report.wording import Document, fixed, number, plural, with_sigma

type Section = dict[str, Any]


def camera_section(report: RigReport) -> Section | None:
    """Intrinsics with their sigmas, residuals a view, coverage of the image, the board's shape."""
    document = report.get("camera")
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
        "transforms": [_transform(name, document) for name in ("H_PC", "H_OB") if document.get(name)],
        "clock": with_sigma(1000 * offset, None if std is None else 1000 * std, "ms") if offset is not None else None,
        "used": f"{len(used)} of {plural(len(views), 'view')}",
        "rms": [
            (name, f"{number(_rms(used, key, scale), 3)} {unit}") for (key, unit, scale), name in zip(measures, _MEASURES, strict=True)
        ],
        "residuals": [
            (name, _view_bars(views, key, unit, "views in order; amber: left out", scale))
            for (key, unit, scale), name in zip(measures, _MEASURES, strict=True)
            if any(isinstance(view.get(key), (int, float)) for view in views)
        ],
        "left_out": _left_out(views),
        "warnings": document.get("warnings") or [],
    }


_MEASURES = ("corners", "panel position", "panel rotation")


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
    rows += [("solver", str(document["solver"]))] if document.get("solver") else []
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


def _coverage(report: RigReport, points_B: Any, document: Document) -> str | None:
    """The board's corners in the image, by the solved camera: the views that the intrinsics used."""
    found = poses(report.get("H_CB"), "H_CB")
    if points_B is None or not found or not document.get("K") or not document.get("image_size"):
        return None
    used = {str(view.get("image")) for view in items(document, "views") if view.get("used")}
    chosen = [pose for image, pose in found.items() if not used or image in used]
    if not chosen:
        return None
    points_C = np.concatenate([se3.apply(H_CB, points_B) for H_CB in chosen])
    pixels = central.project(points_C[points_C[:, 2] > 0], array(document["K"]), array(document.get("distortion") or [0.0]))
    w, h = document["image_size"]
    return charts.over_image(pixels, (int(w), int(h)))


def _warp(points_B: Any) -> str | None:
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
