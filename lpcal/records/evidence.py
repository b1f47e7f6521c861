"""What each stage's result rests on: frozen figures, as they stand under ``evidence`` in camera.yaml, handeye.yaml and lights.yaml.

A field that has a default stands in the file only where it is not None; the key is the field's name (`formats.record_documents`).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from lpcal.geometry.arrays import Array, Index, Mask


@dataclass(frozen=True, kw_only=True)
class ChosenModel:
    """The lens model and the board's shape that were taken, and why, in words."""

    model: str
    """The lens model: opencv4, opencv5, opencv8 or splined."""
    board: str
    """The board's shape: shaped, bowed, stretched or flat."""
    why: str
    """Why these were taken, in words."""


@dataclass(frozen=True, kw_only=True)
class TriedModel:
    """A lens model on a board: how far the halves of the views are apart, and the expected error, px; NaN where not known."""

    model: str
    """The lens model: opencv4, opencv5, opencv8 or splined."""
    board: str
    """The board's shape: shaped, bowed, stretched or flat."""
    cross_validation_px: float
    """How far the cameras of two halves of the views are apart, rms over the image."""
    expected_error_px: float
    """The expected error of its projection, of noise and of what the model lacks."""


@dataclass(frozen=True, kw_only=True)
class ShapeTerm:
    """A term of the board's shape (metres; stretch and shear without unit) with its standard deviation."""

    value: float
    """Metres; stretch and shear without unit."""
    std: float
    """Standard deviation of `value`."""


@dataclass(frozen=True, kw_only=True)
class Coverage:
    """Corners in each cell of the image, and the span (2,) of the boards' tilts, rolls (degrees) and distances (m)."""

    corners_in_cells: Index
    """(rows, columns) counts."""
    empty_cells: int
    """Count of the image's parts in which no corner fell."""
    tilt_about_x_deg: tuple[float, ...]
    """The least and the largest tilt of the boards about x."""
    tilt_about_y_deg: tuple[float, ...]
    """The least and the largest tilt of the boards about y."""
    roll_deg: tuple[float, ...]
    """The least and the largest turn of the boards in the image."""
    distance_m: tuple[float, ...]
    """The nearest and the farthest of the boards."""
    in_words: str
    """What is lacking, in words."""


@dataclass(frozen=True, kw_only=True)
class ProjectionUncertainty:
    """Standard deviation of projection on a grid (R, C) of the imager, px, in its worst direction."""

    of: str
    """What it is the standard deviation of, in words."""
    columns_px: Array
    """(C,) where the grid's columns are."""
    rows_px: Array
    """(R,) where its rows are."""
    worst_direction_std_px: Array
    """(R, C) of each point."""
    rms_px: float
    """Root mean square over the grid."""
    most_px: float
    """The largest of the grid."""
    covered_share: float
    """Share of the grid that is covered."""
    covered: Mask
    """(R, C) covered: corners are near."""
    trusted: Mask
    """(R, C) trusted: the lens is known there."""
    trusted_share: float
    """Share of the grid that is trusted."""


@dataclass(frozen=True, kw_only=True)
class OtherSolver:
    """The same corners by another program: its camera and how far it projects from ours, px; `failed` holds its message where it failed."""

    by: str
    """Whose solver it is."""
    failed: str | None = None
    """What went wrong, where it found nothing."""
    f_px: tuple[float, ...] | None = None
    """The focal lengths that it finds, x and y."""
    c_px: tuple[float, ...] | None = None
    """The principal point that it finds, x and y."""
    difference_rms_px: float | None = None
    """By how much its projection differs, rms over the image."""
    difference_worst_px: float | None = None
    """By how much its projection differs where it does so most."""
    board_off_rms_m: float | None = None
    """How far the corners lie from the board's shape, where they were free."""


@dataclass(frozen=True, kw_only=True)
class ResidualPattern:
    """How large a pattern left in the residuals is, rms px a coordinate, and how sure it is there, in standard errors."""

    size_px: float
    """Rms of the pattern that is left in the residuals, a coordinate."""
    z: float
    """How sure it is there, in standard errors."""


@dataclass(frozen=True, kw_only=True)
class ViewThatMatters:
    """By what factor the camera would be less well known without this view."""

    image: str
    """The image's name."""
    without_it: float
    """By what the camera's standard deviation grows without it, as a factor."""


@dataclass(frozen=True, kw_only=True)
class NextView:
    """Where to hold the board next, in words, and what that makes of the mean standard deviation, px."""

    hold_the_board: str
    """Where and how to hold the board, in words."""
    std_now_px: float
    """The mean standard deviation of the projection as it is."""
    std_then_px: float
    """The same with that view."""


@dataclass(frozen=True, kw_only=True)
class CameraEvidence:
    """What a camera solve rests on."""

    chosen: ChosenModel | None = None
    """The lens model and the board's shape that were taken, and why."""
    cross_validation: tuple[TriedModel, ...] = ()
    """The models that were tried: how far two halves of the views are apart, and the expected error."""
    corner_sigma_px: float | None = None
    """Standard deviation of a corner's coordinate, as the residuals show it."""
    board_warp_m: tuple[float, ...] | None = None
    """How far the board bows along x and y; None: it was taken as flat."""
    board_shape: dict[str, ShapeTerm] | None = None
    """Terms of the board's shape, by name."""
    board_warp_allowed: bool | None = None
    """Whether the board's departure from a plane was solved for."""
    coverage: Coverage | None = None
    """Where in the image corners were seen, and how the boards were turned."""
    residual_pattern: dict[str, ResidualPattern] | None = None
    """The pattern left in the residuals over the ``board`` and over the ``image``, each with its size and its z score."""
    projection_uncertainty: ProjectionUncertainty | None = None
    """How well the camera projects, over the image."""
    independent_check: OtherSolver | None = None
    """The same corners by another program (OpenCV)."""
    free_board_check: OtherSolver | None = None
    """The same corners by COLMAP's bundle adjustment, every corner of the board free."""
    views_that_matter: tuple[ViewThatMatters, ...] | None = None
    """The views without which the camera would be known less well, the most important first."""
    next_view: NextView | None = None
    """Where to hold the board next."""
    solver_note: str | None = None
    """Why another solver than mrcal was taken."""


