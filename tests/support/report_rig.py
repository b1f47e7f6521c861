"""A small rig as its stages write it, for the tests of the report."""

from __future__ import annotations

from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.formats.calibration_yaml import calibration_from_document
from lpcal.formats.camera_yaml import solution_from_document
from lpcal.formats.h_cb_yaml import h_cb_from_document
from lpcal.formats.h_op_yaml import h_op_from_document
from lpcal.formats.handeye_yaml import handeye_from_document
from lpcal.formats.lights_yaml import lights_from_document
from lpcal.formats.surface_files import summary_from_document
from lpcal.formats.wings_yaml import wings_from_document
from lpcal.geometry import camera as central
from lpcal.geometry import se3
from lpcal.records.pictures import png
from lpcal.records.provenance import Provenance
from lpcal.report.rig_report import RigReport, SurfaceReport

K = np.array([[700.0, 0, 320], [0, 701.0, 240], [0, 0, 1]])
DISTORTION = np.array([-0.2, 0.05, 1e-3, -1e-3])
VOID = {"area", "base", "br", "col", "embed", "hr", "img", "input", "link", "meta", "source", "track", "wbr"}


class Reader(HTMLParser):
    """Whether the tags nest, what is referred to, and the words that a reader sees."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.references: list[str] = []
        self.words: list[str] = []
        self.ids: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        for key, value in attrs:
            if key in {"src", "href", "srcset", "data", "action", "poster"} and value is not None:
                self.references.append(value)
            if key == "id" and value is not None:
                self.ids.add(value)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if not self.open or self.open[-1] not in {"script", "style"}:
            self.words.append(data)


def read(page: str) -> Reader:
    reader = Reader()
    reader.feed(page)
    reader.close()
    assert reader.open == []
    return reader


def text_of(page: str) -> str:
    return " ".join(" ".join(read(page).words).split())


def provenance() -> dict[str, Any]:
    return {
        "inputs": {"stations/a.png": "ab" * 32},
        "options": {"model": "auto"},
        "lpcal_version": "0.1.0",
        "time": "2026-01-02T03:04:05+00:00",
    }


def documents(seed: int = 0) -> dict[str, Any]:
    """What the stages write for a small rig, after the contract."""
    rng = np.random.default_rng(seed)
    x, y = np.meshgrid(np.arange(5) * 0.03, np.arange(4) * 0.03)
    points_B = np.column_stack([x.ravel(), y.ravel(), 1e-3 * (x.ravel() - 0.06) ** 2 / 0.06**2])
    H_PC, H_OB = se3.exp(np.array([0.1, 0.2, -0.1, 0.01, 0.02, 0.03])), se3.exp(np.array([0, 0.3, 0, 0.4, 1.0, -0.5]))
    H_CB = [se3.exp(np.concatenate([rng.normal(0, 0.3, 3), rng.normal([-0.06, -0.05, 0.5], 0.02)])) for _ in range(6)]
    views, boards, stations = [], [], []
    for k, pose in enumerate(H_CB):
        pixels = central.project(se3.apply(pose, points_B), K, DISTORTION) + rng.normal(0, 0.1, (20, 2))
        lost = k == 5
        why = "no board found" if lost else None
        views.append(
            {"image": f"stations/{k}.png", "used": not lost, "why": why, "corners": 0 if lost else 20, "rms_px": None if lost else 0.1}
        )
        found = {"H_CB": pose, "corners_px": pixels, "covariance": np.eye(6) * 1e-8, "rms_px": 0.1}
        found = dict.fromkeys(found) if lost else found
        boards.append({"image": f"stations/{k}.png", "used": not lost, "why": why, **found})
        H_OP = H_OB @ se3.inv(pose) @ se3.inv(H_PC)
        stations.append({"image": f"stations/{k}.png", "t_camera_s": None, "used": True, "why": None, "steady": True, "H_OP": H_OP})
    lights = [light(k) for k in range(3)]
    drawn = [
        {"name": entry["name"], "H_CL": moved(entry["H_CL"], 0.002), "H_DL": entry["H_CL"], "leds": None, "setting": setting(k)}
        for k, entry in enumerate(lights)
    ]
    std = {"azimuth_deg": 0.5, "joint_angle_deg": 1.0, "d1_m": 5e-4, "d2_m": 5e-4}
    covariance = np.diag([1e-3, 1e-3, 1e-3, 1e-4, 1e-4, 1e-4]) ** 2
    body: dict[str, dict[str, Any]] = {
        "camera": {
            "image_size": [640, 480],
            "model": "opencv4",
            "K": K,
            "distortion": DISTORTION,
            "rms_px": 0.1,
            "parameters": ["fx", "fy", "cx", "cy", "k1", "k2", "p1", "p2"],
            "covariance": np.diag([0.3, 0.3, 0.2, 0.2, 1e-3, 1e-3, 1e-4, 1e-4]) ** 2,
            "views": views,
        },
        "H_CB": {"board": {"corners": [5, 4], "points_m": points_B}, "corner_sigma_px": 0.1, "views": boards},
        "H_OP": {"body": "panel", "clock_offset_s": 0.0321, "views": stations},
        "handeye": {
            "H_PC": H_PC,
            "H_PC_covariance": covariance,
            "H_OB": H_OB,
            "H_OB_covariance": covariance,
            "clock_offset_s": 0.0321,
            "clock_offset_std_s": 2e-4,
            "views": [view | {"residual_px": view["rms_px"], "residual_m": 2e-4, "residual_deg": 0.05} for view in views],
        },
        "wings": {
            "lights": drawn,
            "H_CD": np.eye(4),
            "H_CD_covariance": covariance,
            "H_CD_from": "the drawing",
            "setting_std": std,
            "covariance": 1e-6 * np.eye(18),
            "d_object_m": 0.35,
        },
        "lights": {"focus_m": [0, 0, 0.35], "d_object_m": 0.35, "H_CD": np.eye(4), "lights": lights, "spheres": [chrome(lights)]},
        "calibration": {"name": "small", "camera": None, "lights": lights, "focus_m": [0, 0, 0.35], "d_object_m": 0.35},
    }
    return {kind: plain({"lpcal": 1, "kind": kind, **entry, "provenance": provenance()}) for kind, entry in body.items()}


def plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    return [plain(entry) for entry in value] if isinstance(value, list) else value


def setting(k: int) -> dict[str, float]:
    return {"azimuth_deg": 120.0 * k, "joint_angle_deg": 30.0, "d1_m": 0.1, "d2_m": 0.09}


def light(k: int) -> dict[str, Any]:
    azimuth = 2 * np.pi * k / 3
    place = np.array([0.18 * np.cos(azimuth), 0.18 * np.sin(azimuth), 0.04])
    axis = np.array([0, 0, 0.35]) - place
    axis /= np.linalg.norm(axis)
    side = np.cross([0, 1, 0], axis) / np.linalg.norm(np.cross([0, 1, 0], axis))
    H_CL = np.eye(4)
    H_CL[:3] = np.column_stack([side, np.cross(axis, side), axis, place])
    return {
        "name": f"L{k}",
        "H_CL": H_CL,
        "source_m": place - 0.02 * axis,
        "axis": axis,
        "direction": -axis,
        "intensity": 1.0 + 0.1 * k,
        "lobe": {"kind": "cosine", "exponent": 4.0},
        "position_std_m": 8e-4,
        "direction_std_deg": 0.08,
        "intensity_std": 0.01,
    }


def moved(H: Any, by: float) -> Any:
    found = np.array(H, dtype=float)
    found[0, 3] += by
    return found


def chrome(lights: list[dict[str, Any]]) -> dict[str, Any]:
    """A chrome sphere and the exact directions of the mirrored rays: from a point of the sphere to where the ray goes."""
    centre, radius = np.array([0.01, -0.02, 0.34]), 0.025
    found = {"name": "chrome_0", "kind": "chrome", "centre_m": centre, "radius_m": radius, "used": True, "why": None, "residual": 0.02}
    directions = {}
    for entry in lights:
        source = np.array(entry["source_m"])
        axis = (source - centre) / np.linalg.norm(source - centre) - centre / np.linalg.norm(centre)
        normal = axis / np.linalg.norm(axis)
        for _ in range(60):  # the normal at which view and light make the same angle
            point = centre + radius * normal
            to_light, to_eye = source - point, -point
            half = to_light / np.linalg.norm(to_light) + to_eye / np.linalg.norm(to_eye)
            normal = half / np.linalg.norm(half)
        directions[entry["name"]] = to_light / np.linalg.norm(to_light)
    return found | {"directions": directions}


def surface(scale_std: float = 0.005, units: str = "metres") -> SurfaceReport:
    pixels = np.full((4, 5, 4), 200, np.uint8)
    summary = {
        "units": units,
        "components": [{"label": 1, "pixels": 1234, "mean_depth_m": 0.35, "scale_std": scale_std}],
        "counts_and_residuals": {"pixels": 1234, "residual_sigmas_rms": 1.23},
        "times_s": {"solving": 4.5},
        "notes": ["left out: ref.jpg"],
    }
    return SurfaceReport("bust", summary_from_document(summary), {"shape": png(pixels)}, "../surfaces/bust/relight.html")


def report_of(whole: dict[str, Any], *surfaces: SurfaceReport, name: str = "r") -> RigReport:
    """The report of what documents hold."""

    def read(kind: str, from_document: Any) -> Any:
        return from_document(whole[kind]) if kind in whole else None

    poses = read("H_OP", h_op_from_document)
    return RigReport(
        name,
        camera=read("camera", solution_from_document),
        boards=read("H_CB", h_cb_from_document),
        body_poses=None if poses is None else poses.by_image(),
        course=None if poses is None else poses.course,
        image_times_s={} if poses is None else poses.times_by_image(),
        handeye=read("handeye", handeye_from_document),
        wings=read("wings", wings_from_document),
        lights=read("lights", lights_from_document),
        calibration=read("calibration", lambda document: calibration_from_document(document, Path("calibration.yaml"))),
        provenance={kind: Provenance(**document.get("provenance", provenance())) for kind, document in whole.items()},
        surfaces=surfaces,
    )
