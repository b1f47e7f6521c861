"""Notes on a surface: its distance with what else it may be, what in it is in doubt; and its refusal where no light is known."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from lpcal.detect.radiometry import NO_AMBIENT
from lpcal.errors import DegenerateError
from lpcal.geometry import lambert
from lpcal.geometry.arrays import Array, Image, Mask
from lpcal.integration.convention import exchanged, hollow, mirrored
from lpcal.records.calibration import Calibration
from lpcal.records.observations import Radiance
from lpcal.records.surface import Surface
from lpcal.view import parallel
from lpcal.view.constants import OUTLIER_RATE

OUTSIDE = (0.5, 2.0)
"""Multiples of the working distance between which an object may be found: beyond them nothing is known of the lights."""
VAGUE_DEG = 6.0
"""Median doubt of the normals, degrees an axis, from which the lights are asked about: a surface so poorly known is of no use."""
MASK_IN_DOUBT = 0.02
"""Odds of being wrong from which a mask is spoken of. Of 666 simulated scenes, each judged by a network that was not fitted to it, nine of
ten wrong masks have them and 8 % of the right ones, of which two of five have an IoU under .95."""
LEAST_HIT = 0.33
"""Odds of having met the object under which a distance sensor's reading is said to be left out."""


def far_stated(stated_m: float | None, calibration: Calibration) -> tuple[str, ...]:
    """In words, where a stated distance is far out of the working volume, as one in another unit is, or not used without a camera."""
    working_m = calibration.d_object_m
    if stated_m is not None and calibration.camera is None:
        return ("the distance is stated, but without a calibrated camera depths are in pixels: it is not used",)
    if stated_m is None or working_m is None or OUTSIDE[0] * working_m < stated_m < OUTSIDE[1] * working_m:
        return ()
    return (
        f"the distance is stated as {1e3 * stated_m:.0f} mm, the lights are calibrated for {1e3 * working_m:.0f} mm: is its unit right?",
    )


def refuse_outside(surface: Surface, calibration: Calibration, fits: tuple[str, ...]) -> None:
    """Refuse an object that near light puts far from where the lights are known.

    Raises
    ------
    DegenerateError
        Its distance is out of OUTSIDE times the working distance.
    """
    working_m = calibration.d_object_m
    if calibration.camera is None or working_m is None or not any(light.source_C is not None for light in calibration.lights):
        return
    distance_m = max(surface.components, key=lambda piece: piece.pixels).mean_depth_m
    if not OUTSIDE[0] * working_m < distance_m < OUTSIDE[1] * working_m:
        raise DegenerateError(
            "; ".join(
                (f"the object seems to stand {1e3 * distance_m:.0f} mm away, outside the working volume", *fits, *misfit_said(surface))
            ),
            where=surface.name,
            needed=f"an object about {1e3 * working_m:.0f} mm away, where the lights are calibrated",
            todo="put it there, or state its distance with --distance, or take the lights as distant ones with --lights distant",
        )


def notes_of(known: tuple[str, ...], surface: Surface) -> tuple[str, ...]:
    """The notes of a capture with those of its surface."""
    return (
        *_with_ambient_said(known, surface),
        *_intensities_said(surface),
        *misfit_said(surface),
        *_exchange_said(surface),
        *_mask_said(surface),
        *_reading_said(surface),
    )


def _reading_said(surface: Surface) -> tuple[str, ...]:
    """What became of the distance sensor's reading."""
    found = surface.figures.distance_reading
    if found is None:
        return ()
    read_mm = 1e3 * found.reading_m
    if not np.isfinite(found.expected_m):
        return (f"the distance sensor's beam goes beside the object: its reading, {read_mm:.0f} mm, says nothing of it",)
    if found.hit < LEAST_HIT:
        return (
            f"the distance sensor reads {read_mm:.0f} mm where the object would be at {1e3 * found.expected_m:.0f} mm by its light: it may "
            "have met something else, and was left out",
        )
    return ()


