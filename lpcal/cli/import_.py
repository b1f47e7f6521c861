"""``lpcal import``: a calibration from other systems' files."""

from __future__ import annotations

import argparse
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "source", type=Path, metavar="FILE_OR_FOLDER", help=".lp, DiLiGenT folder, LUCES led_params, near_ps light.mat, directions"
    )
    parser.add_argument("--images", type=Path, metavar="FOLDER", help="name the lights after these images, in their order")
    parser.add_argument(
        "--vectors", choices=("directions", "positions"), help="what the vectors of an .lp or a table are, where their lengths do not tell"
    )
    parser.add_argument("-o", "--output", type=Path, required=True, metavar="calibration.yaml", help="the calibration to write")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:
    """Do it."""
    from lpcal.formats.calibration_yaml import KIND, write_calibration
    from lpcal.formats.documents import document_kind, sha256
    from lpcal.formats.import_lights import import_lights, named_after
    from lpcal.formats.outputs import refuse_place
    from lpcal.records.provenance import Provenance

    refuse_place(options.output, document_kind(KIND), [options.source])
    progress("reading", 0, 1)
    found = import_lights(options.source, options.vectors)
    name, calibration = found.format, found.calibration
    calibration = named_after(calibration, options.images) if options.images else calibration
    files = sorted(options.source.glob("*.txt")) + sorted(options.source.glob("*.mat")) if options.source.is_dir() else [options.source]
    write_calibration(options.output, calibration, Provenance({path.name: sha256(path) for path in files}, {"format": name}))
    progress("reading", 1, 1)
    near = sum(light.source_C is not None for light in calibration.lights)
    camera = "a camera" if calibration.camera else "no camera: parallel rays"
    kind = "near" if near else "distant"
    notes = list(found.notes)
    if near and calibration.d_object_m is None:
        notes.append("the lights' axes meet nowhere: no working distance; reconstruct finds it from the light, or takes --distance")
    if calibration.camera is not None and calibration.camera.size_guessed:
        width, height = calibration.camera.image_size
        notes.append(
            f"no image beside it: its size is guessed as {width}x{height} from the principal point; reconstruct takes the capture's"
        )
    return Outcome(
        [f"{name}: {len(calibration.lights)} {kind} lights, {camera} -> {options.output}"],
        {
            "format": name,
            "lights": len(calibration.lights),
            "near": near,
            "camera": calibration.camera is not None,
            "file": options.output,
            "notes": notes,
        },
        list(notes),
        next_command=f"lpcal reconstruct CAPTURE -c {options.output}",
    )
