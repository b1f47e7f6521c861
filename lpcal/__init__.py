"""lpcal: calibrates a camera-and-light panel and rebuilds surfaces with it.

The names below are the library: arrays and records in, records out. Arrays are in C order, in metres, radians and seconds; ``H_AB`` (4x4)
takes coordinates in B to coordinates in A: O room, P tracked body, D disc of the panel, C camera (x right, y down, z forward), B board,
L light. A result is a frozen record with its evidence, its covariance and its warnings; errors are those of `lpcal.errors`; progress is a
callback ``progress(what, done, total)``; the log is called ``lpcal``. Nothing is printed, and nothing is imported before it is used.

Read the chain in the file list of ``lpcal/chain``, the frames in README.md.
"""

__version__ = "0.1.0"

TYPE_CHECKING = False  # as `typing` has it, which would be the slowest import here

if TYPE_CHECKING:
    from lpcal import errors as errors
    from lpcal import extend as extend
    from lpcal import methods as methods
    from lpcal import tables as tables
    from lpcal.api.boards import calibrate_camera as calibrate_camera
    from lpcal.api.boards import find_boards as find_boards
    from lpcal.api.boards import locate_boards as locate_boards
    from lpcal.api.comparison import compare_calibrations as compare_calibrations
    from lpcal.api.distance import calibrate_distance_sensor as calibrate_distance_sensor
    from lpcal.api.evaluation import evaluate as evaluate
    from lpcal.api.exchange import export_calibration as export_calibration
    from lpcal.api.exchange import register_format as register_format
    from lpcal.api.files import read_calibration as read_calibration
    from lpcal.api.files import read_camera as read_camera
    from lpcal.api.files import read_capture as read_capture
    from lpcal.api.files import read_mocap as read_mocap
    from lpcal.api.files import read_rig as read_rig
    from lpcal.api.files import read_surface as read_surface
    from lpcal.api.files import write_calibration as write_calibration
    from lpcal.api.files import write_camera as write_camera
    from lpcal.api.files import write_surface as write_surface
    from lpcal.api.fusing import fuse as fuse
    from lpcal.api.fusing import refine_rig as refine_rig
    from lpcal.api.handeye import solve_handeye as solve_handeye
    from lpcal.api.handeye_check import check_handeye as check_handeye
    from lpcal.api.lights import assemble_calibration as assemble_calibration
    from lpcal.api.lights import design_lights as design_lights
    from lpcal.api.lights import light_field as light_field
    from lpcal.api.many import reconstruct_many as reconstruct_many
    from lpcal.api.placement import place as place
    from lpcal.api.simulation import simulate_rig as simulate_rig
    from lpcal.api.spheres import find_sphere as find_sphere
    from lpcal.api.spheres import refine_lights as refine_lights
    from lpcal.api.studies import study as study
    from lpcal.api.surfaces import integrate as integrate
    from lpcal.api.surfaces import mesh as mesh
    from lpcal.api.surfaces import reconstruct as reconstruct
    from lpcal.api.wing_settings import wing_settings as wing_settings
    from lpcal.extend import register_mocap as register_mocap
    from lpcal.formats.exchange import ExchangeFormat as ExchangeFormat
    from lpcal.records.calibration import Calibration as Calibration
    from lpcal.records.calibration import Camera as Camera
    from lpcal.records.calibration import HandEye as HandEye
    from lpcal.records.calibration import Light as Light
    from lpcal.records.calibration import Wing as Wing
    from lpcal.records.distance import DistanceSensor as DistanceSensor
    from lpcal.records.model import ObjectModel as ObjectModel
    from lpcal.records.observations import Board as Board
    from lpcal.records.observations import PoseStream as PoseStream
    from lpcal.records.placement import Placement as Placement
    from lpcal.records.sensor import StatedSensor as StatedSensor
    from lpcal.records.surface import Surface as Surface

_HOME = {
    "api.boards": ("calibrate_camera", "find_boards", "locate_boards"),
    "api.comparison": ("compare_calibrations",),
    "api.distance": ("calibrate_distance_sensor",),
    "api.evaluation": ("evaluate",),
    "api.exchange": ("export_calibration", "register_format"),
    "api.files": (
        "read_calibration",
        "read_camera",
        "read_capture",
        "read_mocap",
        "read_rig",
        "read_surface",
        "write_calibration",
        "write_camera",
        "write_surface",
    ),
    "api.fusing": (
        "fuse",
        "refine_rig",
    ),
    "api.handeye": ("solve_handeye",),
    "api.handeye_check": ("check_handeye",),
    "api.lights": ("assemble_calibration", "design_lights", "light_field"),
    "api.many": ("reconstruct_many",),
    "api.placement": ("place",),
    "api.simulation": ("simulate_rig",),
    "api.spheres": ("find_sphere", "refine_lights"),
    "api.studies": ("study",),
    "api.surfaces": ("integrate", "mesh", "reconstruct"),
    "api.wing_settings": ("wing_settings",),
    "extend": ("register_mocap",),
    "formats.exchange": ("ExchangeFormat",),
    "records.calibration": ("Calibration", "Camera", "HandEye", "Light", "Wing"),
    "records.model": ("ObjectModel",),
    "records.distance": ("DistanceSensor",),
    "records.observations": ("Board", "PoseStream"),
    "records.placement": ("Placement",),
    "records.sensor": ("StatedSensor",),
    "records.surface": ("Surface",),
}
"""The module that each public name is loaded from when it is first used."""

MODULES = ("errors", "extend", "methods", "tables")
"""Modules that are public as a whole."""

__all__ = [*sorted(name for names in _HOME.values() for name in names), *MODULES]  # noqa: PLE0604


def __getattr__(name: str) -> object:
    """Load a public name from its module when it is first used (PEP 562)."""
    from importlib import import_module

    home = next((module for module, names in _HOME.items() if name in names), None)
    if home is not None:
        found = getattr(import_module(f"lpcal.{home}"), name)
    elif name in MODULES:
        found = import_module(f"lpcal.{name}")
    else:
        raise AttributeError(f"module 'lpcal' has no attribute {name!r}")
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    """The public names, whether they were loaded or not."""
    return sorted({*__all__, "__version__"})
