"""A synthetic rig folder: whatever a panel.yaml asks for, with the truth beside it.

The simulator makes arrays, the formats write them; here they meet. The folder appears whole or not at all.

A second part, ``session/stop_00 ...``, is a robot's path round an object: placed captures, whose capture.yaml states the time on the
camera's clock and the recording session/mocap.csv, with their own truth.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from lpcal.api.simulation import Simulation, simulation_of
from lpcal.errors import InputError
from lpcal.formats.mocap_motive import write_motive
from lpcal.formats.outputs import NEW, refuse_place, whole, write_text
from lpcal.formats.truth_folder import README, write_field, write_leds, write_poses, write_solid, write_surface, write_yaml
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import Rig, RigFile
from lpcal.simulate import motion, tour
from lpcal.simulate.beam import board_distances
from lpcal.simulate.built import Built
from lpcal.simulate.captures import Capture, object_captures, sphere_captures
from lpcal.simulate.recipe import Recipe
from lpcal.simulate.sensor import Stored
from lpcal.simulate.tracking import Recording, record

MADE_FROM = "truth/made_from.txt"
"""What says that a drawn folder is up to date, where many are drawn."""


@dataclass(frozen=True)
class _BoardImages:
    """Names, true panel poses and times (camera clock) of the board images."""

    names: list[str]
    H_OP: Array
    t_camera_s: Array


def simulate(
    rig_file: RigFile, folder: Path, recipe: Recipe, progress: Progress, *, stops: int = 0, item: str = "bust", made_from: str = ""
) -> Outcome:
    """Write the rig folder; with `stops` also a robot's path round an object of a name, its captures placed by its own recording.

    Raises
    ------
    InputError
        The folder is there already, or the rig asks for what cannot be simulated.
    """
    rig = rig_file.rig
    refuse_place(folder, NEW)
    _check(rig_file)
    if stops and (rig.mocap is None or not rig.mocap.file or not rig.lights):
        needed = "mocap.file and lights: a session is tracked, and its captures are lit"
        raise InputError("no session can be simulated", where=str(rig_file.file), needed=needed, todo="take another rig")
    session = simulation_of(rig, recipe)
    with whole(folder, NEW) as draft:
        draft.mkdir()
        write_text(draft / "panel.yaml", rig_file.file.read_text(encoding="utf-8"))
        write_text(draft / "truth" / "README.md", README)
        if made_from:
            write_text(draft / MADE_FROM, made_from + "\n")
        _write_camera(draft, rig, session.built, recipe)
        if session.built.beam is not None:
            write_yaml(draft / "truth" / "distance_sensor.yaml", asdict(session.built.beam))
        counts = _write_boards(draft, session, progress) if rig.board else {}
        counts |= _write_captures(draft, session, progress) if rig.lights else {}
        counts |= write_session(draft, session, item, stops, progress) if stops else {}
    made = ", ".join(f"{count} {what}" for what, count in counts.items())
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    return Outcome(
        summary=[f"{folder}: a simulated {rig.name}, seed {recipe.seed}: {made}; {size / 1e6:.1f} MB, truth in {folder / 'truth'}"],
        document={"folder": str(folder), "seed": recipe.seed, "bytes": size, **counts},
        next_command=f"cd {folder} && lpcal run" + " && lpcal reconstruct session/stop_* && lpcal fuse session/stop_*" * bool(stops),
    )


def _check(rig_file: RigFile) -> None:
    """What cannot be simulated is said before anything is drawn."""
    rig = rig_file.rig
    if rig.camera is None:
        raise InputError(
            "no section camera:", where=str(rig_file.file), needed="camera:", todo="add it: a rig is simulated through a camera"
        )
    if (rig.mocap or rig.camera.images) and rig.board is None:
        raise InputError(
            "no section board:", where=str(rig_file.file), needed="board:", todo="add it, or leave mocap: and camera.images out"
        )
    if rig.mocap and rig.mocap.board_poses:
        todo = "name images instead: mocap.images"
        raise InputError("board poses are not simulated", where=rig_file.where("mocap.board_poses"), needed="mocap.images", todo=todo)
    if rig.mocap and rig.mocap.file and (rig.mocap.direction == "H_PO" or not rig.mocap.file.endswith(".csv")):
        where = rig_file.where("mocap.direction" if rig.mocap.direction == "H_PO" else "mocap.file")
        raise InputError("only Motive's CSV with H_OP is simulated", where=where, needed="a .csv and direction: H_OP", todo="change it")

    for key, name in _names(rig):
        if PurePosixPath(name).is_absolute() or ".." in PurePosixPath(name).parts:
            where = rig_file.where(key)
            raise InputError(
                f"{name} leads out of the folder", where=where, needed="a path in the rig folder", todo="simulate a copy that names such"
            )
    for pattern in rig.camera.images:
        if any(sign in pattern for sign in "*?[") and not fnmatch(_numbered(pattern, "station", 0), pattern):
            where = rig_file.where("camera.images")
            raise InputError(
                f"images {pattern} cannot be numbered", where=where, needed="a pattern with one *, or names", todo="change the pattern"
            )


def _names(rig: Rig) -> Iterator[tuple[str, str]]:
    """Every path that the rig names, with its key."""
    if rig.camera:
        yield from (("camera.images", name) for name in rig.camera.images)
        yield from (("camera.flat_field", name) for name in [rig.camera.flat_field, rig.camera.cameramodel] if name)
    if rig.mocap:
        yield from (("mocap", name) for name in [rig.mocap.file, rig.mocap.poses, *rig.mocap.images] if name)
    yield from ((f"spheres.{name}", sphere.images) for name, sphere in rig.spheres.items())
    yield from ((f"objects.{name}", images) for name, images in rig.objects.items())


def _write_camera(folder: Path, rig: Rig, built: Built, recipe: Recipe) -> None:
    lens, camera = built.lens, rig.camera
    truth: dict[str, Any] = {
        "image_size": lens.image_size,
        "model": "opencv5",
        "K": lens.K,
        "distortion": lens.distortion,
        "black_level_percent": 100 * camera.black_level if camera else 0.0,
        "gamma": camera.gamma if camera else 1.0,
        "noise": {key: getattr(recipe.sensor, key) for key in ("full_well_e", "read_noise_e", "psf_sigma_px")},
        "vignetting": {"power_of_cos4": 1.0, "extra_r4": lens.vignetting_r4, "centre_from_middle_px": lens.vignetting_centre_px},
    }
    write_yaml(folder / "truth" / "camera.yaml", truth)
    if camera and camera.cameramodel:
        core = [lens.K[0, 0], lens.K[1, 1], lens.K[0, 2], lens.K[1, 2], *lens.distortion]
        lines = [
            "{",
            "    'lensmodel':  'LENSMODEL_OPENCV5',",
            f"    'intrinsics': [ {', '.join(repr(float(value)) for value in core)} ],",
            "    'extrinsics': [ 0, 0, 0, 0, 0, 0 ],",
            f"    'imagersize': [ {lens.image_size[0]}, {lens.image_size[1]} ]",
            "}",
        ]
        write_text(folder / camera.cameramodel, "\n".join(lines) + "\n")


def _write_boards(folder: Path, session: Simulation, progress: Progress) -> dict[str, int]:
    """Stations and sweep: images, the mocap stream, the images' times, the truth."""
    rig, built, true = session.rig, session.built, session.board_truth()
    groups = _board_images(session)
    names = [name for group in groups for name in group.names]
    for k, (name, image) in enumerate(zip(names, session.board_images(), strict=True)):
        write_image(folder / name, image)
        progress("board images", k + 1, len(names))
    truth = folder / "truth"
    write_poses(truth / "H_CB.csv", names, true.H_CB)
    counts = {"station images": len(groups[0].names), "sweep images": sum(len(group.names) for group in groups[1:])}
    if rig.mocap is None:
        return counts
    _write_mocap(folder, rig, built, groups, session.recording, session.recipe)
    write_poses(truth / "H_OP.csv", names, true.H_OP, true.t_camera_s)
    write_yaml(truth / "handeye.yaml", _handeye_truth(rig, built, session.recording))
    return counts | ({"mocap samples": len(session.recording.t_s)} if rig.mocap.file else {})


