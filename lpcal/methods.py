"""Methods to compare: ways from shading to normals and from normals to depth, each a function of one signature, in dicts to add to.

lpcal's own method finds normals, depth, light and shadows together; those here are baselines from the literature, each in a few readable
lines. `lpcal.reconstruct(..., method=..., integrator=...)` and ``lpcal reconstruct --method --integrator`` take their names,
`lpcal.evaluate` holds what they find against the truth. Your own is a function put into `NORMALS` or `INTEGRATORS`:

    lpcal.methods.NORMALS["mine"] = lambda shading: ...
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from lpcal.geometry.arrays import Array, Mask

__all__ = ["INTEGRATORS", "NORMALS", "Integrator", "NormalsMethod", "Shading", "cosines", "l1", "least_squares", "poisson", "ranks"]

FEWEST = 3
"""Fewest samples that determine a pixel's normal: it has three unknowns."""
IRLS_ROUNDS, IRLS_FLOOR = 12, 1e-3
"""Rounds of the reweighting, and the residual, as a share of the pixel's brightest sample, under which weights grow no more."""
DARKEST, BRIGHTEST = 0.3, 0.1
"""Shares of a pixel's samples that `ranks` leaves out at either end: shadows are more than highlights."""


@dataclass(frozen=True)
class Shading:
    """What the images show of P pixels under L lights: ``signal = B . b`` for a matte surface, b the normal times the albedo.

    Parameters
    ----------
    signal : ndarray (L, P)
        Linear, the ambient light taken away.
    sigma : ndarray (L, P)
        Standard deviations.
    usable : ndarray (L, P) of bool
        Not saturated.
    B : ndarray (L, P, 3)
        Unit direction in C to the light times its irradiance there.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> B = np.array([[0, 0, -1.0], [0.6, 0, -0.8], [0, 0.6, -0.8]])[:, None]  # three lights, one pixel
    >>> shading = lpcal.methods.Shading(B @ [0, 0, -0.5], np.full((3, 1), 0.01), np.ones((3, 1), bool), B)
    >>> shading.signal.ravel()
    array([0.5, 0.4, 0.4])
    """

    signal: Array
    sigma: Array
    usable: Mask
    B: Array


type NormalsMethod = Callable[[Shading], Array]
"""b (P, 3) of the shading: its direction is the normal in C, towards the camera, its length the albedo; NaN where it is not determined."""
type Integrator = Callable[[Array, Mask], Array]
"""u (H, W) from slopes (H, W, 2), ``du/dx`` and ``du/dy`` a pixel, within a mask (H, W): depth in pixels, or log depth with a camera."""


def least_squares(shading: Shading) -> Array:
    """b (P, 3) by least squares on all usable samples. Source: Woodham 1980.

    Parameters
    ----------
    shading : Shading
        What the images show of P pixels under L lights.

    Returns
    -------
    ndarray (P, 3)
        b, the normal in C times the albedo; NaN where three samples do not determine it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> B = np.array([[0, 0, -1.0], [0.6, 0, -0.8], [0, 0.6, -0.8], [-0.6, 0, -0.8]])[:, None]  # one pixel
    >>> shading = lpcal.methods.Shading(B @ [0, 0, -0.5], np.full((4, 1), 0.01), np.ones((4, 1), bool), B)
    >>> lpcal.methods.least_squares(shading).round(3) + 0.0
    array([[ 0. ,  0. , -0.5]])
    """
    return _weighted(shading, shading.usable.astype(float))


def l1(shading: Shading) -> Array:
    """b (P, 3) by the least sum of absolute residuals: shadows and highlights weigh less. Source: Ikehata et al. 2012, by IRLS.

    Parameters
    ----------
    shading : Shading
        What the images show of P pixels under L lights.

    Returns
    -------
    ndarray (P, 3)
        b, the normal in C times the albedo; NaN where three samples do not determine it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> B = np.array([[0, 0, -1.0], [0.6, 0, -0.8], [0, 0.6, -0.8], [-0.6, 0, -0.8]])[:, None]  # one pixel
    >>> shading = lpcal.methods.Shading(B @ [0, 0, -0.5], np.full((4, 1), 0.01), np.ones((4, 1), bool), B)
    >>> lpcal.methods.l1(shading).round(3) + 0.0
    array([[ 0. ,  0. , -0.5]])
    """
    b = least_squares(shading)
    floor = IRLS_FLOOR * np.max(np.where(shading.usable, shading.signal, 0.0), axis=0)
    for _ in range(IRLS_ROUNDS):
        residual = np.abs(shading.signal - np.einsum("lpi,pi->lp", shading.B, np.nan_to_num(b)))
        b = _weighted(shading, shading.usable / np.maximum(residual, np.maximum(floor, 1e-12)))
    return b


