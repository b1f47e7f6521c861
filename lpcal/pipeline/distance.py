"""distance.yaml: the panel's distance sensor, of its readings on the board.

A reading at an image in which the board was found goes by that image; another goes through the room, by the tracked panel at its time.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.distance import board_readings
from lpcal.api.lights import as_drawn
from lpcal.chain.distance_beam.findings import calibrate, off_drawing
from lpcal.chain.distance_beam.fit import boards_through_room, drawn_in_camera, room_covariance
from lpcal.chain.h_op_panel import track_of
from lpcal.errors import DisagreementError, InputError, LpcalError
from lpcal.formats.distance_files import KIND, ReadingRow, read_distances, write_distance
from lpcal.formats.h_cb_yaml import read_h_cb
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.geometry.pose_track import poses_at
from lpcal.pipeline.handeye_inputs import recording
from lpcal.pipeline.wings import disc_in_camera, tracks_panel
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import HandEye
from lpcal.records.digits import fine, fine_each
from lpcal.records.distance import BeamDrawn, BoardReadings, SensorSolution
from lpcal.records.observations import BoardPoses
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import DistanceSensorSection, PanelSection

FILE = "distance.yaml"
NAMED = 4
"""Readings that are named with why they were left out."""


def wanted(workspace: Workspace) -> bool:
    """Whether the panel has a distance sensor and the rig a board to read it on."""
    rig = workspace.rig_file.rig
    return rig.panel is not None and rig.panel.distance_sensor is not None and rig.board is not None


def inputs(workspace: Workspace) -> list[Path]:
    """The boards, the readings, and the hand-eye with its recording where the panel is tracked."""
    rig = workspace.rig_file.rig
    found = [workspace.calib("H_CB.yaml"), *_tables(workspace)]
    if tracks_panel(workspace):
        found.append(workspace.calib("handeye.yaml"))
        found += [workspace.path(rig.mocap.file, "mocap.file")] if rig.mocap and rig.mocap.file and not rig.mocap.poses else []
    return found


def settings(workspace: Workspace) -> dict[str, Any]:
    """The panel's sensor, camera and markers."""
    panel = workspace.rig_file.rig.panel
    return {} if panel is None else panel.model_dump(include={"distance_sensor", "camera", "markers"})


def run(workspace: Workspace, progress: Progress) -> Outcome:
    """Write distance.yaml.

    Raises
    ------
    InputError, DegenerateError, DisagreementError
        No readings, too few on the board, or readings that are of no beam of this panel.
    """
    panel: PanelSection = workspace.need("panel")
    if panel.distance_sensor is None:
        needed = "panel.distance_sensor: {position: [...], direction: [...], noise: 3 mm}"
        raise InputError("no distance sensor", where=workspace.rig_file.where("panel"), needed=needed, todo="add it")
    progress("distance sensor", 0, 1)
    H_CD, H_CD_covariance, source = disc_in_camera(workspace, panel)
    drawn = drawn_of(panel.distance_sensor)
    start, prior = drawn_in_camera(drawn, H_CD, H_CD_covariance)
    readings, without = gathered(workspace)
    found = calibrate(readings, start, prior, drawn.noise_m)
    write_distance(workspace.calib(FILE), found, STAGE.provenance(workspace))
    progress("distance sensor", 1, 1)
    return Outcome(
        [
            *summary_of(found, source),
            *([f"  without   {without} readings: no board in their image, and no pose at their time"] * bool(without)),
        ],
        {"file": str(workspace.calib(FILE)), "readings_used": found.evidence.readings_used},
        list(found.warnings),
        next_command="lpcal export",
    )


def list_pixels(workspace: Workspace, boards: BoardPoses) -> tuple[list[tuple[str, str]], list[LpcalError]]:
    """Before any solve: what the readings at images with a board say by themselves, and what is wrong with them."""
    panel = workspace.rig_file.rig.panel
    sensor = None if panel is None else panel.distance_sensor
    if panel is None or sensor is None or boards.points_B is None:
        return [], []
    drawn = drawn_of(sensor)
    start, prior = drawn_in_camera(drawn, *as_drawn(panel))
    where = workspace.rig_file.where("panel.distance_sensor")
    try:
        readings, _ = at_images(workspace, boards)
        found = calibrate(readings, start, prior, drawn.noise_m)
    except LpcalError as error:
        return [], [type(error)(error.found, where=error.where or where, needed=error.needed, todo=error.todo)]
    evidence, said = found.evidence, off_drawing(found)
    wrong: list[LpcalError] = []
    if said:
        what, _, todo = said.partition(": ")
        wrong.append(DisagreementError(what, where=where, needed="the beam as it is mounted", todo=todo))
    line = f"{evidence.readings_used} of {len(found.readings)} readings on the board, {1e3 * evidence.residual_rms_m:.1f} mm rms"
    return [("distance", line), *([("", evidence.weakest)] if evidence.weakest else [])], wrong


def drawn_of(section: DistanceSensorSection) -> BeamDrawn:
    """The sensor of panel.yaml."""
    direction = np.array(section.direction)
    return BeamDrawn(np.array(section.position), direction / np.linalg.norm(direction), section.noise, section.tolerance)


