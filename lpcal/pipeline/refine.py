"""lights.yaml: the lights refined from the sphere images.

What the spheres say back to the stages before: the disc in the tracked body, and with ``joint_solve`` camera and hand-eye too.
"""

from __future__ import annotations

import threading
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.sensor import BY_CAPTURE, sensor_of_camera, unlike_plain
from lpcal.api.spheres import find_sphere, refine_lights
from lpcal.chain.h_pl_wings import share_correction
from lpcal.errors import DegenerateError, DisagreementError, InputError, LpcalError
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.capture import check_lights, read_capture
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.lights_yaml import KIND, write_lights
from lpcal.formats.lobe_files import read_lobe
from lpcal.formats.record_documents import document_of
from lpcal.formats.wings_yaml import read_wings
from lpcal.geometry import se3
from lpcal.pipeline import wings as wings_stage
from lpcal.pipeline.sensor import check_sweep, flat_field_path, has_lens, sensor_of_panel, sweep_path
from lpcal.pipeline.wings import disc_in_body, tracks_panel
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import Camera, LightsSolution, SphereFinding
from lpcal.records.digits import fine
from lpcal.records.observations import RawCapture, SphereView
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import SphereSection
from lpcal.records.sensor import Sensor
from lpcal.view.parallel import run_all

FILE = "lights.yaml"
NEAREST, FARTHEST = 0.4, 2.5
"""Spheres are looked for between these multiples of d_object."""
OUTLINE_POINTS = 45
"""About so many points of an outline are kept for the report's drawing and for ``lpcal diff``: one in 8 degrees."""


def wanted(workspace: Workspace) -> bool:
    """Whether the rig has spheres."""
    return bool(workspace.rig_file.rig.spheres and workspace.rig_file.rig.lights)


def inputs(workspace: Workspace) -> list[Path]:
    """Every image of every sphere, the camera, the wings."""
    found = [workspace.calib("camera.yaml")] if has_lens(workspace) else []
    found += [workspace.calib(wings_stage.FILE)] if wings_stage.wanted(workspace) else []
    flat = flat_field_path(workspace)
    found += [flat] if flat and not has_lens(workspace) else []
    sweep = sweep_path(workspace)
    found += workspace.files(str(sweep), "camera.exposure_sweep") if sweep else []
    found += [path for _, path in _lobe_files(workspace)]
    found += wings_stage.inputs(workspace) if wings_stage.wanted(workspace) and workspace.rig_file.rig.joint_solve else []
    for name, sphere in workspace.rig_file.rig.spheres.items():
        found += workspace.files(sphere.images, f"spheres.{name}.images")
    return found


def settings(workspace: Workspace) -> dict[str, Any]:
    """Spheres, lights, tolerance and radiometry."""
    rig = workspace.rig_file.rig
    levels = rig.camera.model_dump(include={"black_level", "white_level", "gamma"}) if rig.camera else {}
    return {
        "spheres": {name: sphere.model_dump() for name, sphere in rig.spheres.items()},
        "lights": {name: light.lobe for name, light in rig.lights.items()},
        "intensity": rig.panel.tolerance.intensity if rig.panel else None,
        "levels": levels,
        "joint_solve": rig.joint_solve,
    }


