"""What ``lpcal intrinsics`` says: views, residual, focal length with its sigma, the board's bow, the model and why."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from typing import Any

import numpy as np

from lpcal.formats.record_documents import document_of
from lpcal.records.calibration import CameraSolution
from lpcal.records.digits import fine
from lpcal.records.evidence import CameraEvidence, ShapeTerm
from lpcal.records.observations import BoardPoses
from lpcal.records.outcome import Outcome
from lpcal.records.rig import Rig

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
