"""Images of the board -> camera.yaml, camera.cameramodel, H_CB.yaml.

The camera is solved from ``camera.images`` alone; H_CB is found for those and for the images of ``mocap.images``.

What ``lpcal intrinsics`` says: views, residual, focal length with its sigma, the board's bow, the model and why.

The board in a rig's images: found there, or recalled from the last time or from a file of corners.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from lpcal.api.board_search import Shown, grey_of, list_pixels, refuse_another_board, refuse_another_count, refuse_two_sizes, spread
from lpcal.api.boards import as_given, board_of, calibrate_camera, locate_boards
from lpcal.detect.board import DETECTOR_VERSION
from lpcal.detect.radiometry import fit_flat_field
from lpcal.errors import DisagreementError, InputError
from lpcal.formats.camera_files import read_camera_file
from lpcal.formats.camera_yaml import write_camera
from lpcal.formats.cameramodel import MARK, MODEL_FILE, cameramodel_text
from lpcal.formats.corner_cache import Sighting, cache_key, read_corner_cache, write_corner_cache
from lpcal.formats.corners_vnl import read_corners, write_corners
from lpcal.formats.h_cb_yaml import write_h_cb
from lpcal.formats.image_times import read_image_times
from lpcal.formats.images import read_image
from lpcal.formats.outputs import write_text
from lpcal.formats.record_documents import document_of
from lpcal.pipeline.sensor import has_lens
from lpcal.pipeline.workspace import Stage, Workspace
from lpcal.records.calibration import CameraSolution
from lpcal.records.digits import fine
from lpcal.records.evidence import CameraEvidence, ShapeTerm
from lpcal.records.observations import Board, BoardPoses, BoardView, BoardViews
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.provenance import Provenance
from lpcal.records.rig import CameraSection, Rig
from lpcal.records.sensor import Sensor

CAMERAMODEL = "camera.cameramodel"


def run(workspace: Workspace, progress: Progress, images: Sequence[Path] | None = None, corners: Path | None = None) -> Outcome:
    """Solve the camera, or take it from ``camera.cameramodel``, and find the board in every image.

    `images` stand in for ``camera.images``; `corners` is a vnlog to read their corners from, or to write them to where it is not there.

    Raises
    ------
    InputError, DegenerateError, DisagreementError, ConvergenceError
        As the steps raise them.
    """
    section: CameraSection = workspace.need("camera")
    board = board_of(workspace.rig_file.rig.board)
    own = list(images) if images is not None else camera_images(workspace)
    others = [image for image in mocap_images(workspace) if image not in set(own)]
    if section.cameramodel is None:
        _refuse_nothing(workspace, own, board)
    STAGE.refuse_places(workspace, _inputs(workspace, own, others))
    views = BoardViews((0, 0), ())
    if board is not None and (own or others):
        known = recall(workspace, corners, own, board) if corners is not None and corners.is_file() else {}
        views = search(workspace, [*own, *others], board, progress, known)
        if corners is not None and not known:
            write_corners(corners, views.views[: len(own)])
        refuse_another_board(shown_in([*own, *others]), replace(views, views=views.views[: len(own) or None]), board)
    solution = _solution(workspace, section, board, replace(views, views=views.views[: len(own)]), progress)
    solution = replace(solution, camera=_with_radiometry(workspace, section, solution))
    solved = section.cameramodel is None or board is None
    poses = locate_boards(views, solution if solved else solution.camera, board, progress=progress)
    if poses.points_B is not None:
        solution = replace(solution, points_B=poses.points_B)
    provenance = workspace.provenance(_inputs(workspace, own, others), settings(workspace))
    _write(workspace, solution, poses, board, provenance)
    return summarise(solution, poses, poses.without, workspace.rig_file.rig)


def camera_images(workspace: Workspace) -> list[Path]:
    """The images of ``camera.images``."""
    section = workspace.rig_file.rig.camera
    return workspace.images(section.images, "camera.images") if section and section.images else []


def mocap_images(workspace: Workspace) -> list[Path]:
    """The images of ``mocap.images``: those that its csv files list, or that a pattern names."""
    section = workspace.rig_file.rig.mocap
    found: dict[Path, None] = {}
    for name in section.images if section else []:
        if name.lower().endswith(".csv"):
            listed = [image for image, _ in read_image_times(workspace.path(name, "mocap.images"))]
        else:
            listed = workspace.images([name], "mocap.images")
        found |= dict.fromkeys(listed)
    return list(found)


def settings(workspace: Workspace) -> dict[str, Any]:
    """The sections that the stage depends on."""
    rig = workspace.rig_file.rig
    return {
        "camera": rig.camera.model_dump() if rig.camera else None,
        "board": rig.board.model_dump() if rig.board else None,
        "mocap_images": list(rig.mocap.images) if rig.mocap else [],
    }


def _refuse_nothing(workspace: Workspace, own: Sequence[Path], board: Board | None) -> None:
    """Without ``camera.cameramodel`` there must be images and a board."""
    workspace.need("board")
    if not own or board is None:
        raise InputError(
            "no images to solve the camera from",
            where=workspace.rig_file.where("camera"),
            needed="camera.images, or camera.cameramodel",
            todo="name the images of the board there, or on the command line: lpcal intrinsics boards/*.png",
        )


def _solution(workspace: Workspace, section: CameraSection, board: Board | None, views: BoardViews, progress: Progress) -> CameraSolution:
    """Solved from the views, or as a file gives it."""
    if section.cameramodel is None:
        assert board is not None
        return calibrate_camera(views, board, model=section.model, progress=progress)
    path = workspace.path(section.cameramodel, "camera.cameramodel")
    return as_given(read_camera_file(path), board, section.cameramodel, str(path), views.image_size if views.views else None)


def _with_radiometry(workspace: Workspace, section: CameraSection, solution: CameraSolution) -> Any:
    """The camera with what its section says of the sensor."""
    sensor = Sensor(section.black_level, section.white_level, section.gamma)
    flat_field = None
    if section.flat_field is not None:
        stored = read_image(workspace.path(section.flat_field, "camera.flat_field"))
        refuse_two_sizes(["the camera", section.flat_field], [solution.camera.image_size, stored.size])
        flat_field = fit_flat_field(stored.pixels, sensor)
    return replace(
        solution.camera,
        black_level=section.black_level,
        white_level=section.white_level,
        gamma=section.gamma,
        flat_field=flat_field,
    )


def _inputs(workspace: Workspace, own: Sequence[Path], others: Sequence[Path]) -> list[Path]:
    rig = workspace.rig_file.rig
    named = [("camera.flat_field", rig.camera.flat_field), ("camera.cameramodel", rig.camera.cameramodel)] if rig.camera else []
    named += [("mocap.images", name) for name in (rig.mocap.images if rig.mocap else []) if name.lower().endswith(".csv")]
    return [*own, *others, *(workspace.path(name, key) for key, name in named if name)]


def _write(
    workspace: Workspace,
    solution: CameraSolution,
    poses: BoardPoses,
    board: Board | None,
    provenance: Provenance,
) -> None:
    write_text(workspace.calib(CAMERAMODEL), MARK + (solution.cameramodel or cameramodel_text(solution.camera)), MODEL_FILE)
    write_h_cb(workspace.calib("H_CB.yaml"), poses, poses.without, board.corners if board else (0, 0), provenance)
    write_camera(workspace.calib("camera.yaml"), solution, provenance)


STAGE = Stage(
    name="intrinsics",
    kinds={"camera.yaml": "camera", "H_CB.yaml": "H_CB"},
    wanted=has_lens,
    inputs=lambda workspace: _inputs(workspace, camera_images(workspace), _others(workspace)),
    settings=settings,
    run=run,
    beside={CAMERAMODEL: MODEL_FILE},
)


def _others(workspace: Workspace) -> list[Path]:
    own = set(camera_images(workspace))
    return [image for image in mocap_images(workspace) if image not in own]


NAMED_VIEWS = 6
FLAT_SIGMAS = 2.0
"""A board none of whose terms is over so many sigmas is said to be flat."""


def summarise(solution: CameraSolution, poses: BoardPoses, left_out: dict[str, str], rig: Rig) -> Outcome:
    """The outcome of the stage."""
    camera = solution.camera
    lines = [f"camera      {camera.model}, {camera.image_size[0]}x{camera.image_size[1]}, {solution.solver}"]
    if note := solution.evidence.solver_note:
        lines.append(f"            {note}")
    lines += _figures(solution)
    images = len(poses.images) + len(left_out)
    if images:
        lines.append(f"board       found in {len(poses.images)} of {images} images, H_CB in calib/H_CB.yaml")
    lines += [f"  without:  {why}: {names}" for why, names in _grouped(left_out)]
    return Outcome(
        summary=[*lines, "written     calib/camera.yaml, calib/camera.cameramodel, calib/H_CB.yaml"],
        document=_document(solution, poses, left_out),
        warnings=list(solution.warnings),
        next_command=_next(rig),
    )


def _figures(solution: CameraSolution) -> list[str]:
    camera, evidence = solution.camera, solution.evidence
    if not solution.views:
        K = camera.K
        return [f"            f {K[0, 0]:.2f} {K[1, 1]:.2f} px, c {K[0, 2]:.2f} {K[1, 2]:.2f} px, as given"]
    why = evidence.chosen.why if evidence.chosen is not None else "as asked"
    used = sum(view.used for view in solution.views)
    found = sum(view.corners + view.rejected > 0 for view in solution.views)
    rejected = sum(view.rejected for view in solution.views)
    lines = [
        f"views       {used} used, board found in {found} of {len(solution.views)}; {rejected} corners rejected",
        f"residual    {camera.rms_px:.4f} px rms a coordinate (over both coordinates: {np.sqrt(2) * camera.rms_px:.4f})",
    ]
    for label, first, second in (("f", 0, 1), ("c", 2, 3)) if camera.spline is None else ():
        values = (camera.K[0, 0], camera.K[1, 1]) if label == "f" else (camera.K[0, 2], camera.K[1, 2])
        sigma = np.sqrt(np.diag(camera.covariance))[[first, second]] if camera.covariance is not None else [np.nan, np.nan]
        lines.append(f"{label}           {values[0]:.2f} +- {fine(sigma[0])}, {values[1]:.2f} +- {fine(sigma[1])} px")
    return [*lines, f"board       {_board(evidence.board_shape or {})}", f"model       {camera.model}: {why}", *_sureness(evidence)]


def _board(shape: Mapping[str, ShapeTerm]) -> str:
    """The board's shape in words."""
    if not shape:
        return "taken as flat"
    within = all(abs(term.value) < FLAT_SIGMAS * term.std for term in shape.values())
    words = "flat within its sigma: " if within else ""
    words += f"bowed by {_mm(shape['bow_x_m'])} along x, {_mm(shape['bow_y_m'])} along y"
    if "twist_m" in shape:
        cubic = max(abs(term.value) for name, term in shape.items() if name.startswith("cubic"))
        words += f", twisted by {_mm(shape['twist_m'])}, bent otherwise by up to {fine(1e3 * cubic)} mm"
    if "stretch" in shape:
        askew_deg = np.degrees(shape["shear"].value)
        words += f"; its squares are {1e2 * shape['stretch'].value:.3f} % longer along x than along y, and {askew_deg:.3f} deg askew"
    return words


