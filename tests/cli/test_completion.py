"""Completion for the shells, and a help that fits a console of 80 columns."""

from __future__ import annotations

import argparse
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

from lpcal.cli.completion import WHERE, script_of
from lpcal.cli.main import COMMANDS, parser_of

CHECK = {"bash": ["bash", "-n"], "zsh": ["zsh", "-n"], "fish": ["fish", "--no-execute"]}
"""What reads a script of each shell without running it."""


@pytest.fixture(scope="module")
def scripts() -> dict[str, str]:
    return {shell: script_of(shell) for shell in WHERE}


@pytest.mark.parametrize("shell", WHERE)
def test_a_script_knows_every_command_and_option(scripts: dict[str, str], shell: str) -> None:
    for word in (*COMMANDS, "integrator", "black-level", "phase-angle"):
        assert word in scripts[shell]


@pytest.mark.parametrize("shell", WHERE)
def test_the_shell_can_read_it(scripts: dict[str, str], shell: str, tmp_path: Path) -> None:
    if shutil.which(shell) is None:
        pytest.skip(f"no {shell} here")
    path = tmp_path / "script"
    path.write_text(scripts[shell], encoding="utf-8")
    found = subprocess.run([*CHECK[shell], str(path)], capture_output=True, text=True, check=False)
    assert (found.returncode, found.stderr) == (0, "")


@pytest.mark.skipif(shutil.which("bash") is None, reason="no bash here")
@pytest.mark.parametrize(("typed", "offered"), [("lpcal rec", "reconstruct"), ("lpcal reconstruct --meth", "--method")])
def test_bash_completes(scripts: dict[str, str], tmp_path: Path, typed: str, offered: str) -> None:
    script = tmp_path / "lpcal"
    words = typed.split()
    script.write_text(
        f"{scripts['bash']}\nCOMP_WORDS=({' '.join(words)})\nCOMP_CWORD={len(words) - 1}\n"
        f"_shtab_lpcal lpcal '{words[-1]}' '{words[-2]}'\necho \"${{COMPREPLY[@]}}\"\n",
        encoding="utf-8",
    )
    found = subprocess.run(["bash", str(script)], capture_output=True, text=True, check=False)
    assert offered in found.stdout.split(), found.stderr


@pytest.mark.skipif(shutil.which("fish") is None, reason="no fish here")
@pytest.mark.parametrize(("typed", "offered"), [("lpcal rec", "reconstruct"), ("lpcal reconstruct --meth", "--method")])
def test_fish_completes(scripts: dict[str, str], tmp_path: Path, typed: str, offered: str) -> None:
    script = tmp_path / "lpcal.fish"
    script.write_text(scripts["fish"], encoding="utf-8")
    found = subprocess.run(
        ["fish", "--no-config", "-c", f"source {script}; complete -C '{typed}'"], capture_output=True, text=True, check=False
    )
    assert offered in [line.split("\t")[0] for line in found.stdout.splitlines()], found.stderr


ZSH = """\
zmodload zsh/zpty
zpty shell zsh -f -i
zpty -w shell 'fpath=(FOLDER $fpath); autoload -Uz compinit; compinit -D -u; bindkey "^I" complete-word; print ready'
for round in {1..200}; do zpty -r -t shell line && shown+=$line; [[ $shown == *$'\\n'ready* ]] && break; sleep .1; done
zpty -wn shell 'TYPED	'
for round in {1..100}; do zpty -r -t shell line && shown+=$line; [[ $shown == *"OFFERED"* ]] && print completed && exit; sleep .1; done
print -r -- $shown
"""
"""An interactive zsh that finds the script in its fpath, as installed, and to which a Tab is typed."""


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("zsh") is None, reason="no zsh here")
@pytest.mark.parametrize(("typed", "offered"), [("lpcal rec", "lpcal reconstruct"), ("lpcal reconstruct --meth", "--method")])
def test_zsh_completes(scripts: dict[str, str], tmp_path: Path, typed: str, offered: str) -> None:
    (tmp_path / "_lpcal").write_text(scripts["zsh"], encoding="utf-8")
    program = ZSH.replace("FOLDER", str(tmp_path)).replace("TYPED", typed).replace("OFFERED", offered)
    found = subprocess.run(["zsh", "-f", "-c", program], capture_output=True, text=True, check=False, timeout=120)
    assert found.stdout.strip() == "completed", found.stdout + found.stderr


@pytest.mark.parametrize("shell", WHERE)
def test_the_command_prints_it(lpcal: Any, shell: str, scripts: dict[str, str]) -> None:
    code, out, _ = lpcal("completion", shell)
    assert code == 0
    assert out.strip() == scripts[shell].strip()


def test_every_help_fits_80_columns(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "80")
    parser, modules = parser_of(COMMANDS)
    assert set(modules) == set(COMMANDS)
    commands = next(one for one in parser._actions if isinstance(one, argparse._SubParsersAction)).choices
    wide = {
        f"lpcal {name}: {line}"
        for name, one in {"": parser, **commands}.items()
        for line in one.format_help().splitlines()
        if len(line) > 80
    }
    assert not wide
