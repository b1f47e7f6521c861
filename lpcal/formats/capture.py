"""Capture folders: one image a light, named after it, with ambient images, shorter exposures and a mask where there are any.

``lights: IMG_*.jpg`` in capture.yaml gives the lights by the order of their images, for photographs that a camera numbered.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Sequence
from dataclasses import dataclass
from fnmatch import fnmatchcase
from itertools import pairwise
from pathlib import Path

import numpy as np

from lpcal.errors import DisagreementError, InputError
from lpcal.formats import full_size
from lpcal.formats.exif import UPRIGHT, TakenAt, exposures, turned_notes
from lpcal.formats.full_scale import FullScale, full_scale, negatives, refuse_odd_floats
from lpcal.formats.images import Numbers, read_numbers, stacked
from lpcal.formats.marks import named_by_capture
from lpcal.formats.mask_files import read_mask
from lpcal.formats.named_files import (
    RAWS,
    RESERVED,
    did_you_mean,
    exists,
    hidden,
    image_endings,
    kind_of_other,
    natural_stem,
    resolve_named,
)
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.formats.placement_document import stated_place
from lpcal.formats.zarr_files import is_zarr, read_capture_zarr
from lpcal.geometry.arrays import Array, Image
from lpcal.records.observations import RawCapture
from lpcal.records.rig import CaptureSection
from lpcal.records.sensor import StatedSensor, ToneClaim

SHORT = "short_"


def read_capture(folder: Path, lights: Sequence[str], *, name: str | None = None, use: Sequence[str] | None = None) -> RawCapture:
    """Read a capture folder, or a capture in Zarr.

    Parameters
    ----------
    folder : holds ``<light>.png``, ``ambient*.png``, ``short_<light>.png``, ``mask.png``, ``capture.yaml``
    lights : names of the calibrated lights
    use : the lights to take; else those that capture.yaml names, else all

    Raises
    ------
    InputError
        The folder or an image is not there or cannot be read.
    DisagreementError
        A light has no image, or two of one name; a name in `use` is no light; or images differ in size or channels.
    """
    _need_folder(folder, "a capture folder: one image a light, named after it")
    if is_zarr(folder):
        return read_capture_zarr(folder, lights, name=name, use=use)
    section = read_capture_section(folder / "capture.yaml")
    files, named, said = _in_order(folder, section, lights)
    chosen = _chosen(folder, lights, use or named, files)
    _refuse_unknown(section, {*lights, *files, *(SHORT + light for light in lights)}, folder)
    reader = _SameSize()
    ambient_names = [stem for stem in files if stem == "ambient" or stem.startswith("ambient_")]
    short_names = [light for light in chosen if SHORT + light in files]
    groups = [[files[stem] for stem in group] for group in (chosen, ambient_names, [SHORT + light for light in short_names])]
    found = _read_images(groups, reader)
    images, ambient, short = found.stacks
    claim = _common_claim([reader.claims[files[light]] for light in chosen])
    flat, full = _flat_field(section, folder), found.full
    sources = {light: files[light] for light in (*chosen, *ambient_names)}
    stated = {path: _exposure(section, name) for name, path in sources.items()}
    exposure, more = exposures({path: reader.taken[path] for path in sources.values()}, stated)
    more += turned_notes({path: reader.turns[path] for path in sources.values()})
    known = {*lights, *ambient_names, "mask", *(SHORT + light for light in lights), *([flat.stem] if flat else [])}
    mask = read_mask(files["mask"], reader.shape) if "mask" in files else None
    raw = RawCapture(
        name=name or folder.resolve().name,
        lights=tuple(chosen),
        images=images,
        exposure_s=np.array([exposure[files[light]] for light in chosen]),
        ambient=ambient if ambient_names else None,
        ambient_exposure_s=np.array([exposure[files[stem]] for stem in ambient_names]),
        short=dict(zip(short_names, short, strict=True)),
        short_exposure_s={light: _short_exposure(section, light, files, reader, exposure) for light in short_names},
        mask=mask,
        left_out=tuple(path.name for stem, path in files.items() if stem not in known),
        step=full.step or reader.step,
        sensor=StatedSensor(section.gamma, section.black_level, section.white_level),
        flat=None if flat is None else reader.read(flat).image.pixels / np.float32(full.divisor),
        claim=claim,
        white_level=full.white_level,
        distance_m=section.distance,
        arrangement_stated=section.arrangement == "stated",
        place=stated_place(section, folder),
        notes=(*said, *more, *full.notes, *negatives(reader.least, full.divisor)),
    )
    return raw if found.sieve is None else full_size.settled(raw, found.sieve, full, mask)


@dataclass(frozen=True)
class _Read:
    """The images of a capture, as fractions of full scale."""

    stacks: list[Image]
    """(N, H, W[, 3]) of the lights, of the ambient images, of the short ones."""
    full: FullScale
    sieve: full_size.Sieve | None
    """What holds them in full size, where they are too large; the stacks are then coarse."""


def _read_images(groups: list[list[Path]], reader: _SameSize) -> _Read:
    """The images of lights, ambient ones and short ones."""
    paths = [path for group in groups for path in group]
    ends = np.cumsum([0, *(len(group) for group in groups)]).tolist()
    first = reader.read(paths[0])
    if full_size.too_large(first.stored.shape, len(groups[0])):
        sieve = full_size.read_all(paths, reader.read, len(groups[0]), first)
        full = sieve.full()
        return _Read([sieve.coarse(range(*both), full) for both in pairwise(ends)], full, sieve)
    stacks = [stacked(group, lambda path: first if path == paths[0] else reader.read(path), first.stored.shape) for group in groups]
    full = full_scale(stacks[0], reader.step)
    for stack in stacks:
        np.divide(stack, np.float32(full.divisor), out=stack)
    return _Read(stacks, full, None)


def _flat_field(section: CaptureSection, folder: Path) -> Path | None:
    """The image that capture.yaml names as flat field.

    Raises
    ------
    InputError
        It is not there.
    """
    if section.flat_field is None:
        return None
    path = resolve_named(folder, section.flat_field)
    if path is None:
        where = f"{folder / 'capture.yaml'}, flat_field"
        todo = did_you_mean(folder / section.flat_field, "correct it")
        raise InputError(f"no such file: {section.flat_field}", where=where, needed="an image of an evenly lit target", todo=todo)
    return path


def _common_claim(claims: Sequence[ToneClaim | None]) -> ToneClaim | None:
    """What all images claim of their tone curve; None where one claims something else, or nothing."""
    return claims[0] if claims and all(claim == claims[0] for claim in claims) else None


def check_lights(folder: Path, lights: Sequence[str], *, use: Sequence[str] | None = None) -> None:
    """Whether a capture folder names an image of every light, before any image is read.

    Raises
    ------
    InputError, DisagreementError
        As `read_capture` raises them for the folder, its capture.yaml and the names of its images.
    """
    _need_folder(folder, "a capture folder: one image a light, named after it")
    files, named, _ = _in_order(folder, read_capture_section(folder / "capture.yaml"), lights)
    _chosen(folder, lights, use or named, files)


def read_sweep(folder: Path) -> tuple[Image, Array, float]:
    """Images (N, H, W[, 3]) of one scene, their exposures times gain (N,), and one step of the stored numbers.

    Raises
    ------
    InputError
        The folder or an image is not there or cannot be read, or an image's exposure is not stated in capture.yaml.
    DisagreementError
        Images differ in size or channels.
    """
    _need_folder(folder, "images of one still scene under several exposures")
    section, reader, files = read_capture_section(folder / "capture.yaml"), _SameSize(), _by_name(folder)
    exposure = {stem: _exposure(section, stem, own=True) for stem in files}
    unstated = [stem for stem, value in exposure.items() if value is None]
    if unstated or not files:
        raise InputError(
            f"no exposure is stated for {', '.join(unstated)}" if unstated else "no image",
            where=str(folder / "capture.yaml"),
            needed="exposures: {image name: 5 ms, ...}",
            todo="state the exposure of each image",
        )
    images = np.stack([reader.read(path).image.pixels for path in files.values()])
    return images, np.array([value for value in exposure.values() if value is not None]), reader.step


class _SameSize:
    """Reads images and holds them to the size and channels of the first."""

    def __init__(self) -> None:
        self.first: Path | None = None
        self.shape: tuple[int, ...] = ()
        self.step = 1 / 255
        self.claims: dict[Path, ToneClaim | None] = {}
        self.least: dict[Path, float] = {}
        self.taken: dict[Path, TakenAt | None] = {}
        self.turns: dict[Path, int] = {}

    def read(self, path: Path) -> Numbers:
        image = read_numbers(path)
        if self.first is None:
            self.first, self.shape, self.step = path, image.stored.shape, image.step
        if image.stored.shape != self.shape:
            raise DisagreementError(
                f"{_kind(image.stored.shape)}, but {self.first.name} is {_kind(self.shape)}",
                where=str(path),
                needed="all images of a capture alike",
                todo=UPRIGHT if image.stored.shape[:2] == self.shape[1::-1] else "take the capture again, or remove the odd image",
            )
        refuse_odd_floats(image.stored, path)
        self.claims[path] = image.claim
        self.least[path] = float(image.stored.min()) / image.full_scale
        self.taken[path], self.turns[path] = image.taken, image.turn
        return image


def _kind(shape: tuple[int, ...]) -> str:
    return f"{shape[1]}x{shape[0]} {'grey' if len(shape) == 2 else 'RGB'}"


def _need_folder(folder: Path, needed: str) -> None:
    if not exists(folder) or not folder.is_dir():
        found = (kind_of_other([folder]) or "not a folder") if exists(folder) else "no such folder"
        raise InputError(found, where=str(folder), needed=needed, todo=did_you_mean(folder))
    try:
        next(folder.iterdir(), None)
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", where=str(folder), needed=needed) from error


def _refuse_unknown(section: CaptureSection, known: set[str], folder: Path) -> None:
    """An exposure or gain that is stated for what is no image would be dropped, as would gains without an exposure."""
    unknown = [name for name in {**section.exposures, **section.gains} if name not in known]
    if unknown:
        raise DisagreementError(
            f"states an exposure or gain of {', '.join(unknown[:8])}, which is no image there",
            where=str(folder / "capture.yaml"),
            needed="names of lights, short_<light>, ambient",
            todo="correct the name",
        )
    if section.gains and section.exposure is None and not set(section.gains) <= set(section.exposures):
        raise InputError(
            f"a gain of {', '.join(section.gains)}, and no exposure",
            where=str(folder / "capture.yaml"),
            needed="an exposure for gains to count",
            todo="state exposure: too, such as 20 ms",
        )


def _by_name(folder: Path) -> dict[str, Path]:
    """The folder's images by their names without the ending."""
    files: dict[str, Path] = {}
    for path in sorted(folder.iterdir()):
        if path.suffix.lower() not in image_endings() or hidden(path):
            continue
        raws = [each for each in (path, files.get(path.stem)) if each is not None and each.suffix.lower() in RAWS]
        if path.stem in files and len(raws) == 1:  # a camera that stores a picture beside its raw file
            files[path.stem] = raws[0]
            continue
        if path.stem in files:
            raise DisagreementError(
                f"{files[path.stem].name} and {path.name}: two images of one name",
                where=str(folder),
                needed=f"one image called {path.stem}",
                todo="remove or rename one of them",
            )
        files[path.stem] = path
    return files


