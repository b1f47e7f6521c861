"""What is wrong with an outline, or why there is none: cut by the border, out of focus, two spheres, a size that cannot be.

The blur of an image is that of its sharpest edges: an edge of height h blurred by sigma climbs by h / (sqrt(2 pi) sigma) a pixel at most.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from lpcal.detect import sphere_start
from lpcal.detect.edge_profile import BLURS_PX, INNER_SHARE
from lpcal.detect.sphere_outline import RAYS, Outline
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array, Image

OUTSIDE_SHARE = 0.02
"""Of the outline may lie outside the picture."""
BLURRED = 0.88
"""Of the largest blur that is tried: a blur at that bound is larger still."""
SOFT_PX = 1.6
"""Where no outline is found in a picture without an edge sharper than this, that is why."""
SCATTER_PX, SCATTER_AND_FAINT = 1.2, (0.5, 15.0)
"""An outline whose points scatter so far (of a large one further), or so far with so little contrast, is none."""
SECOND_RAYS, SECOND_CONTRAST, SECOND_SCATTER_PX = 0.75, 14.0, 0.7
SECOND_SIZE, SECOND_SUPPORT, SECOND_TRIED = (0.5, 2.0), 0.1, 2
HINT = "hint: [x px, y px, r px]"
"""How panel.yaml states where the outline is."""
POSSIBLE_M = (0.02, 20.0)
"""Nearer or farther than this no sphere stands."""
SHARP_EDGE = 0.15
"""An edge over this share of the image's range tells of its blur."""


def refuse_bad_outline(outline: Outline, image: Image) -> None:
    """Refuse an outline that is cut, blurred, or none.

    Raises
    ------
    DegenerateError
        Which of them it is, and where.
    """
    where = _place(outline.centre_px, outline.radius_px)
    height, width = image.shape
    outside = np.mean(np.any((outline.curve_px < -0.5) | (outline.curve_px > [width - 0.5, height - 0.5]), axis=1))
    if is_vague(outline):
        raise _no_outline(image)
    if outside > OUTSIDE_SHARE:
        raise _cut(f"{100 * outside:.0f} % of its outline, {where}, lies outside")
    if outline.blur_px > BLURRED * BLURS_PX[1] * outline.scale:
        raise _out_of_focus(f"its outline, {where}, is blurred by {outline.blur_px:.1f} px or more")
    if blur_of(image) > BLURRED * BLURS_PX[1] * outline.scale:
        raise _out_of_focus(f"nothing in the picture is sharp, its best edges are blurred by {blur_of(image):.1f} px")


def is_vague(outline: Outline) -> bool:
    """Whether its points scatter too far for the outline of a sphere."""
    scatter = outline.sigma_px / outline.scale
    return scatter > SCATTER_PX or (scatter > SCATTER_AND_FAINT[0] and outline.contrast < SCATTER_AND_FAINT[1])


def why_none(image: Image, radius_px: tuple[float, float] | None) -> DegenerateError:
    """Why an image shows no outline: a sphere cut by the border, nothing sharp, or no sphere at all."""
    height, width = image.shape
    for x, y, r in sphere_start.search_beyond(image, radius_px)[:1]:
        around = np.linspace(0, 2 * np.pi, RAYS, endpoint=False)
        column, row = x + r * np.cos(around), y + r * np.sin(around)
        outside = np.mean((column < 0) | (row < 0) | (column > width - 1) | (row > height - 1))
        if outside > OUTSIDE_SHARE:
            return _cut(f"of an outline {_place(np.array([x, y]), r)} about {100 * outside:.0f} % lies outside")
    return _no_outline(image)


def refuse_second(
    first: Outline, starts: Sequence[Array], refines: Sequence[Callable[[Array, str], Outline]], is_like: Callable[[Outline], bool]
) -> None:
    """Refuse a picture in which another outline, apart from the first, is about as clear and holds a sphere too.

    Parameters
    ----------
    refines : how a start becomes an outline, under some of the lights each; a shadow is not there under all of them
    is_like : whether what an outline holds may be a sphere of the kind that is looked for

    Raises
    ------
    DegenerateError
        Two spheres; both places are named.
    """
    for start in starts[:SECOND_TRIED]:
        for kind in INNER_SHARE:
            others = []
            for refine in refines:
                other = _second(start, kind, refine)
                if other is None:
                    break
                others.append(other)
            if len(others) == len(refines) and is_like(others[0]):
                places = [_place(one.centre_px, one.radius_px) for one in (first, others[0])]
                raise DegenerateError(
                    f"two spheres in the picture: {', and '.join(places)}",
                    needed="one sphere a folder",
                    todo=f"say which: hint: [{_pixels(first)}] or hint: [{_pixels(others[0])}] in panel.yaml",
                )


