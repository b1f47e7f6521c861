"""What is said of a surface: an automatic mask in doubt, with the help that there is; none that is sure."""

from __future__ import annotations

from dataclasses import replace

import pytest

from lpcal.api.surface_notes import MASK_IN_DOUBT, notes_of
from relight_ball import ball


@pytest.mark.parametrize("odds", [None, 0.0, 0.9 * MASK_IN_DOUBT, MASK_IN_DOUBT, 0.5])
def test_a_mask_in_doubt_is_named_with_what_it_may_be_and_a_sure_one_is_not(odds: float | None) -> None:
    surface = ball(perspective=True)
    figures = replace(surface.figures, mask_doubt=odds, mask_doubt_why="12 % of its area may be the support under it")
    said = [note for note in notes_of((), replace(surface, figures=figures)) if "mask may be wrong" in note]
    if odds is None or odds < MASK_IN_DOUBT:
        assert not said
    else:
        (note,) = said
        assert f"odds {100 * odds:.0f} %" in note
        assert "the support under it" in note
        assert "--box" in note
