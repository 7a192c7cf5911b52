#!/usr/bin/env python3
"""Peers of benches/mds.rs: the same items from the same start, by SMACOF of scikit-learn.

Usage: mds.py INPUTS        prints one JSON line per measurement
       mds.py --make INPUTS writes generated dissimilarities
Inputs, for 25, 100 and 500 items: `nmds_25.f32`, dissimilarities row by row above the diagonal, and
`nmds_init_25.f32`, the points of classical scaling in two dimensions.
"""
import sys
import warnings
from pathlib import Path

import numpy as np

from measure import bench

ITEMS = (25, 100, 500)


def make(folder):
    """Distances in four dimensions, two of them dominant, with a power transform and log-normal noise."""
    from scipy.spatial.distance import pdist, squareform

    for n in ITEMS:
        rng = np.random.default_rng(3000 + n)
        d = pdist(rng.standard_normal((n, 4)) * [1, 1, 0.4, 0.3])
        d = d**1.4 * np.exp(0.15 * rng.standard_normal(len(d)))
        centering = np.eye(n) - 1 / n
        values, vectors = np.linalg.eigh(-0.5 * centering @ squareform(d) ** 2 @ centering)
        start = vectors[:, [-1, -2]] * np.sqrt(values[[-1, -2]])
        d.astype("<f4").tofile(folder / f"nmds_{n}.f32")
        start.astype("<f4").tofile(folder / f"nmds_init_{n}.f32")


def stress(dissimilarities, points):
    """Stress-1 of a configuration, computed the same way for every peer."""
    from scipy.spatial.distance import pdist
    from sklearn.isotonic import isotonic_regression

    order = np.argsort(dissimilarities, kind="stable")
    distances = pdist(np.asarray(points, float))[order]
    disparities = isotonic_regression(distances)
    return np.sqrt(((distances - disparities) ** 2).sum() / (distances**2).sum())


def main(folder):
    from scipy.spatial.distance import squareform
    from sklearn.manifold import smacof

    warnings.filterwarnings("ignore")
    for n in ITEMS:
        d = np.fromfile(folder / f"nmds_{n}.f32", "<f4").astype(float)
        start = np.fromfile(folder / f"nmds_init_{n}.f32", "<f4").reshape(n, 2).astype(float)
        square = squareform(d)
        for eps, steps in ((1e-6, 300), (1e-9, 2000)):
            bench(f"nonmetric MDS of {n} items, one start", f"scikit-learn smacof {eps:.0e}", 1, "fit",
                  lambda: smacof(square, metric=False, init=start, n_init=1, max_iter=steps, eps=eps,
                                 normalized_stress=True),
                  lambda found: f"stress {stress(d, found[0]):.7f}")


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
