"""The lights refined from images of spheres: `refine_judged`, or `refine` without a judgement; `as_designed` where there are none."""

from lpcal.chain.refine_lights.assemble import as_designed
from lpcal.chain.refine_lights.judged import refine_judged
from lpcal.chain.refine_lights.refine import refine

__all__ = ["as_designed", "refine", "refine_judged"]
