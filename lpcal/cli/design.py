"""``lpcal design``: wing settings for a working distance."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from lpcal.errors import UsageError
from lpcal.records.outcome import Outcome, Progress

if TYPE_CHECKING:
    from lpcal.geometry.wing_design import WingSetting

SPACERS = "0mm,5mm,10mm,15mm,20mm,25mm,30mm,35mm,40mm,50mm,60mm,80mm,100mm"


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument(
        "--distance", required=True, metavar="350mm", help="working distance, from the plane of the joints along the disc axis"
    )
    parser.add_argument("--disc-radius", default="60mm", metavar="L", help="disc axis to rim (default 60mm)")
    parser.add_argument("--joint", default="15mm", metavar="L", help="half a joint (default 15mm)")
    parser.add_argument("--blob", default="30mm", metavar="L", help="end of the spacer to the middle of the blob (default 30mm)")
    parser.add_argument("--spacers", default=SPACERS, metavar="L,L,...", help="lengths that a spacer can have (default 0 to 100 mm)")
    parser.add_argument("--leds", type=int, default=19, choices=(1, 7, 19), help="LEDs lit in a blob (default 19)")
    parser.add_argument("--object", default="100mm", metavar="L", help="side of the object (default 100mm)")
    parser.add_argument("--rig", type=Path, metavar="PANEL", help="panel.yaml or its folder, for its distance sensor: what it meets there")
    parser.add_argument("--slack", default="10mm", metavar="L", help="how far from the distance the axes may meet (default 10mm)")


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """List the settings, one a click."""
    from lpcal.api.wing_settings import wing_settings
    from lpcal.records.quantities import parse

    def length(text: str, name: str) -> float:
        try:
            return parse(text, "length")
        except ValueError as error:
            raise UsageError(str(error), where=f"--{name}", needed="a length with its unit") from error

    distance_m = length(options.distance, "distance")
    if distance_m <= 0:
        raise UsageError(f"--distance {options.distance}", needed="a length over zero")
    found = wing_settings(
        distance_m,
        disc_radius_m=length(options.disc_radius, "disc-radius"),
        joint_m=length(options.joint, "joint"),
        blob_m=length(options.blob, "blob"),
        spacers_m=[length(text, "spacers") for text in options.spacers.split(",")],
        leds=options.leds,
        object_m=length(options.object, "object"),
        slack_m=length(options.slack, "slack"),
    )
    columns = (("g", 5), ("spacers disc, blob", 20), ("meets at", 10), ("light angle", 12), ("away", 8), ("lux", 7), ("evenness", 9))
    head = " ".join(f"{name:>{width}}" for name, width in (*columns, ("turns by", 9), ("sigma", 8)))
    return Outcome(
        [
            f"{options.leds} LEDs a blob, working distance {1e3 * distance_m:.0f} mm, object {options.object}:",
            head,
            *(_line(setting) for setting in found),
            "light angle: from the disc axis, seen from the object; 20 to 30 deg give the least error of the normals",
            *([] if options.rig is None else _sensor_lines(options.rig, distance_m, length(options.object, "object"))),
        ],
        {"settings": [vars(setting) for setting in found]},
        next_command="lpcal new my_rig, and write the spacers and joint_angle into panel.yaml",
    )


def _sensor_lines(panel: Path, distance_m: float, object_m: float) -> list[str]:
    """What the distance sensor of a panel as drawn meets at the working distance, and how it is calibrated.

    Raises
    ------
    InputError
        The panel states no distance sensor.
    """
    from lpcal.errors import InputError
    from lpcal.formats.panel_yaml import find, read_rig
    from lpcal.records.distance import CALIBRATING_POSES, beam_at

    rig_file = read_rig(find(panel))
    section = None if rig_file.rig.panel is None else rig_file.rig.panel.distance_sensor
    if section is None:
        needed = "panel.distance_sensor: {position: [...], direction: [...], noise: 3 mm}"
        raise InputError("no distance sensor", where=rig_file.where("panel"), needed=needed, todo="add it, or leave --rig out")
    reading_m, beside_m = beam_at(section.position, section.direction, distance_m)
    on = "on the object" if beside_m < object_m / 2 else "beside the object: turn the sensor towards the axis"
    return [
        f"distance sensor: reads {1e3 * reading_m:.1f} mm at {1e3 * distance_m:.0f} mm, {1e3 * beside_m:.1f} mm from the axis, {on}",
        f"to calibrate it: {CALIBRATING_POSES}",
    ]


def _line(s: WingSetting) -> str:
    from math import degrees

    spacers = f"{1e3 * s.disc_spacer_m:.0f}, {1e3 * s.blob_spacer_m:.0f} mm"
    cells = (
        f"{degrees(s.joint_angle_rad):5.0f}",
        f"{spacers:>20}",
        f"{1e3 * s.d_object_m:7.0f} mm",
        f"{degrees(s.light_angle_rad):8.1f} deg",
        f"{1e3 * s.light_distance_m:5.0f} mm",
        f"{s.lux:7.0f}",
        f"{100 * s.evenness:7.0f} %",
        f"{degrees(s.turn_rad):5.1f} deg",
        f"{degrees(s.direction_std_rad):4.2f} deg",
    )
    return " ".join(cells)
