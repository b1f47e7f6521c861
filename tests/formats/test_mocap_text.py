"""Recordings that went through other programs: quotes over line ends, commas for points, made-up channels, markers of no one body."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from lpcal.chain.h_op_body import body_of
from lpcal.errors import DegenerateError, InputError
from lpcal.formats.marker_table import MarkerTable, markers_of
from lpcal.formats.mocap import read_mocap
from lpcal.formats.robot_poses import read_robot_poses
from lpcal.formats.text import with_commas
from lpcal.records.observations import MarkerStream

ROWS = ["Take,One", "", ",,Body,Body", "Frame,Time,X,Y", "0,0.25,1.5,-2.5"]


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("ends", [1, 2, 9])
def test_quotes_may_close_after_the_line_ends(delimiter: str, ends: int) -> None:
    rows = [delimiter.join(f'"{cell}"' if cell else "" for cell in row.split(",")) for row in ROWS]
    text = "\n".join(rows).replace('"\n', '\n"', ends)
    plain = with_commas(text, Path("take.csv")).split("\n")
    assert [line for line in plain if line.strip(",")] == [line for line in ROWS if line]


@pytest.mark.parametrize("count", [4, 7, 16])
@pytest.mark.parametrize("quote", ["", '"ABC"'])
def test_commas_both_between_cells_and_in_numbers_are_refused(count: int, quote: str) -> None:
    names = ",".join(f"n{k}" for k in range(count))
    numbers = ",".join(f"{k},{k}25" for k in range(count))
    with pytest.raises(InputError, match="decimal points"):
        with_commas(f"{quote or 'Take'},x\n{names}\n{numbers}\n{numbers}\n", Path("take.csv"))


@pytest.mark.parametrize("label", ["New {:04d}", "Unlabeled {}", "*{}", "CentreOfMass{}"])
def test_trajectories_that_nobody_labelled_make_no_body(label: str) -> None:
    tracks = {label.format(k): np.full((5, 3), float(k)) for k in range(4)}
    with pytest.raises(DegenerateError, match="4 unlabeled are left out"):
        markers_of(MarkerTable(np.arange(5) / 100, tracks), Path("take.tsv"), None)


@pytest.mark.parametrize("loose", [0, 2, 3])
def test_markers_that_move_against_each_other_are_refused_by_name(loose: int) -> None:
    rng = np.random.default_rng(loose)
    x_O = np.tile(np.array([[0.08, 0, 0], [0, 0.06, 0.01], [-0.07, 0.02, 0], [0.01, -0.05, 0.03]]), (200, 1, 1))
    x_O[:, loose] += rng.normal(0, 0.05, (200, 3))
    markers = MarkerStream("Panel", np.arange(200) / 100, ("A", "B", "C", "D"), x_O, 100.0)
    with pytest.raises(DegenerateError, match=f"not rigid together.*{'ABCD'[loose]} worst"):
        body_of(markers)


@pytest.mark.parametrize(("rows", "lost"), [((3,), (3,)), ((0, 5), (0, 5)), ((1, 2, 4), (1, 2, 4)), ((0,), ())])
def test_poses_that_are_exactly_the_identity_are_lost_save_a_first_that_all_count_from(
    tmp_path: Path, rows: tuple[Any, ...], lost: tuple[Any, ...]
) -> None:
    H = np.tile(np.eye(4), (6, 1, 1))
    H[:, 0, 3] = np.arange(1, 7) / 10
    H[list(rows)] = np.eye(4)
    path = tmp_path / "robot.txt"
    np.savetxt(path, H.reshape(6, 16))
    found = read_robot_poses(path)
    assert found.lost == lost
    assert any("are the identity: lost" in note for note in found.notes) == bool(lost)


@pytest.mark.parametrize("nonsense", [(0, "1e20"), (0, "-3e99"), (0, "inf"), (2, "1e6"), (3, "-inf"), (5, "inf")])
def test_numbers_that_no_recording_holds_are_refused_with_their_line(tmp_path: Path, nonsense: tuple[int, str]) -> None:
    rows = [[f"{0.01 * k:.2f}", "0.1", f"{0.01 * k:.2f}", "1.5", "0", "0", "0", "1"] for k in range(50)]
    rows[17][nonsense[0]] = nonsense[1]
    path = tmp_path / "mocap.csv"
    path.write_text("t,x,y,z,qx,qy,qz,qw\n" + "\n".join(",".join(row) for row in rows) + "\n")
    with pytest.raises(InputError, match=r"mocap\.csv:19.*"):
        read_mocap(path)
