"""What `lpcal watch` says beside the images: a capture's reading of the distance sensor, and what the model that stands still lacks."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path

from lpcal.errors import LpcalError
from lpcal.formats.calibration_yaml import read_calibration
from lpcal.formats.model_files import SUMMARY
from lpcal.formats.panel_yaml import read_capture_section
from lpcal.formats.record_documents import known_record_of
from lpcal.records.calibration import Calibration
from lpcal.records.model import Missing
from lpcal.report.model_page import missing_words

BESIDE = 0.1
"""Share of the working distance beyond which a reading is said to be off it: the lights' axes have parted by a tenth of it there."""


@dataclass
class WatchedRoom:
    """The rig's calibration, where there is one, and the newest model of its folder."""

    folder: Path | None
    calibration: Calibration | None = None
    model: list[str] = field(default_factory=list)
    """What it lacks, in lines."""
    seen: tuple[Path, int] | None = None
    """The summary that these lines are of, and its time."""

    @classmethod
    def of(cls, folder: Path | None) -> WatchedRoom:
        """The room of a rig's folder; without a calibration that can be read there is none."""
        path = None if folder is None else folder / "calib" / "calibration.yaml"
        try:
            return cls(folder, read_calibration(path) if path is not None and path.is_file() else None)
        except LpcalError:
            return cls(folder)

    def reading(self, capture: Path) -> tuple[str, bool] | None:
        """What the distance sensor read at a capture, in words, and whether it is well; None where capture.yaml states no distance."""
        try:
            distance_m = read_capture_section(capture / "capture.yaml").distance
        except LpcalError as error:
            return error.found, False
        if distance_m is None:
            return None
        said = f"the distance sensor reads {1e3 * distance_m:.0f} mm"
        known = self.calibration
        if known is None or known.focus_C is None:
            return said, True
        wanted_m = float(known.focus_C[2])
        expected_m = wanted_m if known.distance_sensor is None else known.distance_sensor.reads_m(wanted_m)
        off_m = distance_m - expected_m
        if abs(off_m) <= BESIDE * wanted_m:
            return said, True
        way = "farther" if off_m > 0 else "nearer"
        return f"{said}, {1e3 * abs(off_m):.0f} mm {way} than where the lights meet: move the panel, or it has hit something else", False

    def look_at_models(self) -> bool:
        """Whether the newest model of the folder is another than at the last look; its lines are read then."""
        found = sorted(self.folder.glob(f"*/{SUMMARY}"), key=lambda path: path.stat().st_mtime_ns) if self.folder is not None else []
        for path in reversed(found):
            state = path, path.stat().st_mtime_ns
            if state == self.seen:
                return False
            lines = _lines(path)
            if lines:
                self.seen, self.model = state, lines
                return True
        return False


def _lines(path: Path) -> list[str]:
    """What the model of a summary.json lacks; nothing where it is none of a model."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        missing = known_record_of(Missing, document.get("missing")) if document.get("kind") == "model" else None
        return [] if missing is None else [f"{path.parent.name}: {line}" for line in missing_words(missing, document["frame"])]
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return []
