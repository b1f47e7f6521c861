"""What is missing of a model: holes closed by caps, where to look next, and whether looking there shows what was said."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

import lpcal
from fusion_views import scene
from lpcal.fusion.missing import caps_of, carrier_of, loops_of, zipped
from lpcal.geometry import se3
from lpcal.records.model import Missing, ObjectModel
from lpcal.report.model_page import missing_words

pytest.importorskip("skimage")


@cache
def half() -> ObjectModel:
    """A stone seen from one side alone."""
    return lpcal.fuse(scene().surfaces[:3], step_m=0.004)


def box() -> tuple[np.ndarray, np.ndarray]:
    """An open box, 1 by 1 by 0.5, without its lid at z = 0.5: faces outward."""
    v = np.array([[x, y, z] for z in (0.0, 0.5) for y in (0.0, 1.0) for x in (0.0, 1.0)])
    quads = [(0, 2, 3, 1), (0, 1, 5, 4), (1, 3, 7, 5), (3, 2, 6, 7), (2, 0, 4, 6)]
    return v, np.array([face for a, b, c, d in quads for face in ((a, b, c), (a, c, d))])


def test_a_cap_is_the_lid() -> None:
    """The hole of an open box is one loop; its cap has the lid's area, and looks out of the box."""
    v, faces = box()
    (loop,) = loops_of(faces)
    assert sorted(loop.tolist()) == [4, 5, 6, 7]
    caps = caps_of(v, faces)
    assert caps.area_m2.sum() == pytest.approx(1.0)
    np.testing.assert_allclose(caps.n_A, np.broadcast_to([0, 0, 1.0], caps.n_A.shape), atol=1e-12)
    np.testing.assert_allclose(caps.x_A[:, 2], 0.5)


def test_a_gap_that_winds_is_closed_across() -> None:
    """Round a ring of radius 1 that is open along its inside, a tenth wide: the cap has the gap's area, not that of the ring's hole."""
    around = np.linspace(0, 2 * np.pi, 120, endpoint=False)[:-4]
    side = np.column_stack([np.cos(around), np.sin(around), np.zeros(len(around))])
    gap = np.concatenate([side, side[::-1] + np.array([0, 0, 0.1])])
    triangles = zipped(gap)
    flat = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    assert np.linalg.norm(flat, axis=1).sum() == pytest.approx(0.1 * (around[-1] - around[0]), rel=0.02)
    outward = np.einsum("nk,nk->n", flat[:, :2], triangles.mean(axis=1)[:, :2])
    assert outward.max() < 1e-12 < -outward.sum()  # the faces that the gap lies between go round it the other way


def test_a_closed_surface_has_no_cap() -> None:
    """Nothing is open."""
    v, faces = box()
    closed = np.concatenate([faces, [[4, 5, 7], [4, 7, 6]]])
    assert loops_of(closed) == []
    assert len(caps_of(v, closed).area_m2) == 0


def test_the_panel_of_a_placement() -> None:
    """The adjoint of a pose gives the pose back; a camera that stands still has no panel."""
    H_OP = se3.exp(np.array([0.4, -1.1, 0.3, 1.0, 0.2, -0.5]))
    found = carrier_of(se3.adjoint(H_OP))
    assert found is not None
    np.testing.assert_allclose(found, H_OP, atol=1e-12)
    assert carrier_of(np.eye(6)) is None
    assert carrier_of(np.zeros((6, 6))) is None


def test_the_other_side_is_asked_for() -> None:
    """Of a stone seen from one side the other one is missing: the camera is to look at it from where no view stood."""
    model = half()
    said = model.missing
    assert said is not None
    assert said.stops
    assert said.open_m2 > 0.2 * said.area_m2
    first = said.stops[0]
    stood = [view.H_AC[:3, 2] for view in model.views]
    assert max(float(first.H_AC[:3, 2] @ z) for z in stood) < np.cos(np.radians(35))
    assert first.H_AP is not None
    assert not first.reset
    assert [one.unseen_m2 + one.once_m2 for one in said.stops] == sorted((one.unseen_m2 + one.once_m2 for one in said.stops), reverse=True)


def test_in_words() -> None:
    """What is said of it, without and with a reset of the wings."""
    found = half().missing
    assert found is not None
    lines = missing_words(found, "the room")
    assert lines[0].startswith("missing, of ")
    assert "the panel at" in lines[1]
    assert "wings as they are" in lines[1]
    assert missing_words(Missing(0.01, 0.0, 0.0, 0.0), "the room")[1] == "no further stop would show much more"


@pytest.mark.slow
def test_a_stop_shows_what_was_said() -> None:
    """Of the views that were held back, the one nearest to the stop asked for adds most area; by about what was said."""
    surfaces, model = scene().surfaces, half()
    assert model.missing is not None
    first = model.missing.stops[0]
    held = surfaces[3:]
    added = [lpcal.fuse([*surfaces[:3], one], step_m=0.004).figures.area_m2 - model.figures.area_m2 for one in held]
    near = [float(one.placement.H_AC[:3, 2] @ first.H_AC[:3, 2]) for one in held]
    assert added[int(np.argmax(near))] > 0.5 * max(added)
    assert 0.3 < added[int(np.argmax(near))] / first.unseen_m2 < 3