def _board_images(session: Simulation) -> list[_BoardImages]:
    """The stations take the names of camera.images, or of a folder stations/; the sweep a folder named like its csv."""
    rig, offset_s, motion = session.rig, session.clock_offset_s, session.motion
    pattern = rig.camera.images[0] if rig.camera and rig.camera.images else "stations/*.png"
    stations = session.listed_images or [_numbered(pattern, "station", k) for k in range(len(motion.station_s))]
    groups = [_BoardImages(stations, motion.station_H_OP, motion.station_s + offset_s)]
    if len(motion.sweep_s) and rig.mocap and len(rig.mocap.images) > 1:
        stem = PurePosixPath(rig.mocap.images[1]).stem
        sweep = [f"{stem}/{stem}_{k:03d}.png" for k in range(len(motion.sweep_s))]
        groups.append(_BoardImages(sweep, motion.sweep_H_OP, motion.sweep_s + offset_s))
    return groups


def _numbered(pattern: str, word: str, index: int) -> str:
    """``stations/*.png`` becomes ``stations/station_03.png``."""
    path = PurePosixPath(pattern)
    name = path.name.replace("*", f"{word}_{index:02d}") if path.name.count("*") == 1 else f"{word}_{index:02d}{path.suffix or '.png'}"
    return (path.parent / name).as_posix()


