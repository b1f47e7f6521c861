"""Calibrations, surfaces and captures in other systems' formats."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from lpcal.api.curve import settle_sensor
from lpcal.api.sensor import BY_CAPTURE, stated_in
from lpcal.detect.exposures import with_short_exposures
from lpcal.detect.radiometry import to_radiance
from lpcal.errors import InputError, LpcalError, UsageError
from lpcal.formats.exchange import ExchangeFormat, formats_of, known_formats, register
from lpcal.formats.exchange_folder import Draft, place
from lpcal.records.calibration import Calibration
from lpcal.records.exchange import ExchangeContent, LinearImages
from lpcal.records.observations import RawCapture
from lpcal.records.outcome import Progress, silent
from lpcal.records.provenance import Provenance
from lpcal.records.surface import Surface

ALL = "all"
"""The word for every format that there is enough for."""


@dataclass(frozen=True)
class Exported:
    """What became of one format."""

    format: str
    files: tuple[Path, ...] = ()
    """The files and folders that were written."""
    notes: tuple[str, ...] = ()
    """What was changed or lost of this very calibration."""
    skipped: str = ""
    """Why nothing was written; empty where it was."""


def register_format(added: ExchangeFormat) -> ExchangeFormat:
    r"""Add a format to write calibrations in, or another one under its name; `export_calibration` and the commands know it from then on.

    An installed package adds one for good, and for the command line too, by an entry point:

        [project.entry-points."lpcal.formats"]
        ours = "our_package:FORMAT"            # an ExchangeFormat

    Parameters
    ----------
    added : ExchangeFormat
        Its name, what it needs, keeps and loses, and how it is written.

    Returns
    -------
    ExchangeFormat
        The format.

    Raises
    ------
    InputError
        A name that is empty, or a writer that cannot be called.

    Examples
    --------
    >>> import lpcal
    >>> def write(content, folder):
    ...     (folder / "names.txt").write_text("".join(f"{light.name}\\n" for light in content.calibration.lights))
    ...     return []
    >>> lpcal.register_format(lpcal.ExchangeFormat("names", "names of lights", ("lights",), "names", "the rest", write)).needs
    ('lights',)
    """
    if not isinstance(added, ExchangeFormat) or not added.name or not callable(added.write):
        raise InputError("is no format", where=f"register_format({added!r})", needed="an ExchangeFormat with a name and a writer")
    register(added)
    return added


def export_calibration(
    folder: str | os.PathLike[str],
    calibration: Calibration,
    formats: str | Sequence[str] = "all",
    *,
    surface: Surface | None = None,
    capture: RawCapture | None = None,
    body: str = "panel",
    progress: Progress = silent,
) -> list[Exported]:
    """Write a calibration, and with it a surface or a capture, in other systems' formats.

    Parameters
    ----------
    folder : str or path
        Where to: each format has its own file or folder in it, and ``lpcal-export.json`` says which.
    calibration : Calibration
        The camera, its place in the tracked body, the lights: whatever there is of them.
    formats : str or sequence of str
        Their names, or one of them, see ``lpcal export --list``; "all" are those that there is enough for.
    surface : Surface, optional
        For meshes, depth maps and point clouds.
    capture : RawCapture, optional
        For formats that hold images; it is made linear.
    body : str
        What the tracked body is called in tf and URDF.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Returns
    -------
    list of Exported
        A format each: its files, and what was changed or lost.

    Raises
    ------
    UsageError
        No format has such a name.
    InputError
        A format that was named needs something that is not there, or a file that lpcal did not write stands in its place.

    Examples
    --------
    >>> import lpcal, pathlib, tempfile
    >>> calibration = lpcal.assemble_calibration(lpcal.design_lights(lpcal.read_rig("lightpanel-6")))
    >>> [file.name for one in lpcal.export_calibration(tempfile.mkdtemp(), calibration, ["lp"]) for file in one.files]
    ['lights.lp']
    """
    content = content_of(calibration, surface, capture, body)
    return export_content(Path(folder), content, formats, Provenance(), progress=progress)


def content_of(calibration: Calibration, surface: Surface | None, capture: RawCapture | None, body: str = "panel") -> ExchangeContent:
    """What is to be written; a capture is made linear."""
    return ExchangeContent(calibration, surface, None if capture is None else linear_images(capture, calibration), body)


def export_content(
    folder: Path,
    content: ExchangeContent,
    formats: str | Sequence[str],
    provenance: Provenance,
    *,
    inputs: Iterable[Path] = (),
    progress: Progress = silent,
) -> list[Exported]:
    """Write content in formats, as `export_calibration`.

    Raises
    ------
    UsageError, InputError
        As `export_calibration`.
    """
    names = [formats] if isinstance(formats, str) else list(formats)
    every = ALL in names
    wanted = list(known_formats().values()) if every else formats_of(names)
    if not wanted:
        raise UsageError("no format", needed="--format NAME", todo="lpcal export --list names them")
    results: dict[str, Exported] = {}
    with tempfile.TemporaryDirectory(prefix="lpcal-export-") as scratch:
        drafts = []
        for count, one in enumerate(wanted):
            progress("export", count, len(wanted))
            draft = _draft(one, content, Path(scratch), strict=not every)
            results[one.name] = Exported(one.name, (), draft.notes) if isinstance(draft, Draft) else draft
            drafts += [draft] if isinstance(draft, Draft) else []
        files = {draft.format: tuple(folder / entry.name for entry in draft.entries) for draft in drafts}
        place(drafts, folder, provenance, inputs)
    progress("export", len(wanted), len(wanted))
    return [Exported(one.format, files.get(one.format, ()), one.notes, one.skipped) for one in results.values()]


def _draft(one: ExchangeFormat, content: ExchangeContent, scratch: Path, *, strict: bool) -> Draft | Exported:
    """Write one format into a folder of its own; what keeps it from being written is an error only where it was asked for by name."""
    lacking = one.lacking(content)
    target = scratch / one.name
    target.mkdir()
    try:
        if lacking:
            raise InputError(f"no {' and no '.join(lacking)}", where=f"--format {one.name}", needed=" and ".join(one.needs))
        notes = one.write(content, target)
    except LpcalError as error:
        if strict:
            raise
        return Exported(one.name, skipped=f"no {', no '.join(lacking)}" if lacking else str(error).splitlines()[0])
    return Draft(one.name, target, tuple(notes))


def linear_images(raw: RawCapture, calibration: Calibration) -> LinearImages:
    """A capture made linear, the ambient light taken off, shorter exposures put in.

    Raises
    ------
    DegenerateError, DisagreementError
        As reconstruction refuses a capture that is dark, saturated or not linear.
    """
    settled = settle_sensor(raw, calibration, [(BY_CAPTURE, raw.sensor), ("the calibration", stated_in(calibration))])
    radiance = with_short_exposures(to_radiance(raw, settled.used.sensor), raw, settled.used.sensor)
    return LinearImages(raw.name, radiance.lights, radiance.signal, raw.mask)
