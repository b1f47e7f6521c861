"""The tables of formats in docs/how-to/formats.md: python tools/make_formats_table.py [--write].

What each format keeps and loses is from the formats themselves. What reads each back is `READ_BACK`, with the readers' versions of uv.lock.
"""

from __future__ import annotations

import sys
import tomllib
from dataclasses import dataclass
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parent.parent
PAGE = REPOSITORY / "docs" / "how-to" / "formats.md"
BEGIN, END = "<!-- the table of formats -->", "<!-- its end -->"
BEGIN_READ, END_READ = "<!-- the table of readers -->", "<!-- its end: readers -->"


@dataclass(frozen=True)
class ReadBack:
    """How a test reads a format back."""

    test: str
    """In tests/formats."""
    by: tuple[str, ...]
    """Distributions, by their names in uv.lock; empty where the system's own reader is no package that can be installed."""
    how: str
    """What is compared."""
    within: str
    """How closely it agrees."""
    instead: str = ""
    """Without a reader: what stands for it."""


LAYOUT = "its documented layout"
READ_BACK = {
    "opencv": ReadBack("test_opencv_reads_its_own", ("opencv-python-headless",), "pixels of a grid over the image", "1e-9 px"),
    "ros": ReadBack(
        "test_mrcal_reads_the_ros_camera",
        ("mrcal", "opencv-python-headless"),
        "pixels of a grid; P by image_proc's map",
        "1e-9 px; 1e-3 px (float32)",
    ),
    "kalibr": ReadBack(
        "test_kalibr_has_no_k3_so_the_lens_is_fitted",
        ("opencv-python-headless",),
        "pixels of a grid, by pinhole-radtan's equations",
        "what the export states",
        "its equations",
    ),
    "colmap": ReadBack("test_colmap_counts_pixels_half_a_pixel_on", ("pycolmap",), "pixels of a grid", "1e-9 px"),
    "mrcal": ReadBack("test_mrcal_reads_its_own_and_the_pose", ("mrcal",), "pixels of a grid, the pose", "1e-9 px, 1e-9"),
    "metashape": ReadBack("test_metashape_by_its_own_equations", (), "pixels of a grid", "1e-9 px", "the equations of its manual"),
    "meshroom": ReadBack("test_meshroom_by_its_own_equations", (), "pixels of a grid", "1e-9 px", "AliceVision's equations"),
    "tf": ReadBack("test_ros_takes_the_transform_as_a_message", ("rosbags",), "H_PC, as a message TransformStamped", "1e-9"),
    "urdf": ReadBack("test_urdf_places_camera_and_lights", ("pytransform3d",), "H_PC, every light's frame", "1e-9"),
    "easy_handeye": ReadBack("test_easy_handeye_as_its_publisher_reads_it", ("pyyaml",), "H_PC", "1e-9", "its publisher's keys"),
    "lp": ReadBack("test_lp_directions_are_those_at_the_working_point", (), "directions", "1e-9", LAYOUT),
    "lp-positions": ReadBack("test_lp_positions_are_millimetres_about_the_working_point", (), "places", "1e-9 mm", LAYOUT),
    "dome": ReadBack("test_relightlabs_dome", (), "places, directions, colours", "1e-9", LAYOUT),
    "diligent": ReadBack("test_diligent_has_the_light_that_arrives", (), "directions, intensities", "1e-9", LAYOUT),
    "luces": ReadBack("test_luces_holds_the_near_lights", (), "places; the field of a light", "1e-9", LAYOUT),
    "near_ps": ReadBack("test_near_ps_is_read_by_scipy_as_by_matlab", ("scipy",), "places, lobes, K; the field of a light", "1e-9"),
    "meshroom-lights": ReadBack("test_meshrooms_lights", (), "directions", "1e-9", "AliceVision's keys"),
    "matlab": ReadBack("test_matlab_holds_all_of_it", ("pymatreader", "scipy"), "camera, H_PC, lights", "1e-9"),
    "rig-glb": ReadBack(
        "test_pygltflib_finds_lights_and_camera_where_they_are",
        ("pygltflib",),
        "places and axes of the lights, H_PC; gltf-validator 2.0.0-dev.3.10 finds nothing",
        "1e-9",
    ),
    "ptm": ReadBack(
        "test_relit_from_directions_that_it_was_not_made_from",
        (),
        "images from directions that it was not made from",
        "see [below](#what-an-rti-is-worth)",
        "PTM 1.2's formula",
    ),
    "hsh": ReadBack(
        "test_relit_from_directions_that_it_was_not_made_from",
        (),
        "the same",
        "see [below](#what-an-rti-is-worth)",
        "the harmonics' formula",
    ),
    "openlime": ReadBack(
        "test_relit_from_directions_that_it_was_not_made_from",
        (),
        "the same",
        "see [below](#what-an-rti-is-worth)",
        "OpenLIME's ShaderRTI (its source), and its equations",
    ),
    "ply": ReadBack("test_trimesh_reads_the_meshes", ("trimesh",), "vertices' bounds, faces", "1e-6 of a unit"),
    "glb": ReadBack(
        "test_trimesh_reads_the_meshes", ("trimesh",), "the same; gltf-validator 2.0.0-dev.3.10 finds nothing", "1e-6 of a unit"
    ),
    "obj": ReadBack("test_the_texture_lies_on_its_pixels", ("trimesh",), "vertices, the texture's pixels", "1e-6 of a unit"),
    "stl": ReadBack("test_numpy_stl_reads_the_stl_in_millimetres", ("numpy-stl",), "bounds", "1e-3 mm"),
    "depth-tiff": ReadBack("test_the_depth_says_its_unit", ("tifffile",), "depth, standard deviation, unit", "float32"),
    "depth-exr": ReadBack("test_openexr_reads_the_depth", ("openexr",), "depth, normals, albedo, unit", "float32"),
    "points": ReadBack("test_plyfile_reads_points_with_their_sigma", ("plyfile",), "points, sigma", "1e-7 m, 1e-9 m"),
    "normals": ReadBack("test_normal_maps_of_both_greens", ("opencv-python-headless",), "normals", "1e-4"),
}
"""Every format of lpcal's own; a test holds this complete, the tests' names and the versions true."""


