#!/usr/bin/env python3
"""Peers of benches/delaunay.rs: the same points, triangulated and interpolated by scipy (Qhull).

Usage: delaunay.py INPUTS        prints one JSON line per measurement
       delaunay.py --make INPUTS writes generated points
Inputs: `delaunay_25.f64`, points of the unit square, likewise for 1,000, 10,000 and 100,000; `delaunay_drag.f64` and
`delaunay_random.f64`, query points. Each row is two numbers.
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

POINTS = (25, 1000, 10_000, 100_000)


def make(folder):
    """Uniform random points, and one period of a curve that fills the square, sampled every millisecond."""
    for n in POINTS:
        np.random.default_rng(900 + n).random((n, 2)).astype("<f8").tofile(folder / f"delaunay_{n}.f64")
    t = 1e-3 * np.arange(100_000)
    drag = np.stack([0.5 + 0.45 * np.sin(2 * np.pi * hz * t + phase) for hz, phase in ((0.31, 0), (0.47, 1))], 1)
    drag.astype("<f8").tofile(folder / "delaunay_drag.f64")
    anywhere = 0.01 + 0.98 * np.random.default_rng(950).random((100_000, 2))
    anywhere.astype("<f8").tofile(folder / "delaunay_random.f64")


def said(values):
    inside = values[~np.isnan(values)]
    return f"{100 * len(inside) / len(values):.3f} % inside, mean {inside.mean():.9f}"


def main(folder):
    from scipy.interpolate import LinearNDInterpolator
    from scipy.spatial import Delaunay

    def points(name):
        return np.fromfile(folder / f"delaunay_{name}.f64", "<f8").reshape(-1, 2)

    drag, anywhere = points("drag"), points("random")
    for n in POINTS:
        sites = points(n)
        bench(f"Delaunay of {n} points", "scipy Delaunay (Qhull)", n, "point", lambda: Delaunay(sites),
              lambda built: f"{len(built.simplices)} triangles")
        built = Delaunay(sites)
        between = LinearNDInterpolator(built, np.sin(6 * sites[:, 0]) + np.cos(5 * sites[:, 1]))
        for kind, at in (("along a drag", drag), ("at random", anywhere)):
            case = f"interpolation among {n} points {kind}"
            bench(case, "scipy LinearNDInterpolator", len(at), "value", lambda: between(at), said)
            bench(case, "scipy find_simplex only", len(at), "value", lambda: built.find_simplex(at),
                  lambda found: f"{100 * (found >= 0).mean():.3f} % inside")


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
