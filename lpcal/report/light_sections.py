"""The lights' and the spheres' sections: a table, how far each light lies from its drawing, what each sphere says by itself.

A chrome sphere of centre C and radius R shows light L at its surface point P: ``n = (l + v) / |l + v|``, ``P = C + R n``, l the unit vector
from P to the light, v from P to the camera. So a sphere's own direction l is compared with ``(L - P) / |L - P|``.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.report import charts
from lpcal.report.rig_report import RigReport, array, items
from lpcal.report.wording import NOTHING, fixed, number, plural, sigma_of

type Section = dict[str, Any]


def lights_section(report: RigReport) -> Section | None:
    """One row a light: position, direction, their sigmas, intensity, and the way from the drawing."""
    document, measured = report.lights, report.intensities_measured
    lights = items(document, "lights")
    if not lights:
        return None
    before = {entry.get("name"): entry for entry in items(report.get("wings"), "lights")}
    focus = document.get("focus_m")
    return {
        "rows": [_row(light, before.get(light.get("name"), {}), measured=measured) for light in lights],
        "moved": any(light.get("name") in before for light in lights),
        "measured": measured,
        "direction_from": "from the focus" if focus else "to the light",
        "focus": None if not focus else ", ".join(fixed(1000 * value, 2) for value in focus),
        "d_object": fixed(1000 * document["d_object_m"], 1, "mm") if document.get("d_object_m") else None,
        "intensities": charts.bars(_intensities(lights), unit="relative", across="lights in order") if measured else None,
        "lobe": _lobe(lights),
        "warnings": document.get("warnings") or [],
    }


def spheres_section(report: RigReport) -> Section | None:
    """What each sphere says: where it is, what was left over, and how far its own light directions are from the refined lights."""
    document = report.get("lights")
    spheres = items(document, "spheres")
    if not spheres:
        return None
    lights = items(document, "lights")
    rows: list[tuple[str, list[tuple[float, str, str]]]] = []
    for light in lights:
        dots = []
        for sphere in spheres:
            angle = sphere_disagreement(sphere, light)
            if angle is not None:
                tone = "accent" if sphere.get("used") else "fair"
                dots.append((angle, f"{sphere['name']}: {angle:.3f}°" + ("" if sphere.get("used") else ", not used"), tone))
        rows.append((str(light.get("name")), dots))
    angles = [angle for _, dots in rows for angle, _, _ in dots]
    return {
        "rows": [_sphere(sphere) for sphere in spheres],
        "median": fixed(float(np.median(angles)), 2, "°") if angles else None,
        "largest": fixed(max(angles), 2, "°") if angles else None,
        "directions": charts.dot_rows(rows, unit="degrees from the refined light; amber: spheres not used")
        if any(dots for _, dots in rows)
        else None,
        "outlines": _outlines(spheres),
        "used": f"{sum(bool(sphere.get('used')) for sphere in spheres)} of {plural(len(spheres), 'sphere')}",
    }


def _outlines(spheres: list[dict[str, Any]]) -> list[str]:
    """Where the spheres were found in their images: a drawing for each size of image."""
    drawn: dict[tuple[int, int], list[charts.Ring]] = {}
    for sphere in spheres:
        if sphere.get("outline_px") and sphere.get("image_size"):
            width, height = sphere["image_size"]
            spots = array([*(sphere.get("highlights_px") or {}).values()]).reshape(-1, 2)
            ring = charts.Ring(array(sphere["outline_px"]), spots, str(sphere.get("name")), doubted=not sphere.get("used"))
            drawn.setdefault((int(width), int(height)), []).append(ring)
    return [charts.rings(found, size) for size, found in drawn.items()]


def sphere_disagreement(sphere: dict[str, Any], light: dict[str, Any]) -> float | None:
    """Degrees between a chrome sphere's own direction to a light and the direction from its highlight to the light as refined."""
    said = (sphere.get("directions") or {}).get(light.get("name"))
    if said is None:
        return None
    said_C = array(said)
    if light.get("source_m") is None or sphere.get("centre_m") is None or sphere.get("radius_m") is None:
        expected_C = array(light["direction"]) if light.get("direction") else None
    else:
        to_light = array(light["source_m"]) - _mirror_point(array(sphere["centre_m"]), float(sphere["radius_m"]), said_C)
        expected_C = to_light / np.linalg.norm(to_light)
    if expected_C is None:
        return None
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(said_C, expected_C)), said_C @ expected_C)))


