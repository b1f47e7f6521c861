"""The plot of a study: error of the normals against what was varied."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass

from lpcal.geometry.arrays import Array

SOFTWARE = "lpcal study"
"""What the PNG says made it; it tells a plot of lpcal's from any other picture."""


@dataclass(frozen=True)
class PlotLine:
    """One line of the plot."""

    name: str
    x: Array
    y: Array
    """Mean relative error, per cent."""


def plot_png(curves: Sequence[PlotLine], across: str) -> bytes:
    """The curves as a PNG, error on a logarithmic axis."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(9, 4.2), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.add_subplot()
    for curve in curves:
        axes.semilogy(curve.x, curve.y, marker=".", label=curve.name)
    axes.set_xlabel(across)
    axes.set_ylabel("mean relative error of the normals, %")
    axes.grid(visible=True, which="both", alpha=0.25)
    figure.legend(frameon=False, fontsize="small", loc="outside right center")
    data = io.BytesIO()
    figure.savefig(data, format="png", dpi=130, metadata={"Software": SOFTWARE})
    return data.getvalue()
