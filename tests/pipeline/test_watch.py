"""A folder that is watched: each new image judged soon, what is wrong with it said, what comes next, and the page on loopback alone."""

from __future__ import annotations

import json
import os
import re
import threading
import time
import urllib.error
import urllib.request
from collections import deque
from collections.abc import Callable
from concurrent.futures import Executor, Future
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest

import ball_scenes
from board_pictures import Pattern, Studio, exposed, poses
from lpcal.api.watching import Watched, exposure_words
from lpcal.errors import InputError, UsageError
from lpcal.formats.panel_yaml import read_rig
from lpcal.geometry.arrays import Array
from lpcal.pipeline.watch import AT_WORK, Watch, watch
from lpcal.records.observations import Board

BOARD = Board((9, 6), (0.025, 0.025))
PANEL = """lpcal: 1
camera: {images: stations/*.png}
board: {kind: chessboard, corners: [9, 6], square: 25 mm}
lights: {L0: {}, L1: {}, L2: {}}
spheres: {ball: {kind: chrome, radius: 25 mm, images: spheres/ball}}
"""


@pytest.fixture(scope="module")
def pictures() -> list[np.ndarray]:
    return [exposed(Studio().picture(H_CB, Pattern()), k) for k, H_CB in enumerate(poses(8, 17))]


def float_of(picture: np.ndarray) -> np.ndarray:
    return (picture / 255).astype(np.float32)


def test_boards_are_counted_by_where_their_corners_fell(pictures: list[np.ndarray]) -> None:
    session = Watched(BOARD, ())
    assert session.following().startswith("the board to the")
    for k, picture in enumerate(pictures):
        seen = session.judge_board(f"{k}.png", float_of(picture))
        assert "board found" in seen.words, seen
    assert 0.2 < session.covered <= 1
    assert session.counted.sum() == 54 * len(pictures)


def test_what_is_wrong_with_a_board_image_is_said(pictures: list[np.ndarray]) -> None:
    session = Watched(BOARD, ())
    for picture in pictures[:4]:
        session.judge_board("good.png", float_of(picture))
    blurred = session.judge_board("blurred.png", cv2.GaussianBlur(float_of(pictures[1]), (0, 0), 4))
    assert blurred.tone != "good"
    white = session.judge_board("white.png", np.minimum(3 * float_of(pictures[2]), 1))
    assert "saturated" in white.words[0]
    none = session.judge_board("none.png", np.full((480, 640), 0.5, np.float32))
    assert none.tone == "poor"
    late = session.judge_board("late.png", np.full((480, 640), 0.5, np.float32), look=False)
    assert late.words == ("no board at a glance; too many at once to search",)


@pytest.mark.parametrize(
    ("pixels", "words", "tone"),
    [
        (np.linspace(0, 0.9, 10000).reshape(100, 100), (), "good"),
        (np.linspace(0, 0.1, 10000).reshape(100, 100), ("dim: its brightest is 10 % of full scale",), "fair"),
        (np.linspace(0, 2, 10000).reshape(100, 100).clip(0, 1), ("50.2 % saturated: a shorter exposure",), "poor"),
    ],
)
def test_exposures(pixels: Array, words: tuple[Any, ...], tone: str) -> None:
    assert exposure_words(pixels.astype(np.float32)) == (words, tone)


def test_lights_that_a_capture_lacks_are_next_and_a_chrome_sphere_may_be_dark() -> None:
    session = Watched(None, ("L0", "L1", "L2"))
    lit, dark = np.full((20, 20), 0.6, np.float32), np.full((20, 20), 0.02, np.float32)
    session.judge_light("objects/vase", "L0", lit)
    session.judge_light("objects/vase", "L2", lit)
    assert session.following() == "objects/vase: 1 of 3 lights are lacking, next L1"
    assert session.judge_light("objects/vase", "L1", dark).tone == "fair"
    assert session.judge_light("spheres/ball", "L0", dark, chrome=True).tone == "good"
    assert session.following() == "spheres/ball: 2 of 3 lights are lacking, next L1"


def test_an_ambient_image_or_a_short_exposure_is_no_board_and_no_light(tmp_path: Path) -> None:
    (tmp_path / "panel.yaml").write_text(PANEL)
    (tmp_path / "objects/vase").mkdir(parents=True)
    for name in ("ambient", "ambient_1", "short_L0"):
        cv2.imwrite(str(tmp_path / f"objects/vase/{name}.png"), np.full((48, 64), 5, np.uint8))
    cv2.imwrite(str(tmp_path / "objects/vase/L1.png"), np.full((48, 64), 200, np.uint8))
    said: list[str] = []
    found = watch(tmp_path, read_rig(tmp_path / "panel.yaml").rig, said.append, port=None, idle_s=0.5).document
    assert found["lacking"] == {"objects/vase": ["L0", "L2"]}
    assert all("ok  " in line for line in said if "objects/vase/" in line and "next" not in line), said


