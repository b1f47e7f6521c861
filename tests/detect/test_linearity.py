"""An exposure sweep tells black level, gamma and noise; what contradicts it is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lpcal.detect.exposures import fit_sweep, refuse_contradiction
from lpcal.detect.radiometry import Sensor
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.geometry.arrays import Array

TIMES = np.array([1, 2, 4, 8, 16]) * 1e-3


def sweep(
    black: float = 0.03, gamma: float = 1.0, seed: int = 0, times: Array = TIMES, curve: Callable[..., Any] = lambda x: x
) -> np.ndarray:
    """Electrons counted, read noise added, stored in 8 bits."""
    rng = np.random.default_rng(seed)
    row, column = np.indices((160, 240))
    light = 40 * (0.1 + 0.6 * column / 240) * (1 + 0.4 * np.sin(row / 9.0) * np.sin(column / 13.0))
    well = 12000
    electrons = rng.poisson(light * times[:, None, None] * well) + 8 * rng.standard_normal((len(times), 160, 240))
    low = black**gamma
    stored = np.maximum(low + (1 - low) * curve(np.clip(electrons / well, 0, 1)), 0) ** (1 / gamma)
    return (np.rint(255 * np.clip(stored, 0, 1)) / 255).astype(np.float32)


@pytest.mark.parametrize(("black", "gamma"), [(0.0, 1.0), (0.03, 1.0), (0.03, 2.2), (0.06, 1.4)])
def test_black_level_and_gamma_are_found(black: float, gamma: float) -> None:
    found = fit_sweep(sweep(black, gamma), TIMES, Sensor(black, 1.0, gamma), 1 / 255)
    assert found.gamma == pytest.approx(gamma, rel=0.03)
    assert found.black_level == pytest.approx(black, abs=0.003 if gamma == 1 else 0.01)
    assert found.misfit < 0.01


def test_the_noise_is_that_of_the_electrons() -> None:
    found = fit_sweep(sweep(0.0), TIMES, Sensor(), 1 / 255)
    for level in (0.1, 0.4):
        assert np.sqrt(found.noise[0] + found.noise[1] * level) == pytest.approx(
            np.sqrt(level / 12000 + (8 / 12000) ** 2 + 1 / 255**2 / 12), rel=0.2
        )


def test_what_contradicts_the_sweep_is_refused() -> None:
    with pytest.raises(DisagreementError, match=r"gamma 2\.[12]\d, not 1"):
        refuse_contradiction(fit_sweep(sweep(0.03, 2.2), TIMES, Sensor(0.03), 1 / 255), Sensor(0.03))
    with pytest.raises(DisagreementError, match=r"black is [23]\.\d+ % of full scale, not 0 %"):
        refuse_contradiction(fit_sweep(sweep(0.03), TIMES, Sensor(), 1 / 255), Sensor())
    refuse_contradiction(fit_sweep(sweep(0.03), TIMES, Sensor(0.03), 1 / 255), Sensor(0.03))


def test_an_s_shaped_curve_is_no_gamma() -> None:
    images = sweep(0.0, curve=lambda x: x**2 * (3 - 2 * x) * 0.6 + 0.4 * np.sqrt(x))
    with pytest.raises(DisagreementError, match="no gamma"):
        refuse_contradiction(fit_sweep(images, TIMES, Sensor(), 1 / 255), Sensor())


def test_auto_exposure_is_named() -> None:
    images = np.stack([sweep(0.0, seed=k)[3] for k in range(5)])
    with pytest.raises(DisagreementError, match="does not follow"):
        fit_sweep(images, TIMES, Sensor(), 1 / 255)


def test_too_few_and_saturated_are_refused() -> None:
    with pytest.raises(DegenerateError, match="2 exposures"):
        fit_sweep(sweep()[:2], TIMES[:2], Sensor(), 1 / 255)
    with pytest.raises(DegenerateError, match="unsaturated"):
        fit_sweep(np.minimum(40 * sweep(), 1), TIMES, Sensor(), 1 / 255)


def test_refine_holds_the_sweep_against_what_is_stated(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    import cv2

    from lights_planted import rig
    from lpcal.formats.lights_yaml import read_lights

    rig(tmp_path, ["chrome_0"])
    panel = tmp_path / "panel.yaml"
    (tmp_path / "sweep").mkdir()
    stated = []
    for k, image in enumerate(sweep(0.008)):
        cv2.imwrite(str(tmp_path / "sweep" / f"e{k}.png"), np.rint(255 * image).astype(np.uint8))
        stated.append(f"e{k}: {1e3 * TIMES[k]:g} ms")
    panel.write_text(panel.read_text().replace("flat_field", "exposure_sweep: sweep, flat_field"))
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 3
    assert "no exposure is stated for e0, e1" in err
    (tmp_path / "sweep" / "capture.yaml").write_text(f"exposures: {{{', '.join(stated)}}}\n")
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 0, err
    said = read_lights(tmp_path / "calib" / "lights.yaml").evidence.exposure_sweep
    assert said.gamma == pytest.approx(1.0, abs=0.03)
    panel.write_text(panel.read_text().replace("black_level: 0.8 %", "black_level: 0.8 %, gamma: 2.2"))
    code, _, err = lpcal("refine", cwd=tmp_path)
    assert code == 6
    assert "not 2.2" in err
