"""Has my rig moved: two calibrations of one rig, part by part, each change with what an unmoved rig shows.

Where both calibrations know what their chrome spheres showed, the spheres of both days are solved in one problem
(`chain.refine_lights.moved_lights`): what is wrong with both alike cancels, and the highlights' own scatter says what is chance.
`tools/moved_rigs.py` says what that can see.

Calibrations alone: what one calibration's spheres are off by moves all its lights together, a shift, a turn and a scale. These seven are
fitted and reported as what the lights share; each light is then held against the prediction by all others: their own
scatter, with what is expected of it, says what an unmoved light shows. That sees less: on simulated rigs of six lights and four chrome
spheres, placed again for each calibration, a light's own scatter is 0.2 mm across and 0.6 mm along; one moved by 1.5 mm is named in half of
the trials, by 2 mm in two thirds, and no unmoved one in 20 pairs.

Which of many points has moved against the others: blocks of a linear model, each held against what the rest predicts.

Symbols: block k has c values, ``y_k = J_k x + e_k``, x (n,) common to all blocks, e of one unknown variance; r residuals of least squares,
H the hat matrix ``J (J^T J)^-1 J^T``::

    d_k = (I - H_kk)^-1 r_k                      what block k is off from the prediction by all others
    F_k = (r_k . d_k / c) / (SSE_k / (m - n - c)),    SSE_k = SSE - r_k . d_k

F_k has the F distribution with c and m - n - c degrees of freedom where block k has not moved: its own error does not hide it. The
scatter that is expected beforehand adds to SSE_k and to the degrees of freedom. Errors that
all blocks share lie in x and cancel, whatever they are. Source: Cook and Weisberg, Residuals and Influence in Regression (1982), 2.2.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from lpcal.chain.refine_lights.moved_lights import Day, moved_lights
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import se3
from lpcal.geometry.arrays import Array
from lpcal.geometry.camera_difference import pixel_grid, projection_difference
from lpcal.records.calibration import Calibration, Camera, Light, LightsSolution
from lpcal.records.comparison import UNLIKELY, CalibrationChange, LightChange, PartChange

ALONG = 3.0
"""How much less certain a light's distance is than its place across: one highlight shows the place across, the distance takes two or more
spheres (measured on simulated rigs: 0.55 mm against 0.18 mm of scatter between two calibrations)."""
OWN_SHARE = 0.12
"""How much of the two stated sigmas of a light's place is its own and not common to all lights or to both calibrations, across (simulated
rigs of four chrome spheres: 0.23 mm of 1.9)."""
OWN_AXIS_RAD, OWN_POWER = 7e-3, 3e-3
"""Scatter of a light's axis, radians, and of its intensity, relative, between two calibrations that are good ones."""
WORTH = 20.0
"""Degrees of freedom that the expected scatter is worth: as many as twelve lights have of their own."""
FEWEST = 4
"""Lights that both must hold: three and the seven numbers that they share leave nothing to hold a fourth against."""
SAME_CAMERA_PX = 0.5
"""Two cameras without a covariance whose projections differ by less, rms over the image, are taken as one."""
INVERTED_PX = 1e-3
"""A pixel whose ray does not project back to it this closely lies where the lens cannot be inverted, and is left out."""


