"""The page of ``lpcal diff``: two rigs drawn over each other, and the table of what has changed."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from lpcal import __version__
from lpcal.records.comparison import CalibrationChange
from lpcal.report.page import script_json
from lpcal.report.rig_report import RigReport, array, items
from lpcal.report.scene import Scene, rig_scene
from lpcal.report.templates import environment
from lpcal.report.wording import Document

MARK = '<meta name="lpcal-page" content="diff">'
"""What tells the page from one of anybody else's."""


def render(names: tuple[str, str], documents: tuple[Document, Document], change: CalibrationChange, lines: Sequence[str]) -> str:
    """The page."""
    scene = scene_of(documents, change)
    return (
        environment()
        .get_template("diff.html")
        .render(
            mark=MARK,
            names=names,
            change=change,
            lines=lines,
            scene=None if scene is None else script_json(scene),
            version=__version__,
        )
    )


def scene_of(documents: tuple[Document, Document], change: CalibrationChange) -> Scene | None:
    """The later rig, where each light stood before, and the arrow of its own change, what all share taken out."""
    before, after = (RigReport(str(one.get("name", "")), {"calibration": one}) for one in documents)
    scene, own = rig_scene(after), rig_scene(before)
    if scene is None or own is None:
        return None
    ghosts = [dict(item, tone="designed", layer="designed", thin=True) for item in own["items"] if item["kind"] in {"line", "point"}]
    placed = {entry["name"]: array(entry["source_m"]) for entry in items(after.get("calibration"), "lights") if entry.get("source_m")}
    arrows = [
        {"kind": "arrow", "from": np.round(placed[light.name] - light.moved_C, 5).tolist(), "by": np.round(light.moved_C, 5).tolist(),
         "tone": "poor" if light.says else "designed", "layer": "wings"}
        for light in change.lights
        if light.name in placed
    ]  # fmt: skip
    return scene | {"items": [*ghosts, *scene["items"], *arrows]}
