"""A motion-capture format of one's own, added from outside: one line of JSON a sample, x y z in mm and a rotation vector in degrees."""

import json
import tempfile
from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

import lpcal


def read(path: Path, body: str | None) -> lpcal.PoseStream:
    rows = [json.loads(line) for line in path.read_text().splitlines()]
    H_OP = np.tile(np.eye(4), (len(rows), 1, 1))
    H_OP[:, :3, :3] = Rotation.from_rotvec([row["turn"] for row in rows], degrees=True).as_matrix()
    H_OP[:, :3, 3] = np.array([row["mm"] for row in rows]) / 1000
    return lpcal.PoseStream(body or "ours", np.array([row["t"] for row in rows]), H_OP, error_m=np.full(len(rows), np.nan))


lpcal.register_mocap("our lab's", lambda head: head.startswith(b'{"t"'), read)
path = Path(tempfile.mkdtemp()) / "run.jsonl"
path.write_text("\n".join(json.dumps({"t": 0.01 * k, "mm": [k, 0, 1200], "turn": [0, 0.1 * k, 0]}) for k in range(200)))
print(lpcal.read_mocap(path))