def run(workspace: Workspace, progress: Progress) -> Outcome:
    """Write lights.yaml; a bad sphere of several is named and left out, and the exit code is its error's."""
    lights = list(workspace.need("lights"))
    spheres: dict[str, SphereSection] = workspace.need("spheres")
    camera = read_camera(workspace.calib("camera.yaml")) if has_lens(workspace) else None
    wings = read_wings(workspace.calib(wings_stage.FILE)) if wings_stage.wanted(workspace) else None
    sensor = sensor_of_camera(camera) if camera else sensor_of_panel(workspace)
    swept = check_sweep(workspace, sensor)
    distance_m = None if wings is None or not np.isfinite(wings.d_object_m) else (NEAREST * wings.d_object_m, FARTHEST * wings.d_object_m)
    looked = _looked(workspace, spheres, camera, sensor, distance_m, progress)
    views = [found for found in looked.values() if isinstance(found, SphereView)]
    bad = {name: found for name, found in looked.items() if isinstance(found, LpcalError)}
    if not views:
        raise next(iter(bad.values()))
    panel = workspace.rig_file.rig.panel
    solution = refine_lights(
        views,
        lights,
        camera,
        wings,
        intensity_std=panel.tolerance.intensity if panel else 0.5,
        lobes={name: read_lobe(path) for name, path in _lobe_files(workspace)},
        joint=workspace.rig_file.rig.joint_solve,
        progress=progress,
    )
    solution = with_handeye(workspace, solution)
    left_out = tuple(SphereFinding(name, spheres[name].kind, None, spheres[name].radius, False, error.found) for name, error in bad.items())
    found = tuple(_thinned(sphere) for sphere in solution.spheres)
    solution = replace(
        solution,
        spheres=(*found, *left_out),
        warnings=(*(note for view in views for note in view.notes), *solution.warnings),
        evidence=replace(solution.evidence, exposure_sweep=swept),
    )
    write_lights(workspace.calib(FILE), solution, STAGE.provenance(workspace))
    return Outcome(
        summary=[*summary_of(solution), *summary_of_handeye(workspace, solution), *_advice(solution)],
        document={
            "file": str(workspace.calib(FILE)),
            "lights": {light.name: light.direction_C for light in solution.lights},
            "evidence": document_of(solution.evidence),
        },
        warnings=[*(f"left out: {error}" for error in bad.values()), *solution.warnings],
        next_command="lpcal export",
        exit_code=next((error.exit_code for error in bad.values()), 0),
    )


def _looked(
    workspace: Workspace,
    spheres: dict[str, SphereSection],
    camera: Camera | None,
    sensor: Sensor,
    distance_m: tuple[float, float] | None,
    progress: Progress,
) -> dict[str, SphereView | LpcalError]:
    """What the images of each sphere show, or what is wrong with them; the cores share the spheres."""
    lock, done = threading.Lock(), 0

    def look(item: tuple[str, SphereSection]) -> SphereView | LpcalError:
        nonlocal done
        name, section = item
        raw = _images(workspace, name, section, list(workspace.need("lights")), camera)
        said = [(BY_CAPTURE, raw.sensor), ("the rig", unlike_plain(sensor))]
        found: SphereView | LpcalError
        try:
            found = find_sphere(
                raw, section.kind, section.radius, camera, hint_px=section.hint, distance_m=distance_m, sensor=said, name=name
            )
        except (DegenerateError, DisagreementError) as error:
            found = error
        with lock:
            done += 1
            progress("spheres", done, len(spheres))
        return found

    progress("spheres", 0, len(spheres))
    return dict(zip(spheres, run_all(look, spheres.items()), strict=True))


