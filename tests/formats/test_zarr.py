"""Captures and surfaces in Zarr v3: the same numbers, read by tiles, and what is wrong with one is said."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import lpcal as library
from lpcal.errors import DisagreementError, InputError
from lpcal.formats import full_size
from lpcal.formats.zarr_files import MAPS, tiles, write_capture_zarr
from many_captures import collection, dome

zarr = pytest.importorskip("zarr")


@pytest.mark.parametrize("bits", [8, 16])
def test_a_capture_comes_back_and_makes_the_same_surface(lpcal: Callable[..., tuple[int, str, str]], tmp_path: Path, bits: int) -> None:
    (folder,) = collection(tmp_path, 1)
    raw = library.read_capture(folder, dome())
    stored = raw if bits == 8 else replace(raw, step=1 / 65535)
    write_capture_zarr(tmp_path / "c.zarr", stored)
    again = library.read_capture(tmp_path / "c.zarr", dome())
    np.testing.assert_allclose(again.images, raw.images, atol=1e-6)
    np.testing.assert_allclose(again.ambient, raw.ambient, atol=1e-6)
    assert np.array_equal(again.mask, raw.mask)
    assert lpcal("reconstruct", tmp_path / "c.zarr", "-c", "dome.yaml", "-o", "out", cwd=tmp_path)[0] == 0
    assert "(up to date)" in lpcal("reconstruct", tmp_path / "c.zarr", "-c", "dome.yaml", "-o", "out", cwd=tmp_path)[1]
    plain = library.reconstruct(raw, dome())
    np.testing.assert_allclose(library.read_surface(tmp_path / "out").normals, plain.normals, atol=1e-3)


def test_a_subset_of_lights_is_taken_and_a_lacking_one_is_named(tmp_path: Path) -> None:
    (folder,) = collection(tmp_path, 1)
    write_capture_zarr(tmp_path / "c.zarr", library.read_capture(folder, ["L1", "L3", "L4"]))
    assert library.read_capture(tmp_path / "c.zarr", dome(), use=["L4", "L1"]).lights == ("L1", "L4")
    with pytest.raises(DisagreementError, match="no image of L0, L2, L5"):
        library.read_capture(tmp_path / "c.zarr", dome())


@pytest.mark.parametrize("colours", [(), (3,)])
def test_a_capture_that_is_too_large_stays_where_it_lies_and_is_read_by_parts(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, colours: tuple[int, ...]
) -> None:
    monkeypatch.setattr(full_size, "HELD", 40_000)
    monkeypatch.setattr(full_size, "COARSE_PIXELS", 4_000)
    images = np.random.default_rng(1).integers(0, 60000, (4, 130, 171, *colours)).astype(np.uint16)
    (raw,) = [library.read_capture(folder, ["L0"]) for folder in collection(tmp_path, 1)]
    shares = (images / np.float32(65535)).astype(np.float32)
    lights, exposures = ("L0", "L1", "L2"), np.ones(3)
    mask = np.ones(images.shape[1:3], bool)
    stored = replace(raw, lights=lights, images=shares[:3], exposure_s=exposures, ambient=shares[3:], mask=mask, step=1 / 65535)
    write_capture_zarr(tmp_path / "c.zarr", stored)
    monkeypatch.setattr(full_size, "Scratch", None)  # nothing is copied
    found = library.read_capture(tmp_path / "c.zarr", ["L2", "L0"])
    assert found.full is not None
    assert found.size == (171, 130)
    rows, columns = slice(90, 130), slice(33, 140)
    of_lights, of_room, _ = found.full.read(rows, columns)
    assert np.array_equal(of_lights, shares[[2, 0], rows, columns])
    assert np.array_equal(of_room, shares[3:, rows, columns])
    factor = found.full.factor
    np.testing.assert_allclose(found.images[1], full_size.blocks(shares[0], factor).mean(axis=(1, 3)), atol=1e-6)
    monkeypatch.undo()
    assert library.read_capture(tmp_path / "c.zarr", ["L2", "L0"]).full is None


READ = """
import resource, sys
import lpcal
raw = lpcal.read_capture(sys.argv[1], [f"L{k}" for k in range(12)])
part, _, _ = raw.full.read(slice(3000, 3256), slice(5000, 5256))
print(raw.size, part.shape, int(65535 * part.max() + 0.5), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss // 1024)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere the peak is counted in other units")
def test_twenty_four_megapixels_under_twelve_lights_are_read_in_half_of_what_holding_them_takes(tmp_path: Path) -> None:
    """Chunks that were never written are zero: the capture takes little disk; what is written allows for the memory of reading."""
    group = zarr.open_group(tmp_path / "c.zarr", mode="w", zarr_format=3)
    group.attrs.update({"lpcal": 1, "kind": "capture", "lights": [f"L{k}" for k in range(12)]})
    images = group.create_array("images", shape=(12, 4000, 6000), chunks=(1, 512, 512), dtype=np.uint16)
    images[:, :512, :1024] = np.random.default_rng(1).integers(0, 60000, (12, 512, 1024), np.uint16)
    images[:, 3100:3110, 5100:5110] = np.full((12, 10, 10), 65000, np.uint16)
    done = subprocess.run([sys.executable, "-c", READ, str(tmp_path / "c.zarr")], capture_output=True, text=True, check=True)
    said, _, peak_mb = done.stdout.strip().rpartition(" ")
    assert said == "(6000, 4000) (12, 256, 256) 65000"
    assert int(peak_mb) < 600  # 12 x 24 million numbers of float32 are 1152 MB


def test_tiles_are_the_image_piece_by_piece(tmp_path: Path) -> None:
    (folder,) = collection(tmp_path, 1)
    raw = library.read_capture(folder, dome())
    write_capture_zarr(tmp_path / "c.zarr", raw)
    pieced = np.zeros(raw.images.shape, np.uint8)
    for rows, columns, numbers in tiles(tmp_path / "c.zarr", 20):
        assert max(numbers.shape[1:]) <= 20
        pieced[:, rows, columns] = numbers
    assert np.array_equal(pieced, np.rint(255 * raw.images))


def test_a_surface_is_written_by_tiles(tmp_path: Path) -> None:
    (folder,) = collection(tmp_path, 1)
    surface = library.reconstruct(library.read_capture(folder, dome()), dome())
    library.write_surface(tmp_path / "s.zarr", surface)
    group = zarr.open_group(tmp_path / "s.zarr", mode="r")
    assert set(MAPS) == set(group.array_keys())
    assert np.array_equal(group["normals"][...], surface.normals, equal_nan=True)


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (lambda group: group.attrs.update({"kind": "picture"}), "of kind 'picture'"),
        (lambda group: group.__delitem__("images"), "no array images"),
        (lambda group: group.attrs.update({"lights": ["L0"]}), "for 1 lights"),
    ],
)
def test_groups_that_are_no_captures(tmp_path: Path, spoil: Callable[..., Any], words: str) -> None:
    (folder,) = collection(tmp_path, 1)
    write_capture_zarr(tmp_path / "c.zarr", library.read_capture(folder, dome()))
    spoil(zarr.open_group(tmp_path / "c.zarr", mode="a"))
    with pytest.raises(InputError, match=words):
        library.read_capture(tmp_path / "c.zarr", dome())
    (tmp_path / "c.zarr/zarr.json").write_text("{")
    with pytest.raises(InputError, match=r"c\.zarr"):
        library.read_capture(tmp_path / "c.zarr", dome())
