"""From the linear images of one sphere to what they say of it: outline, highlights, shading."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from lpcal.detect import sphere_checks, sphere_outline, sphere_start
from lpcal.detect.sphere_checks import chrome_likeness, matte_likeness, refuse_curved
from lpcal.detect.sphere_highlights import Highlight, find_highlight, without_lamps
from lpcal.detect.sphere_outline import Outline
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry import sphere
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.records.calibration import Camera
from lpcal.records.observations import Radiance, SphereKind, SphereView

REFINED_STARTS = 3
CLEAR_RAYS, CLEAR_CONTRAST, CLEAR_SCATTER_PX = 0.9, 20.0, 0.5
"""An outline that so many rays see so clearly and evenly needs no rival."""
TRIED_STARTS, SAME = 6, 0.25
"""So many other outlines are tried where the clearest holds no sphere, those that differ from it by this share of its radius."""
LIKE, UNLIKE = {"matte": 0.9, "chrome": 0.5}, 0.5
"""What is no less like a sphere than the first is taken in the clearest outline's stead; what is less than the second is none: real balls
have 0.98 and more, a vase 0.8, flat things 0; a chrome ball may miss lights that its rod or the camera hides."""
MATTE_DISC, LIT_SIGMAS, LIT_SHARE = 0.9, 5.0, 0.02
"""Inside this share of a matte outline's radius a light must lift this share of the pixels by so many sigmas, unsaturated."""


@dataclass(frozen=True)
class Expected:
    """What is known of a sphere before it is looked for."""

    kind: SphereKind
    radius_m: float | None
    hint_px: Array | None = None
    """(3,) x, y, radius of its outline, about."""
    distance_m: tuple[float, float] | None = None
    """Between which distances from the camera it lies."""


def observe_sphere(radiance: Radiance, expected: Expected, camera: Camera | None) -> SphereView:
    """Outline, and highlights (chrome) or shading (matte), of the one sphere in a capture.

    Raises
    ------
    DegenerateError
        No outline, one cut by the border, blurred or not the only one; or nothing of any light: no highlight, all dark or saturated.
    DisagreementError
        Its radius cannot be right.
    """
    where, todo = f"sphere {radiance.name}", ""
    try:
        outline = _outline_of(mean_image(radiance), radiance, expected, camera)
        if not _place_is_stated(radiance, expected):
            where += f" at ({outline.centre_px[0]:.0f}, {outline.centre_px[1]:.0f}) px, radius {outline.radius_px:.0f} px"
            todo = f"; is it elsewhere? Then state {sphere_checks.HINT} in panel.yaml"
        return _with_lights(_view_of(radiance, expected, outline), radiance, outline)
    except (DegenerateError, DisagreementError) as error:
        raise type(error)(error.found, where=where, needed=error.needed, todo=error.todo + todo) from error


def _place_is_stated(radiance: Radiance, expected: Expected) -> bool:
    """Whether the outline's place is stated."""
    return expected.hint_px is not None or radiance.mask is not None


def _view_of(radiance: Radiance, expected: Expected, outline: Outline) -> SphereView:
    return SphereView(
        name=radiance.name,
        kind=expected.kind,
        radius_m=expected.radius_m if expected.radius_m is not None else float("nan"),
        outline_px=outline.points_px,
        outline_sigma_px=outline.sigma_px,
    )


def mean_image(radiance: Radiance) -> Image:
    """Mean over the lights (H, W), grey, ambient light included."""
    return _shown(radiance, np.ones(len(radiance.lights), dtype=bool))


def _shown(radiance: Radiance, lights: Mask) -> Image:
    mean = np.mean(radiance.signal[lights], axis=0) + radiance.ambient
    return np.asarray(mean.mean(axis=2) if mean.ndim == 3 else mean, dtype=np.float32)


