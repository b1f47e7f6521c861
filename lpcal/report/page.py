"""calib/report.html: what was found, how sure it is, and what it rests on, in one file that opens offline.

Nothing is loaded from anywhere: style, script, charts and pictures stand in the file.

The lights' and the spheres' sections: a table, how far each light lies from its drawing, what each sphere says by itself.

A chrome sphere of centre C and radius R shows light L at its surface point P: ``n = (l + v) / |l + v|``, ``P = C + R n``, l the unit vector
from P to the light, v from P to the camera. So a sphere's own direction l is compared with ``(L - P) / |L - P|``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from lpcal import __version__
from lpcal.geometry.arrays import Array
from lpcal.geometry.light_field import TABLED
from lpcal.records.calibration import Camera, Light, SphereFinding
from lpcal.records.evidence import LightsEvidence
from lpcal.records.provenance import Provenance
from lpcal.report import charts
from lpcal.report.chain_sections import camera_section, handeye_section
from lpcal.report.charts import Drawing
from lpcal.report.rig_report import KINDS, LACKING, OPTIONAL, PARTS, RigReport, SurfaceReport, designed
from lpcal.report.scene import layers_of, rig_caption, rig_scene, room_scene
from lpcal.report.scene_items import LineScene
from lpcal.report.surface_sections import surface_section
from lpcal.report.templates import environment, packed_three, script_json
from lpcal.report.verdict import headline, verdicts
from lpcal.report.wording import NOTHING, fixed, listed, number, plural, sigma_of

__all__ = ["RigReport", "SurfaceReport", "render"]


def render(report: RigReport, stamp: str = "") -> str:
    """The page, whole; a stage that is not there is said to be so. `stamp` is kept in it and states later what it was made from."""
    lines = verdicts(report)
    tone, sentence = headline(lines)
    rig, judged = rig_scene(report), {line.stage for line in lines}
    return (
        environment()
        .get_template("report.html")
        .render(
            name=report.name,
            stamp=stamp,
            version=__version__,
            made=_latest(report),
            tone=tone,
            sentence=sentence,
            verdicts=lines,
            camera=camera_section(report),
            handeye=handeye_section(report),
            lights=lights_section(report),
            spheres=spheres_section(report),
            rig=_script(rig),
            rig_fields=[] if rig is None or rig.field is None else list(rig.field.values),
            rig_sizes=rig is not None and any(item.kind in {"arrow", "ellipsoid"} for item in rig.items),
            three=packed_three(),
            rig_layers=layers_of(rig),
            rig_caption=rig_caption(report),
            room=_script(room_scene(report)),
            surfaces=[surface_section(surface) for surface in report.surfaces],
            provenance=[_provenance(kind, report.provenance[kind]) for kind in KINDS if kind in report.provenance],
            sections=[part for part in ("camera", "handeye", "lights", "spheres", "surfaces") if not report.left_out(part)],
            without=listed([words for part, words in LACKING.items() if report.left_out(part) and part not in judged]),
            missing=_missing(report),
        )
    )


def _script(scene: LineScene | None) -> str | None:
    return None if scene is None else script_json(scene.document())


def _missing(report: RigReport) -> list[str]:
    """Kinds of document that the rig should have and does not."""
    needless = {kind for part, kinds in PARTS.items() if part in report.lacks for kind in kinds}
    return [kind for kind in KINDS if kind not in report.provenance and kind != OPTIONAL and kind not in needless]


def _latest(report: RigReport) -> str:
    return _shown_time(max((one.time for one in report.provenance.values()), default=""))


def _shown_time(iso: str) -> str:
    return iso.replace("T", " ").replace("+00:00", " UTC")


@dataclass(frozen=True)
class ProvenanceSection:
    """What a document was made from."""

    file: str
    version: str
    time: str
    inputs: list[tuple[str, str]]
    options: str


def _provenance(kind: str, stated: Provenance) -> ProvenanceSection:
    return ProvenanceSection(
        f"{kind}.yaml", stated.lpcal_version, _shown_time(stated.time), [*stated.inputs.items()], script_json(stated.options)
    )


type Dot = tuple[float, str, str]
"""A value, its label and its tone."""

FIELD_COLUMNS = 36
"""Cells across a map of the light: it is smooth."""
SHOWN_DEG = 80
"""Degrees from the axis up to which a lobe by a formula is drawn."""
SEEN_LOBE = 0.01
"""A tabled lobe is drawn to where it falls under this share of its peak."""


@dataclass(frozen=True)
class LightRow:
    """A light: position (3,), direction (3,), their sigmas, intensity, and the way from the drawing."""

    name: str
    position: list[str] | None
    position_std: str
    direction: list[str]
    direction_std: str
    intensity: str
    intensity_std: str
    moved: str
    turned: str


@dataclass(frozen=True)
class LightsPart:
    """One row a light, the focus, and charts of intensities and lobes."""

    rows: list[LightRow]
    moved: bool
    """Whether any light can be held against its drawing."""
    measured: bool
    direction_from: str
    focus: str | None
    d_object: str | None
    before: str
    """What `d_object` is counted from, in words."""
    intensities: str | None
    lobe: str | None
    field: Drawing | None
    """The light of all lamps together over the working plane."""


@dataclass(frozen=True)
class SphereRow:
    """A sphere: its kind, centre (3,) and radius, its residual, and whether it was used."""

    name: str
    kind: str
    used: str
    ok: bool
    centre: list[str] | None
    radius: str
    residual: str


@dataclass(frozen=True)
class SpheresPart:
    """What each sphere shows: where it is, its residual, and how far its own light directions are from the refined lights."""

    rows: list[SphereRow]
    median: str | None
    largest: str | None
    directions: str | None
    outlines: list[str]
    predicted: list[tuple[str, str]]
    """How well a sphere that was held out is predicted by the others, and where one more would help most."""
    used: str
    placed: bool
    """Whether any sphere has a place: without a camera none has."""


def lights_section(report: RigReport) -> LightsPart | None:
    """The lights' section; None where none are refined or imported."""
    found, measured = report.placed, report.intensities_measured
    if found is None or not found.lights:
        return None
    before = {} if report.wings is None else {light.name: light for light in designed(report.wings)}
    focus = report.focus_C
    return LightsPart(
        rows=[_row(light, before.get(light.name), measured=measured) for light in found.lights],
        moved=any(light.name in before for light in found.lights),
        measured=measured,
        direction_from="from the focus" if focus is not None else "to the light",
        focus=None if focus is None else ", ".join(fixed(1000 * value, 2) for value in focus.tolist()),
        d_object=fixed(1000 * found.d_object_m, 1, "mm") if found.d_object_m else None,
        before="away" if report.left_out("wings") else "in front of the disc",
        intensities=charts.bars(_intensities(found.lights), unit="relative", across="lights") if measured else None,
        lobe=_lobe(found.lights),
        field=_field(found.lights, report.lens, found.d_object_m, focus),
    )


