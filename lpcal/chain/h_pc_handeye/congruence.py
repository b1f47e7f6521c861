r"""What is wrong with the data, found before any solve: whether the motions of body and camera can be one rigid motion.

Symbols: relative motions A_ij of the body and B_ij of the camera are one screw, seen in P and in C: equal angle and equal pitch. Data
that were inverted, reordered or mirrored on the way break this in ways of their own; each is undone in turn, and the one after which the
boards of all views coincide is named::

    inverted H_PO for H_OP       H_OP <- inv(H_OP)             quaternion order     components of R turned round by one
    mirrored                     M H_OP M, or the origin alone units, board's size  the ratio of the pitches
    pairing shifted              view k with pose k + s        rotations inverted   R <- R^T, the origin kept
    axes exchanged               x <- P x of the origin alone, or of all

Both streams inverted fit as well as the right ones: then H_PC and H_OB have changed roles, which only their size betrays.
Source: screw congruence, Chen, A screw motion approach to uniqueness analysis of head-eye geometry (1991); the table was measured.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from lpcal.chain.h_pc_handeye.cures import cures
from lpcal.errors import DisagreementError
from lpcal.geometry import park, se3
from lpcal.geometry.arrays import Array
from lpcal.records.calibration import Carries
from lpcal.records.digits import fine

FITS = 0.03
"""Misplacement of the board, as a share of its distance, up to which data count as one rigid motion; real ones leave 0.002 to 0.012."""
MENDS = 0.35
"""A cure counts where it lessens the misplacement to this share."""
SCALE_TOLERANCE = 0.2
BOARD_OFF = 0.004
"""Share by which the board's size must differ from the mocap's metre to be reported: a tenth of a millimetre in a square of 25."""
BOARD_SIGMAS = 3.0
"""Standard deviations by which it must differ: of sound data one session in 400 does."""
STUDENT = 1.28
"""Widens a sigma that comes from a dozen stretches of a session so that three of it are passed as rarely as three of a known one."""
FAR_M = 1.0
ALIKE = 3.0
NEARER = 0.7
MOST_VIEWS = 60
MOST_OFF = 30
"""Views off of which pairs are looked at: of more something else is wrong."""
UNITS = {1000.0: "mm", 100.0: "cm", 25.4: "inches", 0.001: "1/mm", 0.01: "1/cm", 1 / 25.4: "1/inches"}


@dataclass(frozen=True)
class Diagnosis:
    """One thing that is wrong, and the key or command that corrects it."""

    found: str
    todo: str
    misplaced: float
    """Misplacement of the board over its distance, as the data stand."""
    cured: float
    """The same after the cure, over its distance as the data stand."""
    reach_m: float
    """Distance of the camera from the body's origin after the cure."""

    def better_than(self, other: Diagnosis | None) -> bool:
        """Whether the cure is to be preferred: it fits better with the camera about as near, or as well with the camera nearer to the body.

        Inverting the mocap's or the board's poses corrects the same mistake; only one leaves the camera near the body.
        """
        if other is None or self.cured < other.cured / ALIKE:
            return True
        if self.cured < other.cured and NEARER * self.reach_m < other.reach_m:
            return True
        return self.cured < other.cured * ALIKE and self.reach_m < NEARER * other.reach_m


def misplacement(H_OP: Array, H_CB: Array) -> tuple[float, park.Consensus]:
    """Median misplacement of the board over its distance, and the closed form that leaves it."""
    agreed = park.consensus(H_OP, H_CB)
    return agreed.scatter_m / float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1))), agreed


def fits(H_OP: Array, H_CB: Array, agreed: park.Consensus) -> bool:
    """Whether a closed form explains most views."""
    distance = float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1)))
    scale = park.board_scale(H_OP[agreed.inliers], H_CB[agreed.inliers], agreed.H_PC[:3, :3])
    right_size = len(H_OP) < 8 or abs(np.log(max(abs(scale), 1e-9))) < SCALE_TOLERANCE
    return agreed.scatter_m < FITS * distance and right_size


