#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A front that moves through a box, and a mesh that is fine where the front is.

    moving_front.py [STEPS]

A sphere grows from a corner of the unit cube. Before each step the mesh gets short edges around it and long ones
elsewhere. A field of the points and one of the tets are carried along, and never set again: so what the table says
of them is what all steps together did. Needs numpy and tetmend.
"""

import sys

import numpy as np
import tetmend

CENTRE = np.array([0.0, 0.0, 0.0])
SPEED, STEPS = 0.15, 6
FINE, COARSE, GROWTH = 0.06, 0.2, 0.4  # wanted lengths: at the front, at most, and by which they grow with the distance


def box(cells):
    """The unit cube: six tets around a diagonal of each cell, one for each order of the axes."""
    n = cells + 1
    number = np.arange(n ** 3).reshape(n, n, n)
    points = np.stack(np.meshgrid(*[np.linspace(0, 1, n)] * 3, indexing="ij"), axis=-1).reshape(-1, 3)
    tets = []
    for order in ((0, 1, 2), (1, 2, 0), (2, 0, 1), (0, 2, 1), (2, 1, 0), (1, 0, 2)):
        at, corners = np.zeros(3, dtype=int), []
        for axis in (None, *order):
            if axis is not None:
                at[axis] += 1
            corners.append(number[at[0]:at[0] + cells, at[1]:at[1] + cells, at[2]:at[2] + cells].ravel())
        is_odd = order in ((0, 2, 1), (2, 1, 0), (1, 0, 2))
        tets.append(np.stack(corners, axis=1)[:, [1, 0, 2, 3] if is_odd else [0, 1, 2, 3]])
    return points, np.concatenate(tets)


def volumes(points, tets):
    corners = points[tets]
    return np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6


def lengths_for(points, radius):
    away = np.abs(np.linalg.norm(points - CENTRE, axis=1) - radius)
    return np.minimum(FINE + GROWTH * away, COARSE)


def field(points):
    """What the points carry. A linear one would come over exactly."""
    return np.sin(np.pi * points[:, 0]) * np.cos(np.pi * points[:, 1])


def main():
    steps = int(sys.argv[1]) if len(sys.argv) > 1 else STEPS
    points, tets = box(6)
    carried, heat = field(points), field(points[tets].mean(axis=1)) ** 2
    total = heat @ volumes(points, tets)
    print("step  radius    tets  in range  error of the field  change of the total")
    for step in range(1, steps + 1):
        radius = SPEED * step
        result = tetmend.adapt(points, tets, size="array:wanted", surface="flat", gradation=0, conserve=["heat"],
                               point_data={"wanted": lengths_for(points, radius), "field": carried}, cell_data={"heat": heat})
        points, tets = result.points, result.tets
        carried, heat = result.point_data["field"], result.cell_data["heat"]
        size = volumes(points, tets)
        at_corners = ((carried - field(points)) ** 2)[tets].mean(axis=1)
        print(f"{step:4}  {radius:6.2f}  {len(tets):6,}  {100 * result.figures['sizes_after']['in_range']:6.1f} %"
              f"  {np.sqrt(at_corners @ size):18.4f}  {heat @ size / total - 1:19.1e}", flush=True)


if __name__ == "__main__":
    main()
