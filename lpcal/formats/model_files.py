"""The folder of a model: mesh.ply, mesh.glb, mesh.obj, model.npz, summary.json; whole or not there.

All in metres in the frame of the placements: the room, or the body that the object rides on, its axes as the tracking has them. mesh.ply
has a vertex's normal, display colour and, as further properties, ``sigma_m``, ``disagreement_m`` and ``views``; model.npz holds the
arrays of the model by their names.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from lpcal import __version__
from lpcal.errors import InputError
from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.documents import plain
from lpcal.formats.outputs import summarised, whole
from lpcal.formats.record_documents import document_of, known_record_of, record_of
from lpcal.integration.mesh import DISPLAY_GAMMA
from lpcal.records.calibration import Calibration
from lpcal.records.model import Missing, ModelFigures, ObjectModel, RigEvidence, ViewInModel
from lpcal.records.provenance import Provenance

ARRAYS = ("vertices_A", "normals_A", "faces", "albedo", "sigma_m", "normal_sigma_rad", "disagreement_m", "seen_by")
SUMMARY = "summary.json"
FILES = {"mesh.ply", "mesh.glb", "mesh.obj", "model.npz", "model.html", "calibration.yaml", SUMMARY}
SINGLE = {"normals_A", "albedo", "sigma_m", "normal_sigma_rad", "disagreement_m"}
"""Arrays that are stored in single precision: the vertices need more, a room being large."""


MODEL = summarised("the folder of a model", "model", SUMMARY, FILES)
"""A model's folder, as an output: one may replace another."""


def write_model(
    folder: Path, model: ObjectModel, summary: Mapping[str, Any], page: str | None = None, refined: Calibration | None = None
) -> None:
    """Write the files of a model; `summary` adds to what the model says of itself, `refined` is the calibration as its views would have it.

    Raises
    ------
    UsageError, InputError
        As `whole`: something else than a model stands there.
    """
    with whole(folder, MODEL) as draft:
        draft.mkdir()
        arrays = {name: getattr(model, name) for name in ARRAYS}
        np.savez_compressed(draft / "model.npz", **{n: a.astype(np.float32) if n in SINGLE else a for n, a in arrays.items()})
        _write_meshes(draft, model)
        if page is not None:
            (draft / "model.html").write_text(page, encoding="utf-8")
        if refined is not None:
            write_calibration(draft / "calibration.yaml", refined, Provenance())
        files = {path.name: path.stat().st_size for path in sorted(draft.iterdir())}
        text = json.dumps(plain({**summary_of(model), **summary, "files": files}), indent=1)
        (draft / SUMMARY).write_text(text + "\n", encoding="utf-8")


def summary_of(model: ObjectModel) -> dict[str, Any]:
    """What summary.json says of a model itself."""
    return {
        "lpcal": 1,
        "kind": "model",
        "name": model.name,
        "units": "metres",
        "frame": model.frame,
        "figures": document_of(model.figures),
        "views": [document_of(view) for view in model.views],
        "missing": None if model.missing is None else document_of(model.missing),
        "rig": None if model.rig is None else document_of(model.rig),
        "versions": {"lpcal": __version__},
        "notes": list(model.warnings),
    }


def read_model(folder: Path) -> ObjectModel:
    """Read a model back from its folder.

    Raises
    ------
    InputError
        model.npz or summary.json is not there or lacks a part.
    """
    try:
        with np.load(folder / "model.npz") as stored:
            arrays = {name: stored[name].astype(float) if stored[name].dtype == np.float32 else stored[name] for name in ARRAYS}
        summary = json.loads((folder / SUMMARY).read_text(encoding="utf-8"))
        views = tuple(record_of(ViewInModel, entry) for entry in summary["views"])
        figures = record_of(ModelFigures, summary["figures"])
        missing = known_record_of(Missing, summary.get("missing"))
        rig = known_record_of(RigEvidence, summary.get("rig"))
    except (OSError, KeyError, ValueError, TypeError) as error:
        raise InputError(f"no whole model ({error})", where=str(folder), needed="what lpcal fuse writes", todo="run lpcal fuse") from error
    return ObjectModel(
        name=str(summary["name"]),
        frame=str(summary["frame"]),
        views=views,
        figures=figures,
        warnings=tuple(summary["notes"]),
        missing=missing,
        rig=rig,
        **arrays,
    )


def _write_meshes(draft: Path, model: ObjectModel) -> None:
    import trimesh

    display = np.rint(255 * model.colours ** (1 / DISPLAY_GAMMA)).astype(np.uint8)
    opaque = np.concatenate([display, np.full((len(display), 1), 255, np.uint8)], axis=1)

    def solid(**more: Any) -> trimesh.Trimesh:
        return trimesh.Trimesh(vertices=model.vertices_A, faces=model.faces, vertex_normals=model.normals_A, process=False, **more)

    attributes = {
        "sigma_m": model.sigma_m.astype(np.float32),
        "disagreement_m": model.disagreement_m.astype(np.float32),
        "views": model.seen_by.astype(np.uint8),
    }
    ply: bytes = solid(vertex_colors=opaque, vertex_attributes=attributes).export(file_type="ply", vertex_normal=True)
    frame = " ".join(model.frame.encode("ascii", "replace").decode().split())
    (draft / "mesh.ply").write_bytes(ply.replace(b"element vertex", f"comment frame {frame}, metres\nelement vertex".encode(), 1))
    (draft / "mesh.glb").write_bytes(solid(vertex_colors=opaque).export(file_type="glb", include_normals=True))
    (draft / "mesh.obj").write_text(solid(vertex_colors=opaque).export(file_type="obj", include_normals=True), encoding="utf-8")
