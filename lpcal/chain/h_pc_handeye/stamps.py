"""Views left out of the solve whose pose fits at another time: images stamped late, on arrival and not at exposure.

Symbols: the pose that a view's board shows, ``H_OP = H_OB inv(H_PC H_CB)``, against the track at ``t - offset - d``; a lost or flipped pose
fits at no d, one of a wrong stamp at its own. Few views are late by chance, and in slow motion a late one cannot be distinguished from the
others, so it stays in and pulls the offset: hence a warning, though the views that show it are left out.
"""

from __future__ import annotations

import numpy as np

from lpcal.chain.h_pc_handeye.likelihood import Views, misfit
from lpcal.chain.h_pc_handeye.state import SolveState
from lpcal.geometry.arrays import Array
from lpcal.geometry.pose_track import poses_at

FEWEST = 3
"""Views that must fit at another time: one or two may by chance."""
MOST_OF = 0.5
"""Share of the views left out that must: where stamps are what is wrong nearly all do, while of views that are out by their noise one in
five fits somewhere."""
REACH_S = 0.3
"""Seconds by which a stamp may be off: several images of any camera that a panel is calibrated with."""
STEP_S = 0.0025
"""Seconds between the times that are tried: a hand moves a panel by a millimetre in it."""
LEAST_S = 0.01
"""Seconds from which a stamp is off: less is the clock's own scatter."""
FITS = 3.0
"""Times the rms misfit of the views used, within which a view fits."""
NAMED = 4


def late_stamps(state: SolveState, t_camera_s: Array) -> str | None:
    """In words, where views left out fit at other times than theirs; t_camera_s (N,) are the times of all views."""
    out = np.flatnonzero(state.panel.trusted & ~state.inliers)
    if state.track is None or len(out) < FEWEST:
        return None
    found = state.estimate()
    usual = np.array([np.sqrt(np.mean(of**2)) for of in misfit(state.views(), found)])
    tried = np.arange(-REACH_S, REACH_S + STEP_S / 2, STEP_S)
    panel = poses_at(state.track, (t_camera_s[out, None] - state.offset_s - tried).ravel())
    H_CB = np.repeat(state.boards.H_CB[out], len(tried), axis=0)
    shown = Views(H_CB, panel.H, panel.velocity, np.zeros(0, dtype=np.intp), np.zeros(0))
    off = np.max(np.stack(misfit(shown, found), axis=1) / usual, axis=1)
    off = np.where(panel.trusted, off, np.inf).reshape(len(out), len(tried))
    best = np.argmin(off, axis=1)
    late = (off[np.arange(len(out)), best] < FITS) & (np.abs(tried[best]) > LEAST_S)
    if late.sum() < max(FEWEST, MOST_OF * len(out)):
        return None
    images = [state.boards.images[row] for row in out[late]]
    more = f" and {len(images) - NAMED} more" if len(images) > NAMED else ""
    by_ms = 1e3 * float(np.median(tried[best[late]]))
    return (
        f"the stamps of {len(images)} images do not hold: {abs(by_ms):.0f} ms {'earlier' if by_ms > 0 else 'later'} (median) their views "
        f"fit as the others do: {', '.join(images[:NAMED])}{more}. They are left out; others that are as late in slow motion are not, and "
        "may bend H_PC and the clock offset beyond their sigmas: stamp the images at exposure, not on arrival"
    )