def _mm(term: ShapeTerm) -> str:
    """A term of the board's shape in mm, with its sigma where that is known."""
    sigma = "" if not np.isfinite(term.std) else f" +- {fine(1e3 * term.std)}"
    return f"{fine(1e3 * term.value)}{sigma} mm"


def _sureness(evidence: CameraEvidence) -> list[str]:
    """How sure, where, by which views, and what to do next."""
    sure, lines = evidence.projection_uncertainty, []
    if sure is not None:
        lines += [
            f"sure to     {fine(sure.rms_px)} px rms where corners are, {fine(sure.most_px)} px at most",
            f"            to be trusted over {100 * sure.trusted_share:.0f} % of the imager, of which corners cover "
            f"{100 * sure.covered_share:.0f} %; not known beyond them",
        ]
    for other in (evidence.independent_check, evidence.free_board_check):
        if other is not None and other.difference_rms_px is not None and other.difference_worst_px is not None:
            apart = f"{fine(other.difference_rms_px)} px rms, {fine(other.difference_worst_px)} px at most apart"
            lines.append(f"check       {other.by}: {apart}")
    if evidence.coverage is not None:
        lines.append(f"coverage    {evidence.coverage.in_words}")
    if evidence.views_that_matter:
        first = evidence.views_that_matter[:3]
        lines.append("views       that matter most: " + ", ".join(f"{v.image} ({100 * (v.without_it - 1):.0f} %)" for v in first))
    if (view := evidence.next_view) is not None:
        lines.append(f"next view   {view.hold_the_board}: {fine(view.std_now_px)} px would become {fine(view.std_then_px)} px")
    return lines


