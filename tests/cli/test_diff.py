"""Two calibrations of one rig: what has moved is named, what has not is not, and what both share is taken out."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import lpcal as library
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.calibration_yaml import write_calibration
from lpcal.formats.documents import Provenance
from lpcal.formats.lights_yaml import write_lights
from lpcal.geometry import se3, sphere
from lpcal.pipeline.diff import lines_of, verdict
from lpcal.records.calibration import Calibration, Light, LightsSolution, SphereFinding
from lpcal.records.comparison import CalibrationChange
from lpcal.records.evidence import RefinedSetting

FOCUS = np.array([0.0, 0.0, 0.35])


def rig(count: int = 8) -> Calibration:
    lights = []
    for k in range(count):
        angle = 2 * np.pi * k / count + 0.2
        source = np.array([0.17 * np.cos(angle), 0.17 * np.sin(angle), 0.04 + 0.02 * (k % 2)])
        axis = (FOCUS - source) / np.linalg.norm(FOCUS - source)
        H_CL = se3.transform(
            np.stack(
                [side := np.cross([0, 1, 0.2], axis) / np.linalg.norm(np.cross([0, 1, 0.2], axis)), np.cross(axis, side), axis], axis=1
            ),
            source,
        )
        lights.append(
            Light(f"L{k}", -axis, np.ones(1), H_CL, source, axis, position_std_m=1.4e-3, direction_std_rad=1e-3, intensity_std=3e-3)
        )
    camera = library.Camera(
        (640, 480),
        "opencv4",
        np.array([[600.0, 0, 320], [0, 600, 240], [0, 0, 1]]),
        np.zeros(4),
        parameters=("fx", "fy", "cx", "cy"),
        covariance=np.diag([0.2, 0.2, 0.3, 0.3]) ** 2,
    )
    return Calibration("rig", tuple(lights), camera, np.eye(4), 0.35, FOCUS)


def moved(light: Light, by_m: np.ndarray, turn_rad: np.ndarray | float = 0.0, power: float = 1.0) -> Light:
    R = se3.rotation(turn_rad + np.zeros(3))
    return replace(light, source_C=light.source_C + by_m, axis_C=R @ light.axis_C, intensity=light.intensity * power)


def measured(true: Calibration, seed: int) -> Calibration:
    """As spheres show it: a shift, a turn and a scale of all lights, and a light's own errors across and along."""
    rng = np.random.default_rng(seed)
    H, scale = se3.exp(rng.normal(size=6) * ([1e-3] * 3 + [1e-3] * 3)), 1 + 4e-3 * rng.normal()
    lights = []
    for light in true.lights:
        across, along = 1.3e-4 * rng.normal(size=3), 4e-4 * rng.normal() * light.direction_C
        source = se3.apply(H, (FOCUS + scale * (light.source_C - FOCUS))[None])[0] + across + along
        axis = se3.rotate(H, light.axis_C[None])[0] + 3e-3 * rng.normal(size=3)
        power = light.intensity * np.exp(1e-3 * rng.normal())
        lights.append(
            replace(
                light,
                source_C=source,
                axis_C=axis / np.linalg.norm(axis),
                intensity=power,
                direction_C=(source - FOCUS) / np.linalg.norm(source - FOCUS),
            )
        )
    return replace(true, lights=tuple(lights))


@pytest.mark.parametrize("count", [6, 12])
def test_an_unmoved_rig_is_silent(count: int) -> None:
    true = rig(count)
    said = [library.compare_calibrations(measured(true, 2 * k), measured(true, 2 * k + 1)).changed for k in range(20)]
    assert said == [()] * 20


