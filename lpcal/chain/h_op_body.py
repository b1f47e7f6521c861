"""H_OP from bare marker tracks: the body's template, a rigid fit a sample, and the samples in which a marker took another's name.

Symbols: marker m at x_O,m(t), in the template at x_P,m: ``x_O,m = H_OP(t) x_P,m + e``. The template is the median, over the slower
half of the samples, of the tracks brought back by their own fits. A sample whose residual is beyond the usual is tried again without
each marker in turn, and with each two markers' names exchanged; what corrects it is kept and counted, what nothing corrects is lost::

    sigma^2 = sum |e|^2 / (3 markers - 6),   covariance of H_OP(t) = sigma^2 (sum J_m^T J_m)^-1

Where the markers' places in a frame of one's own are known, P is that frame; otherwise P has its origin at the markers' centre and the
room's axes of the sample that the template starts from.
Source: Kabsch 1976 (see `lpcal.geometry.rigid_fit`); leave-one-out against mislabelled markers is common practice.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass

import numpy as np

from lpcal.errors import DegenerateError
from lpcal.geometry import rigid_fit, se3
from lpcal.geometry.arrays import Array, Mask
from lpcal.records.observations import MarkerStream, PoseStream

FEWEST = rigid_fit.FEWEST_POINTS
ROUNDS = 4
LIMIT_SIGMAS = 6.0
"""Residual of a sample, rms a coordinate, over the usual one, beyond which it is tried again."""
FLOOR_M = 1e-4
SOME = 4000
"""Samples that a template is made of, at most."""
FLAT = 0.02
"""Second extent of the template over the first, under which it is a line."""
WORST_FIT = 0.05
"""Residual of the usual sample over the body's size, beyond which its markers are on no rigid body: systems reach a hundredth."""
MOST_MARKERS = 12
"""Beyond so many markers exchanged names are not tried: leaving one out is enough."""


@dataclass(frozen=True)
class _Fits:
    """One fit a sample; the tracks as they count."""

    H_OP: Array
    x_O: Array
    seen: Mask
    rms_m: Array
    """(N,) a coordinate, with the fit's freedom counted; NaN with fewer than three markers."""


def body_of(markers: MarkerStream, places_P: dict[str, tuple[float, float, float]] | None = None) -> PoseStream:
    """The poses of a body of three markers or more.

    Parameters
    ----------
    markers : the tracks
    places_P : where markers are in a frame P of one's own (m); used where three of them and more are named as in the file

    Raises
    ------
    DegenerateError
        Fewer than three markers together at any time, all on a line, or markers that move against each other.
    """
    seen = np.isfinite(markers.x_O).all(axis=2)
    template, reference = _template(markers.x_O, seen)
    fits = _fit(markers.x_O, seen, template)
    sigma_m = float(np.sqrt(np.nanmedian(fits.rms_m**2)))
    if sigma_m > WORST_FIT * float(np.sqrt(np.mean(np.sum(template**2, axis=1)))):
        raise _not_rigid(markers, fits, sigma_m)
    limit_m = LIMIT_SIGMAS * max(sigma_m, FLOOR_M)
    fits, repaired, exchanged = _mended(fits, template, limit_m)
    good = fits.rms_m <= limit_m
    if not good.any():
        raise DegenerateError("no sample in which the markers are one rigid body", needed="markers fixed to the body")
    template, frame = _placed(template, markers.names, places_P)
    H_OP, residual = rigid_fit.fit_each(fits.x_O[good], template, fits.seen[good])
    freedom = float(np.sum(3 * fits.seen[good].sum(axis=1) - 6))
    sigma_m = float(np.sqrt(np.sum(residual**2) / freedom)) if freedom > 0 else sigma_m
    error_m = np.linalg.norm(residual, axis=2).sum(axis=1) / fits.seen[good].sum(axis=1)
    track = np.where(fits.seen[good][..., None], fits.x_O[good], np.nan)
    frame = frame or f"origin their centre, axes the room's at {markers.t_s[reference]:.3f} s"
    notes = [f"{len(markers.names)} markers made a body ({frame}); they fit to {1e3 * sigma_m:.2f} mm"]
    notes += [f"{repaired} samples with one marker off: that one left out"] * bool(repaired)
    notes += [f"{exchanged} samples with two markers' names exchanged: put right"] * bool(exchanged)
    return PoseStream(
        markers.body,
        markers.t_s[good],
        H_OP,
        error_m,
        {name: track[:, m] for m, name in enumerate(markers.names)},
        lost=int(np.sum(~good)),
        rate_hz=markers.rate_hz,
        notes=(*markers.notes, *notes),
        covariance=rigid_fit.covariances(se3.apply(H_OP, np.broadcast_to(template, track.shape)), fits.seen[good], sigma_m),
        format=markers.format,
    )