def diagnose(H_OP: Array, H_CB: Array, *, from_images: bool = True) -> Diagnosis | None:
    """The likeliest thing wrong with panel poses H_OP (N, 4, 4) and board poses H_CB (N, 4, 4).

    None where they are one rigid motion, or where no known correction applies. `from_images`: lpcal found the boards itself, so that
    they are not inverted.
    """
    before, agreed = misplacement(H_OP, H_CB)
    if fits(H_OP, H_CB, agreed):
        return None
    some = np.linspace(0, len(H_OP) - 1, min(len(H_OP), MOST_VIEWS)).astype(int)
    best: Diagnosis | None = None
    for found, todo, poses, boards in cures(H_OP[some], H_CB[some], in_order=len(some) == len(H_OP), from_images=from_images):
        scaled = poses.copy()
        scale = _scale(poses, boards)
        if not np.isfinite(scale):
            continue
        scaled[:, :3, 3] /= scale
        cured, agreed = misplacement(scaled, boards)
        plain = abs(np.log(scale)) < SCALE_TOLERANCE
        if found is None and plain:
            continue
        words = found if plain else _with_scale(found, scale, from_images=from_images)
        if cured < min(MENDS * before, FITS):
            reach = float(np.linalg.norm(agreed.H_PC[:3, 3]))
            of_boards = not plain and not from_images and scale < 1
            mends = todo if plain and todo else _scale_todo(scale, todo, from_images=from_images)
            named = Diagnosis(words or "", mends, before, cured * (scale if of_boards else 1.0), reach)
            best = named if named.better_than(best) else best
    return best


def refuse(H_OP: Array, H_CB: Array, agreed: park.Consensus, *, from_images: bool = True) -> None:
    """Stop where the data are no rigid motion; `agreed` is their closed form.

    Raises
    ------
    DisagreementError
        With what is wrong and the key that corrects it, where that is known.
    """
    if fits(H_OP, H_CB, agreed):
        return
    before = agreed.scatter_m / float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1)))
    named = diagnose(H_OP, H_CB, from_images=from_images)
    distance = 1e3 * float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1)))
    if named is None:
        raise DisagreementError(
            f"body and camera do not move as one rigid thing: the board is misplaced by {before * distance:.0f} mm",
            needed="a camera fixed to the tracked body, a board that stays put, poses that belong to the images",
            todo="check which body is tracked, the images' times, and that neither camera nor board was moved on its own",
        )
    raise DisagreementError(
        f"{named.found} (the board is misplaced by {named.misplaced * distance:.0f} mm, by {named.cured * distance:.1f} mm once corrected)",
        needed="H_OP, the body's pose in the room, in metres, its quaternion in the order stated, paired with the right image",
        todo=named.todo,
    )


def exchanged(H_OP: Array, H_CB: Array, agreed: park.Consensus) -> list[tuple[int, int]]:
    """Pairs of views that do not fit the closed form, but would with each other's pose."""
    off = np.flatnonzero(~agreed.inliers)
    if not 2 <= len(off) <= MOST_OFF:
        return []
    within_m = FITS * float(np.median(np.linalg.norm(H_CB[:, :3, 3], axis=1)))

    def fit(pose: int, board: int) -> bool:
        """Whether a board is where the others are, under a pose."""
        placed = H_OP[pose] @ agreed.H_PC @ H_CB[board]
        turn = se3.angle_rad(placed[:3, :3].T @ agreed.H_OB[:3, :3])
        return bool(np.linalg.norm(placed[:3, 3] - agreed.H_OB[:3, 3]) < within_m and turn < ALIKE * FITS)

    rows = off.tolist()
    return [(i, j) for k, i in enumerate(rows) for j in rows[k + 1 :] if fit(i, j) and fit(j, i)]