@pytest.mark.parametrize("count", [6, 12])
@pytest.mark.parametrize(("by_mm", "turn_deg", "power", "word"), [(3.0, 0, 1, "moved"), (0, 4.0, 1, "turned"), (0, 0, 1.04, "power")])
def test_the_one_that_changed_is_named_and_no_other(count: int, by_mm: float, turn_deg: float, power: float, word: str) -> None:
    true = rig(count)
    for seed in range(6):
        k = seed % count
        direction = np.cross(true.lights[k].direction_C, [0.3, 0.5, 0.8])
        direction /= np.linalg.norm(direction)
        changed = moved(true.lights[k], 1e-3 * by_mm * direction, np.radians(turn_deg) * direction, power)
        after = replace(true, lights=(*true.lights[:k], changed, *true.lights[k + 1 :]))
        found = library.compare_calibrations(measured(true, 2 * seed), measured(after, 2 * seed + 1))
        assert found.changed == (f"L{k}: {word}",)
        if word == "moved":
            assert abs(found.lights[k].moved - 1e-3 * by_mm) < 4 * found.lights[k].moved_std


def test_the_stated_scatter_is_what_unmoved_lights_show() -> None:
    ratios = []
    for seed in range(40):
        true = rig(8)
        found = library.compare_calibrations(measured(true, 2 * seed), measured(true, 2 * seed + 1))
        ratios += [light.power / light.power_std for light in found.lights]
    assert 0.3 < np.std(ratios) < 1.3


def spheres(true: Calibration, seed: int, count: int = 10) -> LightsSolution:
    """What chrome spheres show of the lights: highlights to 0.005 px, outlines to 0.02 px."""
    rng = np.random.default_rng([seed, 5])
    camera, found = true.camera, []
    for k in range(count):
        centre = FOCUS + rng.uniform(-1, 1, 3) * [0.04, 0.03, 0.03]
        outline = camera.project(sphere.outline(centre, 0.025, np.linspace(0, 2 * np.pi, 45, endpoint=False)))
        outward = outline - outline.mean(axis=0)
        outline += -0.31 * outward / np.linalg.norm(outward, axis=1, keepdims=True) + rng.normal(size=2) * 0.02
        seen = {
            one.name: camera.project(sphere.mirror_point(centre, 0.025, one.source_C)) + 5e-3 * rng.normal(size=2) for one in true.lights
        }
        found.append(SphereFinding(f"chrome_{k}", "chrome", centre, 0.025, True, None, outline_px=outline, highlights_px=seen))
    return LightsSolution(true.lights, FOCUS, 0.35, np.eye(4), tuple(found))


def seen_on_two_days(before: Calibration, after: Calibration, seed: int) -> CalibrationChange:
    both = spheres(before, 2 * seed), spheres(after, 2 * seed + 1)
    return library.compare_calibrations(measured(before, 2 * seed), measured(after, 2 * seed + 1), solutions=both)


def test_with_the_spheres_of_both_days_an_unmoved_rig_is_silent_and_the_sigmas_are_those_of_the_moves() -> None:
    true, ratios = rig(6), []
    for seed in range(3):
        found = seen_on_two_days(true, true, seed)
        assert found.changed == ()
        ratios += [light.moved_L / light.moved_L_std for light in found.lights]
    assert 0.7 < np.sqrt(np.mean(np.square(ratios))) < 1.4
    assert 0.004 < found.highlight_px < 0.006


@pytest.mark.parametrize("axis", [0, 1])
def test_with_the_spheres_of_both_days_three_tenths_of_a_millimetre_are_named(axis: int) -> None:
    true = rig(6)
    for k in range(2):
        by = 3e-4 * true.lights[k].H_CL[:3, axis]
        changed = moved(true.lights[k], by)
        found = seen_on_two_days(true, replace(true, lights=(*true.lights[:k], changed, *true.lights[k + 1 :])), k)
        assert found.changed == (f"L{k}: moved",)
        assert abs(found.lights[k].moved_L[axis] - 3e-4) < 4 * found.lights[k].moved_L_std[axis]
        assert found.lights[k].moved_L_std[axis] < 1e-4


