"""The lights refined from images of spheres: `refine` from what they show, `as_designed` where there are none."""

from lpcal.chain.refine_lights.assemble import as_designed
from lpcal.chain.refine_lights.refine import refine

__all__ = ["as_designed", "refine"]
