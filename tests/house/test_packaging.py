"""The recipes for packagers ask for what the package itself asks for."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import yaml

REPOSITORY = Path(__file__).resolve().parents[2]
OTHER_NAMES = {"opencv-contrib-python-headless": "opencv", "matplotlib": "matplotlib-base"}
"""What conda-forge calls some of the packages."""


def test_the_conda_recipe_asks_for_what_the_package_does() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    recipe = yaml.safe_load((REPOSITORY / "packaging" / "conda-recipe.yaml").read_text(encoding="utf-8"))
    assert recipe["context"]["version"] == project["version"]
    wanted = {f"python {project['requires-python']}"}
    for one in project["dependencies"]:
        found = re.fullmatch(r"([\w-]+)(>=[\d.]+)", one)
        assert found is not None, one
        wanted.add(f"{OTHER_NAMES.get(found[1], found[1])} {found[2]}")
    assert set(recipe["requirements"]["run"]) == wanted


def test_the_container_has_a_python_that_the_package_runs_on() -> None:
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    text = (REPOSITORY / "packaging" / "Containerfile").read_text(encoding="utf-8")
    least = int(project["requires-python"].removeprefix(">=3."))
    found = [int(minor) for minor in re.findall(r"^FROM \S+python:3\.(\d+)", text, re.MULTILINE)]
    assert len(found) == 2
    assert len(set(found)) == 1
    assert found[0] >= least
