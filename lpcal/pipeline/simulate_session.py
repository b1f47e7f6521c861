"""The second part of a simulated rig folder: a robot's path round an object, its recording, a capture at every stop, and the truth.

``session/stop_00 ...`` are placed captures: their capture.yaml states the time on the camera's clock and the recording session/mocap.csv.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np

from lpcal.api.simulation import Simulation
from lpcal.formats.mocap_motive import write_motive
from lpcal.formats.outputs import write_text
from lpcal.formats.truth_folder import write_poses, write_solid, write_surface, write_yaml
from lpcal.geometry import se3
from lpcal.pipeline.simulated_captures import write_capture
from lpcal.records.outcome import Progress
from lpcal.simulate import motion, tour
from lpcal.simulate.recipe import Recipe
from lpcal.simulate.tracking import record

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
    write_text(truth / "README.md", README)
    return {"stops": stops}


def quiet(recipe: Recipe) -> Recipe:
    """The recipe of a robot's path: a pose that is lost or flipped there is planted by tests, not by chance."""
    return replace(recipe, tracking=replace(recipe.tracking, flipped_stations=0, lost_stations=0))


README = """# Truth of a session

    H_OC.csv     image,t_camera_s,x,y,z,qx,qy,qz,qw    true camera in the room at every stop
    object.yaml  H_OS: the object's frame in the room
    mesh.ply     the object in the room, metres, outward normals
    STOP.npz     normals, depth, albedo, mask, component a pixel, as those of objects/
"""