def _outline_of(image: Image, radiance: Radiance, expected: Expected, camera: Camera | None) -> Outline:
    """The outline of the only sphere in an image, looked for where it is expected, else anywhere."""
    curve = sphere_outline.circle_curve()
    if camera is not None and expected.radius_m is not None:
        curve = sphere_outline.perspective_curve(camera, expected.radius_m)

    def refine(start: Array, kind: str = expected.kind, shown: Image = image) -> Outline:
        return sphere_outline.refine_outline(shown, kind, start, curve)

    stated = _place_is_stated(radiance, expected)
    radius_px = _radius_range(expected, camera)
    if expected.hint_px is not None:
        starts = [expected.hint_px]
    elif radiance.mask is not None:
        starts = [sphere_start.from_mask(radiance.mask)]
    else:
        starts = sphere_start.search(image, radius_px)
    outline = _best_of(starts[:REFINED_STARTS], refine)
    if (outline is None or sphere_checks.is_vague(outline)) and not stated and radius_px is not None:
        starts = sphere_start.search(image)
        outline = _best_of(starts[:REFINED_STARTS], refine)
        outline = outline if outline is not None and _is_clear(outline) else None
    if outline is None or sphere_checks.is_vague(outline):
        raise sphere_checks.why_none(image, radius_px)
    if not stated and len(radiance.lights) > 1:
        outline = _most_like(outline, starts, radiance, expected.kind, refine)
    sphere_checks.refuse_bad_outline(outline, image)
    rivals = sphere_checks.rivals(outline, starts, image) if not stated and len(radiance.lights) > 1 else []
    if rivals:
        parts = [_shown(radiance, np.arange(len(radiance.lights)) % 3 != third) for third in range(3)]
        refines = [partial(refine, shown=shown) for shown in parts]
        unsure = np.isnan(_likeness(radiance, expected.kind, outline))
        sphere_checks.refuse_second(outline, rivals, refines, lambda o: bool(unsure or _likeness(radiance, expected.kind, o) > UNLIKE))
    if camera is not None and expected.radius_m is not None:
        centre_C = sphere.from_outline(camera.unproject(outline.points_px), expected.radius_m)
        sphere_checks.refuse_far(float(np.linalg.norm(centre_C)), expected.radius_m, expected.distance_m)
    return sphere_outline.on_sharp_edges(image, outline, curve) if expected.kind == "chrome" else outline


def _most_like(first: Outline, starts: Sequence[Array], radiance: Radiance, kind: str, refine: Callable[[Array], Outline]) -> Outline:
    """The clearest outline where what it holds is a sphere of this kind; else the first of the others that does; else the clearest.

    Raises
    ------
    DegenerateError
        None of them does, and the clearest holds something else.
    """
    likeness = _likeness(radiance, kind, first)
    if likeness > UNLIKE:
        return first
    for start in starts[:TRIED_STARTS]:
        if np.linalg.norm(start[:2] - first.centre_px) < SAME * first.radius_px and abs(start[2] / first.radius_px - 1) < SAME:
            continue
        try:
            other = refine(start)
        except DegenerateError:
            continue
        if not sphere_checks.is_vague(other) and _likeness(radiance, kind, other) > LIKE[kind]:
            return other
    if np.isnan(likeness):
        return first
    raise sphere_checks.not_a_sphere(first, kind, likeness)


def _likeness(radiance: Radiance, kind: str, outline: Outline) -> float:
    """From 0 to 1; NaN where no light shows it."""
    lit = [light for light in radiance.lights if light not in radiance.dark]
    if kind == "matte":
        return matte_likeness(radiance, lit, outline)
    images = {light: _grey(radiance.short.get(light, radiance.signal[radiance.lights.index(light)])) for light in lit}
    return chrome_likeness(without_lamps({light: _spots(radiance, light, outline) for light in lit}, outline.radius_px), images, outline)


def _radius_range(expected: Expected, camera: Camera | None) -> tuple[float, float] | None:
    """Between which radii in pixels the outline is expected."""
    if camera is None or expected.radius_m is None or expected.distance_m is None:
        return None
    near, far = expected.distance_m
    focal = float(np.sqrt(camera.K[0, 0] * camera.K[1, 1]))
    return focal * expected.radius_m / far, 1.2 * focal * expected.radius_m / near


def _best_of(starts: Sequence[Array], refine: Callable[[Array], Outline]) -> Outline | None:
    found: list[Outline] = []
    for start in starts:
        try:
            found.append(refine(start))
        except DegenerateError:
            continue
        if _is_clear(found[-1]):
            break
    return max(found, key=_clearness, default=None)


def _is_clear(outline: Outline) -> bool:
    """Whether an outline needs no rival."""
    whole = len(outline.points_px) > CLEAR_RAYS * sphere_outline.RAYS
    return whole and outline.contrast > CLEAR_CONTRAST and outline.sigma_px < CLEAR_SCATTER_PX * outline.scale


def _clearness(outline: Outline) -> float:
    scatter = 0.3 + outline.sigma_px / outline.scale
    return float(len(outline.points_px) * np.sqrt(outline.radius_px) * min(outline.contrast, CLEAR_CONTRAST) / scatter)


