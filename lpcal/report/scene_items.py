"""What a drawing in space is made of: lines, points, labels, arrows and ellipsoids with a tone and a layer, in metres."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from lpcal.geometry.arrays import Array
from lpcal.report.page_data import FieldData, ItemData, LightValues, SceneData

type Kind = Literal["line", "point", "label", "arrow", "ellipsoid"]


@dataclass(frozen=True, kw_only=True)
class LineItem:
    """A line, a point, a label or an arrow; `points` (N, 3) metres, of an arrow its foot alone. Its look: tone, layer, and the flags."""

    kind: Kind
    points: Array
    tone: str
    layer: str
    by: Array | None = None
    """(3,) of an arrow, whose length the page may exaggerate: ``foot + k by``."""
    axes: Array | None = None
    """(3, 3) of an ellipsoid: its half axes, one a row, which the page may exaggerate."""
    text: str | None = None
    r: float | None = None
    """A point's radius, px."""
    fill: float | None = None
    """Opacity of a closed line's inside."""
    closed: bool = False
    thin: bool = False
    dash: bool = False
    bold: bool = False
    hollow: bool = False

    def document(self) -> ItemData:
        """The item as the page's script reads it: what is not set is left out."""
        item = ItemData(kind=self.kind, tone=self.tone, layer=self.layer)
        points = np.round(self.points, DIGITS).tolist()
        if self.by is None:
            item["p"] = points
        else:
            item["from"], item["by"] = points[0], np.round(self.by, DIGITS).tolist()
        if self.axes is not None:
            item["axes"] = np.round(self.axes, DIGITS + 2).tolist()
        if self.text is not None:
            item["text"] = self.text
        if self.r is not None:
            item["r"] = self.r
        if self.fill is not None:
            item["fill"] = self.fill
        for flag in FLAGS:
            if getattr(self, flag):
                item[flag] = True
        return item


FIELD_CELLS = 24
"""Cells along a side of a light's field: it is smooth."""


@dataclass(frozen=True)
class FieldPlane:
    """The lights' irradiance over the camera's view at the focus' depth: corners (4, 3) of the plane, and values (n, n) a light."""

    corners: Array
    values: dict[str, Array]
    """By light, of a surface that faces it, as a share of its own largest."""

    def document(self) -> FieldData:
        """The plane as the page's script reads it; values are per cent."""
        lights = [LightValues(name=name, values=np.round(100 * one).astype(int).ravel().tolist()) for name, one in self.values.items()]
        return {"size": FIELD_CELLS, "corners": np.round(self.corners, DIGITS).tolist(), "lights": lights}


@dataclass(frozen=True)
class LineScene:
    """What is drawn, the middle (3,) and radius of it all, which way is up, and from where it is seen at first, radians."""

    items: tuple[LineItem, ...]
    centre: Array
    radius: float
    up: Array
    yaw: float
    pitch: float
    field: FieldPlane | None = None
    """The lights' field over a plane."""

    def document(self) -> SceneData:
        """The scene as the page's script reads it."""
        return {
            "items": [item.document() for item in self.items],
            "centre": np.round(self.centre, DIGITS).tolist(),
            "radius": round(self.radius, DIGITS),
            "up": np.round(self.up, DIGITS).tolist(),
            "yaw": self.yaw,
            "pitch": self.pitch,
            "field": None if self.field is None else self.field.document(),
        }


FLAGS: tuple[Literal["closed", "thin", "dash", "bold", "hollow"], ...] = ("closed", "thin", "dash", "bold", "hollow")
"""Fields of an item that are given to the page's script only where they are true."""
DIGITS = 5
"""Decimals of a metre that the page is given: hundredths of a millimetre."""
