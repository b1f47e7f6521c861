"""Look for the board in all images: read, detect (or recall what was found), and refuse what cannot be one camera's views of one board."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

import numpy as np

from lpcal.detect.board import DETECTOR_VERSION, count_corners, find_board
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.corner_cache import Sighting, cache_key, read_corner_cache, write_corner_cache
from lpcal.formats.corners_vnl import read_corners
from lpcal.formats.images import read_image
from lpcal.geometry.arrays import Image
from lpcal.pipeline.workspace import Workspace
from lpcal.records.observations import Board, BoardView, BoardViews
from lpcal.records.outcome import Progress

COUNTED_IMAGES = 3
"""So many of the images without a board are searched for a board of another count, before the rest is looked at where they come first."""
FEW = 0.5
"""A board found in fewer images than this is suspected to be another one."""


def search(
    workspace: Workspace, images: Sequence[Path], board: Board, progress: Progress, known: Mapping[Path, BoardView] | None = None
) -> BoardViews:
    """The board in each image, in the images' order; images whose corners are known are read for their size only.

    Raises
    ------
    InputError
        An image that cannot be read.
    DisagreementError
        Images of two sizes, or a board of another corner count.
    DegenerateError
        No board in any image.
    """
    known = known or {}
    store = workspace.calib(".cache/corners.json")
    kept = read_corner_cache(store)
    keys = [cache_key(image, board, DETECTOR_VERSION) for image in images]
    found: dict[str, Sighting] = {key: kept[key] for key in keys if key in kept}
    given = {image: Sighting(read_image(image).size, view) for image, view in known.items()}
    new = [row for row, (key, image) in enumerate(zip(keys, images, strict=True)) if key not in kept and image not in given]
    first = _spread(new)
    found |= _look_at(images, keys, first, board, lambda done: progress("board", done, len(new)))
    if first and len(new) == len(images) and all(found[keys[row]].view.corners_px is None for row in first):
        refuse_another_count(images, first, found[keys[first[0]]].named(workspace.relative(images[first[0]])), board)
    rest = [row for row in new if row not in first]
    found |= _look_at(images, keys, rest, board, lambda done: progress("board", len(first) + done, len(new)))
    if new:
        write_corner_cache(store, found)
    sightings = [given[image] if image in given else found[key] for key, image in zip(keys, images, strict=True)]
    sizes = [sighting.size for sighting in sightings]
    refuse_two_sizes([workspace.relative(path) for path in images], sizes)
    return BoardViews(sizes[0], tuple(one.named(workspace.relative(path)) for one, path in zip(sightings, images, strict=True)))


def recall(workspace: Workspace, corners: Path, images: Sequence[Path], board: Board) -> dict[Path, BoardView]:
    """The corners of images as a vnlog has them, by path: named there as here, by the whole path, or by the file's name alone.

    Raises
    ------
    InputError, DisagreementError
        The file cannot be read, has another count of corners, or names none of the images.
    """
    listed = read_corners(corners, board.corners[0] * board.corners[1])
    by_name = {Path(name).name: name for name in listed}
    found: dict[Path, BoardView] = {}
    for image in images:
        name = next((one for one in (workspace.relative(image), str(image)) if one in listed), by_name.get(image.name))
        if name is not None:
            why = None if listed[name] is not None else f"no board, says {corners.name}"
            found[image] = BoardView(workspace.relative(image), listed[name], why)
    if not found:
        raise DisagreementError(
            f"none of the {len(images)} images is named in it",
            where=str(corners),
            needed="corners of these images",
            todo="name another file; one that is not there yet is written",
        )
    return found


def refuse_another_board(images: Sequence[Path], views: BoardViews, board: Board) -> None:
    """Say so where the images show a board of another corner count, or none at all.

    Raises
    ------
    DisagreementError, DegenerateError
    """
    empty = [row for row, view in enumerate(views.views) if view.corners_px is None]
    found = len(images) - len(empty)
    if found >= FEW * len(images) and found > 0:
        return
    picks = _spread(empty)
    refuse_another_count(images, picks, views.views[picks[0]], board)
    if found == 0:
        asked = f"{board.corners[0]}x{board.corners[1]}"
        kinds = [(view.why or "").partition(" (")[0] for view in views.views]
        kind, count = Counter(kinds).most_common(1)[0]
        why = views.views[kinds.index(kind)].why
        raise DegenerateError(
            f"no board of {asked} inner corners in any of {len(images)} images; {count} of them: {why}",
            where=views.views[0].image,
            needed="images that show the whole board, sharp and lit evenly",
            todo="look at the images, and at board.corners",
        )


def refuse_another_count(images: Sequence[Path], picks: Sequence[int], first: BoardView, board: Board) -> None:
    """Say so where most of the images picked, in which the board was not found, show a chessboard of another corner count.

    Raises
    ------
    DisagreementError
    """
    if board.kind != "chessboard":
        return
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        others = pool.map(lambda row: count_corners(_grey(images[row])), picks)
        counts = Counter(other for other in others if other is not None)
    counts.pop((max(board.corners), min(board.corners)), None)
    if not counts or counts.most_common(1)[0][1] <= len(picks) / 2:
        return
    (columns, rows), votes = counts.most_common(1)[0]
    asked = f"{board.corners[0]}x{board.corners[1]}"
    raise DisagreementError(
        f"found a board of {columns}x{rows} inner corners in {votes} of the {len(picks)} images looked at, you asked for {asked}",
        where=first.image,
        needed="board.corners as on the board: inner corners, one fewer than squares, along x and y",
        todo=f"write corners: [{columns}, {rows}], or give the images of the other board",
    )


def _spread(rows: Sequence[int]) -> list[int]:
    """A few of the rows, over all of them."""
    return [rows[k] for k in np.unique(np.linspace(0, len(rows) - 1, COUNTED_IMAGES).round().astype(int))] if rows else []


def _look_at(
    images: Sequence[Path], keys: Sequence[str], rows: Sequence[int], board: Board, done: Callable[[int], None]
) -> dict[str, Sighting]:
    """The board in some of the images, by their keys."""
    found: dict[str, Sighting] = {}
    with ThreadPoolExecutor(max_workers=os.cpu_count() or 1) as pool:
        # threads, not processes: OpenCV gives up the interpreter's lock while it searches
        tasks = {pool.submit(_look, images[row], board): keys[row] for row in rows}
        try:
            for count, task in enumerate(as_completed(tasks), start=1):
                found[tasks[task]] = task.result()
                done(count)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise
    return found


def refuse_two_sizes(names: Sequence[str], sizes: Sequence[tuple[int, int]]) -> None:
    """All images must be of one size.

    Raises
    ------
    DisagreementError
        They are not: both sizes, an image of each.
    """
    counts = Counter(sizes)
    if len(counts) > 1:
        (usual, many), (other, few) = counts.most_common(2)
        first, second = names[sizes.index(usual)], names[sizes.index(other)]
        first, second = (name + (f" and {count - 1} more" if count > 1 else "") for name, count in ((first, many), (second, few)))
        raise DisagreementError(
            f"two sizes: {usual[0]}x{usual[1]} ({first}) and {other[0]}x{other[1]} ({second})",
            where=names[sizes.index(other)],
            needed="images of one camera, not cropped, scaled or turned",
            todo="leave out those of the other size",
        )


def _look(path: Path, board: Board) -> Sighting:
    grey = _grey(path)
    return Sighting((grey.shape[1], grey.shape[0]), find_board(grey, board))


def _grey(path: Path) -> Image:
    pixels = read_image(path).pixels
    return pixels if pixels.ndim == 2 else np.asarray(pixels @ np.array([0.299, 0.587, 0.114], np.float32))
