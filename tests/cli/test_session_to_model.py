"""A simulated session by the commands alone: calibrated, reconstructed, fused; and what wrong captures do to its model."""

from __future__ import annotations

import contextlib
import io
import json
import shutil
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from scipy.spatial import cKDTree

import lpcal
from lpcal.cli.main import main
from lpcal.formats.mocap_motive import write_motive
from lpcal.geometry import se3
from lpcal.pipeline.simulated_captures import write_capture
from lpcal.simulate import tour

pytest.importorskip("skimage")
pytestmark = pytest.mark.slow

SIZE, STOPS, STATIONS = (320, 204), 10, 12
STEP = "1mm"


def said(*words: str) -> dict:
    """What a command says as --json; it must go well."""
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main([*words, "--json"])
    assert code == 0, f"{words}: exit {code}\n{err.getvalue()[-2000:]}"
    return json.loads(out.getvalue())


@dataclass(frozen=True)
class Session:
    """A rig's folder with its session reconstructed, and the true surface in the room."""

    folder: Path
    vertices_O: np.ndarray
    normals_O: np.ndarray
    drawn: lpcal.Simulation

    def surface(self, stop: int) -> Path:
        return self.folder / "surfaces" / f"stop_{stop:02d}"

    def capture(self, stop: int) -> Path:
        return self.folder / "session" / f"stop_{stop:02d}"

    def model(self, target: Path, surfaces: list[Path]) -> tuple[dict, np.ndarray, float]:
        """Fused: what is said, errors of the vertices along the true normals in metres, and the normals' median error in degrees."""
        found = said("fuse", *map(str, surfaces), "-o", str(target), "--rig", str(self.folder), "--step", STEP)
        with np.load(target / "model.npz") as stored:
            x, n = stored["vertices_A"].astype(float), stored["normals_A"].astype(float)
        _, nearest = cKDTree(self.vertices_O).query(x)
        off = ((x - self.vertices_O[nearest]) * self.normals_O[nearest]).sum(axis=1)
        angle = np.degrees(np.arccos(np.clip((n * self.normals_O[nearest]).sum(axis=1), -1, 1)))
        return found, off, float(np.median(angle))


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Session:
    """Ten stops round a bust, all by commands."""
    import trimesh

    folder = tmp_path_factory.mktemp("session") / "rig"
    size = "x".join(map(str, SIZE))
    said("simulate", str(folder), "--session", str(STOPS), "--object", "bust", "--size", size, "--stations", str(STATIONS))
    said("run", str(folder))
    said("reconstruct", *(str(folder / "session" / f"stop_{k:02d}") for k in range(STOPS)), "--rig", str(folder), "--no-pages")
    mesh = trimesh.load(folder / "truth" / "session" / "mesh.ply", process=False, force="mesh")
    drawn = lpcal.simulate_rig(lpcal.read_rig(folder), image_size=SIZE, stations=STATIONS)
    return Session(folder, np.asarray(mesh.vertices), np.asarray(mesh.vertex_normals), drawn)


@pytest.fixture(scope="module")
def whole(session: Session, tmp_path_factory: pytest.TempPathFactory) -> tuple[dict, np.ndarray, float]:
    """The model of all stops."""
    return session.model(tmp_path_factory.mktemp("whole") / "model", [session.surface(k) for k in range(STOPS)])


def rms_mm(off: np.ndarray) -> float:
    return 1e3 * float(np.sqrt(np.mean(off**2)))


def test_from_a_session_to_a_model(whole: tuple[dict, np.ndarray, float]) -> None:
    """All stops are used; the model is within half a millimetre of the truth, its normals within a degree."""
    found, off, normals_deg = whole
    assert all(view["used"] for view in found["views"])
    assert rms_mm(off) < 0.5
    assert normals_deg < 1.2


