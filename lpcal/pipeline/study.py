"""``lpcal study``: an experiment of the LightPanel paper into a table, a plot and a sentence."""

from __future__ import annotations

from pathlib import Path

from lpcal.api.studies import ACROSS, Study, StudyCurve, Which, study
from lpcal.formats.outputs import marked, refuse_place, whole, write_text
from lpcal.records.outcome import Outcome, Progress
from lpcal.report.side_pages import SOFTWARE, PlotLine, plot_png

TABLE = marked("a study's table", *(across.replace(",", "") for across in ACROSS.values()))
PLOT = marked("a study's plot", SOFTWARE)
FULL_SCALE = 2.55
"""Stored numbers of 8 bits a per cent of ambient light."""


def write_study(which: Which, folder: Path, progress: Progress) -> Outcome:
    """``phase-angle`` or ``ambient``: table, plot and a sentence, into a folder."""
    table, plot = folder / f"study_{which}.csv", folder / f"study_{which}.png"
    refuse_place(table, TABLE)
    refuse_place(plot, PLOT)
    found = study(which, progress=progress)
    scale = 1.0 if which == "phase-angle" else FULL_SCALE
    curves = [PlotLine(curve.name, scale * curve.x, curve.mean_percent) for curve in found.curves]
    lines = [f"{'x':>8} " + "".join(f"{curve.name[:24]:>26}" for curve in curves)]
    lines += [f"{x:8.1f} " + "".join(f"{curve.y[k]:26.3f}" for curve in curves) for k, x in enumerate(curves[0].x)]
    write_text(table, "\n".join(",".join(row) for row in _csv(found, curves)) + "\n", TABLE)
    with whole(plot, PLOT) as draft:
        draft.write_bytes(plot_png(curves, found.across))
    document = {"study": which, "rows": [_row(curve) for curve in found.curves], "says": found.says}
    return Outcome([*lines, found.says, f"written {table}, {plot}"], document)


def _row(curve: StudyCurve) -> dict[str, object]:
    return {
        "name": curve.name,
        "best": curve.best,
        "as_good": list(curve.as_good),
        "mean_percent": curve.least_percent,
        "best_by_median": curve.best_by_median,
        "first_percent": float(curve.mean_percent[0]),
        "curve_percent": curve.mean_percent.tolist(),
    }


def _csv(found: Study, curves: list[PlotLine]) -> list[list[str]]:
    head = [found.across.replace(",", ""), *(curve.name.replace(",", "") for curve in curves)]
    return [head, *([f"{x:g}", *(f"{curve.y[k]:.4f}" for curve in curves)] for k, x in enumerate(curves[0].x))]
