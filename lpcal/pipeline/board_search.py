"""The board in a rig's images: found there, or recalled from the last time or from a file of corners."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

from lpcal.api.board_search import Shown, grey_of, look_at, refuse_another_count, refuse_two_sizes, spread
from lpcal.detect.board import DETECTOR_VERSION
from lpcal.errors import DisagreementError
from lpcal.formats.corner_cache import Sighting, cache_key, read_corner_cache, write_corner_cache
from lpcal.formats.corners_vnl import read_corners
from lpcal.formats.images import read_image
from lpcal.pipeline.workspace import Workspace
from lpcal.records.observations import Board, BoardView, BoardViews
from lpcal.records.outcome import Progress


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
    first, shown = spread(new), shown_in(images)
    seen = look_at(shown, first, board, lambda done: progress("board", done, len(new)))
    if first and len(new) == len(images) and all(seen[row].view.corners_px is None for row in first):
        refuse_another_count(shown, first, seen[first[0]].named(workspace.relative(images[first[0]])), board)
    rest = [row for row in new if row not in first]
    seen |= look_at(shown, rest, board, lambda done: progress("board", len(first) + done, len(new)))
    found |= {keys[row]: sighting for row, sighting in seen.items()}
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


def shown_in(images: Sequence[Path]) -> Shown:
    """The grey images of files, read when they are asked for."""
    return lambda row: grey_of(read_image(images[row]).pixels)
