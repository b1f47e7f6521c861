"""Many simulated rigs, a folder a seed, drawn where an engine says; what stands and would come out the same is not drawn again."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from lpcal import __version__
from lpcal.api.engines import Engine, Lost, each
from lpcal.errors import InputError, LpcalError
from lpcal.formats.panel_yaml import read_rig
from lpcal.pipeline.simulate import MADE_FROM, simulate
from lpcal.records.outcome import Outcome, Progress
from lpcal.records.rig import RigFile
from lpcal.simulate.recipe import Recipe


@dataclass(frozen=True)
class RigToDraw:
    """One rig to draw, as it goes to a worker."""

    panel: Path
    folder: Path
    recipe: Recipe
    stops: int
    item: str

    @property
    def made_from(self) -> str:
        """A digest of all that the folder follows from."""
        said = [__version__, self.panel.read_bytes().hex(), repr(self.recipe), str(self.stops), self.item]
        return hashlib.sha256("\n".join(said).encode()).hexdigest()

    @property
    def stands(self) -> bool:
        """Whether the folder is there and follows from the same."""
        try:
            return (self.folder / MADE_FROM).read_text(encoding="utf-8").strip() == self.made_from
        except OSError:
            return False


def draw(drawing: RigToDraw) -> str | LpcalError:
    """Draw a rig: its line; what goes wrong is the result, for a worker raises nothing."""
    try:
        if drawing.stands:
            return f"{drawing.folder}: seed {drawing.recipe.seed} (up to date)"
        rig = read_rig(drawing.panel)
        found = simulate(
            rig, drawing.folder, drawing.recipe, lambda *_: None, stops=drawing.stops, item=drawing.item, made_from=drawing.made_from
        )
    except LpcalError as error:
        return error
    except OSError as error:
        return InputError(error.strerror or str(error), where=str(error.filename or drawing.folder))
    return found.summary[0]


def simulate_many(
    rig_file: RigFile,
    root: Path,
    recipe: Recipe,
    count: int,
    progress: Progress,
    *,
    engine: Engine | None,
    stops: int = 0,
    item: str = "bust",
) -> Outcome:
    """Draw so many rigs into ``root/seed_0001`` and so on; a folder that cannot be written is named and stops no other.

    Raises
    ------
    InputError
        The folder cannot be made.
    """
    try:
        root.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"cannot be made: {error.strerror}", where=str(root), needed="a folder that can be written") from error
    seeds = range(recipe.seed, recipe.seed + count)
    panel, home = rig_file.file.absolute(), root.absolute()
    drawings = [RigToDraw(panel, home / f"seed_{seed:04d}", replace(recipe, seed=seed), stops, item) for seed in seeds]
    done: dict[int, str | LpcalError] = {}
    for number, found in _found(drawings, engine):
        where, todo = str(drawings[number].folder), "the same command again does what is not done yet"
        done[number] = InputError(found.why, where=where, todo=todo) if isinstance(found, Lost) else found
        progress("rigs", len(done), count)
    said = [done[number] for number in range(count)]
    errors = [one for one in said if isinstance(one, LpcalError)]
    lines = [one for one in said if isinstance(one, str)]
    failures = [
        f"{drawing.folder.name} was not drawn: {one}" for drawing, one in zip(drawings, said, strict=True) if isinstance(one, LpcalError)
    ]
    same = sum(line.endswith("(up to date)") for line in lines)
    counted = f"{count} rigs: {len(lines) - same} drawn, {same} up to date, {len(errors)} failed"
    document = {"folder": str(root), "seeds": list(seeds), "rigs": [drawing.folder.name for drawing in drawings], "failed": len(errors)}
    return Outcome(
        [*lines, counted], document, failures, next_command=f"lpcal run {root}", exit_code=next((error.exit_code for error in errors), 0)
    )


def _found(drawings: Sequence[RigToDraw], engine: Engine | None) -> Iterable[tuple[int, str | LpcalError | Lost]]:
    return enumerate(map(draw, drawings)) if engine is None else each(draw, drawings, engine)
