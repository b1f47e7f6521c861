"""Compiles lpcal/kernels/*.c when the package is built: hatchling calls it for wheels and for `uv sync` in a clone (docs/kernels.md).

The compiler is zig's, which comes by pip for the build alone; where it is not to be had, the compiler that ``CC`` names, or `cc`. With
neither, the package is built without the library, which is said, and the kernels' twins in numpy do the work. No relaxed arithmetic: no
-ffast-math, no contraction, so that the same source gives the same numbers wherever it is compiled. Without traps, which nothing here asks
for, gcc works on several pixels at a time as zig does, with the same bytes.
"""

from __future__ import annotations

import os
import platform
import runpy
import shlex
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

FLAGS = ("-O3", "-std=c11", "-shared", "-ffp-contract=off", "-fno-math-errno", "-fno-trapping-math", "-Wall", "-Wextra")
LONGEST_S = 180
"""Seconds after which a compiler is given up: zig builds its own run time first, some ten of them on one core."""
TARGETS = {
    ("linux", "x86_64"): ("x86_64-linux-gnu.2.17", "manylinux_2_17_x86_64"),
    ("linux", "aarch64"): ("aarch64-linux-gnu.2.17", "manylinux_2_17_aarch64"),
    ("darwin", "arm64"): ("aarch64-macos.11.0", "macosx_11_0_arm64"),
    ("darwin", "x86_64"): ("x86_64-macos.11.0", "macosx_11_0_x86_64"),
    ("win32", "AMD64"): ("x86_64-windows-gnu", "win_amd64"),
}
"""Target of the compiler and tag of the wheel, by system and machine."""


class KernelsHook(BuildHookInterface[Any]):
    """Builds the library into lpcal/kernels and puts it into the wheel, whose tag then names the system but no version of Python."""

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Compile; in a clone only if that has not been done for these sources."""
        home = runpy.run_path(str(Path(self.root) / "lpcal" / "kernels" / "library.py"))
        library: Path = home["built"]()
        wide: Path | None = home["built"](home["WIDE"]) if platform.machine() in {"x86_64", "AMD64"} else None
        if version == "editable" and library.exists() and (wide is None or wide.exists()):
            return
        target, tag = TARGETS.get((sys.platform, platform.machine()), (None, None))
        plain = f"{sys.platform}_{platform.machine()}".lower()
        zig = [sys.executable, "-m", "ziglang", "cc", *(("-target", target) if target else ())]
        failures: list[str] = []
        for compiler, its_tag in ((zig, tag or plain), ([*shlex.split(os.environ.get("CC") or "cc"), "-fPIC"], plain)):
            if failure := compiled(compiler, home["sources"](), library):
                failures.append(f"{' '.join(compiler[:4])}: {failure}")
                continue
            made = [library]
            if wide is not None and not compiled([*compiler, "-mavx2"], home["sources"](), wide):
                made.append(wide)
            for old in set(library.parent.glob(f"kernels-*{library.suffix}")) - set(made):
                old.unlink(missing_ok=True)
            build_data["artifacts"] += [f"lpcal/kernels/{one.name}" for one in made]
            build_data["pure_python"] = False
            build_data["tag"] = f"py3-none-{its_tag}"
            return
        self.app.display_warning(f"lpcal is built without its compiled kernels; numpy does their work, slower: {'; '.join(failures)}")


def compiled(compiler: list[str], sources: list[Path], library: Path) -> str:
    """Compile the sources to the library; what went wrong, empty where nothing did."""
    with tempfile.TemporaryDirectory(dir=library.parent) as folder:  # beside the library: it is moved into place whole
        made = Path(folder) / library.name
        private = {**os.environ, "ZIG_LOCAL_CACHE_DIR": folder, "ZIG_GLOBAL_CACHE_DIR": folder}  # zig never ends where it cannot write
        libraries = [] if sys.platform == "win32" else ["-lm"]
        words = [*compiler, *FLAGS, "-o", str(made), *(str(path) for path in sources if path.suffix == ".c"), *libraries]
        try:
            run = subprocess.run(words, capture_output=True, text=True, timeout=LONGEST_S, check=False, env=private)
        except (OSError, subprocess.TimeoutExpired) as error:
            return str(error)
        if run.returncode:
            return run.stderr.strip()[-300:]
        made.replace(library)
    return ""
