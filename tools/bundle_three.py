"""Bundles the parts of three.js that lpcal's pages call into lpcal/report/templates/three.min.js.zlib.

three and esbuild come by npm in these versions, into a folder that is thrown away. Nothing of this runs when lpcal is built, installed or
used: the file it makes is kept in the repository. The licence of three.js (MIT) stands in NOTICE and at the file's head.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

THREE = "0.187.0"
"""Version of three.js: the newest when this was written."""
ESBUILD = "0.28.2"
"""Version of the bundler."""
TARGET = Path(__file__).parents[1] / "lpcal" / "report" / "templates" / "three.min.js.zlib"
PARTS = {
    "three": (
        "BufferAttribute BufferGeometry Color DataTexture DoubleSide FloatType Frustum GLSL3 Group HalfFloatType LinearFilter "
        "LinearMipmapLinearFilter LinearMipmapNearestFilter Matrix4 Mesh MeshBasicMaterial NearestFilter NearestMipmapNearestFilter "
        "OrthographicCamera PerspectiveCamera Quaternion RawShaderMaterial Raycaster RedFormat RedIntegerFormat "
        "RGBAFormat RGFormat Scene Sphere SphereGeometry UnsignedByteType UnsignedShortType Vector2 Vector3 Vector4 "
        "WebGLRenderer"
    ),
    "three/addons/controls/OrbitControls.js": "OrbitControls",
    "three/addons/lines/LineMaterial.js": "LineMaterial",
    "three/addons/lines/LineSegments2.js": "LineSegments2",
    "three/addons/lines/LineSegmentsGeometry.js": "LineSegmentsGeometry",
}
"""What the pages call, by module; the bundler leaves out what none of it needs."""
HEAD = f"/*! three.js {THREE}, MIT License, Copyright 2010-2026 three.js authors; by tools/bundle_three.py, esbuild {ESBUILD} */\n"
"""First line of the file."""
WORDS = "--bundle --minify --format=iife --global-name=THREE --target=es2020 --charset=utf8 --legal-comments=none --outfile=three.js"
"""What the bundler is given."""


def main() -> int:
    npm = shutil.which("npm")
    if npm is None:
        print("npm is not there: it brings three.js and the bundler", file=sys.stderr)
        return 1
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        subprocess.run([npm, "init", "-y"], cwd=home, check=True, stdout=subprocess.DEVNULL)
        subprocess.run([npm, "install", "--silent", f"three@{THREE}", f"esbuild@{ESBUILD}"], cwd=home, check=True)
        parts = [f'export {{ {", ".join(names.split())} }} from "{module}";' for module, names in PARTS.items()]
        (home / "parts.js").write_text("\n".join(parts), encoding="utf-8")
        esbuild = home / "node_modules" / ".bin" / "esbuild"
        subprocess.run([esbuild, "parts.js", *WORDS.split()], cwd=home, check=True, stderr=subprocess.DEVNULL)
        source = HEAD + (home / "three.js").read_text(encoding="utf-8")
        TARGET.write_bytes(zlib.compress(source.encode(), 9))  # as the pages hold it: deflating it takes longer than all else in a page
    print(f"{TARGET.name}: three.js {THREE}, {TARGET.stat().st_size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
