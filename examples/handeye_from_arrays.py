"""Hand-eye from arrays: poses of a robot's flange and of a board before its camera, to the camera on the flange with its sigma."""

import numpy as np
from scipy.spatial.transform import Rotation

import lpcal

# Your own arrays: H_OP (N, 4, 4) flange in room, H_CB (N, 4, 4) board in camera, metres. These are a simulated robot's, with noise.
session = lpcal.simulate_rig(lpcal.read_rig("robot-camera"), seed=3)
truth = session.board_truth()
rng = np.random.default_rng(0)
H_OP, H_CB = truth.H_OP.copy(), truth.H_CB.copy()
for H, sigma_m, sigma_deg in ((H_OP, 0.0001, 0.02), (H_CB, 0.0003, 0.05)):
    H[:, :3, 3] += sigma_m * rng.standard_normal((len(H), 3))
    H[:, :3, :3] = Rotation.from_rotvec(sigma_deg * rng.standard_normal((len(H), 3)), degrees=True).as_matrix() @ H[:, :3, :3]

found = lpcal.solve_handeye(H_OP, H_CB)
print(found)
off_mm = 1e3 * np.linalg.norm(found.H_PC[:3, 3] - session.H_PC[:3, 3])
print(f"the camera is {off_mm:.3f} mm from the truth")
