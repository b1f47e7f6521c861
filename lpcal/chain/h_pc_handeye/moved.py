r"""Whether the board, or the camera in its mount, moved between two views of a session.

Symbols: views in the order in which they were taken, misplacement e_k of the board in view k; for a step after view m the views before and
after it have a board, or a camera, of their own::

    one rigid session:  H_OP H_PC H_CB = H_OB        board moved: H_OB, H'_OB        camera slipped: H_PC, H'_PC

A step is believed where two parts, each with all unknowns of its own, make the mean square misplacement `NEEDED` times smaller: twelve more
unknowns make it 1.2 times smaller by themselves, noise that wanders from view to view up to 2.7 times. Which of the two moved is what
explains both parts best with the other one shared.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from lpcal.errors import DisagreementError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array

FEWEST = 6
"""Views on either side of a step: with fewer a part fits by its own unknowns."""
NEEDED = 3.5
"""How many times smaller the mean square misplacement must be in two parts than in one; see tools/step_threshold.py."""
PLACES = 24
"""Places in a long session at which a step is looked for first; then every place near the likeliest."""
EXACT_M = 1e-6
"""Metres of misplacement up to which nothing moved: no mocap measures a micrometre, and poses that are exact scatter by rounding alone."""
BOARD = "the board"
TRIM = 0.9
"""Share of the views that count, those that fit best: a blurred or flipped one is no step."""


@dataclass(frozen=True)
class Step:
    """A step between two views that follow each other."""

    before: str
    after: str
    what: str
    """The board, or the camera in its mount."""
    distance_m: float
    angle_rad: float
    misplaced_m: float
    """Root mean square misplacement of all views taken as one session."""
    parted_m: float
    """The same of the two parts, each by itself."""
    needed: str = "a board that stays put and a camera fixed to the tracked body, from the first view to the last"

    def refusal(self) -> DisagreementError:
        """The step as an error."""
        return DisagreementError(
            f"{self.what} moved between {self.before} and {self.after}, by {1e3 * self.distance_m:.1f} mm and "
            f"{np.degrees(self.angle_rad):.2f} deg: as one session the board is misplaced by {1e3 * self.misplaced_m:.1f} mm rms, "
            f"each part by itself fits to {1e3 * self.parted_m:.1f} mm",
            needed=self.needed,
            todo="use the views of one part alone, or take the session again",
        )


def find_step(H_OP: Array, H_CB: Array, images: list[str], *, needed: float = NEEDED, board_carried: bool = False) -> Step | None:
    """The step in a session of views H_OP (N, 4, 4), H_CB (N, 4, 4) in their order; None where none shows.

    Where the board is carried, the poses are H_PO (see `set_up`), and a camera that moved has moved in the room.
    """
    count = len(H_OP)
    if count < 2 * FEWEST:
        return None
    whole = _fit(H_OP, H_CB)
    tried: dict[int, float] = {}
    for stride in (max(count // PLACES, 1), 1):
        middle = min(tried, key=lambda at: tried[at]) if tried else None
        places = range(FEWEST, count - FEWEST + 1, stride) if middle is None else range(middle - PLACES // 2, middle + PLACES // 2)
        for at in places:
            if at not in tried and FEWEST <= at <= count - FEWEST:
                tried[at] = _parted(H_OP, H_CB, at)
    at = min(tried, key=lambda place: tried[place])
    parted = tried[at]
    together = _trimmed(_squares(H_OP, H_CB, *whole))
    if together < EXACT_M**2 or not together > needed * parted:
        return None
    what, H = _which(H_OP, H_CB, at)
    step = Step(
        images[at - 1],
        images[at],
        what,
        float(np.linalg.norm(H[:3, 3])),
        float(se3.angle_rad(H[:3, :3])),
        float(np.sqrt(together)),
        float(np.sqrt(parted)),
    )
    if not board_carried:
        return step
    what = "the board on the body" if what == BOARD else "the camera in the room"
    return replace(step, what=what, needed="a camera that stays put and a board fixed to the tracked body, from the first view to the last")


def _parted(H_OP: Array, H_CB: Array, at: int) -> float:
    """Mean square misplacement of the two parts before and after view `at`, each by itself."""
    parts = [(H_OP[part], H_CB[part]) for part in _halves(at)]
    return _trimmed(np.concatenate([_squares(*part, *_fit(*part)) for part in parts]))


def _halves(at: int) -> tuple[slice, slice]:
    return slice(None, at), slice(at, None)


def _fit(H_OP: Array, H_CB: Array) -> tuple[Array, Array]:
    """The closed form, refitted without the views that miss it by far."""
    H_PC, H_OB = park.park(H_OP, H_CB)
    squares = _squares(H_OP, H_CB, H_PC, H_OB)
    good = squares <= np.quantile(squares, TRIM)
    return park.park(H_OP[good], H_CB[good]) if good.sum() >= FEWEST - 1 else (H_PC, H_OB)


def _squares(H_OP: Array, H_CB: Array, H_PC: Array, H_OB: Array) -> Array:
    """Squared misplacement (N,) of the board, its angle acting over half its distance."""
    angle, distance = park.residuals(H_OP, H_CB, H_PC, H_OB)
    lever = 0.5 * np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1))
    return np.asarray(distance**2 + (lever * angle) ** 2)


def _trimmed(squares: Array) -> float:
    """Mean of the smaller ones."""
    return float(np.sort(squares)[: max(int(TRIM * len(squares)), 1)].mean())


def _which(H_OP: Array, H_CB: Array, at: int) -> tuple[str, Array]:
    """What moved at a step, and its motion: of the board as seen from where it stood, of the camera as seen from its first mount."""
    candidates = []
    for own, other in (_halves(at), _halves(at)[::-1]):
        H_PC, H_OB = _fit(H_OP[own], H_CB[own])
        seen_OB = H_OP[other] @ H_PC @ H_CB[other]
        moved_OB = _mean(seen_OB)
        board = _trimmed(_squares(H_OP[other], H_CB[other], H_PC, moved_OB))
        candidates.append((board, BOARD, se3.inv(H_OB) @ moved_OB))
        moved_PC = _mean(se3.inv(H_OP[other]) @ H_OB @ se3.inv(H_CB[other]))
        camera = _trimmed(_squares(H_OP[other], H_CB[other], moved_PC, H_OB))
        candidates.append((camera, "the camera in its mount", se3.inv(H_PC) @ moved_PC))
    _, what, H = min(candidates, key=lambda candidate: candidate[0])
    return what, H


def _mean(H: Array) -> Array:
    """The median place and mean rotation of transforms (N, 4, 4)."""
    return se3.transform(se3.nearest_rotation(np.mean(H[:, :3, :3], axis=0)), np.median(H[:, :3, 3], axis=0))
