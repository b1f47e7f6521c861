"""The page of ``lpcal diff``: two rigs drawn over each other, and the table of what has changed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from lpcal import __version__
from lpcal.records.calibration import Calibration
from lpcal.records.comparison import CalibrationChange
from lpcal.report.page import script_json
from lpcal.report.rig_report import RigReport
from lpcal.report.scene import LineItem, LineScene, rig_scene
from lpcal.report.templates import environment

MARK = '<meta name="lpcal-page" content="diff">'
"""What tells the page from one of anybody else's."""


def render(names: tuple[str, str], rigs: tuple[Calibration, Calibration], change: CalibrationChange, lines: Sequence[str]) -> str:
    """The page."""
    scene = scene_of(rigs, change)
    return (
        environment()
        .get_template("diff.html")
        .render(
            mark=MARK,
            names=names,
            change=change,
            lines=lines,
            scene=None if scene is None else script_json(scene.document()),
            version=__version__,
        )
    )


def scene_of(rigs: tuple[Calibration, Calibration], change: CalibrationChange) -> LineScene | None:
    """The later rig, where each light stood before, and the arrow of its own change, what all share taken out."""
    own, scene = (rig_scene(RigReport(one.name, calibration=one)) for one in rigs)
    if scene is None or own is None:
        return None
    ghosts = [replace(item, tone="designed", layer="designed", thin=True) for item in own.items if item.kind in {"line", "point"}]
    sources = {light.name: light.source_C for light in rigs[1].lights if light.source_C is not None}
    arrows = [
        LineItem(
            kind="arrow",
            points=(sources[light.name] - light.moved_C)[None],
            by=light.moved_C,
            tone="poor" if light.says else "designed",
            layer="wings",
        )
        for light in change.lights
        if light.name in sources
    ]
    return replace(scene, items=(*ghosts, *scene.items, *arrows))
