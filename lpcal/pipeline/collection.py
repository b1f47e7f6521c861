"""The table of many surfaces: surfaces.csv and surfaces.html in their folder, worst first."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.errors import InputError, LpcalError
from lpcal.formats.images import read_image
from lpcal.formats.outputs import marked, refuse_place, write_text
from lpcal.pipeline.reconstruct import Task
from lpcal.report.collection_page import MARK, Row, render
from lpcal.report.page import data_uri
from lpcal.report.pictures import png, shaded, shrink

THUMBNAIL = 120
"""Pixels of a surface's picture along its longer side: a screen shows some fifty."""
COLUMNS = tuple(one.name for one in fields(Row) if one.name != "picture")


@dataclass(frozen=True)
class Table:
    """The two files of a table, as outputs."""

    csv: str = "surfaces.csv"
    page: str = "surfaces.html"

    def refuse(self, root: Path) -> None:
        """Refuse to write where something else stands.

        Raises
        ------
        UsageError, InputError
            As `refuse_place`.
        """
        refuse_place(root / self.csv, CSV)
        refuse_place(root / self.page, PAGE)


CSV = marked("a table of surfaces", ",".join(COLUMNS))
PAGE = marked("a page of surfaces", MARK)
COLLECTION = Table()


def write_collection(root: Path, found: Sequence[tuple[Task, str, dict[str, Any], LpcalError | None]]) -> Path:
    """Write the table of what became of each capture; the page's path.

    Raises
    ------
    InputError
        They cannot be written.
    """
    rows = sorted((row_of(root, *one) for one in found), key=lambda row: (-row.doubt, row.name))
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    table.writerows([_written(getattr(row, column)) for column in COLUMNS] for row in rows)
    write_text(root / COLLECTION.csv, text.getvalue(), CSV)
    write_text(root / COLLECTION.page, render(root.resolve().name, rows), PAGE)
    return root / COLLECTION.page


def row_of(root: Path, task: Task, state: str, document: dict[str, Any], error: LpcalError | None) -> Row:
    """One capture's line: its figures, and how much is to be doubted, 1 for one that has no surface."""
    figures, pieces = document.get("counts_and_residuals", {}), document.get("components", [])
    metric = document.get("units") == "metres"
    largest = max(pieces, key=lambda piece: piece["pixels"], default=None)
    odds = max((one["odds"] for one in (largest or {}).get("alternatives", [])), default=None)
    picture = _picture(task.target) if document else None
    return Row(
        name=task.name,
        state=state,
        doubt=round(1.0 if not document else max(float(document.get("mask_doubt") or 0), float(odds or 0)), 3),
        pixels=figures.get("pixels"),
        pieces=len(pieces) if document else None,
        distance_mm=1e3 * largest["mean_depth_m"] if largest and metric else None,
        distance_std_mm=1e3 * largest["mean_depth_m"] * largest["scale_std"] if largest and metric else None,
        other_distance_odds=odds,
        mask_doubt=document.get("mask_doubt"),
        normal_std_deg=figures.get("normal_std_deg"),
        residual_sigmas=figures.get("residual_sigmas_rms"),
        solving_s=document.get("times_s", {}).get("solving"),
        peak_memory_mb=document.get("peak_memory_mb"),
        folder=_seen_from(root, task.target),
        notes=" | ".join(document.get("notes", [])),
        error="" if error is None else " ".join(str(error).split()),
        picture=data_uri(picture) if picture else None,
    )


def _seen_from(root: Path, target: Path) -> str:
    return target.relative_to(root).as_posix() if target.is_relative_to(root) else target.resolve().as_posix()


def _written(cell: Any) -> str:
    return "" if cell is None else f"{cell:.6g}" if isinstance(cell, float) else str(cell)


def _picture(folder: Path) -> bytes | None:
    """The shaded surface, small; None where its pictures are not there."""
    try:
        inside = read_image(folder / "mask.png").pixels > 0
        normals_gl = read_image(folder / "normals_gl.png").pixels
    except (InputError, OSError):
        return None
    return png(shrink(shaded((2 * normals_gl - 1) * np.array([1, -1, -1], np.float32)), inside, THUMBNAIL))