def compare_calibrations(
    before: Calibration,
    after: Calibration,
    *,
    H_PC_covariances: tuple[Array | None, Array | None] = (None, None),
    solutions: tuple[LightsSolution | None, LightsSolution | None] = (None, None),
) -> CalibrationChange:
    """Compare two calibrations of one rig: what has moved, by how much, and whether it is more than chance.

    Parameters
    ----------
    before, after : Calibration
        Two calibrations of one rig.
    H_PC_covariances : pair of ndarray (6, 6), optional
        Those of the camera in the tracked body, which a calibration does not hold.
    solutions : pair of LightsSolution, optional
        What the calibrations' lights rest on, as `refine_lights` returns it or lights.yaml holds it: with the chrome spheres of both days a
        light's move is seen several times better.

    Returns
    -------
    CalibrationChange
        Every light's change against the others (metres, radians, a share of its intensity) with its standard deviation; what all lights
        share; the hand-eye; the camera. ``changed`` says what is more than chance (three sigma, all lights counted);
        ``lights[k].least`` how small a change of each light would have shown.

    Raises
    ------
    DisagreementError
        One has near lights and the other distant ones.
    DegenerateError
        They have fewer than four lights in common.

    Examples
    --------
    >>> import lpcal
    >>> from dataclasses import replace
    >>> rig = lpcal.assemble_calibration(lpcal.design_lights(lpcal.read_rig("lightpanel-12")))
    >>> moved = replace(rig.lights[2], source_C=rig.lights[2].source_C + [0.006, 0, 0])
    >>> after = replace(rig, lights=(*rig.lights[:2], moved, *rig.lights[3:]))
    >>> [light.name for light in lpcal.compare_calibrations(rig, after).lights if light.says]
    ['L2']
    """
    names = [light.name for light in before.lights if light.name in {other.name for other in after.lights}]
    if len(names) < FEWEST:
        raise DegenerateError(
            f"{len(names)} lights in common", where=f"{before.name}, {after.name}", needed=f"{FEWEST} at least, by their names"
        )
    old, new = ([next(light for light in one.lights if light.name == name) for name in names] for one in (before, after))
    near = {light.source_C is not None for light in (*old, *new)}
    if len(near) > 1:
        raise DisagreementError(
            "near lights in one, distant ones in the other", where=f"{before.name}, {after.name}", needed="lights of one kind"
        )
    exchanged = _exchanged(old, new)
    camera, said = _camera(before.camera, after.camera)
    cameras = (before.camera, after.camera if _is_another(camera) else before.camera)
    seen = _by_spheres(cameras, solutions, old, new, exchanged) if near == {True} else None
    places = seen.places if seen is not None else _places(old, new) if near == {True} else _directions(old, new)
    axes = _axes(old, new) if near == {True} else None
    powers = _powers(old, new)
    lights = tuple(_light(k, name, places, axes, powers) for k, name in enumerate(names))
    if seen is not None:
        lights = tuple(_in_own_frame(one, k, seen, old[k], solutions[0]) for k, one in enumerate(lights))
    swapped = {name for pair in exchanged for name in pair}
    all_names = [*dict.fromkeys(light.name for one in (before, after) for light in one.lights)]
    return CalibrationChange(
        lights=tuple(light for light in lights if light.name not in swapped) if exchanged else lights,
        together=_together(places.common, old, new, float("nan") if seen is None else seen.shared_chance),
        scale=float(places.common[6]) if places.common.size > 6 else 0.0,
        handeye=_handeye(before.H_PC, after.H_PC, H_PC_covariances),
        camera=camera,
        exchanged=exchanged,
        missing=tuple(name for name in all_names if name not in names),
        notes=said,
        highlight_px=float("nan") if seen is None else seen.scatter_px,
        either=() if seen is None else tuple(names[k] for k in seen.either),
        distant=near == {False},
    )


@dataclass(frozen=True)
class _Seen:
    """What the spheres of both days say."""

    places: OddOnes
    covariance: Array
    """(L, 3, 3) of `places.off`."""
    scatter_px: float
    either: tuple[int, ...]
    shared_chance: float


def _by_spheres(
    cameras: tuple[Camera | None, Camera | None],
    solutions: tuple[LightsSolution | None, LightsSolution | None],
    old: list[Light],
    new: list[Light],
    exchanged: Sequence[tuple[str, str]],
) -> _Seen | None:
    """The lights held against each other by the chrome spheres; None where they say too little."""
    if solutions[0] is None or solutions[1] is None or cameras[0] is None or cameras[1] is None or exchanged:
        return None
    days = Day(solutions[0].spheres, cameras[0]), Day(solutions[1].spheres, cameras[1])
    sources_C = np.array([[light.source_C for light in one] for one in (old, new)])
    axes_C = np.array([np.full((3, 3), np.nan) if light.H_CL is None else light.H_CL[:3, :3] for light in new])
    found = moved_lights(*days, sources_C, axes_C, [light.name for light in old], UNLIKELY)
    if found is None:
        return None
    std = np.sqrt(np.diagonal(found.covariance, axis1=1, axis2=2))
    places = OddOnes(found.common, found.moved_C, std, found.chance, found.freedom)
    return _Seen(places, found.covariance, found.scatter_px, found.either, found.shared_chance)