def spheres_section(report: RigReport) -> SpheresPart | None:
    """The spheres' section; None where none were looked at."""
    if report.lights is None or not report.lights.spheres:
        return None
    spheres, rows = report.lights.spheres, list[tuple[str, list[Dot]]]()
    for light in report.lights.lights:
        dots = []
        for sphere in spheres:
            angle = sphere_disagreement(sphere, light)
            if angle is not None:
                label = f"{sphere.name}: {angle:.3f}°" + ("" if sphere.used else ", not used")
                dots.append((angle, label, "accent" if sphere.used else "fair"))
        rows.append((light.name, dots))
    angles = [angle for _, dots in rows for angle, _, _ in dots]
    return SpheresPart(
        rows=[_sphere(sphere) for sphere in spheres],
        median=fixed(float(np.median(angles)), 2, "°") if angles else None,
        largest=fixed(max(angles), 2, "°") if angles else None,
        directions=charts.dot_rows(rows, unit="degrees from the refined light; amber: spheres not used") if angles else None,
        outlines=_outlines(spheres),
        predicted=_predicted(report.lights.evidence),
        used=f"{sum(sphere.used for sphere in spheres)} of {plural(len(spheres), 'sphere')}",
        placed=any(sphere.centre_C is not None or sphere.radius_m is not None or np.isfinite(sphere.residual) for sphere in spheres),
    )


