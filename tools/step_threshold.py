"""How many times smaller two parts of a session make the misplacement of the board, with a step and without: the reason for `moved.NEEDED`.

Sessions are drawn with mocap noise of each view's own and noise that wanders from view to view; the table gives the ratio's quantiles.

::

    uv run python tools/step_threshold.py [--sessions 300]
"""

from __future__ import annotations

import argparse

import numpy as np

from lpcal.chain.h_pc_handeye import moved
from lpcal.geometry import se3

H_PC = se3.transform(se3.rotation(np.array([0.3, -0.2, 0.9])), np.array([0.03, -0.05, 0.08]))
H_OB = se3.transform(se3.rotation(np.array([0.1, 2.9, 0.2])), np.array([0.5, 1.0, 0.2]))
NOISE = np.array([6e-4] * 3 + [4e-4] * 3)
"""Standard deviations of a panel pose's turn (rad) and shift (m), as mocap systems have them."""
VIEWS, STEP_AT = 30, 17
STEPS_MM = (0.0, 2.0, 5.0, 20.0)


def ratio(seed: int, wander: float, step_m: float) -> float:
    """The ratio of one drawn session."""
    rng = np.random.default_rng(seed)
    tilt = se3.exp(np.concatenate([rng.normal(0, 0.25, (VIEWS, 3)), rng.normal(0, 0.05, (VIEWS, 3))], axis=1))
    H_CB = tilt @ se3.transform(se3.rotation(np.array([0.1, 0.2, 0.0])), np.array([-0.1, -0.06, 0.5]))
    slow = np.zeros((VIEWS, 6))
    for k in range(1, VIEWS):
        slow[k] = 0.8 * slow[k - 1] + 0.6 * rng.normal(size=6)
    noise = NOISE * (np.sqrt(1 - wander) * rng.normal(size=(VIEWS, 6)) + np.sqrt(wander) * slow)
    H_OP = H_OB @ se3.inv(H_PC @ H_CB) @ se3.exp(noise)
    step = se3.exp(np.array([0, 0, 0, step_m, 0, 0]))
    late = (np.arange(VIEWS) >= STEP_AT)[:, None, None]
    found = moved.find_step(H_OP, np.where(late, H_CB @ step, H_CB), [str(k) for k in range(VIEWS)], needed=0.0)
    return float("nan") if found is None else (found.misplaced_m / found.parted_m) ** 2


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--sessions", type=int, default=100, help="drawn of each kind (default 100)")
    sessions = parser.parse_args().sessions
    print(f"{'step, mm':>9} {'wandering':>10} {'least':>7} {'median':>7} {'99 %':>7} {'most':>7}")
    for step_mm in STEPS_MM:
        for wander in (0.0, 0.6, 0.9):
            found = [ratio(seed, wander, 1e-3 * step_mm) for seed in range(sessions)]
            print(f"{step_mm:9.1f} {wander:10.1f} " + " ".join(f"{value:7.2f}" for value in np.quantile(found, [0, 0.5, 0.99, 1])))


if __name__ == "__main__":
    main()