@dataclass(frozen=True, kw_only=True)
class HandEyeEvidence:
    """What a hand-eye solve rests on."""

    views_used: int
    """Count of views that the solve used."""
    rotation_spread_deg: Array
    """(3,) by how much the body turned, rms about three axes, the largest first."""
    mocap_sigma_deg: float
    """One standard deviation of a measured body pose's rotation, an axis."""
    mocap_sigma_m: float
    """One standard deviation of a measured body pose's position, an axis."""
    closed_form_H_PC: Array | None = None
    """(4, 4) where the solve started, by Park's closed form."""
    closed_form_H_OC: Array | None = None
    """The same where the body carries the board."""
    covariance_factor_of_shared_errors: float
    """By how much errors that neighbouring views share grow the covariance."""
    board_size_by_mocap: float
    """The board's size over its stated size, by the mocap's metres."""
    board_size_by_mocap_std: float
    """Its standard deviation."""
    views_that_share_an_error: float
    """Count of neighbouring views whose errors are alike."""
    mocap_sigma_dwell_deg: float | None = None
    """One standard deviation of the rotation of a body pose that is the mean over a dwell."""
    mocap_sigma_dwell_m: float | None = None
    """One standard deviation of the position of such a mean."""
    corner_sigma_px: float | None = None
    """Standard deviation of a corner's coordinate, as the residuals show it."""
    camera_as_refined_here: Array | None = None
    """The camera's parameters after this solve."""
    camera_moved: Array | None = None
    """Those parameters less the ones of camera.yaml."""
    board_sigma_deg: float | None = None
    """Standard deviation of the rotation of board poses found elsewhere."""
    board_sigma_m: tuple[float, ...] | None = None
    """Standard deviations of board poses found elsewhere: two directions across, then depth."""
    moved_from_closed_form_deg: float
    """How far the solve turned H_PC from its start."""
    moved_from_closed_form_m: float
    """How far the solve moved H_PC from its start."""
    weakest: str | None = None
    """The direction in which H_PC is known worst, and what would improve it, in words."""


type LightsModel = Literal["sum of LEDs", "round lobe", "geometry only", "distant lights"]
"""What a light is taken for: its LEDs summed, a round lobe, a place without a lobe, a direction alone."""


@dataclass(frozen=True, kw_only=True)
class RefinedSetting:
    """A wing's setting as refined."""

    azimuth_deg: float
    """The wing's azimuth about the disc's axis."""
    joint_angle_deg: float
    """The joint's angle."""
    d1_m: float
    """From the disc's axis to the joint."""
    d2_m: float
    """From the joint to the blob."""


@dataclass(frozen=True, kw_only=True)
class NextSphere:
    """Where one more chrome sphere helps most, and the mean standard deviation of the directions without and with it."""

    where: str
    """Where the sphere would be, in words."""
    centre_m: Array
    """(3,) where in C its centre would be."""
    direction_std_deg: float
    """The mean standard deviation of the directions as they are."""
    with_it_deg: float
    """The same with that sphere."""


@dataclass(frozen=True, kw_only=True)
class ExposureSweep:
    """What a sweep of exposures says of the sensor."""

    black_level: float
    """The stored number of no light, as a fraction of full scale."""
    gamma: float
    """``stored = linear^(1/gamma)``."""
    misfit: float
    """Rms deviation of the images from the curve, in their noise."""
    noise_read: float
    """Variance of reading, of full scale squared."""
    noise_shot: float
    """Variance over signal, of full scale."""


@dataclass(frozen=True, kw_only=True)
class LightsEvidence:
    """What the refined lights rest on."""

    model: LightsModel | None = None
    """What a light is taken for: its LEDs summed, a round lobe, a place without a lobe, a direction alone."""
    source_offset_m: dict[str, float] | None = None
    """How far a blob's source lies before its mechanical centre, by its count of LEDs."""
    outline_bias_px: dict[str, float] | None = None
    """By how much outlines are found too large, by the spheres' kind."""
    settings: dict[str, RefinedSetting] | None = None
    """The wings' settings as refined, by the light's name."""
    lobe_seen_deg: dict[str, float] | None = None
    """The largest angle from the axis at which spheres showed each light."""
    highlight_rms_px: float | None = None
    """Rms misfit of the chrome spheres' highlights."""
    shading_rms: float | None = None
    """Rms misfit of the matte spheres, relative."""
    next_sphere: NextSphere | None = None
    """Where one more chrome sphere would help most."""
    predicted_shading_rms: float | None = None
    """Rms error, relative, of the shading of a matte sphere that was held out and predicted by the others."""
    predicted_shading_rms_albedo_free: float | None = None
    """The same with that sphere's albedo free."""
    predicted_highlight_px: float | None = None
    """Rms error of the highlights of a chrome sphere that was held out and predicted by the others."""
    exposure_sweep: ExposureSweep | None = None
    """Black level, gamma and noise of the sensor by a sweep of exposures."""
    spheres_disagree_deg: float | None = None
    """Rms of what the spheres' own directions differ by, of distant lights."""