def _is_another(camera: PartChange) -> bool:
    """Whether the camera is to be taken as changed: if not, one of the two serves both days, and its errors cancel."""
    return camera.chance < UNLIKELY if np.isfinite(camera.chance) else not camera.moved < SAME_CAMERA_PX


def _in_own_frame(one: LightChange, k: int, seen: _Seen, light: Light, solution: LightsSolution | None) -> LightChange:
    """A change along a light's arm, sideways and along its emission, and the turns that would do it."""
    if light.H_CL is None:
        return one
    R = light.H_CL[:3, :3]
    own, std = R.T @ seen.places.off[k], np.sqrt(np.diag(R.T @ seen.covariance[k] @ R))
    setting = None if solution is None or not solution.evidence.settings else solution.evidence.settings.get(light.name)
    if setting is not None:
        reach_m = setting.d1_m + setting.d2_m * np.cos(np.radians(setting.joint_angle_deg))
        one = replace(
            one,
            by_azimuth_rad=float(own[1] / reach_m),
            by_azimuth_std_rad=float(std[1] / reach_m),
            by_joint_rad=float(own[2] / setting.d2_m),
            by_joint_std_rad=float(std[2] / setting.d2_m),
        )
    return replace(one, moved_L=own, moved_L_std=std)


def _places(old: list[Light], new: list[Light]) -> OddOnes:
    """Sources, by a shift, a turn and a scale about their middle; whitened so that along is `ALONG` times less sure."""
    before, after = (np.array([light.source_C for light in one]) for one in (old, new))
    out = np.array([light.direction_C for light in old])
    white = np.eye(3) - (1 - 1 / ALONG) * out[:, :, None] * out[:, None]
    lever = before - before.mean(axis=0)
    J = np.concatenate([np.tile(np.eye(3), (len(old), 1, 1)), -se3.hat(lever), lever[..., None]], axis=2)
    found = peeled(white @ J, np.einsum("kij,kj->ki", white, after - before), _expected_m(old, new), WORTH, UNLIKELY)
    back = np.linalg.inv(white)
    off = np.einsum("kij,kj->ki", back, found.off)
    return OddOnes(found.common, off, found.off_std * np.sqrt((2 + ALONG**2) / 3), found.chance, found.freedom)


def _expected_m(old: list[Light], new: list[Light]) -> float:
    """The scatter across that two calibrations leave an unmoved light, by their stated sigmas; of lights that state none, a mm's."""
    stated = np.array([[light.position_std_m for light in one] for one in (old, new)])
    return OWN_SHARE * (float(np.sqrt(np.sum(np.mean(stated**2, axis=1)))) if np.isfinite(stated).all() else 1e-3)


def _directions(old: list[Light], new: list[Light]) -> OddOnes:
    """Directions of distant lights, by a turn."""
    before, after = (np.array([light.direction_C for light in one]) for one in (old, new))
    stated = np.array([[light.direction_std_rad for light in one] for one in (old, new)])
    expected_rad = float(np.sqrt(np.sum(np.mean(stated**2, axis=1)))) if np.isfinite(stated).all() else OWN_AXIS_RAD
    return _turned(before, after, expected_rad)


def _axes(old: list[Light], new: list[Light]) -> OddOnes | None:
    """Axes of emission, by a turn; None where a light has none."""
    if any(light.axis_C is None for light in (*old, *new)):
        return None
    before, after = (np.array([light.axis_C for light in one]) for one in (old, new))
    return _turned(before, after, OWN_AXIS_RAD)


def _turned(before: Array, after: Array, expected_rad: float) -> OddOnes:
    """Unit vectors (K, 3): their change across, by a turn common to all."""
    side = np.cross(before, np.where(np.abs(before[:, 2:]) < 0.9, [[0, 0, 1.0]], [[1.0, 0, 0]]))
    side /= np.linalg.norm(side, axis=1, keepdims=True)
    across = np.stack([side, np.cross(before, side)], axis=1)
    found = peeled(across @ -se3.hat(before), np.einsum("kij,kj->ki", across, after - before), expected_rad, WORTH, UNLIKELY)
    off = np.einsum("kij,ki->kj", across, found.off)
    return OddOnes(np.concatenate([np.zeros(3), found.common]), off, found.off_std, found.chance, found.freedom)


