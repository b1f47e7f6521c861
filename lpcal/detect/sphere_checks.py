r"""What is wrong with an outline, or why there is none: cut by the border, out of focus, two spheres, a size that cannot be.

The blur of an image is that of its sharpest edges: an edge of height h blurred by sigma climbs by h / (sqrt(2 pi) sigma) a pixel at most.

Whether stored numbers are light: the shading of a matte sphere, its shape known, shows the camera's curve.

Symbols: data y of one light and a of the room at the pixels of an outline (normal n from its circle), light = data^e::

    y^e - a^e = g . n  where it is lit        e is where the misfit, over the signal, is least; 1 for a linear camera

A gamma that is not stated gives e = gamma, one stated and not there 1 / gamma. Source: Lambert's law. A light as near as fourteen radii
takes a third off e (a linear camera's is .75), a rough surface adds to it, so only the plainest curves are refused here; where chrome
spheres say where the lights are, `chain.refine_lights.matte` judges again.

Whether what is inside a round outline is a ball: shaded as one, or with a mirror image of each light.

Symbols: data s_k (N,) of light k at the pixels of the outline, mean m over the lights, normals n from the outline's circle::

    matte    d_k = s_k - c_k m    what the lights change, c_k by least squares; e_k the same of max(g_k . n, 0), g_k fitted to s_k
             likeness = 1 - sum |d_k - e_k|^2 / sum |d_k|^2, both less what noise adds
    chrome   the share of the lights that show one compact spot, no two of them at one place

A picture on the wall, a plate or a mug's rim is as round as a ball, but the lights change nothing in a flat thing but its brightness, and
one turned on a lathe shows them on one axis only. Source: Lambert's law; the images of a convex Lambertian body span three dimensions
(Shashua 1992), those of a flat one a single one.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from lpcal.detect import sphere_start
from lpcal.detect.edge_profile import BLURS_PX, INNER_SHARE
from lpcal.detect.sphere_highlights import Highlight
from lpcal.detect.sphere_outline import RAYS, Outline
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.geometry.tone_curve import not_linear
from lpcal.records.observations import Radiance

OUTSIDE_SHARE = 0.02
"""Share of the outline that may lie outside the picture."""
BLURRED = 0.88
"""Share of the largest blur that is tried from which a blur counts as beyond it."""
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
"""An edge over this share of the image's range shows its blur."""


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
        f"cut by the picture's border: {found}", needed="the whole sphere in the picture", todo="move it inwards and take it again"
    )


def _out_of_focus(found: str) -> DegenerateError:
    return DegenerateError(f"out of focus: {found}", needed="a sharp outline", todo="focus on the sphere, stop down, and take it again")


def _place(centre_px: Array, radius_px: float) -> str:
    return f"at ({centre_px[0]:.0f}, {centre_px[1]:.0f}) px with radius {radius_px:.0f} px"


def _pixels(outline: Outline) -> str:
    return ", ".join(f"{value:.0f} px" for value in (*outline.centre_px, outline.radius_px))


def _length(metres: float) -> str:
    return f"{metres:.3g} m" if metres >= 0.1 else f"{1e3 * metres:.3g} mm"


EXPONENTS = np.exp(np.linspace(np.log(0.3), np.log(3.0), 24))
LINEAR = (0.6, 1.5)
DISC, LIT, FEWEST = 0.85, 0.08, 200


def refuse_curved(radiance: Radiance, outline: Outline) -> None:
    """Refuse images of a matte sphere whose shading says that they are not linear.

    Raises
    ------
    DisagreementError
        The exponent that makes them so is named.
    """
    found = [e for k in range(len(radiance.lights)) if (e := _exponent(radiance, k, outline)) is not None]
    exponent = float(np.median(found)) if found else 1.0
    if not LINEAR[0] < exponent < LINEAR[1]:
        raise not_linear(exponent)


def _exponent(radiance: Radiance, k: int, outline: Outline) -> float | None:
    rim = [(int(middle - outline.radius_px), int(middle + outline.radius_px) + 2) for middle in outline.centre_px[::-1]]
    box = tuple(slice(max(first, 0), max(last, 0)) for first, last in rim)
    signal, ambient = (one if one.ndim == 2 else one.mean(axis=2) for one in (radiance.signal[k][box], radiance.ambient[box]))
    rows, columns = np.ogrid[: radiance.ambient.shape[0], : radiance.ambient.shape[1]]
    x = (columns[:, box[1]] - outline.centre_px[0]) / outline.radius_px
    y = (rows[box[0]] - outline.centre_px[1]) / outline.radius_px
    x, y = np.broadcast_arrays(x, y)
    inside = np.hypot(x, y) < DISC
    peak = float(np.percentile(signal[inside], 98))
    use = inside & ~radiance.saturated[k][box] & (signal > LIT * peak)
    if use.sum() < FEWEST or peak <= 0:
        return None
    n = np.stack([x, y, np.sqrt(np.maximum(1 - x**2 - y**2, 0))], axis=-1)[use]
    room = np.maximum(ambient, 0.0)[use] / peak
    total = signal[use] / peak + room
    misfit = [_misfit(n, total**e - room**e) for e in EXPONENTS]
    return float(EXPONENTS[int(np.argmin(misfit))])


