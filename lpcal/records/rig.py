"""What a person writes: panel.yaml and capture.yaml, as they are after reading. Metres, radians, seconds, fractions of 1.

Every section is optional; a stage that needs an absent one says which. The page docs/reference/written-files.md has every key.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, field_validator, model_validator

from lpcal.records.names import plain_names, reserved
from lpcal.records.quantities import Angle, Curve, Duration, Length, Pixels, Share, Size, Turn, parse
from lpcal.records.shown import Shown

type Names = list[str]
type Count = Annotated[int, Field(ge=2)]
type Factor = Annotated[float, Field(gt=0, allow_inf_nan=False)]


class Section(BaseModel):
    """A section of a file that people write: frozen, and an unknown key is an error."""

    model_config = ConfigDict(extra="forbid", frozen=True, defer_build=True)


SAME_AZIMUTH_RAD = math.radians(0.5)
"""Wings nearer to each other than this, in azimuth, are one wing written twice: a wing is some ten degrees wide."""


def _version(value: object) -> object:
    return 1 if str(value) == "1" else value


def _offset(value: object) -> object:
    return value if value == "estimate" else parse(value, "time")


def _as_list(value: object) -> object:
    return [value] if isinstance(value, (str, int, float)) else value


class CameraSection(Section):
    """``camera:`` images for the intrinsics, and what the sensor does to light."""

    images: Names = []
    model: Literal["auto", "opencv4", "opencv5", "opencv8", "splined"] = "auto"
    black_level: Share = 0.0
    white_level: Share = 1.0
    gamma: Curve = 1.0
    flat_field: str | None = None
    exposure_sweep: str | None = None
    cameramodel: str | None = None

    _images = field_validator("images", mode="before")(_as_list)

    @model_validator(mode="after")
    def _black_below_white(self) -> Self:
        if self.black_level >= self.white_level:
            msg = f"black_level, {100 * self.black_level:g} %, is not below white_level, {100 * self.white_level:g} %; black below white"
            raise ValueError(msg)
        return self


class BoardSection(Section):
    """``board:`` the calibration target.

    ``corners`` are inner corners along x, along y: of circles their centres, of an aprilgrid two a tag. ``square`` is how far apart they
    are, of an aprilgrid how far apart its tags are, and ``marker`` a tag's side.
    """

    kind: Literal["chessboard", "charuco", "circles", "aprilgrid"] = "chessboard"
    corners: tuple[Count, Count]
    square: tuple[Size, Size]
    warp: Literal["auto", "none"] = "auto"
    corner_fit: Literal["edges", "opencv"] = "edges"
    marker: Size | None = None
    dictionary: str | None = None
    marks: dict[str, tuple[Pixels, Pixels, Pixels, Pixels, Pixels, Pixels, Pixels, Pixels]] = {}
    """By image in which no search finds the board, x and y of its four outermost inner corners, in turn round it."""

    @field_validator("square", mode="before")
    @classmethod
    def _one_or_two(cls, value: object) -> object:
        return value if isinstance(value, (list, tuple)) else (value, value)


class BoardPosesSection(Section):
    """``mocap.board_poses:`` board poses found elsewhere."""

    file: str
    direction: Literal["H_CB", "H_BC"] = "H_CB"


class MocapSection(Section):
    """``mocap:`` where the panel was. ``file`` is a recording with a clock; ``poses`` one pose an image, without."""

    file: str | None = None
    body: str | None = None
    images: Names = []
    board_poses: BoardPosesSection | None = None
    poses: str | None = None
    direction: Literal["H_OP", "H_PO"] = "H_OP"
    carries: Literal["camera", "board"] | None = None
    """What rides on the tracked body, the other one standing still in the room; None: what the data say."""
    quaternion: Literal["xyzw", "wxyz"] | None = None
    rotation: Literal["rotation_vector", "rotation_vector_deg", "abc_deg", "xyz_deg", "zyz_deg", "rpy_deg", "rpy_rad"] | None = None
    """What the three numbers of a rotation are in ``poses``, where their names do not say."""
    units: Literal["m", "mm", "cm"] | None = None
    clock_offset: Annotated[Literal["estimate"] | float, BeforeValidator(_offset)] = "estimate"

    _images = field_validator("images", mode="before")(_as_list)


class CameraMount(Section):
    """``panel.camera:`` C in D as designed; the prior of H_CD where no mocap gives it."""

    position: tuple[Length, Length, Length] = (0.0, 0.0, 0.0)
    tolerance: tuple[Size, Turn] = (0.002, 0.017453292519943295)


class Tolerance(Section):
    """``panel.tolerance:`` 1 sigma, of the azimuth, of g, of d1 and of d2 each, of the relative intensity."""

    azimuth: Turn = 0.008726646259971648
    joint_angle: Turn = 0.017453292519943295
    length: Size = 0.0005
    intensity: Share = 0.10


class DistanceSensorSection(Section):
    """``panel.distance_sensor:`` the beam of the panel's distance sensor in D as designed, and what its readings scatter by, 1 sigma."""

    position: tuple[Length, Length, Length]
    direction: tuple[float, float, float] = (0.0, 0.0, 1.0)
    noise: Size = 0.003
    tolerance: tuple[Size, Turn] = (0.005, 0.03490658503988659)
    readings: Names = []
    """Csv files of readings beside those of ``mocap.images``, which may have a column distance_m themselves."""

    _readings = field_validator("readings", mode="before")(_as_list)

    @field_validator("direction")
    @classmethod
    def _of_some_length(cls, value: tuple[float, float, float]) -> tuple[float, float, float]:
        if not 0 < math.hypot(*value) < math.inf:
            msg = "a direction without length; x, y, z in D, such as [0, 0, 1]"
            raise ValueError(msg)
        return value


