"""Plain csv of poses as loggers write them: several bodies, gaps in words, dates, times in other units, two takes in one file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from lpcal.errors import DisagreementError, InputError
from lpcal.formats.image_times import read_image_times
from lpcal.formats.mocap import read_mocap
from lpcal.formats.time_stamps import with_seconds
from lpcal.geometry import se3
from lpcal.records.observations import PoseStream

COUNT = 300
NAMES = "x_m,y_m,z_m,qx,qy,qz,qw"
T_S = np.arange(COUNT) * 0.01
"""A body that wanders at 0.2 m/s."""


def poses(shift_m: float = 0.0) -> np.ndarray:
    turn = np.stack([0.3 * np.sin(T_S), 0.2 * np.cos(1.3 * T_S), 0.1 * T_S], axis=1)
    x = np.stack([0.2 * T_S + shift_m, 0.1 * np.sin(T_S), np.full(COUNT, 1.0)], axis=1)
    return np.concatenate([x, se3.quaternion(se3.rotation(turn))], axis=1)


def cells(rows: np.ndarray) -> list[str]:
    return [",".join(f"{value:.9f}" for value in row) for row in rows]


def written(path: Path, head: str, rows: list[str]) -> Path:
    path.write_text("\n".join([head, *rows]) + "\n")
    return path


def stream(path: Path, body: str | None = None) -> PoseStream:
    found = read_mocap(path, body)
    assert isinstance(found, PoseStream)
    return found


def long_rows() -> list[str]:
    both = zip(T_S, cells(poses()), cells(poses(0.5)), strict=True)
    return [line for t, panel, wand in both for line in (f"{t:.2f},Wand,{wand}", f"{t:.2f},Panel,{panel}")]


def wide_rows() -> list[str]:
    return [f"{t:.2f},{wand},{panel}" for t, panel, wand in zip(T_S, cells(poses()), cells(poses(0.5)), strict=True)]


def wide_head(join: str) -> str:
    return ",".join(["t_s", *(f"{body}{join}{name}" for body in ("Wand", "Panel") for name in NAMES.split(","))])


@pytest.mark.parametrize(
    ("head", "rows"),
    [(f"t_s,body,{NAMES}", long_rows), (wide_head("_"), wide_rows), (wide_head("."), wide_rows), (wide_head(" "), wide_rows)],
)
def test_a_body_of_several_is_chosen_or_asked_for(tmp_path: Path, head: str, rows: Callable[[], list[str]]) -> None:
    path = written(tmp_path / "mocap.csv", head, rows())
    found = stream(path, "Panel")
    assert found.body == "Panel"
    assert np.allclose(found.t_s, T_S)
    assert np.allclose(found.H_OP[:, :3, 3], poses()[:, :3])
    with pytest.raises(InputError, match=r"(?s)2 bodies: .*needed: one"):
        read_mocap(path)
    with pytest.raises(DisagreementError, match="no body Hand"):
        read_mocap(path, "Hand")


def test_two_columns_of_one_name_are_not_chosen_between(tmp_path: Path) -> None:
    path = written(tmp_path / "mocap.csv", f"t_s,{NAMES},{NAMES}", wide_rows())
    with pytest.raises(InputError, match="x_m in columns 2 and 9"):
        read_mocap(path)


def joined(gap_s: float) -> list[str]:
    """Two takes one after another, each with a clock that begins anew."""
    return [f"{t + late:.6f},{row}" for late, shift in ((0.0, 0.0), (gap_s, 0.5)) for t, row in zip(T_S, cells(poses(shift)), strict=True)]


def interleaved(_: float) -> list[str]:
    """Two bodies in turn, and nothing that names them."""
    return [f"{t:.6f},{row}" for t, *both in zip(T_S, cells(poses()), cells(poses(0.5)), strict=True) for row in both]


@pytest.mark.parametrize(("rows", "gap_s"), [(joined, 0.0), (joined, 0.004), (interleaved, 0.0)])
def test_two_recordings_or_bodies_in_one_file_are_refused(tmp_path: Path, rows: Callable[[float], list[str]], gap_s: float) -> None:
    with pytest.raises(DisagreementError, match=r"5\d\d mm apart: two recordings, or two bodies, in one file"):
        read_mocap(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", rows(gap_s)))


def test_rows_out_of_order_and_repeated_ones_are_one_recording(tmp_path: Path) -> None:
    rows = [f"{t:.6f},{row}" for t, row in zip(T_S, cells(poses()), strict=True)]
    mixed = [rows[k] for k in np.random.default_rng(0).permutation(COUNT)]
    assert len(stream(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", [*mixed, *rows])).t_s) == COUNT


@pytest.mark.parametrize(("head", "factor", "unit"), [("t_s", 1e3, "ms"), ("t", 1e3, "ms"), ("timestamp", 1e6, "us"), ("time", 1e9, "ns")])
def test_times_too_far_apart_for_seconds_are_refused_with_their_unit(tmp_path: Path, head: str, factor: float, unit: str) -> None:
    rows = [f"{t * factor:.3f},{row}" for t, row in zip(T_S, cells(poses()), strict=True)]
    with pytest.raises(DisagreementError, match=rf"(?s)look like {unit} \(100 Hz\).*name the column t_{unit}"):
        read_mocap(written(tmp_path / "mocap.csv", f"{head},{NAMES}", rows))
    rows = [f"{t * factor:.3f},{row}" for t, row in zip(T_S, cells(poses()), strict=True)]
    assert np.allclose(stream(written(tmp_path / "mocap.csv", f"t_{unit},{NAMES}", rows)).t_s, T_S)


def test_a_slow_recording_of_uneven_times_is_read(tmp_path: Path) -> None:
    t_s = np.cumsum(np.random.default_rng(1).uniform(1, 20, COUNT))
    rows = [f"{t:.3f},{row}" for t, row in zip(t_s, cells(poses()), strict=True)]
    assert np.allclose(stream(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", rows)).t_s, t_s, atol=1e-3)


NOTHING = ("NULL", "null", "None", "N/A", "NA", "#N/A", "-", "--", "1.#IND", "-1.#IND0", "1.#QNAN", "-nan(ind)")


@pytest.mark.parametrize("word", NOTHING)
def test_words_for_nothing_are_losses(tmp_path: Path, word: str) -> None:
    gone = {100, 101, 102, 199}
    rows = [f"{t:.2f},{','.join([word] * 7) if k in gone else row}" for k, (t, row) in enumerate(zip(T_S, cells(poses()), strict=True))]
    found = stream(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", rows))
    assert found.lost == len(gone)
    assert np.allclose(found.t_s, np.delete(T_S, sorted(gone)))


def test_a_word_that_means_nothing_known_is_named_with_its_line(tmp_path: Path) -> None:
    rows = [f"{t:.2f},{row}" for t, row in zip(T_S, cells(poses()), strict=True)]
    rows[41] = rows[41].replace(",", ",oops,", 1).rsplit(",", 1)[0]
    with pytest.raises(InputError, match=r"mocap\.csv:43: 'oops' in column 2"):
        read_mocap(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", rows))


def dated(form: str, t_s: np.ndarray) -> list[str]:
    """Times from 23:59:58 of a day on, in a form."""
    found = []
    for t in t_s + 86398.0:
        day, rest = 5 + int(t // 86400), t % 86400
        clock = f"{int(rest // 3600):02d}:{int(rest % 3600 // 60):02d}:{rest % 60:06.3f}"
        found.append(form.format(day=f"{day:02d}", clock=clock))
    return found


FORMS = ("2026-01-{day} {clock}", "2026-01-{day}T{clock}Z", "2026/01/{day} {clock}", "2026-01-{day}T{clock}+02:00", "{clock}")


@pytest.mark.parametrize("form", FORMS)
def test_dates_and_times_of_the_day_are_read(tmp_path: Path, form: str) -> None:
    rows = [f"{stamp},{row}" for stamp, row in zip(dated(form, T_S), cells(poses()), strict=True)]
    found = stream(written(tmp_path / "mocap.csv", f"time,{NAMES}", rows))
    assert np.allclose(found.t_s - found.t_s[0], T_S, atol=1e-5)
    assert any("times are" in note for note in found.notes)
    images = [tmp_path / f"{k}.png" for k in range(5)]
    for image in images:
        image.write_bytes(b"")
    late = np.arange(5) * 0.9
    table = [f"{image.name},{stamp}" for image, stamp in zip(images, dated(form, late), strict=True)]
    times = read_image_times(written(tmp_path / "times.csv", "file,time", table))
    assert np.allclose([t - times[0][1] for _, t in times], late, atol=1e-5)


def test_a_date_that_is_none_is_named_with_its_line(tmp_path: Path) -> None:
    rows = [f"{stamp},{row}" for stamp, row in zip(dated(FORMS[0], T_S), cells(poses()), strict=True)]
    rows[7] = rows[7].replace("2026-01-05", "2026-13-05")
    with pytest.raises(InputError, match=r"mocap\.csv:9: '2026-13-05 "):
        read_mocap(written(tmp_path / "mocap.csv", f"time,{NAMES}", rows))


def test_seconds_of_the_day_pass_midnight(tmp_path: Path) -> None:
    rows = [f"{(t + 86399.0) % 86400:.2f},{row}" for t, row in zip(T_S, cells(poses()), strict=True)]
    found = stream(written(tmp_path / "mocap.csv", f"t_s,{NAMES}", rows))
    assert np.allclose(found.t_s - found.t_s[0], T_S)
    assert "times pass midnight" in found.notes


@pytest.mark.parametrize(
    ("head", "todo"),
    [
        ("t,x,y,z,roll,pitch,yaw", "from_euler"),
        ("t_s,x_m,y_m,z_m,Roll [deg],Pitch [deg],Yaw [deg]", "from_euler"),
        ("t,x,y,z,rx,ry,rz", "from_rotvec"),
        ("t,x,y,z,q0,q1,q2,q3", "which of the four is w"),
        ("t,x,y,z,q1,q2,q3,q4", "which of the four is w"),
        (f"frame,{NAMES}", "the frame's number over the rate"),
        ("t,a,b,c", "name the columns so"),
    ],
)
def test_what_columns_lack_is_said_with_what_to_do(tmp_path: Path, head: str, todo: str) -> None:
    rows = [",".join(["0"] * len(head.split(",")))] * 3
    with pytest.raises(InputError, match=f"(?s)no column for .*{todo}"):
        read_mocap(written(tmp_path / "mocap.csv", head, rows))


def test_a_web_page_is_named(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="a web page"):
        read_mocap(written(tmp_path / "mocap.csv", "<!DOCTYPE html>", ["<html><body>sign in</body></html>"]))


def test_only_times_of_the_day_pass_midnight() -> None:
    dates, _ = with_seconds(["2026-01-05 20:00:00,1", "2026-01-05 03:00:00,2"], 0)
    before, after = (float(row.split(",")[0]) for row in dates)
    assert after - before == -17 * 3600, "a recording that goes back is to be refused, not mended"
    of_the_day, _ = with_seconds(["20:00:00,1", "03:00:00,2"], 0)
    before, after = (float(row.split(",")[0]) for row in of_the_day)
    assert after - before == 7 * 3600