def _misfit(n: Array, light: Array) -> float:
    """Rms misfit of a plane of normals over the mean signal."""
    g = np.linalg.lstsq(n, light, rcond=None)[0]
    return float(np.sqrt(np.mean((light - n @ g) ** 2)) / np.std(light))


LIKE_DISC, LIKE_LIT = 0.88, 0.12
"""Shading is compared inside this share of the radius, and fitted where a normal's cosine with the light is over the second figure."""
CHANGE = 1e-3
"""Least share of the energy that must change between the lights, else it is flat: two lights 5 degrees apart do so in a ball."""
FEWEST_PIXELS, FIT_ROUNDS = 60, 4
COMPACT, RING_PX = 0.5, (5.0, 9.0)
"""A spot's height over the ring about it, in pixels from its middle, as a share of its height over the whole; an edge has less."""
APART_PX = 1.5
"""Two lights' images in a mirror are further apart than this."""


def matte_likeness(radiance: Radiance, lights: Sequence[str], outline: Outline) -> float:
    """How much of what the lights change inside an outline a ball's shading explains: 1 all, 0 nothing; NaN where it is not known."""
    box, n, inside = _normals(outline, radiance.saturated.shape[1:])
    index = [radiance.lights.index(light) for light in lights]
    full = np.asarray(radiance.saturated[:, *box][index].any(axis=0) if index else inside, dtype=bool)
    use = inside & ~full
    if len(index) < 2 or use.sum() < FEWEST_PIXELS:
        return float("nan")
    data = np.stack([_grey(radiance.signal[k][box])[use] for k in index]).astype(float)
    noise = float(sum(np.sum(_grey(radiance.sigma[k][box])[use].astype(float) ** 2) for k in index))
    model = np.stack([_shaded(n[use], own) for own in data])
    changed, explained = _changes(data), _changes(model)
    energy, left = float(np.sum(changed**2)) - noise, float(np.sum((changed - explained) ** 2)) - noise
    whole = float(np.sum(data**2)) - noise
    if whole < noise:
        return float("nan")
    if energy < CHANGE * whole:
        return 0.0
    return float(np.clip(1 - max(left, 0.0) / energy, 0.0, 1.0))


def chrome_likeness(spots: Mapping[str, Sequence[Highlight]], images: Mapping[str, Image], outline: Outline) -> float:
    """The share of the lights with one compact spot at a place of its own; NaN where there is no spot at all."""
    if not any(spots.values()):
        return float("nan")
    places: list[Array] = []
    for light, found in spots.items():
        if len(found) == 1 and (found[0].saturated or _compact(images[light], found[0].centre_px, outline)):
            place = found[0].centre_px
            if all(np.linalg.norm(place - other) > APART_PX for other in places):
                places.append(place)
    return len(places) / len(spots)


def _normals(outline: Outline, shape: tuple[int, ...]) -> tuple[tuple[slice, slice], Array, Mask]:
    """The box of an outline, unit normals (h, w, 3) towards the camera in it, and which of its pixels are well inside."""
    (x, y), r = outline.centre_px, outline.radius_px
    box = (slice(max(int(y - r), 0), min(int(y + r) + 2, shape[0])), slice(max(int(x - r), 0), min(int(x + r) + 2, shape[1])))
    rows, columns = np.mgrid[box]
    u, v = (columns - x) / r, (rows - y) / r
    inside = np.hypot(u, v) < LIKE_DISC
    return box, np.stack([u, v, -np.sqrt(np.maximum(1 - u**2 - v**2, 0.0))], axis=-1), inside


def _shaded(n: Array, data: Array) -> Array:
    """The shading (N,) of a ball that fits data best."""
    lit, model = data > np.quantile(data, 0.3), np.zeros(len(data))
    for _ in range(FIT_ROUNDS):
        if lit.sum() < FEWEST_PIXELS // 2:
            break
        g = np.linalg.lstsq(n[lit], data[lit], rcond=None)[0]
        model = np.maximum(n @ g, 0.0)
        lit = n @ g > LIKE_LIT * float(np.linalg.norm(g))
    return model


def _changes(values: Array) -> Array:
    """Rows (K, N) less their mean times what of it is in each."""
    mean = values.mean(axis=0)
    return np.asarray(values - np.outer(values @ mean / max(float(mean @ mean), 1e-30), mean))


def _compact(image: Image, place: Array, outline: Outline) -> bool:
    """Whether a spot stands over the ring about it about as far as over the whole inside of the outline."""
    box, _, inside = _normals(outline, image.shape)
    rows, columns = np.mgrid[box]
    away, scale = np.hypot(columns - place[0], rows - place[1]), max(1.0, outline.radius_px / 150.0)
    part = _grey(image)[box]
    ring, middle = inside & (away > RING_PX[0] * scale) & (away < RING_PX[1] * scale), away < 2.0 * scale
    if ring.sum() < 8 or not middle.any():
        return False
    peak, background = float(np.percentile(part[middle], 90)), float(np.median(part[inside]))
    return peak - float(np.percentile(part[ring], 75)) > COMPACT * (peak - background) > 0


def _grey(image: Image) -> Image:
    return np.asarray(image.mean(axis=2) if image.ndim == 3 else image)