class PanelSection(Section):
    """``panel:`` the mechanics that all wings share."""

    disc_radius: Size
    joint: Length
    blob: Length
    markers: dict[str, tuple[Length, Length, Length]] | None = None
    camera: CameraMount = CameraMount()
    distance_sensor: DistanceSensorSection | None = None
    tolerance: Tolerance = Tolerance()


class LightSection(Section):
    """One of ``lights:``, a wing's setting, or nothing at all for a light of which nothing is known."""

    azimuth: Angle | None = None
    joint_angle: Angle | None = None
    disc_spacer: Length | None = None
    blob_spacer: Length | None = None
    leds: int | None = Field(default=None, gt=0)
    lobe: str | None = None
    """A maker's photometric file, .ies or .ldt, where it is no blob of LEDs."""

    @property
    def is_wing(self) -> bool:
        """Whether the wing's kinematics are stated."""
        return self.azimuth is not None

    @field_validator("joint_angle")
    @classmethod
    def _a_joints_angle(cls, value: float | None) -> float | None:
        if value is not None and not -math.pi / 2 <= value <= math.pi / 2:
            msg = f"a joint at {math.degrees(value):g} deg; -90 deg to 90 deg"
            raise ValueError(msg)
        return value

    @model_validator(mode="after")
    def _all_or_none(self) -> LightSection:
        setting = {key: getattr(self, key) for key in ("azimuth", "joint_angle", "disc_spacer", "blob_spacer")}
        lacking = [key for key, value in setting.items() if value is None]
        if 0 < len(lacking) < len(setting):
            msg = f"a wing without {', '.join(lacking)}; all of {', '.join(setting)}, or none"
            raise ValueError(msg)
        if self.leds is not None and self.lobe is not None:
            msg = "leds and lobe, where one of them says how the light emits"
            raise ValueError(msg)
        return self


class SphereSection(Section):
    """One of ``spheres:``. The hint is about where its outline is: x, y, radius in pixels."""

    kind: Literal["chrome", "matte"]
    radius: Size | None = None
    images: str
    hint: tuple[Pixels, Pixels, Pixels] | None = None


class Rig(Section):
    """panel.yaml, whole."""

    lpcal: Annotated[Literal[1], BeforeValidator(_version)]
    name: str = "rig"
    camera: CameraSection | None = None
    board: BoardSection | None = None
    mocap: MocapSection | None = None
    panel: PanelSection | None = None
    lights: dict[str, LightSection] = {}
    spheres: dict[str, SphereSection] = {}
    objects: dict[str, str] = {}
    joint_solve: bool = False
    """Whether refine solves for the camera and H_PC too, with what the boards said of them as prior."""

    @field_validator("lights")
    @classmethod
    def _lights_apart(cls, lights: dict[str, LightSection]) -> dict[str, LightSection]:
        for name in plain_names(lights, "light"):
            if reserved(name):
                msg = f"a light called {name!r}; another name: {name}.png in a capture folder is no light's image"
                raise ValueError(msg)
        wings = [(name, light.azimuth) for name, light in lights.items() if light.azimuth is not None]
        for k, (name, azimuth) in enumerate(wings):
            for other, beside in wings[:k]:
                if abs(math.remainder(azimuth - beside, math.tau)) < SAME_AZIMUTH_RAD:
                    msg = (
                        f"the wings {other} and {name} both at an azimuth of {math.degrees(azimuth):g} deg; wings at azimuths of their own"
                    )
                    raise ValueError(msg)
        return lights

    @field_validator("spheres")
    @classmethod
    def _spheres_named(cls, spheres: dict[str, SphereSection]) -> dict[str, SphereSection]:
        return plain_names(spheres, "sphere")

    @field_validator("objects")
    @classmethod
    def _objects_named(cls, objects: dict[str, str]) -> dict[str, str]:
        return plain_names(objects, "object")


