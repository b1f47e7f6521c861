"""A rig folder at work: where its files are, and whether what a stage wrote is still true.

A stage's file is up to date when lpcal's version, the inputs with their sha256, and the settings that stand in its provenance are those
that the stage would use now.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from lpcal import __version__
from lpcal.errors import InputError, LpcalError
from lpcal.formats.documents import document_kind, plain, read_document, sha256
from lpcal.formats.named_files import did_you_mean, hidden, image_endings, kind_of_other, resolve_named, spellings
from lpcal.formats.outputs import Kind, refuse_place
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.provenance import Provenance
from lpcal.records.rig import RigFile


@dataclass(frozen=True)
class Workspace:
    """A rig and the folder that its stages write to."""

    rig_file: RigFile

    @property
    def folder(self) -> Path:
        """The rig folder."""
        return self.rig_file.folder

    def calib(self, name: str) -> Path:
        """The path of one of the stages' files."""
        return self.folder / "calib" / name

    def files(self, name: str, key: str) -> list[Path]:
        """The files in the folder that a key of panel.yaml names, in order; the file itself where it names one.

        Raises
        ------
        InputError
            It is not there, or cannot be looked into.
        """
        path = self.path(name, key)
        try:
            return sorted(each for each in path.iterdir() if each.is_file()) if path.is_dir() else [path]
        except OSError as error:
            raise InputError(f"cannot be read: {error.strerror}", where=str(path), needed="a folder that may be read") from error

    def path(self, name: str, key: str) -> Path:
        """The file or folder that a key of panel.yaml names.

        Raises
        ------
        InputError
            It is not there.
        """
        path = resolve_named(self.folder, name)
        if path is None:
            todo = did_you_mean(self.folder / name, "correct the path")
            raise InputError(f"no such file: {name}", where=self.rig_file.where(key), needed="a file or folder", todo=todo)
        return path

    def images(self, patterns: Iterable[str], key: str) -> list[Path]:
        """Images named by patterns or names, in natural order, each once.

        Raises
        ------
        InputError
            A pattern matches nothing.
        """
        found: dict[Path, None] = {}
        for pattern in patterns:
            named = self._named_by(pattern, key)
            matches = [path for path in named if path.suffix.lower() in image_endings() and not hidden(path)]
            if not matches:
                other = kind_of_other(named)
                raise InputError(
                    other or f"no image matches {pattern}",
                    where=self.rig_file.where(key),
                    needed="images",
                    todo="" if other else did_you_mean(self.folder / pattern, "correct the pattern or the folder"),
                )
            found |= dict.fromkeys(sorted(matches, key=natural))
        return list(found)

    def _named_by(self, pattern: str, key: str) -> list[Path]:
        """What a name or a pattern means: the file of that name, the files in the folder of that name, else what the pattern matches."""
        path = resolve_named(self.folder, pattern)
        if path is not None:
            return self.files(pattern, key)
        folder, _, last = pattern.replace("\\", "/").rpartition("/")
        inside = resolve_named(self.folder, folder) if folder else self.folder
        try:
            if inside is not None and inside.is_dir() and not any(sign in folder for sign in "*?"):  # brackets in a folder's name
                return [path for spelled in spellings(last) for path in inside.glob(spelled)]
            anchor = Path(pattern).anchor
            rest = str(Path(pattern).relative_to(anchor))
            return [path for spelled in spellings(rest) for path in Path(anchor or self.folder).glob(spelled)]
        except (OSError, ValueError, NotImplementedError, IndexError) as error:
            raise InputError(f"the pattern {pattern}: {error}", where=self.rig_file.where(key), needed="a pattern of names") from error

    def relative(self, path: Path) -> str:
        """A path as it is written into files: relative to the rig folder where it lies in it."""
        path = path.resolve()
        return path.relative_to(self.folder.resolve()).as_posix() if path.is_relative_to(self.folder.resolve()) else path.as_posix()

    def provenance(self, inputs: Iterable[Path], settings: dict[str, Any]) -> Provenance:
        """What a file is made from, as of now."""
        return Provenance(inputs={self.relative(path): sha256(path) for path in inputs}, options=plain(settings))

    def need(self, section: str) -> Any:
        """A section of panel.yaml that a stage cannot do without.

        Raises
        ------
        InputError
            It is not there; the key is named.
        """
        value = getattr(self.rig_file.rig, section)
        if value is None or value == {}:
            raise InputError(
                f"no section {section}:", where=str(self.rig_file.file), needed=f"{section}:", todo="add it, see the README's rig folder"
            )
        return value


@dataclass(frozen=True)
class Stage:
    """One stage of the chain: what it reads, what it depends on in panel.yaml, what it writes, and how."""

    name: str
    kinds: dict[str, str]
    """The files it writes under calib/, and the kind of each."""
    wanted: Callable[[Workspace], bool]
    """Whether the rig has the sections that it needs."""
    inputs: Callable[[Workspace], list[Path]]
    """The files it reads."""
    settings: Callable[[Workspace], dict[str, Any]]
    """The sections of panel.yaml that it depends on."""
    run: Callable[[Workspace, Progress], Outcome]
    beside: dict[str, Kind] = field(default_factory=dict)
    """Files that it writes under calib/ and that are no documents of lpcal's."""
    look_closer: Callable[[Workspace], None] = lambda _: None
    """What else can be checked about its inputs before anything is computed; raises as the stage itself would."""

    def look(self, workspace: Workspace) -> None:
        """Before anything is computed: the files that panel.yaml names for it are there, and its outputs replace nothing else.

        Raises
        ------
        InputError, DegenerateError, DisagreementError, UsageError
            As `inputs`, `look_closer` and `refuse_places`.
        """
        self.refuse_places(workspace, self.inputs(workspace))
        self.look_closer(workspace)

    def refuse_places(self, workspace: Workspace, inputs: Iterable[Path]) -> None:
        """Refuse to write where something else stands.

        Raises
        ------
        InputError, UsageError
            As `refuse_place`.
        """
        inputs = list(inputs)
        outputs = {name: document_kind(kind) for name, kind in self.kinds.items()} | self.beside
        for name, kind in outputs.items():
            refuse_place(workspace.calib(name), kind, inputs)

    def provenance(self, workspace: Workspace) -> Provenance:
        """What its files are made from, as of now."""
        return workspace.provenance(self.inputs(workspace), self.settings(workspace))

    def up_to_date(self, workspace: Workspace) -> bool:
        """Whether its files are there and made from what there is now."""
        try:
            now = self.provenance(workspace)
            for name, kind in self.kinds.items():
                before = read_document(workspace.calib(name), kind)["provenance"]
                if (before["lpcal_version"], before["inputs"], before["options"]) != (__version__, now.inputs, now.options):
                    return False
        except (LpcalError, OSError, KeyError, TypeError):
            return False
        return all(workspace.calib(name).exists() for name in self.beside)


def within(workspace: Workspace, *paths: Path) -> bool:
    """Whether any of some paths lies in the rig's folder."""
    folder = workspace.folder.resolve()
    return any(path.resolve().is_relative_to(folder) for path in paths)


def natural(path: Path) -> list[tuple[int, int | str]]:
    """A key that sorts image_9 before image_10."""
    return [(0, int(part)) if part.isdigit() else (1, part) for part in re.split(r"(\d+)", path.as_posix()) if part]
