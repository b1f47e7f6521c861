"""H_PD: the disc in the tracked body, from where its markers are on the disc and where the mocap system saw them.

Symbols: marker m at x_D,m by calipers, at x_P,m = median over time of inv(H_OP(t)) x_O,m(t): ``x_P,m = H_PD x_D,m``, a rigid fit. The
error is that of the calipers and of how the markers were stuck on, not the mocap's; the residuals show it, pooled with a prior.
"""

from __future__ import annotations

import numpy as np

from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import rigid_fit, se3
from lpcal.geometry.arrays import Array
from lpcal.records.observations import PoseStream

PRIOR_SIGMA_M = 5e-4
"""What calipers and glue leave, as a guess beforehand."""
PRIOR_FREEDOM = 4
"""Coordinates' worth of that guess."""
MISFIT_M = 0.01
"""A residual beyond which a marker is another one, or measured wrongly."""
CLEAN_RATIO, CLEAN_FLOOR_M = 5.0, 1e-3


def h_pd_from_markers(stream: PoseStream, markers_D: dict[str, tuple[float, float, float]]) -> tuple[Array, Array, dict[str, float]]:
    """H_PD (4, 4), its covariance (6, 6), and the misfit (m) of each marker.

    Parameters
    ----------
    stream : with marker tracks, named as in the file (a ``Body:`` before the name left out)
    markers_D : position (m) of each marker in D

    Raises
    ------
    DisagreementError
        A marker that the file does not hold (those that it holds are listed), or one that fits nowhere near.
    DegenerateError
        Fewer than three markers were seen, or they lie on a line.
    """
    absent = sorted(set(markers_D) - set(stream.markers_O))
    if absent:
        raise DisagreementError(
            f"no marker {', '.join(absent)} of {stream.body} in the mocap file",
            where="panel.markers",
            needed=f"names of those it holds: {', '.join(stream.markers_O) or 'none'}",
            todo="correct the names, export the marker tracks, or leave panel.markers out",
        )
    points_P = {name: _place(stream, name) for name in markers_D}
    seen = [name for name, x_P in points_P.items() if x_P is not None]
    if len(seen) < rigid_fit.FEWEST_POINTS:
        raise DegenerateError(f"{len(seen)} markers seen", where="panel.markers", needed=f"{rigid_fit.FEWEST_POINTS}, not on one line")
    measured_P = np.array([points_P[name] for name in seen])
    nominal_D = np.array([markers_D[name] for name in seen])
    _, _, residuals_P = rigid_fit.fit(measured_P, nominal_D, PRIOR_SIGMA_M)
    freedom = 3 * len(seen) - 6
    variance = (PRIOR_FREEDOM * PRIOR_SIGMA_M**2 + np.sum(residuals_P**2)) / (PRIOR_FREEDOM + freedom)
    H_PD, covariance, residuals_P = rigid_fit.fit(measured_P, nominal_D, float(np.sqrt(variance)))
    misfit = dict(zip(seen, np.linalg.norm(residuals_P, axis=1).tolist(), strict=True))
    worst = max(misfit, key=misfit.__getitem__)
    if misfit[worst] > MISFIT_M:
        raise DisagreementError(
            f"{worst} is {1e3 * misfit[worst]:.0f} mm from where panel.markers has it",
            where="panel.markers",
            needed=f"within {1e3 * MISFIT_M:.0f} mm",
            todo="measure it again, check names and signs, or leave panel.markers out",
        )
    return H_PD, covariance, misfit


def _place(stream: PoseStream, name: str) -> Array | None:
    """Median position (3,) of a marker in P over the samples in which body and marker were tracked well; None: never."""
    error = stream.error_m
    known = error[np.isfinite(error)]
    limit = CLEAN_RATIO * float(np.median(known)) + CLEAN_FLOOR_M if known.size else np.inf
    track_O = stream.markers_O[name]
    good = np.isfinite(track_O).all(axis=1) & ~(error > limit)
    if not good.any():
        return None
    H_PO = se3.inv(stream.H_OP[good])
    x_P = (H_PO[:, :3, :3] @ track_O[good, :, None])[..., 0] + H_PO[:, :3, 3]
    return np.asarray(np.median(x_P, axis=0))