def _in_order(folder: Path, section: CaptureSection, lights: Sequence[str]) -> tuple[dict[str, Path], Sequence[str] | None, list[str]]:
    """The images by name, the lights that capture.yaml takes, and notes where the images' order names them."""
    files, pattern = named_by_capture(folder, section.images, lights, _by_name(folder)), _pattern_of(section.lights)
    if pattern is None:
        return files, section.lights, []
    files = _by_order(folder, pattern, lights, files)
    first, last = lights[0], lights[-1]
    return files, None, [f"lights by the order of {pattern}: {first} is {files[first].name}, ... {last} is {files[last].name}"]


def _chosen(folder: Path, lights: Sequence[str], use: Sequence[str] | None, files: dict[str, Path]) -> list[str]:
    use = None if use is None else [next((own for own in lights if _composed(own) == _composed(light)), light) for light in use]
    unknown = [light for light in use or [] if light not in lights]
    if unknown:
        raise DisagreementError(
            f"no light is called {', '.join(unknown)}",
            where=str(folder),
            needed=f"some of {', '.join(lights)}",
            todo="correct --use, or lights: in capture.yaml",
        )
    chosen = [light for light in lights if use is None or light in use]
    _spelled_otherwise(chosen, files)
    lacking = [light for light in chosen if light not in files]
    if lacking:
        other = kind_of_other(path for path in folder.iterdir() if path.stem in lacking or not files)
        if other:
            raise InputError(other, where=str(folder), needed=f"an image for each light, for example {lacking[0]}.png")
        others = sorted(stem for stem in files if stem not in lights and not stem.startswith(("ambient", SHORT)) and stem != "mask")
        raise DisagreementError(
            f"no image of {', '.join(lacking)}" + (f"; found are also {', '.join(others[:8])}" if others else ""),
            where=str(folder),
            needed=f"an image for each light, for example {lacking[0]}.png",
            todo="add it, rename it, or take a subset with --use or with lights: in capture.yaml",
        )
    return chosen


