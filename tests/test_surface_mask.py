"""What a plane claims of an image, by its ratios and its albedo, and where an outline lies that falls between pixels."""

from __future__ import annotations

import numpy as np
import pytest

from lit_scene import calibration
from lpcal.surface import cut, mask, planes
from lpcal.surface.backdrop import backdrop, evidence
from lpcal.surface.mask import _without_faint
from lpcal.surface.sight import Grey, Sight, look_at, ray_map

SIZE = (90, 120)
CARD = (slice(30, 62), slice(40, 84))
Q = np.array([0.02, -0.03, 1 / 0.45])


def wall_and_card(albedo: np.ndarray, card: float, seed: int = 0) -> tuple[Grey, np.ndarray]:
    """A wall of an albedo (H, W), a card in front of it that is parallel to it, by the lights of the drawn scene: maps and rays."""
    camera = calibration().camera
    assert camera is not None
    width, height = camera.image_size
    rays = ray_map((height, width), camera)
    step = height // SIZE[0], width // SIZE[1]
    rays = rays[:: step[0], :: step[1]][: SIZE[0], : SIZE[1]]
    lights = calibration().lights

    def sent(q: np.ndarray) -> np.ndarray:
        return planes.foretold(q, rays.reshape(-1, 3), lights).reshape(len(lights), *rays.shape[:2])

    signal = albedo[: rays.shape[0], : rays.shape[1]] * sent(Q)
    signal[:, *CARD] = card * sent(Q * 1.15)[:, *CARD]
    sigma = np.full_like(signal, 0.004 * np.median(signal))
    signal += sigma * np.random.default_rng(seed).standard_normal(signal.shape)
    return Grey(signal.astype(np.float32), sigma.astype(np.float32), np.ones(signal.shape, bool)), rays


def said(maps: Grey, rays: np.ndarray) -> tuple[Sight, np.ndarray]:
    """The evidence against the wall that is known from the image's rim."""
    shape = rays.shape[:2]
    seen = look_at(maps, rays, np.ones(shape, bool), central=True)
    m = planes.foretold(Q, seen.rays_C, calibration().lights)
    rim = mask.border_band(shape).ravel()
    back = backdrop(seen, m, planes.Plane(Q, 1.0), rim, rim)
    assert back is not None
    return seen, evidence(seen, m, back).reshape(shape)


def test_a_card_parallel_to_the_wall_is_told_by_its_albedo() -> None:
    for seed in range(3):
        against = said(*wall_and_card(np.full(SIZE, 0.3), 0.7, seed))[1]
        card = np.zeros(against.shape, bool)
        card[CARD] = True
        assert np.mean(against[card] > 0.3) > 0.99
        assert np.mean(against[~card] < -0.3) > 0.97


def test_a_patterned_wall_is_still_wall() -> None:
    row, column = np.indices(SIZE)
    pattern = np.where((row // 6 + column // 6) % 2, 0.2, 0.45)
    against = said(*wall_and_card(pattern, 0.9))[1]
    card = np.zeros(against.shape, bool)
    card[CARD] = True
    assert np.mean(against[~card] < 0) > 0.95
    assert np.mean(against[card] > 0) > 0.95


def test_shadow_by_some_lights_leaves_the_wall_a_wall_and_shadow_by_all_says_nothing() -> None:
    maps, rays = wall_and_card(np.full(SIZE, 0.3), 0.7)
    maps.signal[:2, 5:20] *= 0.02
    maps.signal[:, 70:85, 5:40] = maps.sigma[:, 70:85, 5:40] * np.random.default_rng(1).standard_normal((len(maps.signal), 15, 35))
    against = said(maps, rays)[1]
    assert np.mean(against[7:18, 7:-7] < 0) > 0.95
    assert np.abs(np.median(against[72:83, 8:38])) < 0.35


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


def picture(*means: float) -> tuple[np.ndarray, np.ndarray]:
    mask, against = np.zeros((40, 90), bool), np.full((40, 90), -0.6, np.float32)
    for k, mean in enumerate(means):
        piece = (slice(10, 30), slice(5 + 30 * k, 25 + 30 * k))
        mask[piece], against[piece] = True, mean
    return mask, against


def test_a_piece_that_hardly_differs_from_the_wall_goes_where_another_clearly_does() -> None:
    mask, against = picture(0.85, 0.1)
    kept = _without_faint(mask, against)
    assert kept[:, :30].sum() == 400
    assert not kept[:, 30:].any()


def test_two_clear_pieces_stay_and_so_does_a_faint_one_by_itself() -> None:
    for means in ((0.85, 0.5), (0.2,), (0.2, 0.1)):
        mask, against = picture(*means)
        assert np.array_equal(_without_faint(mask, against), mask)