def _predicted(found: LightsEvidence) -> list[tuple[str, str]]:
    """Rows of what held-out spheres say, and of the next one."""
    shading, free = found.predicted_shading_rms, found.predicted_shading_rms_albedo_free
    rows = [
        ("highlights in the solve", number(found.highlight_rms_px, 2, "px") + " rms"),
        ("a chrome sphere held out: its highlights, predicted by the others", number(found.predicted_highlight_px, 2, "px") + " rms"),
        ("shading in the solve", number(None if found.shading_rms is None else 100 * found.shading_rms, 2, "%") + " rms"),
        (
            "a matte sphere held out: its shading, predicted by the others",
            number(None if shading is None else 100 * shading, 2, "%") + " rms",
        ),
        ("the same, its albedo free", number(None if free is None else 100 * free, 2, "%") + " rms"),
    ]
    rows = [(label, value) for label, value in rows if not value.startswith(NOTHING)]
    if found.next_sphere is not None:
        then = f"{number(found.next_sphere.direction_std_deg, 2)} → {number(found.next_sphere.with_it_deg, 2, '°')}"
        rows.append(("one more chrome sphere helps most", f"{found.next_sphere.where} ({then})"))
    return rows


def _outlines(spheres: Sequence[SphereFinding]) -> list[str]:
    """Where the spheres were found in their images: a drawing for each size of image."""
    drawn: dict[tuple[int, int], list[charts.Ring]] = {}
    for sphere in spheres:
        if len(sphere.outline_px) and sphere.image_size is not None:
            spots = np.array([*sphere.highlights_px.values()]).reshape(-1, 2)
            ring = charts.Ring(sphere.outline_px, spots, sphere.name, doubted=not sphere.used)
            drawn.setdefault(sphere.image_size, []).append(ring)
    return [charts.rings(found, size) for size, found in drawn.items()]


def sphere_disagreement(sphere: SphereFinding, light: Light) -> float | None:
    """Degrees between a sphere's own direction to a light and the direction from its highlight to the light as refined."""
    said_C = sphere.directions_C.get(light.name)
    if said_C is None:
        return None
    expected_C = light.direction_C
    if light.source_C is not None and sphere.centre_C is not None and sphere.radius_m is not None:
        to_light = light.source_C - _mirror_point(sphere.centre_C, sphere.radius_m, said_C)
        expected_C = to_light / np.linalg.norm(to_light)
    return _apart_deg(said_C, expected_C)


def _apart_deg(a: Array, b: Array) -> float:
    return float(np.degrees(np.arctan2(np.linalg.norm(np.cross(a, b)), a @ b)))


def _mirror_point(centre_C: Array, radius: float, direction_C: Array) -> Array:
    point_C = centre_C
    for _ in range(30):
        half = direction_C - point_C / np.linalg.norm(point_C)
        point_C = centre_C + radius * half / np.linalg.norm(half)
    return point_C


