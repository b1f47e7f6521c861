"""The linter of frame letters: every planted mistake is found, good code raises no alarm, lpcal is clean."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import frame_letters

REPOSITORY = Path(__file__).resolve().parents[2]

MISTAKES = {
    "chain": ("H_AC = H_AB @ H_CB", "H_AB @ H_B?"),
    "the same twice": ("H = H_AB @ H_AB", "H_AB @ H_B?"),
    "assigned name": ("H_CA = H_AB @ H_BC", "H_CA"),
    "inverse": ("H_PC = se3.inv(H_PC)", "found H_CP for H_PC, expected H_PC"),
    "inverse in a chain": ("H_CL = se3.inv(H_OP @ H_PC) @ H_PL", "H_CO @ H_PL"),
    "numpy's inverse": ("H_BA = np.linalg.inv(H_BA)", "H_AB for H_BA"),
    "points": ("x_C = se3.apply(H_CB, x_P)", "H_CB @ x_P"),
    "points' name": ("x_B = se3.apply(H_CB, x_B)", "x_C for x_B"),
    "directions": ("axis_C = se3.rotate(H_CL, axis_D)", "H_CL @ x_D"),
    "directions' name": ("axis_D = se3.rotate(H_CL, axis_L)", "x_C for axis_D"),
    "index": ("H_OB = H_OP[k] @ H_PC @ H_BC[k]", "H_OC @ H_BC"),
    "attribute": ("H_PL = hand.H_PC @ wings.H_DL", "H_PC @ H_DL"),
    "attribute assigned": ("self.H_PL = self.H_PD @ self.H_CL", "H_PD @ H_CL"),
    "suffix": ("error = se3.log(H_PC_true @ H_PC_found)", "H_PC @ H_C?"),
    "one of many": ("H_CB_k = H_BC_all[k]", "H_BC for H_CB_k"),
    "transpose": ("H_BA = H_AB.T", "transpose of H_AB"),
    "transpose by swapaxes": ("H = np.swapaxes(H_AB, -1, -2)", "transpose of H_AB"),
    "rotation": ("v_C = R_CB @ v_P", "R_CB @ x_P"),
    "rotation part": ("v_P = H_CP[..., :3, :3] @ v_P", "x_C for v_P"),
    "row vectors": ("v_A = v_B @ R_AB", "x_B @ R_AB"),
    "rotation's transpose": ("v_A = R_BA.T @ v_A", "R_AB @ x_A"),
    "origin": ("centre_B = H_CB[:3, 3]", "x_C for centre_B"),
    "axis column": ("axis_L = H_CL[..., :3, 2]", "x_C for axis_L"),
    "origin set": ("H_CL[:3, 3] = source_D", "x_D for H_CL[:3, 3]"),
    "sum": ("to_light_C = source_C - x_D", "x_C and x_D"),
    "augmented": ("x_C += shift_D", "x_C and x_D"),
    "scaled": ("x_C = depth * ray_D", "x_D for x_C"),
    "cross": ("n_C = np.cross(a_C, b_D)", "x_C and x_D"),
    "dot": ("cosine = n_C @ axis_L", "x_C @ x_L|x_C and x_L"),
    "translation": ("H_AB = se3.transform(R_AB, t_B)", "a translation in A"),
    "keyword": ("hand = HandEye(H_PC=H_CP, H_OB=H_OB)", "H_CP for H_PC"),
    "document": ("H_PC = document['H_CP']", "H_CP for H_PC"),
    "key": ("document = {'H_PC': se3.inv(H_PC)}", "H_CP for H_PC"),
    "loop": ("for H_CB, H_OP in zip(H_all_BC, H_BC_all, strict=True): pass", "H_BC for H_OP"),
    "comprehension": ("H_CB = np.stack([se3.inv(H_CB_k) for H_CB_k in H_CB_all])", "H_BC for H_CB"),
    "walrus": ("print(H_AB := se3.inv(H_AB))", "H_BA for H_AB"),
    "tuple": ("H_PC, H_OB = H_CP, H_OB_start", "H_CP for H_PC"),
    "inside a call": ("norm(H_AB @ H_AB)", "H_AB @ H_B?"),
    "conditional": ("H_PC = H_CP_a if near else H_CP_b", "H_CP for H_PC"),
    "argument": ("def pixels(x_C, K): return K\nuv = pixels(x_B, K)", "x_B for x_C"),
    "method's argument": ("class M:\n    def see(self, H_CB): return 1\nm.see(H_BC)", "H_BC for H_CB"),
    "record": ("@dataclass(frozen=True)\nclass Pose:\n    t_s: Array\n    H_OP: Array\npose = Pose(t_s, H_PO)", "H_PO for H_OP"),
    "unlettered points": ("x_B = se3.apply(H_CB, outline)", "x_C for x_B"),
    "returned": ("def points_B(H_CB, x_B):\n    return se3.apply(H_CB, x_B)", "x_C for points_B"),
    "rotation for transform": ("H_AB = H_AB_old[:3, :3]", "R_AB for H_AB"),
}

GOOD = """
H_OB = H_OP[k] @ H_PC @ H_CB[k]
H_CL = se3.inv(H_OP @ H_PC) @ H_OL
H_CL = se3.inv(hand.H_PC) @ self.H_PD @ wings.H_DL
H_BC_k = se3.inv(boards.H_CB[k])
H_PP = se3.inv(H_OP[1:]) @ H_OP[:-1]
x_C = se3.apply(H_CB, board.points_B())
axis_C = se3.rotate(H_CL, np.array([0.0, 0.0, 1.0]))
x_A = x_B @ np.swapaxes(H_AB[..., :3, :3], -1, -2) + H_AB[..., None, :3, 3]
x_A = (R_AB @ x_B.T).T + t_A
R_BA = np.swapaxes(H_AB[..., :3, :3], -1, -2)
H_BA = se3.transform(R_BA, -(R_BA @ H_AB[..., :3, 3:])[..., 0])
source_C, axis_C = H_CL[..., :3, 3], H_CL[..., :3, 2]
d_C = (source_C - x_C) / np.linalg.norm(source_C - x_C)
H_new = se3.exp(xi) @ H_PC
H_PC = se3.exp(xi) @ H_PC
H_OP_there = se3.interpolate(stream.H_OP, stream.t_s, t_s)
H_PC_covariance = J @ H_CB_covariance @ J.T
H_PC_covariance = se3.adjoint(H_PC) @ covariance @ se3.adjoint(H_PC).T
source_of_H_CD = "the hand-eye"
names = [light.name for light in lights]
total = sum(n_C * d_C)
K_L, W_D = 3.0, 4.0
t_camera_s = t_mocap_s + offset_s
for H_OP_k, H_CB_k in zip(H_OP, H_CB, strict=True):
    H_OB_k = H_OP_k @ H_PC @ H_CB_k