def _powers(old: list[Light], new: list[Light]) -> OddOnes:
    """Logarithms of intensities, by a factor common to all."""
    stated = np.array([[light.intensity_std for light in one] for one in (old, new)])
    expected = max(OWN_POWER, float(np.sqrt(np.sum(np.mean(stated**2, axis=1)))) if np.isfinite(stated).all() else OWN_POWER)
    before, after = (np.log([light.intensity.mean() for light in one]) for one in (old, new))
    return peeled(np.ones((len(old), 1, 1)), (after - before)[:, None], expected, WORTH, UNLIKELY)


def _light(k: int, name: str, places: OddOnes, axes: OddOnes | None, powers: OddOnes) -> LightChange:
    """One light's changes, and which are more than chance."""
    moved, turned = float(np.linalg.norm(places.off[k])), float("nan") if axes is None else float(np.linalg.norm(axes.off[k]))
    found = (("moved", places), ("turned", axes), ("power", powers))
    return LightChange(
        name=name,
        moved_C=places.off[k],
        moved=moved,
        moved_std=float(np.sqrt(np.mean(places.off_std[k] ** 2))),
        turned_rad=turned,
        turned_std_rad=float("nan") if axes is None else float(np.sqrt(np.mean(axes.off_std[k] ** 2))),
        power=float(np.expm1(powers.off[k, 0])),
        power_std=float(powers.off_std[k, 0]),
        says=tuple(what for what, one in found if one is not None and one.chance[k] < UNLIKELY),
    )


def _exchanged(old: list[Light], new: list[Light]) -> tuple[tuple[str, str], ...]:
    """Pairs of lights each of which is nearer to where the other stood than to its own place."""
    before, after = (np.array([light.direction_C if light.source_C is None else light.source_C for light in one]) for one in (old, new))
    nearest = np.linalg.norm(after[:, None] - before[None], axis=2).argmin(axis=1)
    pairs = [(k, int(j)) for k, j in enumerate(nearest) if k < j and nearest[j] == k]
    return tuple((old[k].name, old[j].name) for k, j in pairs)


def _together(common: Array, old: list[Light], new: list[Light], chance: float) -> PartChange:
    """What all lights share, with the stated sigmas of their places and directions."""
    place = np.array([[light.position_std_m for light in one] for one in (old, new)])
    turn = np.array([[light.direction_std_rad for light in one] for one in (old, new)])
    std, turn_std = (float(np.sqrt(np.sum(np.mean(each**2, axis=1)))) for each in (place, turn))
    moved, turned = float(np.linalg.norm(common[:3])), float(np.linalg.norm(common[3:6]))
    return PartChange(moved, std, turned, turn_std, chance)


def _handeye(before: Array | None, after: Array | None, covariances: tuple[Array | None, Array | None]) -> PartChange:
    """The camera in the tracked body, by both covariances."""
    from scipy.stats import chi2

    if before is None or after is None:
        return PartChange()
    xi = se3.log(after @ se3.inv(before))
    moved, turned = float(np.linalg.norm(after[:3, 3] - before[:3, 3])), float(np.linalg.norm(xi[:3]))
    if covariances[0] is None or covariances[1] is None:
        return PartChange(moved, float("nan"), turned, float("nan"))
    covariance = covariances[0] + covariances[1]
    chance = 1.0 if not xi.any() else float(chi2.sf(xi @ np.linalg.solve(covariance, xi), 6))
    J = se3.turn_and_origin_jacobian(before)
    std = np.sqrt(np.diag(J @ covariance @ J.T))
    return PartChange(moved, float(np.linalg.norm(std[3:])), turned, float(np.linalg.norm(std[:3])), chance)


