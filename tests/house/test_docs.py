"""The documentation: every public name has its place in the reference, every example its place in a page, and the site builds strictly."""

from __future__ import annotations

import ast
import itertools
import re
import shutil
import subprocess
import sys
import textwrap
from importlib.util import find_spec
from pathlib import Path

import pytest

import lpcal

REPOSITORY = Path(__file__).resolve().parents[2]
DOCS = REPOSITORY / "docs"
PAGES = sorted(DOCS.rglob("*.md"))


def test_every_public_name_is_in_the_reference() -> None:
    shown = {name for page in PAGES for name in re.findall(r"^::: (\S+)$", page.read_text(encoding="utf-8"), re.MULTILINE)}
    public = {getattr(lpcal, name) for name in lpcal.__all__ if name not in lpcal.MODULES}
    assert {f"{one.__module__}.{one.__qualname__}" for one in public} <= shown
    index = (DOCS / "reference/index.md").read_text(encoding="utf-8")
    assert [
        name for name in lpcal.__all__ if not name.startswith("write_") and name not in lpcal.MODULES and f"`{name}`" not in index
    ] == []


def test_every_example_is_on_a_page() -> None:
    text = "".join(page.read_text(encoding="utf-8") for page in PAGES)
    assert [path.name for path in (REPOSITORY / "examples").glob("*.py") if f'"examples/{path.name}"' not in text] == []


def test_every_page_is_in_the_table_of_contents() -> None:
    contents = (REPOSITORY / "mkdocs.yml").read_text(encoding="utf-8")
    assert [page for page in PAGES if f"- {page.relative_to(DOCS).as_posix()}\n" not in contents] == []


def test_errors_and_their_codes_are_those_of_the_code() -> None:
    page = (DOCS / "errors.md").read_text(encoding="utf-8")
    rows = {name: int(code) for name, code in re.findall(r"^\| `(\w+)` \| (\d) \|", page, re.MULTILINE)}
    assert rows == {kind.__name__: kind.exit_code for kind in lpcal.errors.LpcalError.__subclasses__()}


def test_messages_on_the_page_are_those_of_the_code() -> None:
    page = (DOCS / "errors.md").read_text(encoding="utf-8")
    fragments = re.findall(r"^\| `([^`]+)` \| [^|\d]", page, re.MULTILINE)
    source = "".join(path.read_text(encoding="utf-8") for path in (REPOSITORY / "lpcal").rglob("*.py"))
    assert len(fragments) > 20
    assert [one for one in fragments if one not in source] == []


def test_tests_on_the_page_are_there() -> None:
    named = re.findall(r"`(test_\w+)`", (DOCS / "uncertainty.md").read_text(encoding="utf-8"))
    source = "".join(path.read_text(encoding="utf-8") for path in (REPOSITORY / "tests").rglob("test_*.py"))
    assert len(named) > 10
    assert [one for one in named if f"def {one}(" not in source] == []


SHOWN = ["CameraEvidence", "ProjectionUncertainty", "HandEyeEvidence", "LightsEvidence", "SurfaceFigures"]
"""Records whose fields the page of files shows as keys."""


def test_every_key_that_the_page_shows_is_described() -> None:
    bare = []
    for module in ("evidence", "figures"):
        tree = ast.parse((REPOSITORY / "lpcal" / "records" / f"{module}.py").read_text(encoding="utf-8"))
        for record in (one for one in tree.body if isinstance(one, ast.ClassDef) and one.name in SHOWN):
            for field, after in itertools.pairwise([*record.body, ast.Pass()]):
                if isinstance(field, ast.AnnAssign) and not (isinstance(after, ast.Expr) and isinstance(after.value, ast.Constant)):
                    bare.append(f"{record.name}.{ast.unparse(field.target)}")
    assert bare == []


def test_the_page_of_the_stages_records_is_that_of_the_records() -> None:
    """Every field of every record that a stage returns has its words, and the page is as the tool writes it."""
    import make_records_page

    records = make_records_page.stage_records()
    assert sum(len(own) for own in records.values()) > 50
    bare = [
        f"{one.__name__}.{name}"
        for own in records.values()
        for one in own
        for name, said in make_records_page.described(one).items()
        if not said
    ]
    assert bare == []
    assert make_records_page.PAGE.read_text(encoding="utf-8") == make_records_page.page(), "uv run python tools/make_records_page.py"


FILES = re.compile(r"(?<![\w/.-])((?:tools|examples|tests|packaging|docs|rigs)/[\w./-]+\.(?:py|md|yaml|csv|ipynb|sbatch|txt))\b")
"""A file of the repository as a page names it."""


