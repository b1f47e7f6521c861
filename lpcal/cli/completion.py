"""``lpcal completion``: what a shell reads to complete commands, options and file names."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

from lpcal.records.outcome import Outcome, Progress

WHERE = {
    "bash": "lpcal completion bash > ~/.local/share/bash-completion/completions/lpcal",
    "zsh": "lpcal completion zsh > ~/.zfunc/_lpcal   # with fpath+=~/.zfunc before compinit in ~/.zshrc",
    "fish": "lpcal completion fish > ~/.config/fish/completions/lpcal.fish",
}
"""By shell, the line that installs it."""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Declare the command's words."""
    parser.add_argument("shell", choices=tuple(WHERE), help="whose completion is printed")
    parser.epilog = "; ".join(WHERE.values())


def run(options: argparse.Namespace, progress: Progress) -> Outcome:  # noqa: ARG001
    """Print it."""
    script = script_of(options.shell)
    return Outcome([script], {"shell": options.shell, "script": script, "install": WHERE[options.shell]})


def script_of(shell: str) -> str:
    """The completion of every command, for a shell."""
    import shtab

    from lpcal.cli.main import COMMANDS, parser_of

    parser, _ = parser_of(COMMANDS)
    for action in _actions(parser):
        if action.type is Path:
            action.complete = shtab.FILE  # type: ignore[attr-defined]
    return shtab.complete(parser, shell=shell, root_prefix="lpcal")


def _actions(parser: argparse.ArgumentParser) -> Iterator[argparse.Action]:
    """Every word of a parser and of its commands."""
    for action in parser._actions:  # noqa: SLF001 - argparse has no public list of them
        yield action
        if isinstance(action, argparse._SubParsersAction):  # noqa: SLF001
            for command in action.choices.values():
                yield from _actions(command)