def _not_rigid(markers: MarkerStream, fits: _Fits, sigma_m: float) -> DegenerateError:
    """Names the marker whose distances from the others vary most."""
    x_O = np.where(fits.seen[..., None], fits.x_O, np.nan)
    distance = np.linalg.norm(x_O[:, :, None] - x_O[:, None], axis=3)
    spread = np.nanmean(np.abs(distance - np.nanmedian(distance, axis=0)), axis=0)
    worst = int(np.argmax(np.nanmedian(spread + np.where(np.eye(len(spread), dtype=bool), np.nan, 0.0), axis=0)))
    return DegenerateError(
        f"the markers {', '.join(markers.names)} are not rigid together: they fit to {1e3 * sigma_m:.0f} mm, {markers.names[worst]} worst",
        needed="markers fixed to one body",
        todo="name the body in panel.yaml: mocap.body, or leave that marker out of the export",
    )


def _fit(x_O: Array, seen: Mask, template: Array) -> _Fits:
    H_OP, residual = rigid_fit.fit_each(x_O, template, seen)
    count = seen.sum(axis=1)
    freedom = np.maximum(3 * count - 6, 1)
    rms = np.where(count >= FEWEST, np.sqrt(np.sum(residual**2, axis=(1, 2)) / freedom), np.nan)
    return _Fits(H_OP, x_O, seen, rms)


def _template(x_O: Array, seen: Mask) -> tuple[Array, int]:
    """Markers (M, 3) in P, and the sample that they start from: the one whose distances are the usual ones."""
    whole = np.flatnonzero(seen.all(axis=1))
    if whole.size == 0:
        most = np.flatnonzero(seen.sum(axis=1) == seen.sum(axis=1).max())
        raise DegenerateError(
            f"the {x_O.shape[1]} markers are never seen together, {seen.sum(axis=1).max()} at most (in {most.size} samples)",
            needed="one moment with all of them",
            todo="leave out of the export those that are hardly ever seen",
        )
    some = whole[np.linspace(0, whole.size - 1, min(whole.size, SOME)).astype(int)]
    i, j = np.triu_indices(x_O.shape[1], 1)
    distance = np.linalg.norm(x_O[some][:, i] - x_O[some][:, j], axis=2)
    reference = int(some[np.argmin(np.max(np.abs(distance - np.median(distance, axis=0)), axis=1))])
    template = x_O[reference] - x_O[reference].mean(axis=0)
    extent = np.linalg.svd(template, compute_uv=False)
    if extent[1] < FLAT * extent[0]:
        raise DegenerateError("the markers lie on one line", needed=f"{FEWEST} that do not")
    step = np.linalg.norm(np.diff(x_O[some].mean(axis=1), axis=0, append=np.nan), axis=1)
    slow = some[step <= np.nanmedian(step)] if len(some) > 10 else some
    for _ in range(ROUNDS):
        fits = _fit(x_O[slow], seen[slow], template)
        good = fits.rms_m <= 2 * np.median(fits.rms_m) + FLOOR_M
        H_PO = se3.inv(fits.H_OP[good])
        template = np.median(se3.apply(H_PO, x_O[slow][good]), axis=0)
    return template - template.mean(axis=0), reference


def _mended(fits: _Fits, template: Array, limit_m: float) -> tuple[_Fits, int, int]:
    """The fits, those beyond the limit tried without one marker or with two exchanged, and how many each of these corrected."""
    bad = np.flatnonzero(fits.rms_m > limit_m)
    if not bad.size:
        return fits, 0, 0
    count = len(template)
    best_rms, best_x, best_seen = np.full(bad.size, np.inf), fits.x_O[bad].copy(), fits.seen[bad].copy()
    how = np.zeros(bad.size, dtype=int)
    orders = [(1, m, m) for m in range(count)] + [(2, a, b) for a, b in itertools.combinations(range(count), 2) if count <= MOST_MARKERS]
    for kind, a, b in orders:
        x_O, seen = fits.x_O[bad].copy(), fits.seen[bad].copy()
        if kind == 1:
            seen[:, a] = False
        else:
            x_O[:, [a, b]], seen[:, [a, b]] = x_O[:, [b, a]], seen[:, [b, a]]
        tried = _fit(x_O, seen, template)
        enough = seen.sum(axis=1) >= (FEWEST if kind == 2 else FEWEST + 1 if count > FEWEST + 1 else FEWEST)
        better = enough & (tried.rms_m < 0.7 * best_rms) & (tried.rms_m <= limit_m)
        best_rms[better], how[better] = tried.rms_m[better], kind
        best_x[better], best_seen[better] = x_O[better], seen[better]
    x_O, seen = fits.x_O.copy(), fits.seen.copy()
    x_O[bad], seen[bad] = best_x, best_seen
    return _fit(x_O, seen, template), int(np.sum(how == 1)), int(np.sum(how == 2))


def _placed(template: Array, names: tuple[str, ...], places_P: dict[str, tuple[float, float, float]] | None) -> tuple[Array, str]:
    """The template in the frame that its markers' stated places give it, and which frame it is, in words."""
    known = [m for m, name in enumerate(names) if places_P and name in places_P]
    if len(known) < FEWEST or places_P is None:
        return template, ""
    H_PT, _, _ = rigid_fit.fit(np.array([places_P[names[m]] for m in known]), template[known])
    return se3.apply(H_PT, template), "in the frame of panel.markers"