def ranks(shading: Shading) -> Array:
    """b (P, 3) by least squares without each pixel's darkest and brightest samples. Source: Rushmeier and Bernardini 1999.

    Parameters
    ----------
    shading : Shading
        What the images show of P pixels under L lights.

    Returns
    -------
    ndarray (P, 3)
        b, the normal in C times the albedo; NaN where three samples do not determine it.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> B = np.array([[0, 0, -1.0], [0.6, 0, -0.8], [0, 0.6, -0.8], [-0.6, 0, -0.8]])[:, None]  # one pixel
    >>> shading = lpcal.methods.Shading(B @ [0, 0, -0.5], np.full((4, 1), 0.01), np.ones((4, 1), bool), B)
    >>> lpcal.methods.ranks(shading).round(3) + 0.0
    array([[ 0. ,  0. , -0.5]])
    """
    brightness = np.where(shading.usable, shading.signal, -np.inf)
    rank = np.argsort(np.argsort(brightness, axis=0), axis=0)
    count = shading.usable.sum(axis=0)
    first = len(brightness) - count  # those that are not usable come first
    low, high = np.floor(DARKEST * count), np.floor(BRIGHTEST * count)
    enough = count - low - high >= FEWEST
    low, high = np.where(enough, low, 0), np.where(enough, high, 0)
    kept = (rank >= first + low) & (rank < len(brightness) - high)
    return _weighted(shading, (kept & shading.usable).astype(float))


def _weighted(shading: Shading, weight: Array) -> Array:
    """b (P, 3) by least squares with weights (L, P); NaN where fewer than three samples weigh anything or their lights lie in a plane."""
    N = np.einsum("lp,lpi,lpj->pij", weight, shading.B, shading.B)
    g = np.einsum("lp,lp,lpi->pi", weight, shading.signal, shading.B)
    scale = np.maximum(np.trace(N, axis1=1, axis2=2), 1e-30)
    determined = ((weight > 0).sum(axis=0) >= FEWEST) & (np.linalg.det(N / scale[:, None, None]) > 1e-9)
    b = np.full_like(g, np.nan)
    b[determined] = np.linalg.solve(N[determined], g[determined][..., None])[..., 0]
    return b


def poisson(slopes: Array, mask: Mask) -> Array:
    """u (H, W) by least squares over the mask's edges, the mean of each piece 0. Source: Horn and Brooks 1986.

    Parameters
    ----------
    slopes : ndarray (H, W, 2)
        ``du/dx`` and ``du/dy`` a pixel.
    mask : ndarray (H, W) of bool
        The pixels that count.

    Returns
    -------
    ndarray (H, W)
        u: depth in pixels, or log depth with a camera; NaN outside the mask.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> slopes = np.full((3, 3, 2), [0.5, 0.0])  # half a pixel deeper with each pixel to the right
    >>> lpcal.methods.poisson(slopes, np.ones((3, 3), bool)).round(3)[0] + 0.0
    array([-0.5,  0. ,  0.5])
    """
    from scipy import sparse
    from scipy.sparse.linalg import spsolve

    number = np.full(mask.shape, -1)
    number[mask] = np.arange(mask.sum())
    right, down = mask[:, :-1] & mask[:, 1:], mask[:-1] & mask[1:]
    a = np.concatenate([number[:, :-1][right], number[:-1][down]])
    b = np.concatenate([number[:, 1:][right], number[1:][down]])
    x, y = slopes[..., 0], slopes[..., 1]
    step = np.concatenate([((x[:, :-1] + x[:, 1:]) / 2)[right], ((y[:-1] + y[1:]) / 2)[down]])
    edge, pixels = np.arange(len(a)), int(mask.sum())
    D = sparse.csr_array((np.repeat([-1.0, 1.0], len(a)), (np.tile(edge, 2), np.concatenate([a, b]))), shape=(len(a), pixels))
    u = np.full(mask.shape, np.nan)
    u[mask] = spsolve(sparse.csc_array(D.T @ D + 1e-9 * sparse.eye_array(pixels)), D.T @ step)
    return u


def cosines(slopes: Array, mask: Mask) -> Array:
    """u (H, W) by cosine transforms over the whole image, slopes 0 outside the mask: fast, and bent where the mask ends at a step.

    Source: Frankot and Chellappa 1988, with the boundary of Simchony et al. 1990.

    Parameters
    ----------
    slopes : ndarray (H, W, 2)
        ``du/dx`` and ``du/dy`` a pixel.
    mask : ndarray (H, W) of bool
        The pixels that count.

    Returns
    -------
    ndarray (H, W)
        u: depth in pixels, or log depth with a camera; NaN outside the mask.

    Examples
    --------
    >>> import lpcal, numpy as np
    >>> slopes = np.full((3, 3, 2), [0.5, 0.0])  # half a pixel deeper with each pixel to the right
    >>> lpcal.methods.cosines(slopes, np.ones((3, 3), bool)).round(3)[0] + 0.0
    array([-0.5,  0. ,  0.5])
    """
    from scipy.fft import dctn, idctn

    p, q = (np.where(mask, slopes[..., k], 0.0) for k in range(2))
    x, y = np.zeros_like(p), np.zeros_like(q)
    x[:, :-1], y[:-1] = (p[:, :-1] + p[:, 1:]) / 2, (q[:-1] + q[1:]) / 2
    divergence = np.diff(x, axis=1, prepend=0) + np.diff(y, axis=0, prepend=0)
    rows, columns = mask.shape
    eigenvalue = 2 * (np.cos(np.pi * np.arange(rows) / rows)[:, None] + np.cos(np.pi * np.arange(columns) / columns) - 2)
    eigenvalue[0, 0] = 1.0
    u = idctn(dctn(divergence) / eigenvalue)
    return np.where(mask, u, np.nan)


NORMALS: dict[str, NormalsMethod] = {"least-squares": least_squares, "l1": l1, "ranks": ranks}
"""Ways from shading to normals, by name."""
INTEGRATORS: dict[str, Integrator] = {"poisson": poisson, "cosines": cosines}
"""Ways from normals to depth, by name; lpcal's own keeps steps, these do not."""
