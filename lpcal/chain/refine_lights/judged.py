"""The lights as `refine` finds them, judged: what the spheres leave open, what contradicts them, how well they foretell a sphere.

Free lights whose distance the spheres do not tell become distant ones (`far`); when the fit does not settle, or settles badly, the
mistake that explains it is looked for (`explain`); the shading and a sphere held out are compared with what the lights foretell
(`diagnosis`).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from lpcal.chain.refine_lights.diagnosis import diagnose
from lpcal.chain.refine_lights.explain import refuse_at_sight, refuse_other_orders, refuse_what_explains
from lpcal.chain.refine_lights.far import far_lights, with_far
from lpcal.chain.refine_lights.geometry_fit import BIAS_PX
from lpcal.chain.refine_lights.matte import refuse_what_explains_shading
from lpcal.chain.refine_lights.measure import Measured, measured_spheres
from lpcal.chain.refine_lights.refine import DOUBTED_PX, DOUBTED_SIGMAS, refine
from lpcal.errors import ConvergenceError
from lpcal.records.calibration import Camera, LightsSolution, Lobe, Wings
from lpcal.records.observations import SphereView

DOUBTED_SHADING = 0.01
"""Shading that agrees no better is worth a look for a mistake, as are highlights and outlines that `refine` doubts."""

STRAINED = 3.0
"""A sphere so many standard deviations from where its outline puts it is worth a look too."""


def refine_judged(
    views: Sequence[SphereView],
    lights: Sequence[str],
    camera: Camera | None,
    wings: Wings | None,
    *,
    intensity_sd: float = 0.10,
    lobes: Mapping[str, Lobe] | None = None,
    free_core: bool = False,
) -> LightsSolution:
    """The lights from spheres, as `refine`; distant where nothing tells their distance; what is wrong named.

    Raises
    ------
    DegenerateError
        No sphere; or a light that the data leave undetermined.
    DisagreementError
        Images under each other's names, a sphere of another radius, a moved camera, images that are not linear.
    ConvergenceError
        The highlights or a sphere held out are nowhere near what the lights foretell, and nothing explains it.
    """
    if camera is None or not views:
        return refine(views, lights, camera, wings)
    used, _ = measured_spheres(views, camera)
    if wings is None:
        refuse_other_orders(used, camera)
    drawn = {wing.name for wing in wings.wings} if wings else set()
    far = far_lights([light for light in lights if light not in drawn], used, camera)
    near = [light for light in lights if light not in far]
    if not near:
        return with_far(None, far, lights, views, used, camera)
    refuse_at_sight(near, used, camera, wings)
    try:
        solution = refine(views, near, camera, wings, intensity_sd=intensity_sd, lobes=lobes, free_core=free_core)
    except ConvergenceError:
        refuse_what_explains(near, used, camera, wings)
        raise
    if _doubtful(solution) or _strained(solution, used):
        refuse_what_explains(near, used, camera, wings)
        chrome = [view for view in views if view.highlights_px]
        if len(chrome) < len(views) and chrome:
            refuse_what_explains_shading(refine(chrome, near, camera, wings, intensity_sd=intensity_sd), used, camera)
    solution = diagnose(solution, used, camera, wings)
    return with_far(solution, far, lights, views, used, camera) if far else solution


def _doubtful(solution: LightsSolution) -> bool:
    """Whether highlights, shading or the outlines' biases are not as they should be."""
    found = solution.evidence
    if found.highlight_rms_px is not None and found.highlight_rms_px > DOUBTED_PX:
        return True
    if found.shading_rms is not None and found.shading_rms > DOUBTED_SHADING:
        return True
    biased = found.outline_bias_px or {}
    return any(abs(biased[kind] - mean) > DOUBTED_SIGMAS * sigma for kind, (mean, sigma) in BIAS_PX.items() if kind in biased)


def _strained(solution: LightsSolution, used: Measured) -> bool:
    """Whether a sphere lies farther from where its outline puts it than the outline's own uncertainty leaves."""
    bias_px = solution.evidence.outline_bias_px or {}
    centres = {finding.name: finding.centre_C for finding in solution.spheres if finding.used}
    for view, measured in used:
        centre_C = centres.get(view.name)
        if centre_C is None:
            continue
        off = centre_C - measured.centre_C - bias_px.get(view.kind, 0.0) * measured.by_bias
        if off @ np.linalg.solve(measured.covariance, off) > STRAINED**2:
            return True
    return False