def test_what_would_have_shown_is_stated_and_is_what_shows() -> None:
    true = rig(6)
    still = seen_on_two_days(true, true, 1)
    least = still.lights[2].least
    assert np.allclose(least.moved_L, 3 * still.lights[2].moved_L_std)
    assert least.moved_L[2] > 3 * least.moved_L[:2].max()  # along its emission: chrome spheres hardly show it
    for share, says in ((0.3, ()), (2.0, ("L2: moved",))):
        for axis in range(2):
            by = share * least.moved_L[axis] * true.lights[2].H_CL[:3, axis]
            after = replace(true, lights=(*true.lights[:2], moved(true.lights[2], by), *true.lights[3:]))
            assert seen_on_two_days(true, after, 1).changed == says
    assert verdict(still).startswith("nothing has changed beyond chance; a light moved across by less than 0.")
    heading = next(k for k, line in enumerate(lines_of(still)) if "along arm, mm" in line)
    assert lines_of(still)[heading + 3].split()[:2] == ["L2", f"{1e3 * least.moved_L[0]:.2f}"]


def test_the_turns_that_would_have_shown_are_stated_where_the_wings_are_known() -> None:
    true = rig(6)
    both = [spheres(true, seed) for seed in (2, 3)]
    settings = {light.name: RefinedSetting(azimuth_deg=0.0, joint_angle_deg=30.0, d1_m=0.1, d2_m=0.085) for light in true.lights}
    both[0] = replace(both[0], evidence=replace(both[0].evidence, settings=settings))
    found = library.compare_calibrations(measured(true, 2), measured(true, 3), solutions=(both[0], both[1]))
    for light in found.lights:
        assert light.least.joint_rad == pytest.approx(3 * light.moved_L_std[2] / 0.085)
        assert light.least.joint_rad > np.radians(0.1)  # a tenth of a degree of a joint is never excluded by this camera
    said = lines_of(found)
    heading = next(k for k, line in enumerate(said) if "along arm, mm" in line)
    assert re.fullmatch(r"L0( +[\d.]+){2} \([\d.]+\) +[\d.]+ \([\d.]+\)( +[\d.]+){2}", said[heading + 1])


def test_with_the_spheres_of_both_days_what_all_lights_share_is_named_as_such_and_no_single_light() -> None:
    true = rig(6)
    knocked = replace(true, lights=tuple(moved(light, np.array([0.0, 3e-3, 0.0])) for light in true.lights))
    found = seen_on_two_days(true, knocked, 4)
    assert found.changed == ("all lights changed",)
    assert found.together.chance < 1e-6
    still = seen_on_two_days(true, true, 4)
    assert still.together.chance > 0.01


def test_with_four_spheres_a_day_half_a_millimetre_is_named_of_one_light_and_no_other_is_doubted() -> None:
    true = rig(6)
    changed = moved(true.lights[3], 5e-4 * true.lights[3].H_CL[:3, 1])
    after = replace(true, lights=(*true.lights[:3], changed, *true.lights[4:]))
    both = spheres(true, 20, 4), spheres(after, 21, 4)
    found = library.compare_calibrations(measured(true, 20), measured(after, 21), solutions=both)
    assert found.changed == ("L3: moved",)
    assert found.lights[3].moved_L_std[1] < 1.1e-4


def test_lights_that_were_exchanged_or_are_missing_are_named() -> None:
    true = rig(8)
    one, two = (replace(true.lights[a], name=true.lights[b].name) for a, b in ((1, 5), (5, 1)))
    after = replace(true, lights=(true.lights[0], one, *true.lights[2:5], two, *true.lights[6:7]))
    found = library.compare_calibrations(measured(true, 0), measured(after, 1))
    assert "L1 and L5 stand where the other stood" in found.changed
    assert "L7 is in one of the two only" in found.changed