for i, H_CB_k in enumerate(H_CB):
    pass
def anywhere(H_AB, x_B):
    return se3.apply(H_AB, x_B)
y = anywhere(H_OP, x_P)
def project(x_C): return x_C
class Camera:
    def project(self, x_B): return x_B
Camera().project(x_D)
se3.inv(H_AB=H_CB)
hand = HandEye(H_PC=H_PC, H_OB=document["H_OB"])
"""


@pytest.mark.parametrize(("source", "told"), MISTAKES.values(), ids=MISTAKES)
def test_a_planted_mistake_is_found_once(source: str, told: str) -> None:
    mistakes = frame_letters.check({"planted.py": source})
    assert len(mistakes) == 1, mistakes
    assert any(words in mistakes[0] for words in told.split("|")), mistakes
    assert mistakes[0].startswith(f"planted.py:{source.count(chr(10)) + 1}: found ")


def test_good_code_raises_no_alarm() -> None:
    assert frame_letters.check({"good.py": GOOD}) == []


def test_arguments_are_held_across_files() -> None:
    mistakes = frame_letters.check({"a.py": "def pixels(x_C, K): return K", "b.py": "\nuv = pixels(x_O, K)"})
    assert mistakes == ["b.py:2: found x_O for x_C, expected x_C"]


def test_lpcal_is_clean_and_a_mistake_ends_with_1(tmp_path: Path) -> None:
    tool = [sys.executable, str(REPOSITORY / "tools" / "frame_letters.py")]
    clean = subprocess.run([*tool, "lpcal"], cwd=REPOSITORY, capture_output=True, text=True, check=False)
    assert (clean.returncode, clean.stderr) == (0, ""), clean.stdout
    planted = tmp_path / "planted.py"
    planted.write_text("H_AC = H_AB @ H_DC\n")
    found = subprocess.run([*tool, planted], capture_output=True, text=True, check=False)
    assert found.returncode == 1
    assert found.stdout.startswith(f"{planted}:1: found H_AB @ H_DC")
    assert subprocess.run([*tool, tmp_path / "nothing"], capture_output=True, text=True, check=False).returncode != 0