def distance_said(piece: dict[str, Any]) -> str:
    """The distance of a component of summary.json and, where the images allow another one, that too."""
    said = f"{1e3 * piece['mean_depth_m']:.1f} mm +- {1e3 * piece['scale_std'] * piece['mean_depth_m']:.1f}"
    others = [f"{1e3 * one['mean_depth_m']:.0f} mm (odds {100 * one['odds']:.0f} %)" for one in piece["alternatives"]]
    return said + (f", or {' or '.join(others)}" if others else "")


def _mask_said(surface: Surface) -> tuple[str, ...]:
    """Notes on an automatic mask that may be wrong."""
    odds = surface.figures.mask_doubt or 0.0
    if odds < MASK_IN_DOUBT:
        return ()
    why = surface.figures.mask_doubt_why or ""
    return (
        f"the automatic mask may be wrong (odds {100 * odds:.0f} %{': ' if why else ''}{why}): look at mask.png; where it is, help with "
        "--box X,Y,W,H round the object, --point X,Y on it, or --mask FILE",
    )


def _with_ambient_said(notes: tuple[str, ...], surface: Surface) -> tuple[str, ...]:
    """The notes with what became of the room's light where there is no image of it."""
    found = surface.figures.ambient
    if found is None:
        return notes
    others = tuple(note for note in notes if note != NO_AMBIENT)
    if not found.estimated:
        return (*others, found.note or "")
    percent, doubt = 100 * (found.share_of_signal or 0.0), 100 * (found.relative_std or 0.0)
    said = f"no ambient image: the room's light was estimated, {percent:.0f} % of the images within {doubt:.0f} % of that, and taken away"
    return (*others, said)


def _intensities_said(surface: Surface) -> tuple[str, ...]:
    """Notes on intensities that were not measured but taken from the object."""
    found = surface.figures.intensities_found
    if not found:
        return ()
    least, most = (100 * (value - 1) for value in (min(found.values()), max(found.values())))
    return (f"the lights' intensities are not stated: they were estimated from the object, {least:+.0f} % to {most:+.0f} % of their mean",)


def _exchange_said(surface: Surface) -> tuple[str, ...]:
    """Notes on images that fit another light than their own."""
    found = surface.figures.images_exchanged
    if not found:
        return ()
    places = ", ".join(f"{image} fits the light {light}" for image, light in found.items())
    return (
        f"images, cables or lines of the light list seem exchanged: {places}; put them right, for now these images only widen the doubt",
    )


def misfit_said(surface: Surface) -> tuple[str, ...]:
    """Notes where the normals are hardly known, those of a surface only with one axis turned over, or of a hollow thing."""
    said = []
    doubt_deg = float(np.median(surface.normal_std_deg[surface.mask])) if surface.mask.any() else 0.0
    if doubt_deg > VAGUE_DEG:
        said.append(
            f"the normals are known to {doubt_deg:.0f} deg only (median, an axis): the images do not fit the lights; are their names, "
            "order and axes those of the images?"
        )
    if way := exchanged(surface.normals, surface.mask, surface.rays_C):
        said.append(
            f"the normals look outwards along the object's outline only if {way}: so the columns of the light list (lpcal takes x right, "
            "y up, z to the camera) or the images seem to be"
        )
    elif mirrored(surface.normals, surface.mask, surface.rays_C):
        said.append(
            "the normals are of a surface only with x or y turned over: an axis of the light list seems flipped "
            "(lpcal takes x right, y up), the images mirrored, or the lights in backward order"
        )
    elif hollow(surface.normals, surface.mask):
        said.append(
            "the object is hollow all along its outline: unless it is a bowl, the images are turned by 180 degrees against their lights, "
            "the light list is half a turn off, or its directions go from the lights to the object"
        )
    return tuple(said)


