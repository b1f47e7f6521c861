"""The notebooks run from top to bottom, and what stands in them is what they print."""

from __future__ import annotations

from pathlib import Path

import nbformat
import pytest

NOTEBOOKS = sorted((Path(__file__).resolve().parents[2] / "examples").glob("*.ipynb"))


def printed(book: nbformat.NotebookNode) -> list[str]:
    """The texts that the code of a notebook has put out, objects' addresses and times apart."""
    outputs = [one for cell in book.cells for one in cell.get("outputs", [])]
    return [one.get("text") or one.get("data", {}).get("text/plain", "") for one in outputs if one.output_type != "error"]


def test_there_are_notebooks() -> None:
    assert len(NOTEBOOKS) >= 2


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_small_and_was_run(path: Path) -> None:
    assert path.stat().st_size < 200_000
    book = nbformat.read(path, as_version=4)
    assert all(cell.execution_count for cell in book.cells if cell.cell_type == "code")
    assert "error" not in {one.output_type for cell in book.cells for one in cell.get("outputs", [])}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")  # jupyter's own
@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_runs(path: Path) -> None:
    from nbclient import NotebookClient

    book = nbformat.read(path, as_version=4)
    before = printed(book)
    NotebookClient(book, timeout=300, kernel_name="python3").execute()
    assert [text.split("\n")[0] for text in printed(book)] == [text.split("\n")[0] for text in before]