def board_size_warning(scale: float, sigma: float, H_PC: Array, carries: Carries = "camera") -> str | None:
    """In words, where the mocap finds the board another size than it was said to have, by its scale and that one's sigma."""
    if abs(scale - 1) < max(BOARD_OFF, BOARD_SIGMAS * sigma):
        return None
    otherwise = ", ".join(f"{1e3 * value:.1f}" for value in H_PC[:3, 3] / scale)
    name, place = ("H_OC", "room") if carries == "board" else ("H_PC", "body")
    return (
        f"the mocap measures the board as {100 * scale:.2f} +- {fine(100 * sigma)} % of its stated size; which of the two is right these "
        f"data cannot tell. {name} is in the mocap's metres: if those are right, board.square is wrong (measure it over many squares); if "
        f"board.square is right, all of the mocap's lengths are wrong by as much and the camera is at {otherwise} mm in the {place}"
    )


def closed_form_size_warning(H_OP: Array, H_CB: Array, H_PC: Array, carries: Carries) -> str | None:
    """`board_size_warning` before any solve; None where the closed form does not determine the board's size that well."""
    sigma = STUDENT * park.board_scale_sigma(H_OP, H_CB)
    return None if sigma > BOARD_OFF else board_size_warning(park.board_scale(H_OP, H_CB, H_PC[:3, :3]), sigma, H_PC, carries)


def swapped_roles_warning(H_PC: Array, H_OB: Array) -> str | None:
    """In words, where H_PC is as large as a room."""
    far = float(np.linalg.norm(H_PC[:3, 3]))
    if far < FAR_M:
        return None
    return (
        f"the camera is {far:.2f} m from the body's origin: if it is not, both streams are inverted and H_PC and H_OB have changed roles "
        f"(the other one is {np.linalg.norm(H_OB[:3, 3]):.2f} m long); then turn round both mocap.direction and the board poses' direction"
    )


def behind_warning(H_CB: Array) -> str | None:
    """In words, where most boards of poses H_CB (N, 4, 4) lie behind the camera."""
    behind = int(np.sum(H_CB[:, 2, 3] < 0))
    if 2 * behind <= len(H_CB):
        return None
    return (
        f"in {behind} of {len(H_CB)} board poses the board lies behind the camera: they are inverted (mocap.board_poses.direction), or of "
        "a camera whose y looks up and z backwards (OpenGL, Blender, ARKit), and so is what is found of it; lpcal's has x right, y down, "
        "z forward"
    )


def _scale(H_OP: Array, H_CB: Array) -> float:
    """Size of the board by the mocap over its stated size; NaN where there is no sense in it."""
    agreed = park.consensus_of_rotations(H_OP, H_CB)
    if agreed is None:
        return float("nan")
    R_PC, inliers = agreed
    scale = park.board_scale(H_OP[inliers], H_CB[inliers], R_PC)
    return scale if scale > 1e-5 else float("nan")


def _with_scale(found: str | None, scale: float, *, from_images: bool) -> str:
    unit = _unit(scale)
    if unit and not unit.startswith("1/"):
        words = f"the mocap's lengths are in {unit}, not in metres"
        words += f", or the board's square is stated {scale:.0f} times too small" if from_images else ""
    elif unit and not from_images:
        words = f"the lengths of the board poses are in {unit.removeprefix('1/')}, not in metres"
    else:
        words = (
            f"the board's size is stated {1 / scale:.4g} times what the mocap measures"
            if scale < 1
            else (f"the mocap's lengths are {scale:.4g} times what the board says")
        )
    return words if found is None else f"{found}; and {words}"


def _scale_todo(scale: float, todo: str, *, from_images: bool) -> str:
    unit = _unit(scale) or ""
    key = f"write mocap.units: {unit}" if unit in {"mm", "cm"} else "correct board.square, or mocap.units"
    if unit.startswith("1/") and not from_images:
        name = unit.removeprefix("1/")
        key = f"name their columns x_{name}, y_{name}, z_{name}" if name in {"mm", "cm"} else "turn them into metres"
    return f"{todo}; {key}" if todo else key


def _unit(scale: float) -> str | None:
    return next((name for size, name in UNITS.items() if abs(scale / size - 1) < 0.1), None)