def table() -> str:
    """The table, in Markdown."""
    from lpcal.formats.exchange import OWN

    rows = ["| `--format` | system and file | read too | keeps | loses |", "|---|---|---|---|---|"]
    rows += [f"| `{one.name}` | {one.title} | {'yes' if one.read else ''} | {one.keeps} | {one.loses} |" for one in OWN]
    return "\n".join(rows)


def readers() -> str:
    """What reads each format back, in Markdown."""
    from lpcal.formats.exchange import OWN

    locked = {one["name"]: one.get("version", "") for one in tomllib.loads((REPOSITORY / "uv.lock").read_text(encoding="utf-8"))["package"]}
    rows = ["| `--format` | read back by | what is compared | agrees to |", "|---|---|---|---|"]
    for one in OWN:
        back = READ_BACK[one.name]
        by = [*([back.instead] if back.instead else []), *(f"{name} {locked[name]}" for name in back.by)]
        rows.append(f"| `{one.name}` | {', '.join(by)} | {back.how} | {back.within} |")
    return "\n".join(rows)


def page(text: str) -> str:
    """The page with the tables as they are now."""
    for begin, end, new in ((BEGIN, END, table()), (BEGIN_READ, END_READ, readers())):
        head, _, rest = text.partition(begin)
        text = f"{head}{begin}\n\n{new}\n\n{end}{rest.partition(end)[2]}"
    return text


if __name__ == "__main__":
    written = page(PAGE.read_text(encoding="utf-8"))
    if "--write" in sys.argv:
        PAGE.write_text(written, encoding="utf-8")
    else:
        print(table())
