"""The distance sensor's beam in C, of readings on the board's plane: ``reading = bias + scale t``, the beam ``o + t u`` meeting the plane.

`fit` is the robust weighted least squares with the drawing as prior, `findings` what the poses determine and what mistakes in the data look
like. Where the beam begins along itself and the bias are one number in the readings; across the beam only tilted boards show its place, and
boards tilted at several distances its direction.
"""