def test_a_sphere_is_looked_for_once_its_lights_have_come_and_a_bad_one_is_asked_for_again(tmp_path: Path) -> None:
    lights = [f"L{k}: {{}}" for k in range(6)]
    spheres = [f"{name}: {{kind: matte, radius: 25 mm, images: spheres/{name}}}" for name in ("ball", "none", "later")]
    (tmp_path / "panel.yaml").write_text(f"lpcal: 1\nlights: {{{', '.join(lights)}}}\nspheres: {{{', '.join(spheres)}}}\n")
    shown = ball_scenes.picture([ball_scenes.matte(150, 110, 60)])
    for k, signal in enumerate(shown.signal):
        for name, pixels in (("ball", 255 * signal / shown.signal.max()), ("none", 120 + signal.std() * np.ones_like(signal))):
            (tmp_path / "spheres" / name).mkdir(parents=True, exist_ok=True)
            cv2.imwrite(str(tmp_path / f"spheres/{name}/L{k}.png"), np.clip(np.rint(pixels), 0, 255).astype(np.uint8))
    said: list[str] = []
    found = watch(tmp_path, read_rig(tmp_path / "panel.yaml").rig, said.append, port=None, idle_s=1.0).document
    assert any(line.startswith("ok  spheres/ball: sphere found at (") for line in said), said
    assert any(line.startswith("!!  spheres/none: ") for line in said)
    assert found["spheres"]["spheres/none"]["tone"] == "poor"
    assert found["next"].startswith("spheres/none again: ")


def fetched(address: str, host: str | None = None) -> bytes:
    with urllib.request.urlopen(urllib.request.Request(address, headers={"Host": host} if host else {}), timeout=10) as answer:
        return answer.read()


def test_a_folder_is_watched_its_page_served_and_its_end_summed_up(tmp_path: Path, pictures: list[np.ndarray]) -> None:
    (tmp_path / "panel.yaml").write_text(PANEL)
    for folder in ("stations", "objects/vase"):
        (tmp_path / folder).mkdir(parents=True)
    said: list[str] = []
    pages: dict[str, bytes] = {}

    def fill() -> None:
        while not any("http://" in line for line in said):
            time.sleep(0.01)
        cv2.imwrite(str(tmp_path / "stations/0.png"), pictures[0])
        (tmp_path / "stations/1.png").write_bytes(b"not yet an image")
        cv2.imwrite(str(tmp_path / "objects/vase/L1.png"), np.full((48, 64), 250, np.uint8))
        while len(said) < 4:
            time.sleep(0.01)
        address = re.search(r"http://\S+", said[0])[0]
        pages["page"], pages["state"] = fetched(address), fetched(f"{address}state.json")
        with pytest.raises(urllib.error.HTTPError, match="403"):
            fetched(address, host="elsewhere.example:80")
        with pytest.raises(urllib.error.HTTPError, match="404"):
            fetched(f"{address}panel.yaml")

    filling = threading.Thread(target=fill)
    filling.start()
    outcome = watch(tmp_path, read_rig(tmp_path / "panel.yaml").rig, said.append, idle_s=3.0)
    filling.join()
    assert "127.0.0.1" in said[0]
    assert any(line.startswith("ok  stations/0.png: board found") for line in said)
    assert any(line.startswith("!!  stations/1.png") for line in said)
    assert json.loads(pages["state"])["lacking"] == {"objects/vase": ["L0", "L2"]}
    assert b"lpcal watch" in pages["page"]
    assert "objects/vase lacks L0, L2" in outcome.summary
    assert outcome.summary[0].startswith("3 images, 1 with the board")


def test_what_cannot_be_watched(tmp_path: Path, lpcal: Callable[..., tuple[int, str, str]]) -> None:
    with pytest.raises(InputError, match="no such folder"):
        watch(tmp_path / "nothing", None, print)
    with pytest.raises(UsageError, match="cannot be used"):
        watch(tmp_path, None, print, port=99999999)
    assert lpcal("watch", tmp_path / "nothing")[0] == 3
    assert lpcal("watch", tmp_path, "--idle", "-1")[0] == 2
    code, told, _ = lpcal("watch", tmp_path, "--idle", "0.3", "--port", "-1", cwd=tmp_path)
    assert (code, told.splitlines()[0]) == (0, "0 images, 0 with the board, 0 % of the image covered")


