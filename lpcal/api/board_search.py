"""Look for the board in many images, and refuse what cannot be one camera's views of one board."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed

import numpy as np

from lpcal.detect.board import count_corners, find_board
from lpcal.detect.board_marked import find_marked
from lpcal.errors import DegenerateError, DisagreementError
from lpcal.formats.corner_cache import Sighting
from lpcal.geometry.arrays import Array, Image
from lpcal.records.observations import Board, BoardView, BoardViews
from lpcal.view.parallel import workers

COUNTED_IMAGES = 3
"""Number of images without a board that are searched for a board of another count, before the rest is looked at where they come first."""
FEW = 0.5
"""Share of the images below which a board that is found in them is suspected to be another one."""

type Shown = Callable[[int], Image]
"""The grey image (H, W) of a row: read when it is asked for, so that no session need fit into memory."""


def refuse_another_board(shown: Shown, views: BoardViews, board: Board) -> None:
    """Say so where the images show a board of another corner count, or none at all.

    Raises
    ------
    DisagreementError, DegenerateError
    """
    empty = [row for row, view in enumerate(views.views) if view.corners_px is None]
    count = len(views.views)
    found = count - len(empty)
    if found >= FEW * count and found > 0:
        return
    picks = spread(empty)
    refuse_another_count(shown, picks, views.views[picks[0]], board)
    if found == 0:
        asked = f"{board.corners[0]}x{board.corners[1]}"
        kinds = [(view.why or "").partition(" (")[0] for view in views.views]
        kind, alike = Counter(kinds).most_common(1)[0]
        why = views.views[kinds.index(kind)].why
        raise DegenerateError(
            f"no board of {asked} inner corners in any of {count} images; {alike} of them: {why}",
            where=views.views[0].image,
            needed="images that show the whole board, sharp and lit evenly",
            todo="look at the images, and at board.corners",
        )


def refuse_another_count(shown: Shown, picks: Sequence[int], first: BoardView, board: Board) -> None:
    """Say so where most of the images picked, in which the board was not found, show a chessboard of another corner count.

    Raises
    ------
    DisagreementError
    """
    if board.kind != "chessboard":
        return
    with ThreadPoolExecutor(max_workers=workers()) as pool:
        others = pool.map(lambda row: count_corners(shown(row)), picks)
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


def spread(rows: Sequence[int]) -> list[int]:
    """A few of the rows, over all of them."""
    return [rows[k] for k in np.unique(np.linspace(0, len(rows) - 1, COUNTED_IMAGES).round().astype(int))] if rows else []


def list_pixels(
    shown: Shown, rows: Sequence[int], board: Board, done: Callable[[int], None], marks_px: Mapping[int, Array] | None = None
) -> dict[int, Sighting]:
    """The board in some of the images, by their rows; `marks_px` are its outermost corners (4, 2) where a person marked them."""
    marks_px = marks_px or {}
    found: dict[int, Sighting] = {}
    with ThreadPoolExecutor(max_workers=workers()) as pool:
        # threads, not processes: OpenCV gives up the interpreter's lock while it searches
        tasks = {pool.submit(_look, shown, row, board, marks_px.get(row)): row for row in rows}
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


def _look(shown: Shown, row: int, board: Board, marks_px: Array | None) -> Sighting:
    grey = shown(row)
    view = find_board(grey, board)
    if view.corners_px is None and marks_px is not None:
        view = find_marked(grey, board, marks_px)
    return Sighting((grey.shape[1], grey.shape[0]), view)


def grey_of(pixels: Image) -> Image:
    """A grey image (H, W) of a grey or RGB one."""
    return pixels if pixels.ndim == 2 else np.asarray(pixels @ np.array([0.299, 0.587, 0.114], np.float32))