def _composed(name: str) -> str:
    return unicodedata.normalize("NFC", name)


def _folded(name: str) -> str:
    return _composed(name).casefold()


def _spelled_otherwise(lights: Sequence[str], files: dict[str, Path]) -> None:
    """Give images whose names are a light's but for accents' form or capitals that light's name, where only one is."""
    for same in (_composed, _folded):
        for light in [light for light in lights if light not in files]:
            twins = [stem for stem in files if same(stem) == same(light) and stem not in lights]
            if len(twins) == 1:
                files[light] = files.pop(twins[0])
                short = next((stem for stem in files if same(stem) == same(SHORT + light)), None)
                if short is not None:
                    files[SHORT + light] = files.pop(short)
    for stem in [stem for stem in files if stem not in lights]:
        plain = stem.lower()
        if plain not in files and (plain in {"mask", "ambient"} or plain.startswith("ambient_")):
            files[plain] = files.pop(stem)


def _exposure(section: CaptureSection, stem: str, *, own: bool = False) -> float | None:
    """Exposure times gain of one image; None where no exposure is stated (`own`: stated for this very image)."""
    exposure = section.exposures.get(stem, None if own else section.exposure)
    return None if exposure is None else exposure * section.gains.get(stem, section.gain)


def _short_exposure(
    section: CaptureSection, light: str, files: dict[str, Path], reader: _SameSize, exposure: dict[Path, float]
) -> float | None:
    """Exposure of a light's shorter image: as stated, else by both images' EXIF tags; None where neither says it."""
    stated = _exposure(section, SHORT + light, own=True)
    short, plain = reader.taken.get(files[SHORT + light]), reader.taken.get(files[light])
    if stated is not None or short is None or plain is None:
        return stated
    return exposure[files[light]] * short.relative_to(plain) / plain.time_s