def rivals(first: Outline, starts: Sequence[Array], image: Image) -> list[Array]:
    """Those of the starts that lie apart from an outline, are about as large, and have an edge about as strong all round."""
    itself = np.array([*first.centre_px, first.radius_px])
    support = sphere_start.supports(image, [itself, *starts])
    found = []
    for start, own in zip(starts, support[1:], strict=True):
        apart = np.linalg.norm(start[:2] - first.centre_px) > 0.9 * (start[2] + first.radius_px)
        if apart and SECOND_SIZE[0] < start[2] / first.radius_px < SECOND_SIZE[1] and own > SECOND_SUPPORT * support[0]:
            found.append(start)
    return found


def _second(start: Array, kind: str, refine: Callable[[Array, str], Outline]) -> Outline | None:
    try:
        other = refine(start, kind)
    except DegenerateError:
        return None
    whole = len(other.points_px) > SECOND_RAYS * RAYS and other.contrast > SECOND_CONTRAST
    there = np.linalg.norm(other.centre_px - start[:2]) < 0.2 * start[2] and abs(other.radius_px / start[2] - 1) < 0.2
    return other if whole and there and other.sigma_px < SECOND_SCATTER_PX * other.scale else None


def refuse_far(distance_m: float, radius_m: float, expected_m: tuple[float, float] | None) -> None:
    """Refuse a radius that puts the sphere where none can stand.

    Raises
    ------
    DisagreementError
        Its radius and its size in the picture contradict each other.
    """
    low, high = expected_m or POSSIBLE_M
    if low <= distance_m <= high:
        return
    about = radius_m * np.sqrt(low * high) / distance_m
    raise DisagreementError(
        f"with radius {_length(radius_m)} it would be {_length(distance_m)} away",
        needed=f"between {_length(low)} and {_length(high)}" + ("" if expected_m is None else ", about where the wings' axes meet"),
        todo=f"correct its radius in panel.yaml: is the unit right? A sphere of that size there has a radius of about {_length(about)}"
        if expected_m is not None
        else "correct its radius in panel.yaml: is the unit right?",
    )


def blur_of(image: Image) -> float:
    """Blur (sigma, px) of the sharpest edges of an image (H, W); NaN where it has none."""
    from scipy.ndimage import gaussian_filter, maximum_filter, minimum_filter, sobel

    level = np.log(np.maximum(image, 0.0) + 0.02 * float(np.percentile(image, 99.5)) + 1e-9)
    smooth = gaussian_filter(level.astype(float), 0.7)
    climb = np.hypot(sobel(smooth, axis=1), sobel(smooth, axis=0)) / 8
    height = maximum_filter(smooth, 15) - minimum_filter(smooth, 15)
    edge = (climb == maximum_filter(climb, 15)) & (height > SHARP_EDGE * np.ptp(smooth))
    if edge.sum() < 3:
        return float("nan")
    sigma = height[edge] / (np.sqrt(2 * np.pi) * np.maximum(climb[edge], 1e-12))
    return float(np.sqrt(max(np.quantile(sigma, 0.2) ** 2 - 0.7**2, 0.0)))


def _no_outline(image: Image) -> DegenerateError:
    blur = blur_of(image)
    if blur > SOFT_PX:
        return _out_of_focus(f"nothing in the picture is sharp, its best edges are blurred by {blur:.1f} px")
    return DegenerateError(
        "no round outline is found",
        needed="one sphere, whole and sharp in the picture",
        todo=f"look at the images; state its place as {HINT} in panel.yaml",
    )


def not_a_sphere(outline: Outline, kind: str, likeness: float) -> DegenerateError:
    """What is said where the roundest thing in a picture is no sphere."""
    why = (
        f"what the lights change in it is not what they change in a ball (likeness {likeness:.2f})"
        if kind == "matte"
        else f"it mirrors only {100 * likeness:.0f} % of the lights as one spot each"
    )
    return DegenerateError(
        f"what is roundest, {_place(outline.centre_px, outline.radius_px)}, is no {kind} sphere: {why}",
        needed="the sphere whole and sharp in the picture, and not hidden",
        todo=f"take the other thing away, or state the sphere's place as {HINT} in panel.yaml",
    )


def _cut(found: str) -> DegenerateError:
    return DegenerateError(
        f"cut by the picture's border: {found}", needed="the whole sphere in the picture", todo="move it inwards and take it anew"
    )


def _out_of_focus(found: str) -> DegenerateError:
    return DegenerateError(f"out of focus: {found}", needed="a sharp outline", todo="focus on the sphere, stop down, and take it anew")


def _place(centre_px: Array, radius_px: float) -> str:
    return f"at ({centre_px[0]:.0f}, {centre_px[1]:.0f}) px with radius {radius_px:.0f} px"


def _pixels(outline: Outline) -> str:
    return ", ".join(f"{value:.0f} px" for value in (*outline.centre_px, outline.radius_px))


def _length(metres: float) -> str:
    return f"{metres:.3g} m" if metres >= 0.1 else f"{1e3 * metres:.3g} mm"