LIT = 0.3
"""Cosine of the angle to a light, and share of the signal that the brightest pixels have for what is expected of them, below which a pixel
is in shadow or at its edge."""
FEWEST_PIXELS = 200
"""Pixels that a light must be seen by: a median of so many is known to a percent where each is off by a tenth."""
CONTRADICTS = 0.04
"""Deviation from which a light is named: a lamp that is off by a tenth shows six per cent, simulated captures of right lights none,
rendered ones with interreflection two."""
AGREES = 0.5
"""Share of the deviation that each quarter of the object has to show: a lamp's power is off everywhere, an error of the surface (a shadow,
interreflection, a wrong distance) is not. Of 91 drawn captures of right lights nine had a light named without this, one has with it."""
SIGMAS = 5.0
"""Stated standard deviations of the intensity that a deviation must exceed as well."""


def deviations(surface: Surface, radiance: Radiance, calibration: Calibration) -> dict[str, float]:
    """How much brighter (log) each light's image is than the surface found makes it, the median of all taken out; NaN: too few pixels."""
    inside = surface.mask
    x_C = surface.depth[inside].astype(float)[:, None] * surface.rays_C[inside] if surface.metric else surface.rays_C[inside]
    n, albedo = surface.normals[inside].astype(float), _grey(surface.albedo[inside])

    def of(k: int) -> float:
        light = next(one for one in calibration.lights if one.name == radiance.lights[k])
        d, E = light.unit_field(x_C, single=True)
        cosine, signal = lambert.dot(d, n), _grey(radiance.signal[k][inside])
        expected = albedo * E * (light.intensity.mean() * cosine)
        good = (cosine > LIT) & ~radiance.saturated[k][inside] & (signal > 0) & np.isfinite(expected) & (expected > 0)
        if good.sum() < FEWEST_PIXELS:
            return np.nan
        brighter = np.log(signal[good] / expected[good])  # shadows only darken: a lamp's factor is that of the brightest
        lit = brighter > np.quantile(brighter, 1 - OUTLIER_RATE) + np.log(LIT)
        return float(np.median(brighter[lit])) if lit.sum() >= FEWEST_PIXELS else np.nan

    found = parallel.run_all(of, range(len(radiance.lights)))
    middle = np.nanmedian(found) if np.isfinite(found).any() else np.nan
    return {name: float(value - middle) for name, value in zip(radiance.lights, found, strict=True)}


def _quarters(mask: Mask) -> list[Mask]:
    """The quarters of a mask (H, W), by the medians of its pixels' rows and columns."""
    row, column = np.indices(mask.shape)
    rows, columns = np.nonzero(mask)
    lower, right = row > np.median(rows), column > np.median(columns)
    return [mask & above & beside for above in (lower, ~lower) for beside in (right, ~right)]


def _grey(values: Array | Image) -> Array:
    """Values (P,) or the mean (P,) of (P, C)."""
    return np.asarray(values if values.ndim == 1 else values.mean(axis=-1), dtype=float)


def contradicting(surface: Surface, radiance: Radiance, calibration: Calibration) -> tuple[str, ...]:
    """Notes on a light whose image contradicts its calibration."""
    figures = surface.figures
    spoken_for = (figures.gloss, figures.intensities_found, figures.images_exchanged, figures.ambient)
    if not surface.metric or any(one is not None for one in spoken_for):
        return ()
    found = deviations(surface, radiance, calibration)
    stated = {light.name: light.intensity_std for light in calibration.lights}
    worst = max((name for name in found if np.isfinite(found[name])), key=lambda name: abs(found[name]), default=None)
    if worst is None or abs(found[worst]) < max(CONTRADICTS, SIGMAS * float(np.nan_to_num(stated[worst]))):
        return ()
    quarters = [deviations(replace(surface, mask=quarter), radiance, calibration)[worst] for quarter in _quarters(surface.mask)]
    shares = [one / found[worst] for one in quarters if np.isfinite(one)]
    if len(shares) < 2 or min(shares) < AGREES:
        return ()
    percent = 100 * np.expm1(found[worst])
    how = f"{abs(percent):.0f} % {'brighter' if percent > 0 else 'darker'}"
    return (
        f"{worst} shines otherwise than its calibration says: its image is {how} than the others' make it (the lamp itself is off by "
        "more): has it aged, moved, another current, or its image another exposure?",
    )
