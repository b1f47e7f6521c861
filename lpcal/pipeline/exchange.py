"""Files of a rig, or any file that lpcal reads, in other systems' formats; and other systems' files as calibration.yaml."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from lpcal.api.exchange import ALL, Exported, content_of, export_content
from lpcal.api.files import read_calibration, read_capture, read_surface
from lpcal.errors import InputError, UsageError
from lpcal.formats.calibration_yaml import KIND, write_calibration
from lpcal.formats.calibration_yaml import read_calibration as read_own
from lpcal.formats.camera_yaml import read_camera
from lpcal.formats.documents import document_kind, sha256
from lpcal.formats.exchange import known_formats
from lpcal.formats.handeye_yaml import read_handeye
from lpcal.formats.named_files import did_you_mean, exists
from lpcal.formats.outputs import refuse_place
from lpcal.pipeline import export, intrinsics
from lpcal.pipeline.run import run_stage
from lpcal.pipeline.sensor import has_lens
from lpcal.pipeline.workspace import Workspace
from lpcal.records.calibration import NAMES, Calibration
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.provenance import Provenance

FOLDER = "exchange"
"""Where exports go if nothing else is said: in the rig's calib/, or in the current folder."""


@dataclass(frozen=True)
class ExchangeWishes:
    """What is to be written of what, and where."""

    formats: Sequence[str]
    capture: Path | None = None
    surface: Path | None = None
    output: Path | None = None


def list_formats() -> Outcome:
    """Every format: what it needs, keeps and loses, and whether lpcal reads it."""
    lines, document = [], []
    for one in known_formats().values():
        needs = " and ".join(one.needs) or "anything"
        lines.append(f"{one.name}: {one.title}{', read too' if one.read else ''}")
        lines += [f"  needs {needs}", f"  keeps {one.keeps}", f"  loses {one.loses}"]
        document.append(
            {
                "name": one.name,
                "title": one.title,
                "needs": list(one.needs),
                "keeps": one.keeps,
                "loses": one.loses,
                "read": one.read is not None,
            }
        )
    return Outcome(lines, {"formats": document})


def export_rig(workspace: Workspace, wishes: ExchangeWishes, progress: Progress) -> Outcome:
    """A rig's calibration, and one of its captures and surfaces, after whatever stages are out of date."""
    lens_alone = not export.wanted(workspace) and has_lens(workspace)
    earlier = run_stage(workspace, intrinsics.STAGE if lens_alone else export.STAGE, progress)
    file = workspace.calib("camera.yaml" if lens_alone else export.FILE)
    calibration = Calibration(workspace.rig_file.rig.name, (), read_camera(file)) if lens_alone else read_own(file)
    mocap = workspace.rig_file.rig.mocap
    body = (mocap.body if mocap is not None else None) or "panel"
    target = wishes.output or workspace.calib(FOLDER)
    found = _write(calibration, [file], wishes, target, body, progress)
    return replace(found, warnings=[*earlier.warnings, *found.warnings])


def export_file(source: Path, wishes: ExchangeWishes, progress: Progress) -> Outcome:
    """A calibration, a camera, a hand-eye transform or lights of whatever format, or a surface's folder."""
    if (source / "summary.json").is_file():
        if wishes.surface is not None:
            raise UsageError("two surfaces", where=f"{source} and {wishes.surface}", needed="one")
        wishes = replace(wishes, surface=source)
        calibration = Calibration(source.resolve().name, ())
    else:
        calibration = read_any(source)
    return _write(calibration, [source], wishes, wishes.output or Path(FOLDER), "panel", progress)


def read_any(source: Path) -> Calibration:
    """The calibration that a file holds, the hand-eye's own too.

    Raises
    ------
    InputError
        Not there, or of no format known.
    """
    if not exists(source):
        needed = "panel.yaml, calibration.yaml, or a file that lpcal imports"
        raise InputError("no such file or folder", where=str(source), needed=needed, todo=did_you_mean(source))
    if source.is_file() and source.suffix == ".yaml" and b"kind: handeye" in source.read_bytes()[:100]:
        handeye = read_handeye(source)
        return Calibration(source.stem, (), H_PC=handeye.H_PC, carries=handeye.carries)
    return read_calibration(source)


def import_file(
    source: Path, target: Path, progress: Progress, *, vectors: Literal["directions", "positions"] | None, images: Path | None
) -> Outcome:
    """Write calibration.yaml of another system's file or folder.

    `vectors` is what its vectors are stated to be; its lights take the names of the `images` of a folder.

    Raises
    ------
    UsageError, InputError, DisagreementError
        As `read_calibration`; or something that lpcal did not write stands in the place of the target.
    """
    refuse_place(target, document_kind(KIND), [source])
    progress("reading", 0, 1)
    found = read_calibration(source, vectors=vectors, images=images)
    files = sorted(source.glob("*.txt")) + sorted(source.glob("*.mat")) if source.is_dir() else [source]
    write_calibration(target, found, Provenance({path.name: sha256(path) for path in files}, {"format": found.origin}))
    progress("reading", 1, 1)
    near = sum(light.source_C is not None for light in found.lights)
    held = [f"{len(found.lights)} {'near' if near else 'distant'} lights"] if found.lights else ["no lights"]
    held += ["a camera" if found.camera else "no camera: parallel rays"] if found.lights or found.camera else []
    held += [f"{NAMES[found.carries][0]}"] * (found.H_PC is not None)
    return Outcome(
        [f"{found.origin or KIND}: {', '.join(held)} -> {target}"],
        {
            "format": found.origin,
            "lights": len(found.lights),
            "near": near,
            "camera": found.camera is not None,
            "hand-eye": found.H_PC is not None,
            "file": target,
            "notes": list(found.warnings),
        },
        list(found.warnings),
        next_command=f"lpcal reconstruct CAPTURE -c {target}" if found.lights else f"lpcal export {target} --format all",
    )


def _write(calibration: Calibration, inputs: list[Path], wishes: ExchangeWishes, target: Path, body: str, progress: Progress) -> Outcome:
    capture = None if wishes.capture is None else read_capture(wishes.capture, calibration)
    surface = None if wishes.surface is None else read_surface(wishes.surface)
    inputs = [*inputs, *(path for path in (wishes.capture, wishes.surface) if path is not None)]
    content = content_of(calibration, surface, capture, body)
    provenance = Provenance({}, {"formats": list(wishes.formats), "of": [path.as_posix() for path in inputs]})
    found = export_content(target, content, wishes.formats, provenance, inputs=inputs, progress=progress)
    return _told(found, target)


def _told(found: list[Exported], target: Path) -> Outcome:
    written = [one for one in found if not one.skipped]
    lines = [f"{one.format}: {', '.join(file.name for file in one.files)}" for one in written]
    left = [f"{one.format} ({one.skipped})" for one in found if one.skipped]
    lines += [f"left out: {'; '.join(left)}"] if left else []
    return Outcome(
        [f"{target}: {len(written)} formats", *lines],
        {
            "folder": str(target),
            "formats": [
                {"format": one.format, "files": [str(file) for file in one.files], "notes": list(one.notes), "skipped": one.skipped or None}
                for one in found
            ],
        },
        [f"{one.format}: {note}" for one in written for note in one.notes],
        exit_code=0 if written else InputError.exit_code,
    )


__all__ = ["ALL", "ExchangeWishes", "export_file", "export_rig", "import_file", "list_formats", "read_any"]
