r"""Cuts within the pieces of a view, along depth discontinuities and seams of uncertain normals.

A piece hangs together wherever a few pixels do, and where it was cut is where cutting was cheapest: a leg seen before another leg may be
cut straight across, and hang on to the wrong one along the dark seam between the two; a ball may hang on to the column beside it where
their outlines touch. What lies behind such a seam may be tens of millimetres off, though the rest of the piece is right. Each part is
therefore a piece of its own here, placed where the other views confirm it (`piece_distances`).

Pixels at a break or on a seam belong to no core; connected cores of some size are the parts, and grow back to the breaks. A part stays with
the neighbour that it touches most where sure normals run on from one to the other along most of its border, and hardly any of that is
broken: an edge of a body is such a border. Unsure normals tell nothing of the step between two parts: of 96 views of six simulated sessions
three had a part that they alone cut off, and it was off by 3 to 12 % of its distance.
"""

from __future__ import annotations

import numpy as np

from lpcal.geometry import raster
from lpcal.geometry.arrays import Image, Index, Labels, Mask

BRIDGE_PX = 2
"""Pixels beside a break that hold no two parts together: bridges of twice as many pixels between the ends of breaks do not."""
SEAM_DEG = 5.0
"""Standard deviation of a normal from which on its pixel holds no two parts together: sure ones have 1 to 2, seams 5 to 40."""
SHARP = np.cos(np.radians(20.0))
"""Cosine between neighbouring normals below which they lie on two sides of a seam or an edge. Of six simulated sessions 14 % of the knot's
pixels were in parts of which they lay off by more than 1.2 % at 35 degrees, 6 % at 20 and at 16; the others hardly had more parts."""
LEAST_SHARE = 0.01
"""Least share of a view's pixels that a part must have: of smaller ones too few points tell where they lie."""
LEAST_PIXELS = 60
"""Least number of its pixels: some five times the points that a piece must show to be looked for."""
BROKEN_SHARE = 0.1
"""Least share of a part's border with others of its piece that is broken: the ends of breaks fray."""
BROKEN_PX = 4
"""Least number of broken edges of that border."""


def parted(component: Labels, breaks: Mask, normals: Image, std_deg: Image) -> tuple[Labels, dict[int, int]]:
    """Labels (H, W) of parts, and of each the piece it is of: a piece's largest part keeps its label, others count on from the last.

    `component` (H, W), 0 outside; `breaks` (2, H, W) towards the right [0] and below [1]; `normals` (H, W, 3) with `std_deg` (H, W).
    """
    right, below = inner_breaks(component > 0, breaks)
    core = (component > 0) & ~near(right, below, BRIDGE_PX) & ~near(*turns(normals), 1) & (std_deg < SEAM_DEG)
    least = max(LEAST_PIXELS, LEAST_SHARE * float((component > 0).sum()))
    found = np.zeros(component.shape, np.intp)
    of: list[int] = [0]
    for label in (int(label) for label in np.unique(component[component > 0])):
        numbers, _ = raster.connected_components(core & (component == label))
        size = np.bincount(numbers.ravel())
        size[0] = 0
        large = [int(number) for number in np.argsort(-size) if size[number] >= least] or [-1]
        for number in large:
            found[(numbers == number) if number > 0 else (component == label)] = len(of)
            of.append(label)
    found = together(grown(found, component, right, below), np.array(of), right, below, std_deg < SEAM_DEG)
    return numbered(found, np.array(of), component)


def inner_breaks(mask: Mask, breaks: Mask) -> tuple[Mask, Mask]:
    """Breaks (H, W-1) and (H-1, W) between two pixels of a mask."""
    return breaks[0, :, :-1] & mask[:, :-1] & mask[:, 1:], breaks[1, :-1] & mask[:-1] & mask[1:]


def ends_of_parts(component: Labels, breaks: Mask) -> tuple[Mask, Mask]:
    """Breaks (H, W) towards the right and below, those between two parts among them."""
    right, below = breaks[0].copy(), breaks[1].copy()
    right[:, :-1] |= component[:, :-1] != component[:, 1:]
    below[:-1] |= component[:-1] != component[1:]
    return right, below


def turns(normals: Image) -> tuple[Mask, Mask]:
    """Edges (H, W-1) and (H-1, W) at which normals (H, W, 3) turn sharply."""
    right = np.einsum("ijk,ijk->ij", normals[:, :-1], normals[:, 1:])
    below = np.einsum("ijk,ijk->ij", normals[:-1], normals[1:])
    return right < SHARP, below < SHARP