def _row(light: Light, before: Light | None, *, measured: bool) -> LightRow:
    place = light.H_CL[:3, 3] if light.H_CL is not None else light.source_C
    moved = turned = NOTHING
    if light.H_CL is not None and before is not None and before.H_CL is not None:
        moved = fixed(1000 * float(np.linalg.norm(light.H_CL[:3, 3] - before.H_CL[:3, 3])), 1)
        turned = fixed(_apart_deg(light.H_CL[:3, 2], before.H_CL[:3, 2]), 2)
    return LightRow(
        name=light.name,
        position=None if place is None else [fixed(1000 * value, 1) for value in place.tolist()],
        position_std=sigma_of(1000 * light.position_std_m, 2),
        direction=[fixed(value, 4) for value in light.direction_C.tolist()],
        direction_std=sigma_of(float(np.degrees(light.direction_std_rad)), 3),
        intensity=" / ".join(fixed(value, 3) for value in light.intensity.tolist()) if measured else "not measured",
        intensity_std=sigma_of(100 * light.intensity_std if measured else None, 2),
        moved=moved,
        turned=turned,
    )


def _field(lights: Sequence[Light], camera: Camera | None, distance_m: float | None, focus_C: Array | None) -> Drawing | None:
    """What a white card at the working distance, facing the camera, gets of all lights, in per cent of the most."""
    depth = float(focus_C[2]) if focus_C is not None else distance_m
    if camera is None or depth is None or not depth > 0 or any(light.source_C is None for light in lights):
        return None
    width, height = camera.image_size
    rows = max(2, round(FIELD_COLUMNS * height / width))
    across, down = (np.arange(FIELD_COLUMNS) + 0.5) / FIELD_COLUMNS * width - 0.5, (np.arange(rows) + 0.5) / rows * height - 0.5
    rays = camera.unproject(np.stack(np.meshgrid(across, down), axis=-1))
    points_C = rays / rays[..., 2:] * depth
    arrives = np.zeros(points_C.shape[:2])
    for light in lights:
        towards, irradiance = light.field(points_C)
        arrives += irradiance.mean(axis=-1) * np.maximum(-towards[..., 2], 0)
    share = 100 * arrives / arrives.max()
    drawn = charts.heat_map(
        share, unit="%", aspect=width / height, low=float(share.min()), what="light of all lamps over the working plane"
    )
    note = f"all lights together on a card that faces the camera, {1000 * depth:.0f} mm away, in per cent of the brightest place; "
    return Drawing(drawn, note + f"the darkest place in view gets {share.min():.0f} %")


def _intensities(lights: Sequence[Light]) -> list[charts.Bar]:
    means = [(light.name, float(light.intensity.mean())) for light in lights]
    return [charts.Bar(mean, f"{name}: {number(mean, 4)}", name=name) for name, mean in means]


def _lobe(lights: Sequence[Light]) -> str | None:
    """The lobes as curves over the angle from the axis."""
    curves = []
    for light in lights:
        lobe = light.lobe
        if lobe.kind not in TABLED and lobe.kind != "isotropic":
            angle = np.linspace(0, SHOWN_DEG, SHOWN_DEG + 1)
            curves.append((light.name, angle, lobe(np.radians(angle))))
        elif lobe.value.size:
            last = np.max(np.flatnonzero(lobe.value > SEEN_LOBE * lobe.value.max(initial=0)), initial=0) + 1
            curves.append((light.name, np.degrees(lobe.angle_rad[: last + 1]), lobe.value[: last + 1]))
    return charts.curves(curves, across="angle from the axis, degrees", unit="relative") if curves else None


def _sphere(sphere: SphereFinding) -> SphereRow:
    chrome = sphere.kind == "chrome"
    return SphereRow(
        name=sphere.name,
        kind=sphere.kind,
        used="yes" if sphere.used else sphere.why or "no",
        ok=sphere.used,
        centre=None if sphere.centre_C is None else [fixed(1000 * value, 2) for value in sphere.centre_C.tolist()],
        radius=fixed(None if sphere.radius_m is None else 1000 * sphere.radius_m, 1),
        residual=number(sphere.residual, 2, "px") if chrome else number(100 * sphere.residual, 2, "%"),
    )