def _mirror_point(centre_C: Array, radius: float, direction_C: Array) -> Array:
    point_C = centre_C
    for _ in range(30):
        half = direction_C - point_C / np.linalg.norm(point_C)
        point_C = centre_C + radius * half / np.linalg.norm(half)
    return point_C


def _row(light: dict[str, Any], before: dict[str, Any], *, measured: bool) -> Section:
    H_CL = array(light["H_CL"]) if light.get("H_CL") else None
    place = H_CL[:3, 3] if H_CL is not None else array(light["source_m"]) if light.get("source_m") else None
    moved, turned = None, None
    if H_CL is not None and before.get("H_CL"):
        drawn = array(before["H_CL"])
        moved = fixed(1000 * float(np.linalg.norm(H_CL[:3, 3] - drawn[:3, 3])), 1)
        axis, axis_drawn = H_CL[:3, 2], drawn[:3, 2]
        turned = fixed(float(np.degrees(np.arctan2(np.linalg.norm(np.cross(axis, axis_drawn)), axis @ axis_drawn))), 2)
    intensity = light.get("intensity")
    intensity = intensity if isinstance(intensity, list) else [intensity]
    return {
        "name": light.get("name"),
        "position": None if place is None else [fixed(1000 * value, 1) for value in place],
        "position_std": sigma_of(_scaled(light, "position_std_m", 1000), 2),
        "direction": [fixed(value, 4) for value in light["direction"]] if light.get("direction") else [NOTHING] * 3,
        "direction_std": sigma_of(light.get("direction_std_deg"), 3),
        "intensity": " / ".join(fixed(value, 3) for value in intensity) if measured else "not measured",
        "intensity_std": sigma_of(_scaled(light, "intensity_std", 100) if measured else None, 2),
        "moved": moved or NOTHING,
        "turned": turned or NOTHING,
    }


def _scaled(light: dict[str, Any], key: str, scale: float) -> float | None:
    value = light.get(key)
    return scale * float(value) if isinstance(value, (int, float)) else None


def _intensities(lights: list[dict[str, Any]]) -> list[charts.Bar]:
    found = []
    for light in lights:
        value = light.get("intensity")
        mean = float(np.mean(value)) if value is not None else None
        found.append(charts.Bar(mean, f"{light.get('name')}: {number(mean, 4)}"))
    return found


def _lobe(lights: list[dict[str, Any]]) -> str | None:
    """The lobes as curves over the angle from the axis."""
    curves = []
    for light in lights:
        lobe = light.get("lobe") or {}
        if lobe.get("kind") == "cosine":
            angle = np.linspace(0, 80, 81)
            curves.append((str(light.get("name")), angle, np.cos(np.radians(angle)) ** float(lobe.get("exponent") or 0)))
        elif lobe.get("kind") == "table":
            angle = array(lobe["angle_deg"]) if lobe.get("angle_deg") else np.degrees(array(lobe.get("angle_rad") or []))
            value = array(lobe.get("value") or [])
            seen = np.arange(value.size) <= np.max(np.flatnonzero(value > 0.01 * value.max(initial=0)), initial=0) + 1
            curves.append((str(light.get("name")), angle[: value.size][seen], value[seen]))
    return charts.curves(curves, across="angle from the axis, degrees", unit="relative") if curves else None


def _sphere(sphere: dict[str, Any]) -> Section:
    centre = sphere.get("centre_m")
    residual = sphere.get("residual")
    chrome = sphere.get("kind") == "chrome"
    return {
        "name": sphere.get("name"),
        "kind": sphere.get("kind"),
        "used": "yes" if sphere.get("used") else sphere.get("why") or "no",
        "ok": bool(sphere.get("used")),
        "centre": None if centre is None else [fixed(1000 * value, 2) for value in centre],
        "radius": fixed(_scaled(sphere, "radius_m", 1000), 1),
        "residual": (number(residual, 2, "px") if chrome else number(100 * residual, 2, "%"))
        if isinstance(residual, (int, float))
        else NOTHING,
    }