def _pattern_of(lights: Sequence[str] | None) -> str | None:
    """The pattern that stands for the lights' names; None where they are names."""
    return lights[0] if lights is not None and len(lights) == 1 and any(sign in lights[0] for sign in "*?") else None


def _by_order(folder: Path, pattern: str, lights: Sequence[str], files: dict[str, Path]) -> dict[str, Path]:
    """The folder's images with the lights' names for those that the pattern matches, in their natural order.

    Raises
    ------
    DisagreementError
        Another number of images than of lights, or an image of a light's own name beside them.
    """
    matched = [stem for stem, path in files.items() if fnmatchcase(path.name.lower(), pattern.lower())]
    matched = [stem for stem in matched if stem.lower() not in RESERVED and not stem.lower().startswith(("ambient", SHORT))]
    matched.sort(key=natural_stem)
    if len(matched) != len(lights):
        raise DisagreementError(
            f"{len(matched)} images match {pattern}",
            where=str(folder),
            needed=f"{len(lights)}, one a light, in the order of the calibration",
            todo="move the others away, call them ambient_0, ..., or narrow the pattern",
        )
    twice = [light for light in lights if light in files and light not in matched]
    if twice:
        raise DisagreementError(
            f"an image called {twice[0]} beside {pattern}", where=str(folder), needed="lights by name or by order", todo="not both"
        )
    others = {stem: path for stem, path in files.items() if stem not in matched}
    return {light: files[stem] for light, stem in zip(lights, matched, strict=True)} | others
