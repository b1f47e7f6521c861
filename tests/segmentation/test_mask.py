"""Planes found by votes, layers labelled by evidence, outlines carried to full size, in pictures of exact planes under near lights."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from lit_scene import calibration
from lpcal.geometry import raster
from lpcal.segmentation import background, cut, layers, mask, plane_hough, planes, sample_costs
from lpcal.segmentation.features import View
from lpcal.segmentation.plane_hough import Sweep
from lpcal.view.coarse import Coarse, LightTable, coarse_of
from lpcal.view.pixel_list import light_vectors, ray_map
from plane_scene import FLOOR, WALL, WORKING_M, picture, scene


def iou(found: np.ndarray, true: np.ndarray) -> float:
    return float((found & true).sum() / (found | true).sum())


@pytest.mark.parametrize(("pattern", "card"), [(False, 0.2), (True, 0.7), pytest.param(False, 0.7, marks=pytest.mark.slow)])
def test_a_card_parallel_to_the_wall_is_the_object(pattern: bool, card: float) -> None:
    parts = scene(pattern, card)
    maps, rays = picture(parts)
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M)
    assert iou(found.mask, parts[-1][2]) > 0.95
    assert found.planes[0].q == pytest.approx(WALL, rel=0.05, abs=0.05)


def test_a_floor_that_meets_the_wall_is_no_object() -> None:
    parts = scene(floor=True)
    maps, rays = picture(parts)
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M)
    assert len(found.planes) >= 2
    assert iou(found.mask, parts[-1][2]) > 0.88


def test_shadows_on_the_wall_are_wall() -> None:
    parts = scene()
    maps, rays = picture(parts)
    maps.signal[0, 60:100, 5:45] *= 0.03
    maps.signal[1, 10:30, 100:150] *= 0.03
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M)
    assert iou(found.mask, parts[-1][2]) > 0.95


def test_a_wall_alone_is_the_object() -> None:
    maps, rays = picture(scene(card=None))
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M)
    assert found.how == "all that is lit lies in one plane: that is the object"
    assert found.mask.mean() > 0.98


def test_planes_are_found_where_they_are() -> None:
    maps, rays = picture(scene(card=None, floor=True))
    image = coarse_of(maps, rays, 2)
    table = LightTable.of(image, calibration().lights, WORKING_M)
    swept = plane_hough.sweep(image, table, WORKING_M)
    found = plane_hough.find(image, table, swept, np.ones(len(image.rays_C), bool), WORKING_M)
    for q in (WALL, FLOOR):
        nearest = min(found, key=lambda one, q=q: float(np.linalg.norm(one - q)))
        assert np.degrees(np.arccos(nearest @ q / np.linalg.norm(nearest) / np.linalg.norm(q))) < 1.5
        assert np.linalg.norm(nearest) == pytest.approx(np.linalg.norm(q), rel=0.02)


def test_the_table_of_lights_is_the_field() -> None:
    maps, rays = picture(scene())
    image, lights = coarse_of(maps, rays, 4), calibration().lights
    table = LightTable.of(image, lights, WORKING_M)
    rng = np.random.default_rng(3)
    u = np.log(WORKING_M * rng.uniform(0.6, 2, len(image.rays_C)))
    B, _ = table.at(u, np.arange(len(u)))
    d, E = light_vectors(lights, np.exp(u)[:, None] * image.rays_C)
    error = np.linalg.norm(B - d * E[..., None], axis=2) / np.linalg.norm(d * E[..., None], axis=2).max(axis=0)
    assert np.median(error) < 1.5e-3
    assert np.percentile(error, 99) < 1e-2


def test_a_light_whose_direction_is_ill_known_is_doubted_in_the_tail_of_its_lobe() -> None:
    maps, rays = picture(scene())
    image, lights = coarse_of(maps, rays, 4), calibration().lights
    vague = [replace(light, direction_std_rad=0.02) for light in lights]
    sure, unsure = (LightTable.of(image, some, WORKING_M).doubt for some in (lights, vague))
    assert np.median(unsure / sure) == pytest.approx(0.02 / 0.0026, rel=0.01)
    assert np.median(np.ptp(unsure, axis=0)) > 0


def test_shadow_costs_less_than_half_light_and_a_highlight_most() -> None:
    rng = np.random.default_rng(0)
    m = rng.uniform(0.5, 1, (6, 400))
    usable, doubt, sigma = np.ones(m.shape, bool), np.zeros(m.shape), np.full(m.shape, 0.005)
    cost = []
    for factor in (1.0, 0.0, 0.6, 3.0):
        signal = 0.4 * m
        signal[2] *= factor
        cost.append(float(np.median(sample_costs.planar(signal, sigma, usable, m, doubt)[0])))
    lit, dark, half, bright = cost
    assert lit < 1 < dark == pytest.approx(sample_costs.DARK)
    assert dark < half == pytest.approx(sample_costs.HALF_DARK)
    assert bright > half


def test_labels_are_smooth_and_end_at_edges() -> None:
    rng = np.random.default_rng(1)
    true = np.zeros((30, 40), int)
    true[8:22, 12:30] = 1
    true[22:, :] = 2
    cost = 12.0 * (np.arange(3)[:, None, None] != true) + 14 * rng.standard_normal((3, 30, 40))
    bright = np.choose(true, [0.2, 0.5, 1.0]).astype(np.float32)
    assert np.mean(np.argmin(cost, axis=0) == true) < 0.8
    assert np.mean(layers.cheapest(cost, *layers.boundary(bright)) == true) > 0.95


def view_of(
    shape: tuple[int, int], allowed: np.ndarray | None = None, points: tuple[tuple[int, int], ...] = (), bright: np.ndarray | None = None
) -> View:
    """A view of which nothing is known but how bright it is; matter of any normal slants to the side."""
    pixels = shape[0] * shape[1]
    signal = np.ones((2, pixels)) if bright is None else np.tile(bright.ravel(), (2, 1))
    image = Coarse(signal, np.ones((2, pixels)), np.ones((2, pixels), bool), np.tile([0.0, 0.0, 1.0], (pixels, 1)), shape, 1)
    no_light = LightTable(0.0, 1.0, np.zeros((pixels, 1, 0, 3)), np.zeros((pixels, 1, 0)))
    slanting = np.tile([0.8, 0.0, -0.6], (1, pixels, 1))
    level = np.zeros(shape, np.float32) if bright is None else np.log(bright).astype(np.float32)
    swept = Sweep(np.full(1, np.log(0.4)), slanting, np.zeros((1, pixels)))
    return View(image, no_light, swept, WORKING_M, level, None, allowed, points)


def costs(labels: np.ndarray, planes_found: int, apart: float = 20.0) -> np.ndarray:
    """Costs (layers, rows, columns): nothing for the own layer, `apart` for the others."""
    return apart * (np.arange(planes_found + 3)[:, None, None] != labels)


def object_of(labels: np.ndarray, planes_found: list[np.ndarray], view: View) -> np.ndarray:
    return background.judged(view, labels, planes_found, costs(labels, len(planes_found))).mask


def test_what_holds_the_frame_is_background_and_what_lies_in_the_middle_the_object() -> None:
    labels = np.full((40, 60), 1)
    labels[10:28, 20:40] = 0
    assert iou(object_of(labels, [WALL], view_of(labels.shape)), labels == 0) > 0.94
    labels[14:20, 24:30] = 3
    assert iou(object_of(labels, [WALL], view_of(labels.shape)), labels != 1) > 0.94, "other matter within it"
    labels[30:, 50:] = 3
    assert iou(object_of(labels, [WALL], view_of(labels.shape)), (labels != 1) & (np.indices(labels.shape)[0] < 30)) > 0.94


def test_the_odds_turn_as_a_region_takes_more_of_the_frame() -> None:
    odds = []
    for wide in (0, 10, 30, 60):
        labels = np.full((40, 60), 1)
        labels[8:32, 15:45] = 2
        labels[32:, :wide] = 2
        judged = background.judged(
            view_of(labels.shape, bright=np.where(labels == 2, 1.0, 0.4)), labels, [WALL, WALL / 0.8], costs(labels, 2)
        )
        odds.append(float(judged.odds[20, 30]))
    assert odds == sorted(odds, reverse=True)
    assert odds[0] > 4 * odds[-1]


@pytest.mark.parametrize("room", [None, 0.1, 0.02], ids=["a wall", "a bright room that no light reaches", "a dark one"])
def test_the_background_is_seen_through_a_hole_in_the_object(room: float | None) -> None:
    """A ring before it, turned to the side; what no light reaches is told from the object by the image without lights."""
    row, column = np.indices((112, 160))
    far = np.hypot(row - 56, column - 78)
    ring = (far < 40) & (far > 18)
    turned = (WALL + np.array([1.2, 0.3, 0.0])) * 0.45 / 0.4
    behind = [(WALL, np.full(row.shape, 0.35), np.ones(row.shape, bool))] if room is None else []
    maps, rays = picture([*behind, (turned, np.full(row.shape, 0.7), ring)])
    maps = replace(maps, sigma=np.full_like(maps.sigma, 0.004 * np.median(maps.signal[:, ring])))
    ambient = None
    if room is not None:
        ambient = (np.where(ring, 0.05, room) * (1 + 0.02 * np.random.default_rng(2).standard_normal(ring.shape))).astype(np.float32)
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M, room=ambient)
    assert iou(found.mask, ring) > 0.95


def test_what_lies_beyond_the_box_is_not_the_object_and_its_edge_is_the_frame() -> None:
    labels = np.full((40, 60), 1)
    labels[8:28, 6:26], labels[8:28, 34:54] = 0, 0
    assert iou(object_of(labels, [WALL], view_of(labels.shape)), labels == 0) > 0.9
    allowed = np.zeros(labels.shape, bool)
    allowed[4:32, 2:30] = True
    assert iou(object_of(labels, [WALL], view_of(labels.shape, allowed)), (labels == 0) & allowed) > 0.9
    labels[6:34, 6:54], labels[15:25, 25:35] = 2, 0
    allowed[:], allowed[10:30, 20:40] = False, True
    assert iou(object_of(labels, [WALL, WALL / 0.7], view_of(labels.shape, allowed)), labels == 0) > 0.9


def test_a_point_makes_what_it_shows_the_object_and_chooses_among_pieces() -> None:
    labels = np.full((40, 60), 1)
    labels[:, 40:] = 2
    labels[10:25, 10:20] = 0
    planes_found = [WALL, WALL / 0.7]
    assert iou(object_of(labels, planes_found, view_of(labels.shape)), labels == 0) > 0.94
    assert iou(object_of(labels, planes_found, view_of(labels.shape, points=((30, 50),))), labels == 2) > 0.94
    assert iou(object_of(labels, planes_found, view_of(labels.shape, points=((30, 50), (12, 12)))), labels != 1) > 0.94


def test_hints_in_pixels_bound_a_mask() -> None:
    given = np.zeros((30, 40), bool)
    given[5:15, 5:15], given[20:28, 20:35] = True, True
    assert np.array_equal(mask.Hints().of(given), given)
    boxed = mask.Hints(box=(0, 0, 10, 30)).of(given)
    assert boxed.sum() == 50
    assert not boxed[:, 10:].any()
    pointed = mask.Hints(points=((22, 21),)).of(given)
    assert np.array_equal(pointed, given & (np.indices(given.shape)[0] >= 20))
    assert not mask.Hints(box=(0, 0, 18, 18), points=((1, 1),)).of(given).any()
    large = np.kron(given, np.ones((10, 10), bool))
    assert np.array_equal(mask.Hints(points=((198, 245),)).of(large), large & (np.indices(large.shape)[0] >= 180)), "two pixels beside it"
    assert not mask.Hints(points=((180, 245),)).of(large).any()


def test_a_box_helps_where_two_things_stand_before_the_wall() -> None:
    """Of two cards the left one alone is wanted."""
    row, column = np.indices((112, 160))
    left, right = ((row > 36) & (row < 74) & (column > at) & (column < at + 40) for at in (20, 95))
    parts = [(WALL, np.full(row.shape, 0.35), np.ones(row.shape, bool))]
    parts += [(WALL * 0.45 / 0.4, np.full(row.shape, 0.7), one) for one in (left, right)]
    maps, rays = picture(parts)
    lights = calibration().lights
    assert iou(mask.automatic(maps, rays, lights, WORKING_M, mask.Hints(box=(10, 20, 70, 70))).mask, left) > 0.95
    assert iou(mask.automatic(maps, rays, lights, WORKING_M, mask.Hints(points=((40, 50),))).mask, left) > 0.95


def test_the_floor_carries_the_object_and_the_wall_does_not() -> None:
    parts = scene(floor=True)
    maps, rays = picture(parts)
    found = mask.automatic(maps, rays, calibration().lights, WORKING_M)
    card, floor = parts[-1][2], parts[1][2]
    assert found.layer is not None
    clear = ~raster.eroded(~card, 3, beyond=True) == card  # away from the card's outline
    for value, true in ((background.Layer.WALL, ~card & ~floor), (background.Layer.SUPPORT, floor & ~card)):
        assert np.mean(found.layer[true & clear] == value) > 0.95
    assert np.array_equal(found.kept("object"), found.mask)
    assert iou(found.kept("support"), card | floor) > 0.9
    assert found.kept("all").mean() > 0.97


def test_why_a_mask_is_doubted_names_the_rival_and_the_place() -> None:
    labels = np.full((30, 40), 1)
    labels[10:20, 10:30] = 0
    odds = np.where(labels == 0, 0.98, 0.01)
    judged = background.judged(view_of(labels.shape), labels, [WALL], costs(labels, 1))
    sure = background.doubt_of(replace(judged, odds=odds, behind=labels == 1, mask=labels == 0), labels)
    assert sure.share < 0.08
    assert not sure.place.any()
    labels[10:20, 24:30], odds[10:20, 24:30] = 2, 0.6
    doubt = background.doubt_of(replace(judged, odds=odds, behind=odds < 0.5, mask=odds > 0.5), labels)
    assert doubt.rival == 2
    assert doubt.share == pytest.approx((60 * 0.4 + 140 * 0.02 + 1000 * 0.01) / 200)
    assert doubt.open == pytest.approx(60 / 200)
    said = mask._in_words(doubt, "support", 5)
    assert "the support under it" in said
    assert "x 120 to 150, y 50 to 100" in said


def test_the_doubt_rises_with_what_is_expected_wrong() -> None:
    odds = [
        mask.Found(np.ones((2, 2), bool), "", expected_wrong=share).doubt
        for share in (0.3 * mask.DOUBTED, 0.6 * mask.DOUBTED, mask.DOUBTED, 0.5)
    ]
    assert odds == sorted(odds)
    assert odds[0] < 0.05 < odds[2] == pytest.approx(0.5)


@pytest.mark.parametrize("offset", [0.0, 0.3, 0.6])
def test_an_edge_between_pixels_is_put_where_it_lies(offset: float) -> None:
    import cv2

    fine = np.full((400, 400), 1.0, np.float32)
    edge = 200 + round(10 * offset)
    fine[:, edge:] = 3.0
    image = cv2.GaussianBlur(fine, (0, 0), 6).reshape(40, 10, 40, 10).mean(axis=(1, 3))
    signal = np.stack([image, 2 * image])
    truth = np.zeros((40, 40), bool)
    truth[:, int(np.ceil((edge - 5) / 10)) :] = True
    for slip in (-1, 0, 1):
        found = cut.halfway(np.roll(truth, slip, axis=1) if slip else truth, signal, np.full_like(signal, 0.05))
        assert np.abs(found[5:-5, 10:30].sum(axis=1) - truth[5:-5, 10:30].sum(axis=1)).max() <= (0 if offset == 0 else 1)


@pytest.mark.parametrize("q", [WALL, FLOOR], ids=["wall", "floor up to its horizon"])
def test_a_plane_of_many_rays_is_lit_as_one_of_few(q: np.ndarray) -> None:
    camera, lights = calibration().camera, calibration().lights
    rays = ray_map((112, 160), camera).reshape(-1, 3)
    assert len(rays) > 2 * planes.NODES**2
    between = planes.predicted(q, rays, lights)
    each = np.concatenate([planes.predicted(q, part, lights) for part in np.array_split(rays, 4)], axis=1)
    assert np.array_equal(np.isnan(between), np.isnan(each))
    assert np.nanmax(np.abs(between - each)) < 1e-4 * np.nanmax(each)


def test_what_is_smooth_is_right_between_nodes() -> None:
    at = np.random.default_rng(2).uniform(-1, 1, (4000, 2)) * [1.0, 0.6]

    def smooth(xy: np.ndarray) -> np.ndarray:
        return np.stack([np.exp(-((xy[:, 0] - 0.2) ** 2) / 0.1) + xy[:, 1], np.cos(3 * xy[:, 0] * xy[:, 1])])

    assert np.abs(planes.interpolated(smooth, at, 64) - smooth(at)).max() < 1e-4  # nodes a thirtieth apart
    alone = np.zeros((20, 2))  # no extent: every place is one node
    np.testing.assert_allclose(planes.interpolated(smooth, alone, 8), smooth(alone), atol=1e-9)