def test_files_that_a_page_names_are_there() -> None:
    texts = {path: path.read_text(encoding="utf-8") for path in [*PAGES, REPOSITORY / "README.md", REPOSITORY / "CONTRIBUTING.md"]}
    named = {(path.name, name) for path, text in texts.items() for name in FILES.findall(text)}
    assert len(named) > 20
    assert [one for one in sorted(named) if not (REPOSITORY / one[1]).is_file()] == []


@pytest.mark.slow
def test_the_site_builds_strictly(tmp_path: Path) -> None:
    if find_spec("mkdocs") is None:
        pytest.skip("mkdocs is not installed: uv sync --group docs")
    words = [sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(tmp_path)]
    found = subprocess.run(words, cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stderr
    page = (tmp_path / "reference/handeye/index.html").read_text(encoding="utf-8")
    assert "solve_handeye" in page
    assert "seconds on the mocap" in page.lower()


def test_a_lobe_of_ones_own_is_what_the_page_says(capsys: pytest.CaptureFixture[str]) -> None:
    from lpcal.geometry.light_field import FORMULAS

    page = (DOCS / "add-your-own.md").read_text(encoding="utf-8")
    (code,) = re.findall(r"^```python\n(.*?)^```", page, re.MULTILINE | re.DOTALL)
    try:
        exec(compile(code, "add-your-own.md", "exec"), {})
    finally:
        for kind in ("gaussian", "flat-top"):
            FORMULAS.pop(kind, None)
    (said,) = re.findall(r"# (\[.*\])$", code, re.MULTILINE)
    assert capsys.readouterr().out.split() == said.split()


TRIED = """
import lpcal
from lpcal.report.page import render
from lpcal.report.rig_report import RigReport

session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), image_size=(320, 200), stations=6)
views = lpcal.find_boards(list(session.board_images()), session.board)
solution = lpcal.calibrate_camera(views, session.board, (320, 200), model="opencv4", solver="opencv")
page = render(RigReport("tried", camera=solution))
print(lpcal.__file__, solution.evidence.corners_used, ">corners used<" in page, "Corners by view" in page, "corners of each view" in page)
"""


def test_a_figure_of_ones_own_gets_into_the_report_as_the_page_says(tmp_path: Path) -> None:
    """The page's own pieces, put into a copy of the package at the places that it names, give a row and a chart."""
    page = (DOCS / "add-your-own.md").read_text(encoding="utf-8")
    section = page[page.index("## A figure in the report") :]
    blocks = [textwrap.dedent(one) for one in re.findall(r"^    ```(?:python|text)\n(.*?)^    ```", section, re.MULTILINE | re.DOTALL)]
    field, stage, row, part, value, function, line = blocks
    copy = tmp_path / "lpcal"
    shutil.copytree(REPOSITORY / "lpcal", copy, ignore=shutil.ignore_patterns("__pycache__"))
    for folder in ("rigs", "calib_data"):
        (tmp_path / folder).symlink_to(REPOSITORY / folder)

    def put(name: str, at: str, piece: str, *, instead: bool = False, after: int = 0) -> None:
        path = copy / name
        before, mark, rest = path.read_text(encoding="utf-8").partition(at)
        assert mark, f"{name} has no line {at!r}"
        skipped = rest.split("\n", after)
        path.write_text(
            before + ("" if instead else mark) + "".join(f"{one}\n" for one in skipped[:-1]) + piece + skipped[-1], encoding="utf-8"
        )

    put("records/evidence.py", "class CameraEvidence:\n", "\n" + textwrap.indent(field, "    "), after=1)
    put(
        "chain/k_camera/findings.py",
        "    figures = CameraEvidence(coverage=_coverage(fit), residual_pattern=left)\n",
        textwrap.indent(stage, "    "),
        instead=True,
    )
    sections = "report/chain_sections.py"
    put(sections, "    if solution is None:\n        return rows\n", textwrap.indent(row, "    "))
    put(sections, "class CameraPart:\n", "\n" + textwrap.indent(part, "    "), after=1)
    put(sections, "    return CameraPart(\n", textwrap.indent(value, "        "))
    put(sections, "def handeye_section(", function + "\n\ndef handeye_section(", instead=True)
    put("report/templates/report.html", "{% if camera.vectors %}", line + "{% if camera.vectors %}", instead=True)
    found = subprocess.run([sys.executable, "-c", TRIED], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert found.returncode == 0, found.stderr
    home, corners, *shown = found.stdout.split()
    assert Path(home).is_relative_to(tmp_path)
    assert int(corners) > 100
    assert shown == ["True", "True", "True"]