@pytest.mark.parametrize("kind", ["20 mm too far", "flipped", "other object"])
def test_a_wrong_capture_is_named(session: Session, whole: tuple[dict, np.ndarray, float], tmp_path: Path, kind: str) -> None:
    """Its distance stated wrongly, its pose with the body's markers swapped, or another object: left out, the model as good without it."""
    stop, capture = 3, tmp_path / "stop_03"
    shutil.copytree(session.capture(stop), capture)
    recording = session.folder / "session" / "mocap.csv"
    words: list[str] = []
    if kind == "20 mm too far":
        (true,) = lpcal.read_surface(session.surface(stop)).components[:1]
        words = ["--distance", f"{1e3 * true.mean_depth_m + 20:.1f}mm"]
    if kind == "flipped":
        recording = flipped(recording, tmp_path / "flipped.csv")
    if kind == "other object":
        path = tour.plan(session.drawn.built, "stone", STOPS, 1)
        shot = session.drawn.studio.stop(path.shape, path.H_CS[stop], np.random.default_rng(5))
        write_capture(capture, shot, [line for line in (capture / "capture.yaml").read_text().splitlines() if line.startswith("time")])
    lines = [line for line in (capture / "capture.yaml").read_text().splitlines() if not line.startswith("mocap")]
    (capture / "capture.yaml").write_text("\n".join([*lines, f"mocap: {recording}"]) + "\n")
    said("reconstruct", str(capture), "--rig", str(session.folder), "-o", str(tmp_path / "surfaces"), "--no-pages", *words)
    written = next(path.parent for path in (tmp_path / "surfaces").rglob("surface.npz"))
    surfaces = [written if k == stop else session.surface(k) for k in range(STOPS)]
    found, off, _ = session.model(tmp_path / "model", surfaces)
    assert [k for k, view in enumerate(found["views"]) if not view["used"]] == [stop]
    assert any("left out" in note for note in found["notes"])
    assert rms_mm(off) < 1.5 * rms_mm(whole[1]) + 0.05


def flipped(recording: Path, target: Path) -> Path:
    """The recording as a system writes it that takes the body's markers for each other: the body turned by 72 degrees about its axis."""
    stream = lpcal.read_mocap(recording, "LightPanel")
    turned = stream.H_OP @ se3.transform(se3.rotation(np.array([0, 0, np.radians(72)])), np.zeros(3))
    write_motive(target, "LightPanel", stream.t_s, turned, stream.error_m, {}, stream.rate_hz)
    return target


def test_the_next_stop_shows_what_was_predicted(session: Session, tmp_path: Path) -> None:
    """A real view from the pose that is asked for: captured, reconstructed and fused, it adds about the area that was predicted."""
    seen = [session.surface(k) for k in (0, 1, 2, 3)]
    before, _, _ = session.model(tmp_path / "before", seen)
    asked = before["missing"]["stops"][0]
    path = tour.plan(session.drawn.built, "bust", STOPS, 1)
    H_OC = np.array(asked["H_AC"])
    shot = session.drawn.studio.stop(path.shape, se3.inv(H_OC) @ path.H_OS, np.random.default_rng(7))
    x, y, z, w = se3.quaternion(H_OC[:3, :3])
    at = ", ".join(f"{1e3 * value:.4f} mm" for value in H_OC[:3, 3])
    pose = [
        "pose:",
        f"  H_OC: {{position: [{at}], quaternion: [{x:.9f}, {y:.9f}, {z:.9f}, {w:.9f}]}}",
        "  tolerance: [0.2 mm, 0.05 deg]",
    ]
    write_capture(tmp_path / "next", shot, pose)
    said("reconstruct", str(tmp_path / "next"), "--rig", str(session.folder), "-o", str(tmp_path / "surface"), "--no-pages")
    written = next(path.parent for path in (tmp_path / "surface").rglob("surface.npz"))
    after, _, _ = session.model(tmp_path / "after", [*seen, written])
    assert all(view["used"] for view in after["views"])
    added = after["missing"]["area_m2"] - before["missing"]["area_m2"]
    twice = [one["missing"]["area_m2"] - one["missing"]["once_m2"] for one in (before, after)]
    assert 0.5 < added / asked["unseen_m2"] < 2
    assert 0.5 < (twice[1] - twice[0]) / asked["once_m2"] < 2
