"""A queue of many captures on 1 to 200 workers that fail, simulated: what bounds it, and what failures cost.

``python tools/queue_of_captures.py [--captures 10000] [--seconds 12] [--megabytes 40] [--disk 500] [--hand-over 0.01] [--mtbf 24]``

A capture takes `seconds` of one core (log-normal, a third of itself), `megabytes` of reading and writing from one disk that all share,
and `hand-over` seconds of one scheduler. A worker fails after `mtbf` hours on average (exponential), is back after five minutes, and the
capture that it was at goes to the end of the queue; one in a thousand captures kills whatever works on it and is given up after three
tries, as lpcal does. One in a hundred is bad and ends at once.
"""

from __future__ import annotations

import argparse
import heapq
from collections import deque
from dataclasses import dataclass

import numpy as np

WORKERS = (1, 2, 5, 10, 20, 50, 100, 200)
BACK_S, SPREAD, POISONED, BAD, TRIES = 300.0, 0.33, 1e-3, 1e-2, 3


@dataclass(frozen=True)
class Site:
    """What a capture costs, and what the site has."""

    captures: int
    seconds: float
    megabytes: float
    disk_mb_s: float
    hand_over_s: float
    mtbf_s: float


@dataclass(frozen=True)
class Played:
    """How it went."""

    hours: float
    busy_share: float
    """Of the workers' time, what went into captures that were done."""
    lost_share: float
    """Of the workers' time, what failures took."""
    retried: int
    given_up: int
    disk_share: float
    scheduler_share: float


def play(site: Site, workers: int, seed: int = 0) -> Played:
    """Simulate the queue."""
    rng = np.random.default_rng(seed)
    cost = site.seconds * np.exp(SPREAD * rng.normal(size=site.captures) - SPREAD**2 / 2)
    kind = rng.random(site.captures)
    row, tries = deque(range(site.captures)), np.zeros(site.captures, int)
    free = [(0.0, worker) for worker in range(workers)]
    fails_at = rng.exponential(site.mtbf_s, workers)
    disk = scheduler = end = useful = lost = 0.0
    retried = given_up = 0
    while row:
        now, worker = heapq.heappop(free)
        capture = row.popleft()
        scheduler = max(scheduler, now) + site.hand_over_s
        began = scheduler
        disk = max(disk, began) + site.megabytes / site.disk_mb_s
        wanted = 0.05 * site.seconds if kind[capture] < BAD else cost[capture]
        done = max(began + wanted, disk)
        poisoned = kind[capture] > 1 - POISONED
        if poisoned or fails_at[worker] < done:
            stopped = began + wanted / 2 if poisoned else max(fails_at[worker], began)
            tries[capture] += 1
            lost += stopped - began
            if tries[capture] < TRIES:
                row.append(capture)
                retried += 1
            else:
                given_up += 1
            back = stopped + (2.0 if poisoned else BACK_S)
            fails_at[worker] = back + rng.exponential(site.mtbf_s)
            heapq.heappush(free, (back, worker))
            end = max(end, stopped)
            continue
        useful += wanted
        end = max(end, done)
        heapq.heappush(free, (done, worker))
    total = workers * end
    read = site.captures * site.megabytes / site.disk_mb_s / end
    return Played(end / 3600, useful / total, lost / total, retried, given_up, read, site.captures * site.hand_over_s / end)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--captures", type=int, default=10000)
    parser.add_argument("--seconds", type=float, default=12.0, help="of one core a capture")
    parser.add_argument("--megabytes", type=float, default=40.0, help="read and written a capture")
    parser.add_argument("--disk", type=float, default=500.0, help="MB/s that all share")
    parser.add_argument("--hand-over", type=float, default=0.01, help="seconds of the scheduler a capture")
    parser.add_argument("--mtbf", type=float, default=24.0, help="hours between two failures of a worker")
    asked = parser.parse_args()
    site = Site(asked.captures, asked.seconds, asked.megabytes, asked.disk, asked.hand_over, 3600 * asked.mtbf)
    print("workers    hours  captures/day  busy %  lost to failures %  retried  given up  disk %  scheduler %")
    for workers in WORKERS:
        one = play(site, workers)
        a_day = 24 * site.captures / one.hours
        print(
            f"{workers:7d} {one.hours:8.2f} {a_day:13.0f} {100 * one.busy_share:7.1f} {100 * one.lost_share:19.2f} {one.retried:8d} "
            f"{one.given_up:9d} {100 * one.disk_share:7.1f} {100 * one.scheduler_share:12.1f}"
        )


if __name__ == "__main__":
    main()
