"""Constants that several steps of a reconstruction share: each is chosen once and has the same meaning wherever it is used."""

from __future__ import annotations

OUTLIER = 3.0
"""Residual, in standard deviations, beyond which a sample counts as an outlier."""
OUTLIER2 = OUTLIER**2
CERTAIN = 2 * OUTLIER
"""Standard deviations beyond which a difference is significant, although errors of the model and of neighbouring pixels are correlated."""
LEAST_COSINE = 0.03
"""Least cosine (88 degrees) of a normal to a light or the viewer: smaller ones are clamped to it, as they are divided by."""
DOUBT = 0.25
"""Relative standard deviation of light that is modelled, not measured directly (interreflection, gloss): models are right to a quarter."""
NEIGHBOURS = 25.0
"""Samples that count as one independent sample: model errors are correlated between neighbouring pixels."""
OUTLIER_RATE = 0.1
"""Outlier rate of the mixture models: the prior share of cases that the model does not describe."""
SHADOW = 0.15
"""Shading, as a share of the second largest of its pixel, below which a sample counts as shadowed while no normal is known."""
UNLIKELY = 0.02
"""Probability below which an alternative is neither used nor reported."""
SMALLEST_SHARE = 0.02
"""Area, as a share of the whole, below which a connected component is dropped."""
FEWEST_PIXELS = 50
"""Least number of pixels from which a statistic of a region is estimated."""
COARSE_PIXELS = 5200
"""Pixels of the binned image in which planes, layers and the ambient light are found: some 80 columns of a 4:3 camera."""
MANY_PIXELS = 2000
"""Pixels, spread over an object, from which its common parameters are estimated: more do not improve them."""
STATED_STD = 0.003
"""Relative standard deviation, about a millimetre, of a distance that the user or other views provide."""
REGULARISATION = 1e-6
"""Relative weight of terms that only keep equations solvable: small enough not to change a determined solution."""
RIM_PX = 2
"""Half-width, pixels, of the band about an outline or shadow edge that belongs to neither side, or is decided again at a finer scale."""
SHADOW_STEPS = 32
"""Points between a surface point and a light at which the shadow ray is tested for occlusion."""