def _camera(before: Camera | None, after: Camera | None) -> tuple[PartChange, tuple[str, ...]]:
    """Projection difference over the image, and whether the parameters differ by more than both covariances allow."""
    from scipy.stats import chi2

    if before is None or after is None:
        return PartChange(), ("no camera in one of the two",) if before is not after else ()
    if before.image_size != after.image_size:
        return PartChange(), ("images of {}x{} and of {}x{}: cameras are not compared".format(*before.image_size, *after.image_size),)
    pixels = pixel_grid(before.image_size)
    rays_C = before.unproject(pixels)
    good = np.linalg.norm(before.project(rays_C) - pixels, axis=1) < INVERTED_PX
    difference, turn = projection_difference(pixels[good], rays_C[good], after.project)
    moved, turned = float(np.sqrt(np.mean(np.sum(difference**2, axis=1)))), float(np.linalg.norm(turn))
    same = before.parameters == after.parameters and before.model == after.model and len(before.parameters) > 0
    if not same or before.covariance is None or after.covariance is None or before.spline is not None:
        return PartChange(moved, float("nan"), turned), ()
    gap = _parameters(after) - _parameters(before)
    covariance = (before.covariance + after.covariance)[: gap.size, : gap.size]
    std = np.sqrt(np.diag(covariance))
    whitened = gap / std
    chance = 1.0 if not gap.any() else float(chi2.sf(whitened @ np.linalg.pinv(covariance / np.outer(std, std)) @ whitened, gap.size))
    return PartChange(moved, float("nan"), turned, float("nan"), chance), ()


def _parameters(camera: Camera) -> Array:
    """fx, fy, cx, cy and the distortion, in the order of the covariance."""
    K = camera.K
    return np.concatenate([[K[0, 0], K[1, 1], K[0, 2], K[1, 2]], camera.distortion])[: len(camera.parameters)]


@dataclass(frozen=True)
class OddOnes:
    """What each of K blocks is off by, in the units of y."""

    common: Array
    """x (n,)."""
    off: Array
    """d (K, c)."""
    off_std: Array
    """(K, c) standard deviation of `off` where the block has not moved, by the scatter of all others."""
    chance: Array
    """(K,) of so large an F where the block has not moved."""
    freedom: int
    """Degrees of freedom of the scatter; 0 or fewer: there are too few blocks."""


def odd_ones(J: Array, y: Array, expected: float, worth: float) -> OddOnes:
    """Hold each block y (K, c) against the others by the model J (K, c, n).

    `expected` is the scatter that is known beforehand, worth so many degrees of freedom: few lights determine their own scatter badly.
    """
    from scipy.stats import f as fisher

    count, size, unknowns = J.shape
    A, b = J.reshape(-1, unknowns), y.ravel()
    x = np.linalg.lstsq(A, b, rcond=None)[0]
    r = (b - A @ x).reshape(count, size)
    freedom = count * size - unknowns - size
    if freedom <= 0:
        nothing = np.full((count, size), np.nan)
        return OddOnes(x, r, nothing, np.ones(count), freedom)
    hat = np.einsum("kcn,nm,kdm->kcd", J, np.linalg.pinv(A.T @ A), J)
    freed = np.linalg.inv(np.eye(size) - hat)
    d = np.einsum("kcd,kd->kc", freed, r)
    explained = np.sum(r * d, axis=1)
    variance = (np.maximum(np.sum(r * r) - explained, 0) + worth * expected**2) / (freedom + worth)
    chance = fisher.sf(explained / size / variance, size, freedom + worth)
    std = np.sqrt(variance[:, None] * np.diagonal(freed, axis1=1, axis2=2))
    return OddOnes(x, d, std, np.asarray(chance), freedom)


def peeled(J: Array, y: Array, expected: float, worth: float, unlikely: float) -> OddOnes:
    """As `odd_ones`, but a block that has moved beyond chance is left out of the fit that the others are held against."""
    rows, least = list(range(len(J))), J.shape[2] // J.shape[1] + 2
    found = odd_ones(J, y, expected, worth)
    off, std, chance = found.off.copy(), found.off_std.copy(), found.chance.copy()
    while len(rows) > least and found.freedom > 0 and found.chance.min() < unlikely:
        worst = int(found.chance.argmin())
        k = rows.pop(worst)
        std[k], chance[k] = found.off_std[worst], found.chance[worst]
        found = odd_ones(J[rows], y[rows], expected, worth)
        off[rows], std[rows], chance[rows] = found.off, found.off_std, found.chance
    gone = [k for k in range(len(J)) if k not in rows]
    off[gone] = y[gone] - J[gone] @ found.common
    return OddOnes(found.common, off, std, chance, found.freedom)