class AtOnce(Executor):
    """An executor whose calls are done when they are handed over; what was looked at, in that order."""

    def __init__(self) -> None:
        self.judged: list[tuple[str, bool]] = []

    def submit[**P, T](self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        self.judged.append((args[0].stem, kwargs["look"]))
        found: Future[T] = Future()
        found.set_result(fn(*args, **kwargs))
        return found


def test_of_too_many_images_the_newest_come_first_and_each_is_judged_in_the_end(tmp_path: Path, pictures: list[np.ndarray]) -> None:
    at, pool, touched = Watch(tmp_path, None, Watched(BOARD, ())), AtOnce(), set()
    for k in range(12):
        cv2.imwrite(str(tmp_path / f"{k}.png"), pictures[k % len(pictures)] if k else np.full((480, 640), 128, np.uint8))
        os.utime(tmp_path / f"{k}.png", (2e9 + k, 2e9 + k))
    at.look()
    assert at.waiting == 0  # an image may still be written to
    at.look()
    at.begun_s = -1.0
    at.fresh = {path: replace(one, came_s=time.time() - 12.0 + int(path.stem)) for path, one in at.fresh.items()}
    at.unshown = deque(one.came_s for one in at.fresh.values())
    assert at.waiting == 12
    seen = []
    while at.waiting:
        at.hand_over(pool)
        seen += at.judged_within(0.0, touched)
    names = [name for name, _ in pool.judged]
    assert names[:AT_WORK] == [str(11 - k) for k in range(AT_WORK)]
    assert sorted(one.name for one in seen) == sorted(f"{k}.png" for k in range(12))
    assert sum(one.words[-1] == "board found" for one in seen) == 11
    assert at.put_off == 12 - AT_WORK
    assert names.count("0") == 1  # it waited, and was then searched for the board at once
    assert dict(pool.judged)["0"]
    assert at.behind_s > 11.0  # for so long none was judged
    cv2.imwrite(str(tmp_path / "3.png"), np.full((480, 640), 255, np.uint8))
    at.look(), at.look()
    at.hand_over(pool)
    assert [one.tone for one in at.judged_within(1.0, touched)] == ["poor"]
    assert touched == {tmp_path}


def test_an_image_that_changes_while_it_is_judged_is_judged_as_it_is_then(tmp_path: Path, pictures: list[np.ndarray]) -> None:
    at, pool = Watch(tmp_path, None, Watched(BOARD, ())), AtOnce()
    (tmp_path / "a.png").write_bytes(b"half of an image")
    at.look(), at.look()
    at.hand_over(pool)
    cv2.imwrite(str(tmp_path / "a.png"), pictures[0])
    at.look(), at.look()
    assert at.judged_within(0.0, set()) == []
    at.hand_over(pool)
    assert [one.words[-1] for one in at.judged_within(0.0, set())] == ["board found"]


def test_exposure_is_told_by_the_brightest_channel_and_in_any_depth() -> None:
    red = np.zeros((600, 900, 3), np.uint8)
    red[:, :90, 0] = 255
    assert exposure_words(red)[0] == ("10.0 % saturated: a shorter exposure",)
    assert exposure_words(np.full((600, 900), 5000, np.uint16))[0] == ("dim: its brightest is 8 % of full scale",)


@pytest.mark.slow
def test_twelve_images_a_second_are_never_more_than_two_seconds_behind(tmp_path: Path, pictures: list[np.ndarray]) -> None:
    (tmp_path / "panel.yaml").write_text(PANEL)
    (tmp_path / "stations").mkdir()
    encoded = [cv2.imencode(".png", picture)[1].tobytes() for picture in pictures]

    def fill() -> None:
        begun = time.monotonic()
        for k in range(120):
            time.sleep(max(0.0, begun + k / 12 - time.monotonic()))
            (tmp_path / f"stations/{k:03d}.png").write_bytes(encoded[k % len(encoded)])

    filling = threading.Thread(target=fill)
    filling.start()
    found = watch(tmp_path, read_rig(tmp_path / "panel.yaml").rig, lambda _: None, idle_s=4.0).document
    filling.join()
    assert found["images"] == 120
    assert found["boards"] > 10
    assert found["behind_s"] < 2.0