def _write_mocap(folder: Path, rig: Rig, built: Built, groups: Sequence[_BoardImages], recording: Recording, recipe: Recipe) -> None:
    mocap = rig.mocap
    if mocap is None:
        return
    if mocap.poses:
        H = recording_at(recording, groups[0].t_camera_s - built.clock_offset_s)
        H = se3.inv(H) if mocap.direction == "H_PO" else H
        q = se3.quaternion(H[:, :3, :3])
        lines = ["file,x_m,y_m,z_m,qx,qy,qz,qw"]
        base = PurePosixPath(mocap.poses).parent
        for k, name in enumerate(groups[0].names):
            lines.append(f"{_relative(name, base)}," + ",".join(f"{value:.7f}" for value in (*H[k, :3, 3], *q[k])))
        write_text(folder / mocap.poses, "\n".join(lines) + "\n")
        return
    if mocap.file:
        tracked = (recording.t_s, recording.H_OP, recording.error_m, recording.markers_O)
        write_motive(folder / mocap.file, mocap.body or "LightPanel", *tracked, recipe.tracking.rate_hz)
    for number, (csv_name, group) in enumerate(zip(mocap.images, groups, strict=False)):
        base = PurePosixPath(csv_name).parent
        rows = [f"{_relative(name, base)},{t:.6f}" for name, t in zip(group.names, group.t_camera_s, strict=True)]
        read = _readings(rig, built, group, [recipe.seed, 13, number])
        rows = [f"{row},{value:.4f}" for row, value in zip(rows, read, strict=True)] if len(read) else rows
        write_text(folder / csv_name, "\n".join(["file,time_s" + ",distance_m" * bool(len(read)), *rows]) + "\n")


def _readings(rig: Rig, built: Built, group: _BoardImages, seed: list[int]) -> Array:
    """What the distance sensor reads at board images; (0,) without one."""
    if built.beam is None or rig.board is None:
        return np.zeros(0)
    H_CB = se3.inv(built.H_PC) @ se3.inv(group.H_OP) @ built.H_OB
    distances = board_distances(built.beam, rig.board, built.bow_m, built.twist, H_CB)
    return built.beam.reads(distances, np.random.default_rng(seed))


def _relative(name: str, base: PurePosixPath) -> str:
    return PurePosixPath(name).relative_to(base, walk_up=True).as_posix()


