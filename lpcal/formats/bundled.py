"""The rigs and the data that travel with lpcal: in the wheel under lpcal/, in a clone beside it."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path

from lpcal.errors import InputError
from lpcal.formats.named_files import did_you_mean, nearest
from lpcal.formats.panel_yaml import FILE_NAME, find

DEFAULT_RIG = "lightpanel-6"
START = "start"
"""The folder of folders to start from."""


def folder(name: str) -> Path:
    """``rigs`` or ``calib_data``.

    Raises
    ------
    InputError
        It is not there: the installation is not whole.
    """
    package = Path(str(files("lpcal")))
    for place in (package / name, package.parent / name):
        if place.is_dir():
            return place
    raise InputError(f"lpcal's own folder {name} is not there", where=str(package), needed=name, todo="install lpcal again")


def rig_names() -> list[str]:
    """The bundled rigs."""
    return sorted(path.parent.name for path in folder("rigs").glob(f"*/{FILE_NAME}"))


def start_names() -> list[str]:
    """Folders to start from that are no whole rigs: their images and recordings are the user's to bring."""
    return sorted(path.parent.name for path in (folder("rigs") / START).glob(f"*/{FILE_NAME}"))


def start_file(name: str | None) -> Path:
    """The panel.yaml to start a folder from: as `rig_file`, or one of `start_names`.

    Raises
    ------
    InputError
        As `rig_file`.
    """
    if name in start_names() and not Path(str(name)).exists():
        return folder("rigs") / START / str(name) / FILE_NAME
    return rig_file(name)


def rig_file(name: str | None) -> Path:
    """The panel.yaml of a bundled rig's name, of a file, or of a folder; default the paper's panel.

    Raises
    ------
    InputError
        Neither a bundled rig nor a file or folder with a panel.yaml.
    """
    bundled = folder("rigs") / (name or DEFAULT_RIG) / FILE_NAME
    if name is None or (name in rig_names() and not Path(name).exists()):
        return bundled
    if not Path(name).exists():
        raise InputError(
            "no bundled rig, and no file or folder",
            where=name,
            needed=f"one of {', '.join(rig_names())}, or the path of a panel.yaml",
            todo=nearest(name, rig_names(), did_you_mean(Path(name), "correct the name")),
        )
    return find(Path(name))
