"""The tracked body over a recording: gaps, flips and how far it went, as planted; the same after H_OP.yaml."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lpcal.chain.h_op_panel import MOMENTS, course_of, track_of
from lpcal.formats.h_op_yaml import ImagePanelPoses, read_h_op, write_h_op
from lpcal.geometry import se3
from lpcal.records.observations import PoseStream
from lpcal.records.provenance import Provenance

RATE_HZ = 100.0
LOST_S, FLIPPED_S = (6.0, 7.5), (12.0, 12.4)


def stream(lost: tuple[float, float] | None = LOST_S, flipped: tuple[float, float] | None = FLIPPED_S) -> PoseStream:
    """Twenty seconds of a slow swing of 0.2 m and 30 degrees, lost for a while, with its markers swapped for a while."""
    t_s = np.arange(2000) / RATE_HZ
    swing = np.sin(2 * np.pi * t_s / 20)
    H_OP = np.array([se3.exp(np.array([0, 0, np.radians(30) * s, 0, 0, 0])) for s in swing])
    H_OP[:, 0, 3] = 0.2 * swing
    if flipped is not None:
        inside = (t_s >= flipped[0]) & (t_s < flipped[1])
        H_OP[inside] = H_OP[inside] @ se3.exp(np.array([np.pi, 0, 0, 0, 0, 0]))
    kept = np.ones(len(t_s), bool) if lost is None else (t_s < lost[0]) | (t_s >= lost[1])
    return PoseStream("panel", t_s[kept], H_OP[kept], np.full(int(kept.sum()), np.nan), rate_hz=RATE_HZ)


def test_gaps_and_flips_stand_where_they_were_planted() -> None:
    given = stream()
    found = course_of(given, track_of(given))
    assert [one.tracked for one in found.lapses] == [False, True]
    for one, (start, end) in zip(found.lapses, (LOST_S, FLIPPED_S), strict=True):
        assert (one.start_s, one.end_s) == pytest.approx((start, end), abs=0.12)
    assert not np.any((found.t_s > LOST_S[0]) & (found.t_s < LOST_S[1]))
    assert not np.any((found.t_s > FLIPPED_S[0]) & (found.t_s < FLIPPED_S[1]))


def test_a_flip_that_lasts_is_a_jump_at_either_end() -> None:
    given = stream(lost=None, flipped=(9.0, 14.0))
    found = course_of(given, track_of(given))
    assert [one.tracked for one in found.lapses] == [True, True]
    assert [one.start_s for one in found.lapses] == pytest.approx([9.0, 14.0], abs=0.02)
    assert max(one.end_s - one.start_s for one in found.lapses) < 0.05


def test_a_recording_without_fault_has_no_lapse_and_says_how_far_the_body_went() -> None:
    given = stream(lost=None, flipped=None)
    found = course_of(given, track_of(given))
    assert found.lapses == ()
    assert len(found.t_s) == MOMENTS
    assert found.moved_m.max() == pytest.approx(0.2, abs=0.01)
    assert np.degrees(found.turned_rad.max()) == pytest.approx(30, abs=1.5)
    turned_round = replace(given, H_OP=se3.inv(given.H_OP))
    assert course_of(turned_round, track_of(turned_round), inverse=True).moved_m == pytest.approx(found.moved_m, abs=1e-9)


def test_it_is_the_same_after_its_document(tmp_path: Path) -> None:
    given = stream()
    found = course_of(given, track_of(given))
    poses = ImagePanelPoses("panel", ("a.png",), np.array([1.5]), np.eye(4)[None], (None,), np.array([True]), 0.01, found)
    write_h_op(tmp_path / "H_OP.yaml", poses, Provenance())
    again = read_h_op(tmp_path / "H_OP.yaml")
    assert again.times_by_image() == {"a.png": 1.5}
    assert again.course is not None
    assert again.course.moved_m == pytest.approx(found.moved_m, abs=1e-5)
    assert again.course.turned_rad == pytest.approx(found.turned_rad, abs=1e-5)
    assert [one.tracked for one in again.course.lapses] == [False, True]
    assert len((tmp_path / "H_OP.yaml").read_text()) < 12_000