def recording_at(recording: Recording, t_s: Array) -> Array:
    """Reported poses (N, 4, 4) at times t_s (N,), of the samples that were not lost."""
    seen = np.isfinite(recording.error_m)
    return se3.interpolate(recording.H_OP[seen], recording.t_s[seen], t_s)


def _handeye_truth(rig: Rig, built: Built, recording: Recording) -> dict[str, Any]:
    note = "z_B = bow (m - 0.7 u^2 - 0.3 v^2 + twist u v), u, v from -1 to 1 over the corners, m so that the mean over the corners is 0"
    clock = rig.mocap is not None and rig.mocap.file is not None
    return {
        "H_PC": built.H_PC,
        "H_PD": built.H_PD,
        "H_DC": built.H_DC,
        "H_OB": built.H_OB,
        "clock_offset_s": built.clock_offset_s if clock else None,
        "bad_stations": [{"station": station, "why": why} for station, why in recording.bad_stations],
        "marker_in_P_m": built.markers_P,
        "board": {"bow_m": built.bow_m, "twist": built.twist, "note": note},
    }


def _write_captures(folder: Path, session: Simulation, progress: Progress) -> dict[str, int]:
    """Spheres, objects, the flat field, and the truth of lights, spheres and surfaces."""
    truth, rig, recipe, studio = folder / "truth", session.rig, session.recipe, session.studio
    _write_lights(truth, session.built)
    spheres = studio.spheres
    if rig.camera and rig.camera.flat_field:
        write_image(folder / rig.camera.flat_field, studio.flat(np.random.default_rng([recipe.seed, 9])))
    total = len(rig.spheres) + len(rig.objects)
    for done, (name, capture) in enumerate(sphere_captures(studio)):
        write_capture(folder / rig.spheres[name].images, capture)
        progress("captures", done + 1, total)
    if spheres:
        found = {name: {"kind": s.kind, "centre_m": s.centre_C, "radius_m": s.radius_m} for name, s in spheres.items()}
        write_yaml(truth / "spheres.yaml", found)
    notes = {}
    for done, (name, capture) in enumerate(object_captures(studio, list(rig.objects))):
        write_capture(folder / rig.objects[name], capture)
        maps = {key: getattr(capture.truth, key) for key in ("normals", "depth", "albedo", "mask", "component")}
        write_surface(truth / "objects" / f"{name}.npz", maps)
        notes[name] = {"material": "diffuse", "note": capture.note}
        progress("captures", len(rig.spheres) + done + 1, total)
    if notes:
        write_yaml(truth / "objects.yaml", notes)
    return {"spheres": len(rig.spheres), "objects": len(rig.objects)}


def _write_lights(truth: Path, built: Built) -> None:
    entries: list[dict[str, Any]] = []
    for light in built.lights:
        entry: dict[str, Any] = {"name": light.name, "H_CL": light.H_CL}
        entry |= {"H_DL": light.H_DL, **(light.setting or {})} if light.H_DL is not None else {}
        entries.append(entry | {"intensity": light.intensity, "lit": len(light.power), "source_m": light.source_C})
    write_yaml(truth / "lights.yaml", {"lights": entries})
    write_leds(
        truth / "leds.npz", {light.name: (light.position_C, light.axis_C, light.power) for light in built.lights}, built.lights[0].exponent
    )
    write_field(truth, built.points_C, {light.name: light.field(built.points_C) for light in built.lights})


SESSION = "session"
"""The folder of the stops, in the rig's and in that of the truth."""
MESH_STEP_M = 0.0006
"""Edge of the true mesh's triangles, metres: they leave some micrometres of a surface that bends within 30 mm."""


