"""Records as documents and back: what is written is what is read, and what is garbled is the file's fault."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from lpcal.formats.documents import plain
from lpcal.formats.record_documents import document_of, known_record_of, record_of
from lpcal.records.evidence import (
    CameraEvidence,
    Coverage,
    HandEyeEvidence,
    LightsEvidence,
    NextSphere,
    OtherSolver,
    RefinedSetting,
    TriedModel,
)
from lpcal.records.figures import SurfaceFigures

HANDEYE = HandEyeEvidence(
    views_used=12,
    rotation_spread_deg=np.array([30.0, 21.5, 9.25]),
    mocap_sigma_deg=0.04,
    mocap_sigma_m=2e-4,
    closed_form_H_PC=np.eye(4),
    covariance_factor_of_shared_errors=1.5,
    board_size_by_mocap=1.001,
    board_size_by_mocap_std=2e-4,
    views_that_share_an_error=1.0,
    board_sigma_m=(1e-4, 1e-4, 4e-4),
    moved_from_closed_form_deg=0.01,
    moved_from_closed_form_m=1e-4,
)
COVERAGE = Coverage(
    corners_in_cells=np.array([[300, 0], [12, 7]]),
    empty_cells=1,
    tilt_about_x_deg=(-20.0, 31.0),
    tilt_about_y_deg=(-3.0, 5.0),
    roll_deg=(0.0, 90.0),
    distance_m=(0.3, 0.6),
    in_words="corners in every part",
)
TRIED = TriedModel(model="opencv5", board="bowed", cross_validation_px=float("nan"), expected_error_px=0.1)
CAMERA = CameraEvidence(cross_validation=(TRIED,), coverage=COVERAGE, independent_check=OtherSolver(by="OpenCV", f_px=(700.0, 701.0)))
SPHERE = NextSphere(where="at the left", centre_m=np.array([0.1, 0.0, 0.3]), direction_std_deg=0.1, with_it_deg=0.05)
SETTING = RefinedSetting(azimuth_deg=1.0, joint_angle_deg=30.0, d1_m=0.1, d2_m=0.09)
LIGHTS = LightsEvidence(model="round lobe", settings={"L0": SETTING}, next_sphere=SPHERE, outline_bias_px={"chrome": 0.1})
SURFACE = SurfaceFigures(pixels=9, images_exchanged={"L0": "L1"})


def through_yaml(record: Any) -> Any:
    return record_of(type(record), yaml.safe_load(yaml.safe_dump(plain(document_of(record)))))


@pytest.mark.parametrize("record", [HANDEYE, CAMERA, LIGHTS, SURFACE, CameraEvidence()], ids=lambda record: type(record).__name__)
def test_what_is_written_is_read(record: Any) -> None:
    np.testing.assert_equal(document_of(through_yaml(record)), document_of(record))
    assert type(through_yaml(record)) is type(record)


@given(st.floats(), st.integers(0, 100), st.dictionaries(st.text(max_size=5), st.floats(allow_nan=False, allow_infinity=False)))
def test_any_number_survives(residual: float, pixels: int, found: dict[str, float]) -> None:
    read = through_yaml(SurfaceFigures(pixels=pixels, residual_sigmas_rms=residual, intensities_found=found))
    assert read.pixels == pixels
    assert read.intensities_found == found
    assert read.residual_sigmas_rms == (residual if np.isfinite(residual) else None)


def test_nothing_is_written_of_what_is_not_known() -> None:
    assert document_of(CameraEvidence()) == {}
    assert document_of(SurfaceFigures()) == {"pixels": 0, "gloss": None, "reflectance": None}
    assert "closed_form_H_OC" not in document_of(HANDEYE)


@pytest.mark.parametrize(
    ("kind", "key", "value"),
    [
        (HANDEYE, "views_used", "many"),
        (HANDEYE, "rotation_spread_deg", {"x": 1}),
        (HANDEYE, "mocap_sigma_m", None),
        (LIGHTS, "model", "a candle"),
        (LIGHTS, "settings", [1, 2]),
        (CAMERA, "cross_validation", 7),
        (CAMERA, "coverage", "all of it"),
    ],
)
def test_what_is_garbled_is_named(kind: Any, key: str, value: Any) -> None:
    document = plain(document_of(kind)) | {key: value}
    if value is None:
        assert np.isnan(getattr(record_of(type(kind), document), key))
        return
    with pytest.raises((ValueError, KeyError), match=key):
        record_of(type(kind), document)


def test_a_key_that_no_record_knows_is_left_out() -> None:
    assert record_of(SurfaceFigures, {"pixels": 3, "phase_of_the_moon": 0.5}) == SurfaceFigures(pixels=3)


def test_what_an_earlier_version_did_not_write_is_not_known() -> None:
    document = plain(document_of(CAMERA))
    del document["coverage"]["roll_deg"]
    assert record_of(CameraEvidence, document).coverage is None
    handeye = plain(document_of(HANDEYE))
    del handeye["board_size_by_mocap"]
    assert known_record_of(HandEyeEvidence, handeye) is None
    assert known_record_of(HandEyeEvidence, None) is None