def _grouped(left_out: dict[str, str]) -> list[tuple[str, str]]:
    """Reasons, and the images of each, the first few by name."""
    lines = []
    for why in Counter(left_out.values()):
        names = [image for image, reason in left_out.items() if reason == why]
        more = f" and {len(names) - NAMED_VIEWS} more" if len(names) > NAMED_VIEWS else ""
        lines.append((why, ", ".join(names[:NAMED_VIEWS]) + more))
    return lines


def _document(solution: CameraSolution, poses: BoardPoses, left_out: dict[str, str]) -> dict[str, Any]:
    camera = solution.camera
    return {
        "model": camera.model,
        "image_size": camera.image_size,
        "K": camera.K,
        "distortion": camera.distortion,
        "rms_px": camera.rms_px,
        "parameters": camera.parameters,
        "std": None if camera.covariance is None else np.sqrt(np.diag(camera.covariance)),
        "solver": solution.solver,
        "evidence": document_of(solution.evidence),
        "views": [vars(view) for view in solution.views],
        "boards_found": len(poses.images),
        "boards_not_found": left_out,
    }


def _next(rig: Rig) -> str | None:
    if rig.mocap is not None:
        return "lpcal handeye"
    if rig.lights and rig.panel is not None:
        return "lpcal wings"
    return "lpcal refine" if rig.spheres else None


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
    marked = {} if workspace.rig_file.rig.board is None else workspace.rig_file.rig.board.marks
    marks_px = {row: np.reshape(marked[name], (4, 2)) for row, image in enumerate(images) if (name := workspace.relative(image)) in marked}
    keys = [cache_key(image, board, DETECTOR_VERSION, marks_px.get(row)) for row, image in enumerate(images)]
    found: dict[str, Sighting] = {key: kept[key] for key in keys if key in kept}
    given = {image: Sighting(read_image(image).size, view) for image, view in known.items()}
    new = [row for row, (key, image) in enumerate(zip(keys, images, strict=True)) if key not in kept and image not in given]
    first, shown = spread(new), shown_in(images)
    seen = list_pixels(shown, first, board, lambda done: progress("board", done, len(new)), marks_px)
    if first and len(new) == len(images) and all(seen[row].view.corners_px is None for row in first):
        refuse_another_count(shown, first, seen[first[0]].named(workspace.relative(images[first[0]])), board)
    rest = [row for row in new if row not in first]
    seen |= list_pixels(shown, rest, board, lambda done: progress("board", len(first) + done, len(new)), marks_px)
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
