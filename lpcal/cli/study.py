"""``lpcal study``: the two experiments of the LightPanel paper, table and plot."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.cli.engine_words import add_engine_words, engine_of_words, jobs_of
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.api.studies import Study, StudyCurve
    from lpcal.report.side_pages import PlotLine

FULL_SCALE = 2.55
"""Stored numbers of 8 bits a per cent of ambient light."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("which", choices=("phase-angle", "ambient"), help="what is varied: the lights' angle, or the ambient light")
    parser.add_argument("-o", "--output", type=Path, default=Path(), metavar="DIR", help="where table and plot go (default: here)")
    add_engine_words(parser, "trials")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Table, plot and a sentence, into a folder."""
    from lpcal.api.studies import ACROSS, study_on
    from lpcal.formats.outputs import marked, refuse_place, whole, write_text
    from lpcal.report.side_pages import SOFTWARE, PlotLine, plot_png

    of_table = marked("a study's table", *(across.replace(",", "") for across in ACROSS.values()))
    of_plot = marked("a study's plot", SOFTWARE)
    table, plot = options.output / f"study_{options.which}.csv", options.output / f"study_{options.which}.png"
    refuse_place(table, of_table)
    refuse_place(plot, of_plot)
    engine = engine_of_words(options.on, jobs_of(options.jobs), options.output)
    found = study_on(engine, options.which, progress=progress)
    scale = 1.0 if options.which == "phase-angle" else FULL_SCALE
    curves = [PlotLine(curve.name, scale * curve.x, curve.mean_percent) for curve in found.curves]
    lines = [f"{'x':>8} " + "".join(f"{curve.name[:24]:>26}" for curve in curves)]
    lines += [f"{x:8.1f} " + "".join(f"{curve.y[k]:26.3f}" for curve in curves) for k, x in enumerate(curves[0].x)]
    write_text(table, "\n".join(",".join(row) for row in _csv(found, curves)) + "\n", of_table)
    with whole(plot, of_plot) as draft:
        draft.write_bytes(plot_png(curves, found.across))
    document = {"study": options.which, "rows": [_row(curve) for curve in found.curves], "says": found.says}
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
