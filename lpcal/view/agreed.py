"""Numbers that several steps of a reconstruction share: each is chosen once, and means the same wherever it is used."""

from __future__ import annotations

OUTLIER = 3.0
"""Standard deviations from which a residual is taken for an outlier's."""
OUTLIER2 = OUTLIER**2
CERTAIN = 2 * OUTLIER
"""Standard deviations beyond which a difference is real, although the errors of neighbours, and those of the model, are correlated."""
GRAZING = 0.03
"""Cosine (of 88 degrees) of a surface to light or viewer under which it is too steep to be computed with: smaller ones are held there."""
DOUBT = 0.25
"""Standard deviation of light that is computed, not seen by itself (interreflected, a gloss), as a share of it: right to a quarter."""
NEIGHBOURS = 25.0
"""How many samples are worth one: what a model lacks they have in common with those around."""
RARE = 0.1
"""Share of cases that are taken to be none of the kind that a model knows."""
SHADOW = 0.15
"""Share of a pixel's second largest shading under which a sample is taken to lie in shadow where nothing is known of the normal."""
UNLIKELY = 0.02
"""Odds under which an answer is neither used nor stated."""
SMALLEST_SHARE = 0.02
"""Share of a whole under which a piece of it is none of its own."""
FEWEST_PIXELS = 50
"""Pixels from which something can be said of what they are part of."""
COARSE_PIXELS = 5200
"""Pixels of the scale at which planes, layers and the room's light are found: the picture of a 4:3 camera is then some 80 across."""
MANY_PIXELS = 2000
"""Pixels, spread over an object, that say what all of it has in common: more say no more."""
STATED_STD = 0.003
"""Relative standard deviation, a millimetre, of a distance that is known from elsewhere: by the user, or by other views."""
NEXT_TO_NOTHING = 1e-6
"""Weight, as a share of what it stands beside, of what only keeps equations solvable."""
RIM_PX = 2
"""Pixels about an outline, or about a shadow's edge, that are of neither side, or judged again at a finer scale."""
SHADOW_STEPS = 32
"""Places between a point and a light that are tested for a surface which hides the light."""