def near(right: Mask, below: Mask, reach_px: int) -> Mask:
    """Pixels (H, W) at a break, or so many less one beside one that is."""
    broken = np.zeros((right.shape[0], below.shape[1]), bool)
    broken[:, :-1] |= right
    broken[:, 1:] |= right
    broken[:-1] |= below
    broken[1:] |= below
    return raster.dilated(broken, reach_px - 1)


def grown(found: Index, component: Labels, right: Mask, below: Mask) -> Index:
    """Parts grown over the rest of their pieces, up to breaks; what no part reaches so goes to the nearest of its piece."""
    found = found.copy()
    joined = ~right & (component[:, :-1] == component[:, 1:]), ~below & (component[:-1] == component[1:])
    changed = True
    while changed:
        before, changed = found.copy(), False
        for first, second, open_edge in ((np.s_[:, :-1], np.s_[:, 1:], joined[0]), (np.s_[:-1], np.s_[1:], joined[1])):
            for target, source in ((first, second), (second, first)):
                take = (found[target] == 0) & (before[source] > 0) & open_edge
                found[target] = np.where(take, before[source], found[target])
                changed |= bool(take.any())
    for label in np.unique(component[(component > 0) & (found == 0)]):
        inside = component == label
        rest = inside & (found == 0)
        found[rest] = found.ravel()[raster.nearest(inside & (found > 0))[rest]]
    return found


def together(found: Index, of: Index, right: Mask, below: Mask, sure: Mask) -> Index:
    """Parts that their borders hold, each with the neighbour of its piece that it touches most; the smallest first."""
    pairs = [
        np.stack([found[:, :-1].ravel(), found[:, 1:].ravel(), right.ravel(), (sure[:, :-1] & sure[:, 1:]).ravel()]),
        np.stack([found[:-1].ravel(), found[1:].ravel(), below.ravel(), (sure[:-1] & sure[1:]).ravel()]),
    ]
    a, b, broken, firm = np.concatenate(pairs, axis=1)
    meets = (a != b) & (a > 0) & (b > 0) & (of[a] == of[b])
    count = int(found.max(initial=0)) + 1
    held, cut, loose = np.zeros((3, count, count), np.intp)
    for total, some in ((held, meets & (broken == 0)), (cut, meets & (broken > 0)), (loose, meets & (broken == 0) & (firm == 0))):
        np.add.at(total, (a[some], b[some]), 1)
        np.add.at(total, (b[some], a[some]), 1)
    size, into = np.bincount(found.ravel(), minlength=count), np.arange(count)
    size[0] = 0
    waiting = [part for part in np.argsort(size) if size[part]]
    while waiting:
        part = waiting.pop(0)
        split, unsure = cut[part].sum(), loose[part].sum()
        border = held[part].sum() + split
        if not held[part].any() or split >= max(BROKEN_PX, BROKEN_SHARE * border) or split + unsure > border / 2:
            continue
        other = int(np.argmax(held[part]))
        into[into == part] = other
        for total in (held, cut, loose):
            total[other] += total[part]
            total[:, other] += total[:, part]
            total[other, other] = total[part] = total[:, part] = 0
        size[other] += size[part]
        waiting = sorted((left for left in waiting if left != part), key=lambda left: size[left])
    return np.asarray(into[found])


def numbered(found: Index, of: Index, component: Labels) -> tuple[Labels, dict[int, int]]:
    """Parts by labels: the largest of a piece has the piece's, others count on from the last."""
    size = np.bincount(found.ravel(), minlength=len(of))
    size[0] = 0
    labels, last, pieces = np.zeros(len(of), component.dtype), int(component.max(initial=0)), {}
    for part in np.argsort(-size):
        if not size[part]:
            break
        label = int(of[part])
        if label in pieces:
            label = last + 1 if last < np.iinfo(component.dtype).max else label
            last = max(last, label)
        labels[part], pieces[label] = label, int(of[part])
    return labels[found], pieces


def stds(pieces: tuple[tuple[int, float], ...], of: dict[int, int]) -> tuple[tuple[int, float], ...]:
    """Label and relative standard deviation of the distance of each part: that of its piece."""
    std = dict(pieces)
    return tuple((part, std[label]) for part, label in sorted(of.items()) if label in std)