def summary_of(found: SensorSolution, source: str) -> list[str]:
    """What was found, in lines."""
    sensor, evidence = found.sensor, found.evidence
    std = np.sqrt(np.diag(sensor.covariance))
    middle = sensor.bias_m + sensor.scale * float(np.mean(evidence.span_m))
    left = [one for one in found.readings if not one.used]
    named = "; ".join(f"{one.name}: {one.why}" for one in left[:NAMED]) + (f"; and {len(left) - NAMED} more" if len(left) > NAMED else "")
    x, y, z = (f"{1e3 * value:.1f}" for value in sensor.position_C)
    ux, uy, uz = (f"{value:.4f}" for value in sensor.direction_C)
    return [
        f"beam from [{x} {y} {z}] +- {fine_each(1e3 * std[:3])} mm along [{ux} {uy} {uz}] +- {fine_each(np.degrees(std[3:6]))} deg in C",
        f"readings    {evidence.readings_used} of {len(found.readings)} used, {1e3 * evidence.residual_rms_m:.2f} mm rms; "
        f"bias {1e3 * sensor.bias_m:+.1f} +- {fine(1e3 * std[6])} mm, scale {sensor.scale:.4f} +- {fine(std[7], 4)}",
        f"a reading of {middle:.2f} m means a point within {fine(1e3 * sensor.std_m(middle))} mm along the beam, "
        f"{fine(1e3 * sensor.across_std_m(middle))} mm across",
        f"drawing     {evidence.off_drawing_deg:.2f} deg and {1e3 * evidence.off_drawing_m:.1f} mm off it; H_CD from {source}",
        *([f"  without   {named}"] if left else []),
    ]


def gathered(workspace: Workspace) -> tuple[BoardReadings, int]:
    """All readings with the board's pose, and how many have none.

    Raises
    ------
    InputError
        There is none.
    """
    boards = read_h_cb(workspace.calib("H_CB.yaml"))
    seen, others = at_images(workspace, boards)
    handeye = read_handeye(workspace.calib("handeye.yaml")) if tracks_panel(workspace) else None
    timed = [row for row in others if row.t_camera_s is not None]
    section = workspace.rig_file.rig.mocap
    if handeye is None or handeye.carries == "board" or not timed or section is None or section.file is None or section.poses:
        return seen, len(others)
    both, lost = _with_room(workspace, seen, timed, handeye, boards)
    return both, lost + len(others) - len(timed)


def at_images(workspace: Workspace, boards: BoardPoses) -> tuple[BoardReadings, list[ReadingRow]]:
    """The readings at images in which the board was found, and the others.

    Raises
    ------
    InputError
        There is no reading at all.
    """
    rows = [row for path in _tables(workspace) for row in read_distances(path, needed=path in _own_tables(workspace))]
    if not rows:
        raise InputError(
            "no readings of the distance sensor",
            where=workspace.rig_file.where("panel.distance_sensor"),
            needed="a column distance_m in the csv files of mocap.images, or panel.distance_sensor.readings: a csv of file,distance_m",
            todo="add it",
        )
    place = {image: k for k, image in enumerate(boards.images)}
    where = [place.get(workspace.relative(row.image), -1) if row.image else -1 for row in rows]
    distance_m = np.full(len(boards.images), np.nan)
    for row, k in zip(rows, where, strict=True):
        if k >= 0:
            distance_m[k] = row.distance_m
    others = [row for row, k in zip(rows, where, strict=True) if k < 0]
    return board_readings(boards, distance_m, np.flatnonzero(np.isfinite(distance_m))), others


def _with_room(
    workspace: Workspace, seen: BoardReadings, rows: list[ReadingRow], handeye: HandEye, boards: BoardPoses
) -> tuple[BoardReadings, int]:
    """The readings with those whose board is known through the room, and how many of these have no pose to trust."""
    section = workspace.rig_file.rig.mocap
    assert section is not None
    found = poses_at(track_of(recording(workspace, section)), handeye.mocap_times(np.array([row.t_camera_s for row in rows])))
    good = np.flatnonzero(found.trusted)
    sigma = _mocap_sigmas(handeye)
    variance = np.stack([np.repeat([sigma[found.steady[k]][1] ** 2, sigma[found.steady[k]][0] ** 2], 3) for k in good]).reshape(-1, 6)
    H_CB, own, by_room = boards_through_room(handeye, found.H[good], variance, found.velocity[good])
    shared = room_covariance(handeye)
    count = len(seen.names)
    return replace(
        seen,
        names=(*seen.names, *(rows[k].name for k in good)),
        distance_m=np.concatenate([seen.distance_m, [rows[k].distance_m for k in good]]),
        H_CB=np.concatenate([seen.H_CB, H_CB]),
        covariance=np.concatenate([seen.covariance, own]),
        by_room=np.concatenate([np.zeros((count, 6, len(shared))), by_room]),
        room_covariance=shared,
        points_B=seen.points_B if boards.points_B is None else boards.points_B,
    ), len(rows) - len(good)


def _mocap_sigmas(handeye: HandEye) -> dict[bool, tuple[float, float]]:
    """One sigma of a tracked pose, metres and radians, by whether the body stood still."""
    from lpcal.api.tracking import tracking_of

    known = tracking_of(handeye)
    return {steady: known.sigmas(steady=steady) for steady in (False, True)}


def _own_tables(workspace: Workspace) -> list[Path]:
    """The files of readings that panel.distance_sensor names."""
    panel = workspace.rig_file.rig.panel
    sensor = None if panel is None else panel.distance_sensor
    return [] if sensor is None else [workspace.path(name, "panel.distance_sensor.readings") for name in sensor.readings]


def _tables(workspace: Workspace) -> list[Path]:
    """All csv files that may hold readings."""
    mocap = workspace.rig_file.rig.mocap
    listed = [] if mocap is None else [workspace.path(name, "mocap.images") for name in mocap.images if name.lower().endswith(".csv")]
    return [*listed, *_own_tables(workspace)]


STAGE = Stage("distance", {FILE: KIND}, wanted, inputs, settings, run)
