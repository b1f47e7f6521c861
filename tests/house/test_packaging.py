"""The recipes for packagers ask for what the package itself asks for."""

from __future__ import annotations

import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
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


def test_conda_forges_builder_reads_the_recipe() -> None:
    """rattler-build, which builds conda-forge's packages, knows every key and renders it; building needs its channel."""
    builder = pytest.importorskip("rattler_build", reason="uv run --group packagers")
    text = (REPOSITORY / "packaging" / "conda-recipe.yaml").read_text(encoding="utf-8")
    (found,) = builder.Stage0Recipe.from_yaml(text).render(builder.VariantConfig())
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    assert found.recipe.package.name == project["name"]
    assert str(found.recipe.package.version) == project["version"]
    assert len(found.recipe.requirements.run) == len(project["dependencies"]) + 1
    with pytest.raises(builder.RecipeParseError):
        builder.Stage0Recipe.from_yaml(text.replace("requirements:", "requirement:"))


def test_a_linter_of_container_files_finds_nothing() -> None:
    """hadolint parses the container file and its shell lines; building it needs a registry of images."""
    linter = shutil.which("hadolint", path=str(Path(sys.executable).parent))
    if linter is None:
        pytest.skip("hadolint is not there: uv run --group packagers")
    file = REPOSITORY / "packaging" / "Containerfile"
    found = subprocess.run([linter, str(file)], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stdout) == (0, "")
    wrong = file.read_text(encoding="utf-8").replace("RUN uv build", "RUM uv build")
    assert subprocess.run([linter, "-"], input=wrong, capture_output=True, text=True, check=False).returncode == 1


def test_the_container_copies_what_the_wheel_is_built_from_and_runs_the_command() -> None:
    """Stage by stage: the wheel built in the first is what the second installs, and its entry point is the project's."""
    project = tomllib.loads((REPOSITORY / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    lines = (REPOSITORY / "packaging" / "Containerfile").read_text(encoding="utf-8").splitlines()
    said = [line.split(maxsplit=1) for line in lines if line and line[0].isupper()]
    first = next(rest.rpartition(" ")[2] for word, rest in said if word == "FROM")
    copied = [rest.split() for word, rest in said if word == "COPY" and rest.startswith("--from=")]
    assert [(one[0], one[1]) for one in copied] == [(f"--from={first}", "/wheels")]
    assert any("--out-dir /wheels" in rest for word, rest in said if word == "RUN")
    entry = next(rest for word, rest in said if word == "ENTRYPOINT")
    assert entry.strip('[]"') in project["scripts"]