@dataclass(frozen=True, repr=False)
class RigFile(Shown):
    """A panel.yaml and where it was read; its paths are relative to `folder`."""

    rig: Rig
    file: Path
    lines: dict[str, int] = field(default_factory=dict)
    """Line of each key, by its dotted path."""

    @property
    def folder(self) -> Path:
        """The rig folder."""
        return self.file.parent

    def where(self, key: str) -> str:
        """``panel.yaml:12, board.square`` for a message; the line of the nearest key above where the key itself is not there."""
        above = key
        while above and above not in self.lines:
            above = above.rpartition(".")[0]
        return f"{self.file}:{self.lines[above]}, {key}" if above else f"{self.file}, {key}"


class WrittenTransform(Section):
    """A transform as a person writes it: where the frame's origin is, and one of the two ways to say how it is turned."""

    position: tuple[Length, Length, Length]
    quaternion: tuple[float, float, float, float] | None = None
    rotation_vector: tuple[Angle, Angle, Angle] | None = None

    @model_validator(mode="after")
    def _one_rotation(self) -> Self:
        if (self.quaternion is None) == (self.rotation_vector is None):
            msg = (
                f"{'no' if self.quaternion is None else 'two'} rotation{'s' * (self.quaternion is not None)}; quaternion or rotation_vector"
            )
            raise ValueError(msg)
        if self.quaternion is not None and not abs(math.hypot(*self.quaternion) - 1) < QUATERNION:
            msg = f"a quaternion of length {math.hypot(*self.quaternion):.3g}; x, y, z, w of length 1"
            raise ValueError(msg)
        return self


QUATERNION = 0.02
"""By how much the length of a written quaternion may differ from 1: digits that a person cut off."""


class PoseSection(Section):
    """``pose:`` of capture.yaml: the tracked body that carries the camera in the room (H_OP), or the camera itself (H_OC)."""

    H_OP: WrittenTransform | None = None
    H_OC: WrittenTransform | None = None
    tolerance: tuple[Size, Turn] | None = None
    """One sigma of it, an axis; else what the calibration knows of tracked poses, or what rooms and arms keep."""

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.H_OP is None) == (self.H_OC is None):
            msg = f"{'neither H_OP nor' if self.H_OP is None else 'both H_OP and'} H_OC; one of the two"
            raise ValueError(msg)
        return self


class CaptureSection(Section):
    """capture.yaml: exposures, lights, the sensor; when (camera's clock) and from where it was taken, the body that the object rides on."""

    distance: Size | None = None
    """The panel's distance from the object, where a sensor says it."""
    time: Annotated[float, BeforeValidator(lambda value: parse(value, "time"))] | None = None
    pose: PoseSection | None = None
    body: str | None = None
    mocap: str | None = None
    """The recording of this capture, relative to its folder, where it is another than the rig's."""
    clock_offset: Annotated[float, BeforeValidator(lambda value: parse(value, "time"))] | None = None
    gamma: Curve | None = None
    black_level: Share | None = None
    white_level: Share | None = None
    flat_field: str | None = None
    """An image of an evenly lit target, relative to the capture folder."""
    exposure: Duration | None = None
    gain: Factor = 1.0
    exposures: dict[str, Duration] = {}
    gains: dict[str, Factor] = {}
    lights: Names | None = None
    """Names of those that are taken; or one pattern of images, such as IMG_*.jpg, that are all the lights in their order."""

    images: dict[str, str] = {}
    """Light: the file that shows it, where files are not called after their lights."""
    arrangement: Literal["auto", "stated"] = "auto"
    """Whether images that fit their lights better in another order, or turned, are refused, or taken as stated."""

    @field_validator("lights", mode="before")
    @classmethod
    def _lights_as_list(cls, lights: object) -> object:
        return [name.strip() for name in lights.split(",")] if isinstance(lights, str) else _as_list(lights)