def write_session(folder: Path, session: Simulation, name: str, stops: int, progress: Progress) -> dict[str, int]:
    """Write the path round an object of a name, with so many stops."""
    built, rig = session.built, session.rig
    recipe = quiet(session.recipe)
    path = tour.plan(built, name, stops, recipe.seed)
    trip = motion.round_trip(path.H_OC @ se3.inv(built.H_PC), recipe, np.random.default_rng([recipe.seed, 11]))
    moved = replace(path, H_CS=se3.inv(trip.station_H_OP @ built.H_PC) @ path.H_OS)
    recording = record(built, trip, recipe)
    body = rig.mocap.body if rig.mocap and rig.mocap.body else "LightPanel"
    tracked = (recording.t_s, recording.H_OP, recording.error_m, recording.markers_O)
    write_motive(folder / SESSION / "mocap.csv", body, *tracked, recipe.tracking.rate_hz)
    truth, names = folder / "truth" / SESSION, [f"stop_{k:02d}" for k in range(stops)]
    t_camera_s = trip.station_s + built.clock_offset_s
    write_poses(truth / "H_OC.csv", names, moved.H_OC, t_camera_s)
    write_yaml(truth / "object.yaml", {"name": name, "note": moved.shape.note, "H_OS": moved.H_OS})
    vertices_S, faces = tour.solid(moved.shape, MESH_STEP_M)
    write_solid(truth / "mesh.ply", se3.apply(moved.H_OS, vertices_S), se3.rotate(moved.H_OS, moved.shape.normal(vertices_S)), faces)
    for k, stop in enumerate(names):
        capture = session.studio.stop(moved.shape, moved.H_CS[k], np.random.default_rng([recipe.seed, 12, k]))
        write_capture(folder / SESSION / stop, capture, [f"time: {t_camera_s[k]:.6f} s", "mocap: ../mocap.csv"])
        maps = {key: getattr(capture.truth, key) for key in ("normals", "depth", "albedo", "mask", "component")}
        write_surface(truth / f"{stop}.npz", maps)
        progress("stops", k + 1, stops)
    write_text(truth / "README.md", SESSION_README)
    return {"stops": stops}


def quiet(recipe: Recipe) -> Recipe:
    """The recipe of a robot's path: a pose that is lost or flipped there is planted by tests, not by chance."""
    return replace(recipe, tracking=replace(recipe.tracking, flipped_stations=0, lost_stations=0))


SESSION_README = """# Truth of a session

    H_OC.csv     image,t_camera_s,x,y,z,qx,qy,qz,qw    true camera in the room at every stop
    object.yaml  H_OS: the object's frame in the room
    mesh.ply     the object in the room, metres, outward normals
    STOP.npz     normals, depth, albedo, mask, component a pixel, as those of objects/
"""


def write_capture(folder: Path, capture: Capture, more: Sequence[str] = ()) -> None:
    """A capture folder; `more` are further lines of its capture.yaml."""
    for name, image in capture.images.items():
        write_image(folder / f"{name}.png", image)
    lines = [*more, f"exposure: {1e3 * capture.exposure_s:g} ms", "gain: 1.0"]
    if capture.distance_m is not None:
        lines.append(f"distance: {1e3 * capture.distance_m:.1f} mm")
    if capture.exposures_s:
        lines.append("exposures: {" + ", ".join(f"{name}: {1e3 * seconds:g} ms" for name, seconds in capture.exposures_s.items()) + "}")
    write_text(folder / "capture.yaml", "\n".join(lines) + "\n")


def write_image(path: Path, image: Stored) -> None:
    """A noisy image packs best without a search for repeats, a dark one with runs: the smaller of the two is kept."""
    import cv2

    path.parent.mkdir(parents=True, exist_ok=True)
    ways = [cv2.IMWRITE_PNG_STRATEGY_HUFFMAN_ONLY, cv2.IMWRITE_PNG_STRATEGY_RLE] if path.suffix.lower() == ".png" else [None]
    if not cv2.haveImageWriter(path.name):
        raise InputError(
            "cannot be written as an image", where=str(path), needed="a name that ends in .png or .tif", todo="change the pattern"
        )
    packed = [cv2.imencode(path.suffix, image, [] if way is None else [cv2.IMWRITE_PNG_STRATEGY, way])[1].tobytes() for way in ways]
    path.write_bytes(min(packed, key=len))