def _with_lights(view: SphereView, radiance: Radiance, outline: Outline) -> SphereView:
    lit = [light for light in radiance.lights if light not in radiance.dark]
    notes = [f"{', '.join(radiance.dark)} lights nothing: is it off in its image?"] if radiance.dark else []
    if view.kind == "matte":
        lit, more = _shaded(radiance, lit, outline)
        if not lit:
            raise DegenerateError(
                "; ".join([*notes, *more]), needed="a matte sphere neither dark nor saturated", todo="change the exposure"
            )
        view = replace(view, shading=radiance.of(lit))
        refuse_curved(radiance.of(lit), outline)
    else:
        places, sigmas, more = _highlights(radiance, lit, outline)
        if not places:
            raise DegenerateError(
                "; ".join([*notes, *more]),
                needed="a mirror image of each light",
                todo="is it a chrome sphere, and are its images lit by one light each?",
            )
        view = replace(view, highlights_px=places, highlight_sigma_px=sigmas)
    remarks = [*(f"{note}; left out" for note in [*notes, *more]), *_room_light(view, outline)]
    return replace(view, notes=tuple(f"sphere {view.name}: {note}" for note in remarks))


def _room_light(view: SphereView, outline: Outline) -> list[str]:
    """Whether a matte sphere is lit more by the room than by its lights."""
    if view.shading is None:
        return []
    disc = _disc(view.shading, outline)
    lamps, room = np.median(_grey(view.shading.signal.max(axis=0))[disc]), np.median(_grey(view.shading.ambient)[disc])
    if room <= lamps:
        return []
    return [f"more ambient light than lamp light on it (the brightest lamp adds {100 * lamps / room:.0f} % of it): shade the scene"]


def _disc(radiance: Radiance, outline: Outline) -> Mask:
    height, width = radiance.saturated.shape[1:]
    rows, columns = np.ogrid[:height, :width]
    return np.asarray((columns - outline.centre_px[0]) ** 2 + (rows - outline.centre_px[1]) ** 2 < (MATTE_DISC * outline.radius_px) ** 2)


def _shaded(radiance: Radiance, lit: Sequence[str], outline: Outline) -> tuple[list[str], list[str]]:
    """The lights whose shading of a matte sphere can be used, and why the others' cannot."""
    disc = _disc(radiance, outline)
    found, full, dark = list[str](), list[str](), list[str]()
    for light in lit:
        k = radiance.lights.index(light)
        over = radiance.saturated[k][disc]
        shaded = ~over & (_grey(radiance.signal[k])[disc] > LIT_SIGMAS * _grey(radiance.sigma[k])[disc])
        (found if shaded.mean() > LIT_SHARE else full if over.mean() > LIT_SHARE else dark).append(light)
    remarks = ((full, "saturated wherever it is lit under"), (dark, "not lit by"))
    return found, [f"it is {what} {', '.join(some)}" for some, what in remarks if some]


def _highlights(radiance: Radiance, lit: Sequence[str], outline: Outline) -> tuple[dict[str, Array], dict[str, float], list[str]]:
    """Place and sigma of each light's mirror image in a chrome sphere, and why there is none of the others."""
    spots = without_lamps({light: _spots(radiance, light, outline) for light in lit}, outline.radius_px)
    places: dict[str, Array] = {}
    sigmas: dict[str, float] = {}
    notes, without = [], []
    for light, found in spots.items():
        if len(found) == 1:
            places[light], sigmas[light] = found[0].centre_px, found[0].sigma_px
        elif found:
            at = " and ".join(f"({x:.0f}, {y:.0f}) px" for x, y in (spot.centre_px for spot in found))
            notes.append(f"it shows {len(found)} bright spots under {light}, at {at}: is the highlight split, or another lamp on?")
        else:
            without.append(light)
    if without:
        notes.append(f"no highlight of {', '.join(without)} stands out inside its outline")
    return places, sigmas, notes


def _spots(radiance: Radiance, light: str, outline: Outline) -> list[Highlight]:
    """Bright spots under a light: in its shorter exposure where there is one, else in the long one."""
    k = radiance.lights.index(light)
    full, found = radiance.saturated[k], list[Highlight]()
    if light in radiance.short:
        short = _grey(radiance.short[light])
        noise = float(1.4826 * np.median(np.abs(short - np.median(short)))) + 1e-9
        found = find_highlight(short, noise, np.zeros_like(full), outline.centre_px, outline.radius_px)
    dark = float(np.median(radiance.sigma[k]))
    return found or find_highlight(_grey(radiance.signal[k]), dark, full, outline.centre_px, outline.radius_px)


def _grey(image: Image) -> Image:
    return np.asarray(image.mean(axis=2) if image.ndim == 3 else image)
