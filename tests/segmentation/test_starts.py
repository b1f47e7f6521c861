"""Planes are searched from several starts where they are many, and another is taken only where its layers cost clearly less."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from lpcal.segmentation import flats, layers, mask


@pytest.mark.parametrize(
    ("energies", "planes", "taken"),
    [([10.0, 9.0, 8.5], 7, 0), ([10.0, 5.0, 9.0], 7, 1), ([10.0, 7.0, 6.0], 7, 1), ([-3.0, -4.0, -2.0], 7, 1), ([10.0, 1.0, 1.0], 2, 0)],
    ids=["ties leave the first", "a clear winner", "the first of two winners", "below nought", "few planes are searched once"],
)
def test_another_start_is_taken_where_it_costs_clearly_less(
    energies: list[float], planes: int, taken: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    image = SimpleNamespace(signal=np.ones((4, 6)), sigma=np.full((4, 6), 0.1))
    seen: list[float] = []

    def find(given: Any, *_: Any) -> list[Any]:
        seen.append(float(given.signal.sum()))
        return []

    def label(*_: Any) -> tuple[Any, Any, Any]:
        return len(seen) - 1, SimpleNamespace(planes=[None] * planes), None

    monkeypatch.setattr(flats, "find", find)
    monkeypatch.setattr(layers, "label", label)
    monkeypatch.setattr(layers, "energy", lambda _view, number, _cost: energies[number])
    monkeypatch.setattr(mask, "replace", lambda one, signal: SimpleNamespace(signal=signal, sigma=one.sigma))
    monkeypatch.setattr(mask.bands, "shared", lambda work, items: [work(one) for one in items])
    view: Any = SimpleNamespace(image=image, table=None, swept=None)
    found = mask._labelled(view, np.ones(6, bool), 0.4)
    assert found[0] == taken
    assert len(set(seen)) == (mask.STARTS if planes >= mask.MANY_PLANES else 1)