def _thinned(finding: SphereFinding) -> SphereFinding:
    """A finding with as many points of its outline as are written."""
    return replace(finding, outline_px=finding.outline_px[:: max(1, len(finding.outline_px) // OUTLINE_POINTS)])


def summary_of(solution: LightsSolution) -> list[str]:
    """A line a light, and what it rests on."""
    used = [sphere for sphere in solution.spheres if sphere.used]
    lines = [f"{len(solution.lights)} lights from {len(used)} of {len(solution.spheres)} spheres"]
    for light in solution.lights:
        seen = any(sphere.used and sphere.kind == "matte" for sphere in solution.spheres)
        intensity = "intensity " + " ".join(f"{value:.3f}" for value in light.intensity) if seen else "intensity not measured"
        turn = f"direction +- {fine(np.degrees(light.direction_std_rad))} deg  {intensity}"
        if light.source_C is None:
            lines.append(f"{light.name:<6} from {_numbers(light.direction_C, 4)}  {turn}")
        else:
            place = f"{_numbers(1e3 * light.source_C, 1)} mm  position +- {fine(1e3 * light.position_std_m, 1)} mm"
            lines.append(f"{light.name:<6} source {place}  {turn}")
    return lines


def _advice(solution: LightsSolution) -> list[str]:
    """Which sphere to add next, and what it gains."""
    advice = solution.evidence.next_sphere
    if advice is None:
        return []
    gain = f"directions from +- {fine(advice.direction_std_deg, 3)} to +- {fine(advice.with_it_deg, 3)} deg"
    return [f"one more chrome sphere helps most {advice.where}: {gain}"]


def _lobe_files(workspace: Workspace) -> list[tuple[str, Path]]:
    """Lights whose maker says how they emit, and the file."""
    lights = workspace.rig_file.rig.lights
    return [(name, workspace.path(light.lobe, f"lights.{name}.lobe")) for name, light in lights.items() if light.lobe]


def _images(workspace: Workspace, name: str, section: SphereSection, lights: list[str], camera: Camera | None) -> RawCapture:
    if camera is not None and section.radius is None:
        raise InputError(
            "no radius", where=workspace.rig_file.where(f"spheres.{name}"), needed="radius: 25 mm", todo="measure the sphere with calipers"
        )
    return read_capture(workspace.path(section.images, f"spheres.{name}.images"), lights, name=name)


def _numbers(values: Any, digits: int) -> str:
    return "[" + " ".join(f"{value:.{digits}f}" for value in values) + "]"


def _look_closer(workspace: Workspace) -> None:
    """Whether every sphere has an image of every light, and every lobe can be read."""
    for _, path in _lobe_files(workspace):
        read_lobe(path)
    rig = workspace.rig_file.rig
    for name, sphere in rig.spheres.items():
        check_lights(workspace.path(sphere.images, f"spheres.{name}.images"), list(rig.lights))


STAGE = Stage("refine", {FILE: KIND}, wanted, inputs, settings, run, look_closer=_look_closer)


def with_handeye(workspace: Workspace, solution: LightsSolution) -> LightsSolution:
    """The solution with H_PD, where the panel is tracked and no markers say it; with ``joint_solve`` always, and H_PC too.

    Each has moved by its share of what H_CD has moved.
    """
    rig = workspace.rig_file.rig
    if rig.panel is None or (rig.panel.markers and not rig.joint_solve) or not (wings_stage.wanted(workspace) and tracks_panel(workspace)):
        return solution
    if solution.H_CD is None or solution.H_CD_covariance is None:
        return solution
    handeye = read_handeye(workspace.calib("handeye.yaml"))
    H_PD, H_PD_covariance, _ = disc_in_body(workspace, rig.panel)
    (H_PC, H_PC_covariance), (H_PD, H_PD_covariance) = share_correction(
        handeye.H_PC, handeye.H_PC_covariance, H_PD, H_PD_covariance, solution.H_CD, solution.H_CD_covariance
    )
    found = replace(solution, H_PD=H_PD, H_PD_covariance=H_PD_covariance)
    return replace(found, H_PC=H_PC, H_PC_covariance=H_PC_covariance) if rig.joint_solve else found


def summary_of_handeye(workspace: Workspace, solution: LightsSolution) -> list[str]:
    """Lines on H_PD where no markers say it, and on what the joint solve has moved."""
    lines = []
    panel = workspace.rig_file.rig.panel
    if solution.H_PD is not None and solution.H_PD_covariance is not None and panel is not None and not panel.markers:
        lines.append(f"H_PD   from the spheres: disc at {_place(solution.H_PD, solution.H_PD_covariance)} in the tracked body")
    if solution.camera is not None:
        K = solution.camera.K
        lines.append(f"joint  f {K[0, 0]:.3f}, {K[1, 1]:.3f} px  c {K[0, 2]:.3f}, {K[1, 2]:.3f} px with the spheres")
    if solution.H_PC is not None and solution.H_PC_covariance is not None:
        lines.append(f"joint  H_PC {_place(solution.H_PC, solution.H_PC_covariance)} with the spheres")
    return lines


def _place(H_AB: np.ndarray, covariance: np.ndarray) -> str:
    """Origin and turn of a transform, and how sure: the place's covariance is that of the left perturbation carried to the origin."""
    x_A = H_AB[:3, 3]
    spread_mm = 1e3 * np.linalg.norm(se3.origin_sigmas(H_AB, covariance)) / np.sqrt(3)
    turn_deg = np.degrees(np.linalg.norm(se3.log(H_AB)[:3]))
    spread_deg = np.degrees(np.sqrt(np.trace(covariance[:3, :3]) / 3))
    x, y, z = 1e3 * x_A
    return f"[{x:.2f} {y:.2f} {z:.2f}] mm +- {fine(spread_mm)}, turned {turn_deg:.3f} deg +- {fine(spread_deg, 3)}"