def test_hand_eye_and_camera_are_held_against_both_covariances() -> None:
    true = rig()
    covariance = np.diag([2e-4] * 3 + [2e-4] * 3) ** 2
    same = replace(true, H_PC=se3.exp(1e-4 * np.array([1.0, -1, 1, 1, 1, -1])))
    assert library.compare_calibrations(true, same, H_PC_covariances=(covariance, covariance)).changed == ()
    off = replace(
        true, H_PC=se3.exp(np.array([0, 0, 0, 1.6e-3, 0, 0])), camera=replace(true.camera, K=true.camera.K + np.diag([3.0, 3.0, 0]))
    )
    found = library.compare_calibrations(true, off, H_PC_covariances=(covariance, covariance))
    assert found.changed == ("the camera on the body changed", "the camera itself changed")
    assert found.camera.moved == pytest.approx(np.sqrt(np.mean(np.sum(((GRID - [320, 240]) * 3 / 600) ** 2, axis=1))), rel=0.2)


GRID = np.stack(np.meshgrid(np.linspace(0, 639, 40), np.linspace(0, 479, 30)), axis=-1).reshape(-1, 2)


def test_what_cannot_be_compared() -> None:
    true = rig()
    with pytest.raises(DegenerateError, match="3 lights in common"):
        library.compare_calibrations(true, replace(true, lights=true.lights[:3]))
    far = replace(true, lights=tuple(replace(light, source_C=None, axis_C=None) for light in true.lights))
    with pytest.raises(DisagreementError, match="near lights in one, distant ones in the other"):
        library.compare_calibrations(true, far)


def test_distant_lights_are_compared_by_their_directions() -> None:
    far = replace(rig(), camera=None, lights=tuple(replace(light, source_C=None, axis_C=None, H_CL=None) for light in rig().lights))
    turn = se3.rotation(np.radians([0.0, 0.0, 2.0]))
    lights = [replace(light, direction_C=turn @ light.direction_C) for light in far.lights]
    lights[3] = replace(lights[3], direction_C=se3.rotation(np.radians([1.5, 0, 0])) @ lights[3].direction_C)
    found = library.compare_calibrations(far, replace(far, lights=tuple(lights)))
    assert found.changed == ("L3: moved",)
    said = lines_of(found)
    assert "direction, deg" in said[0]
    assert re.search(r"^L3 +1\.[34]\d ", said[4])
    heading = next(k for k, line in enumerate(said) if "would have shown" in line) + 1
    assert said[heading].split() == ["light", "direction,", "deg", "axis", "turned,", "deg", "power,", "%"]
    assert re.fullmatch(r"L0 +[\d.]+ +- +[\d.]+", said[heading + 1])


def test_the_command_says_it_and_draws_it(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path) -> None:
    true = rig()
    after = replace(true, lights=(*true.lights[:2], moved(true.lights[2], np.array([0.004, 0, 0])), *true.lights[3:]))
    for name, one in (("old.yaml", measured(true, 0)), ("new/calib/calibration.yaml", measured(after, 1))):
        write_calibration(tmp_path / name, one, Provenance())
    code, told, _ = lpcal("diff", "old.yaml", "new", cwd=tmp_path)
    assert code == 0
    assert "changed beyond chance: L2: moved" in told
    for name, one in (("lights.yaml", true), ("new/calib/lights.yaml", after)):
        write_lights(tmp_path / name, replace(spheres(one, 3), lights=measured(one, int(one is after)).lights), Provenance())
    assert "moves are by the chrome spheres of both days" in lpcal("diff", "old.yaml", "new", "-o", "seen.html", cwd=tmp_path)[1]
    page = (tmp_path / "diff.html").read_text()
    assert "L2: moved" in page
    scene = json.loads(page.partition('<script type="application/json">')[2].partition("</script>")[0])
    arrows = [item for item in scene["items"] if item["kind"] == "arrow"]
    assert len(arrows) == 8
    assert [item["tone"] for item in arrows].count("poor") == 1
    assert lpcal("diff", "old.yaml", "new", "--json", "-o", "other.html", cwd=tmp_path)[0] == 0
    assert lpcal("diff", "old.yaml", "old.yaml", "-o", "old.yaml", cwd=tmp_path)[0] == 2
    assert lpcal("diff", "old.yaml", "nothing.yaml", cwd=tmp_path)[0] == 3
