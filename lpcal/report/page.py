"""calib/report.html: what was found, how sure it is, and what it rests on, in one file that opens offline.

Nothing is loaded from anywhere: style, script, charts and pictures stand in the file.
"""

from __future__ import annotations

import base64
import json
from typing import Any

from lpcal import __version__
from lpcal.report.chain_sections import camera_section, handeye_section
from lpcal.report.light_sections import lights_section, spheres_section
from lpcal.report.rig_report import KINDS, RigReport, SurfaceReport
from lpcal.report.scene import layers_of, rig_caption, rig_scene, room_scene
from lpcal.report.templates import environment
from lpcal.report.verdict import headline, verdicts
from lpcal.report.wording import Document, with_sigma

FIGURES_SHOWN = 16

__all__ = ["RigReport", "SurfaceReport", "render"]


def render(report: RigReport, stamp: str = "") -> str:
    """The page, whole; a stage that is not there is said to be so. `stamp` stands in it and tells later what it was made from."""
    lines = verdicts(report)
    tone, sentence = headline(lines)
    rig = rig_scene(report)
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
            rig_layers=layers_of(rig),
            rig_caption=rig_caption(report),
            room=_script(room_scene(report)),
            surfaces=[_surface(surface) for surface in report.surfaces],
            provenance=[_provenance(kind, report) for kind in KINDS if report.get(kind)],
            missing=[kind for kind in KINDS if not report.get(kind)],
        )
    )


def data_uri(content: bytes, media: str = "image/png") -> str:
    """Content as a data: URI."""
    return f"data:{media};base64,{base64.b64encode(content).decode('ascii')}"


def script_json(value: Any) -> str:
    """JSON that may stand inside a script element."""
    return json.dumps(value, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _script(scene: Any) -> str | None:
    return None if scene is None else script_json(scene)


def _latest(report: RigReport) -> str:
    times = [str((document.get("provenance") or {}).get("time") or "") for document in report.documents.values() if document]
    return max(times, default="").replace("T", " ").replace("+00:00", " UTC")


def _surface(surface: SurfaceReport) -> dict[str, Any]:
    summary = surface.summary
    figures = [
        *(summary.get("counts_and_residuals") or {}).items(),
        *((f"{key}, s", value) for key, value in (summary.get("times_s") or {}).items()),
        ("peak memory, MB", summary.get("peak_memory_mb")),
    ]
    return {
        "name": surface.name,
        "relight": surface.relight,
        "pictures": [(what, data_uri(content)) for what, content in surface.pictures.items()],
        "pieces": [_piece(piece, summary) for piece in summary.get("components") or []],
        "notes": [str(note) for note in summary.get("notes") or []],
        "figures": [(str(key).replace("_", " "), _figure(value)) for key, value in figures if _is_figure(value)][:FIGURES_SHOWN],
    }


def _piece(piece: dict[str, Any], summary: Document) -> tuple[str, str]:
    depth, spread = piece.get("mean_depth_m"), piece.get("scale_std")
    label = f"piece {piece.get('label')}, {piece.get('pixels')} pixels"
    if summary.get("units") == "pixels" or not isinstance(depth, (int, float)):
        return label, "relative depth"
    return label, with_sigma(1000 * depth, None if spread is None else 1000 * depth * spread, "mm")


def _is_figure(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _figure(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:.4g}"


def _provenance(kind: str, report: RigReport) -> dict[str, Any]:
    stated = report.get(kind).get("provenance") or {}
    inputs = stated.get("inputs") or {}
    return {
        "file": f"{kind}.yaml",
        "version": stated.get("lpcal_version", "–"),
        "time": str(stated.get("time", "–")).replace("T", " ").replace("+00:00", " UTC"),
        "inputs": [(path, str(digest)) for path, digest in inputs.items()],
        "options": script_json(stated.get("options") or {}),
    }
