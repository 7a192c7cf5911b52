#!/usr/bin/env python3
"""Peers of benches/live.rs: the same texture along the same stroke, in scipy and in numba.

Usage: live.py INPUTS        prints one JSON line per measurement
       live.py --make INPUTS writes a generated texture and stroke
Inputs: `model_ar20.txt` (counts; triangles; then per line speed in mm/s, force in N, variance, gain and 20 line
spectral frequencies) and `traj_60s_1kHz.f32` (speed in mm/s, force in N, at 1 kHz).
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

ORDER, TICK = 20, 5


def make(folder):
    """A texture of order 20 at 5 speeds x 5 forces, plus zero speed and zero force, and 60 s of strokes."""
    from scipy.spatial import Delaunay

    rng = np.random.default_rng(20)
    speeds, forces = np.meshgrid([0, 30, 70, 120, 180, 250], [0, 0.15, 0.4, 0.8, 1.5, 3.0])
    points = np.c_[speeds.ravel(), forces.ravel()]
    base = (np.arange(ORDER) + 0.3 + 0.4 * rng.random(ORDER)) * np.pi / ORDER
    lines = []
    for v, f in points:
        lsf = np.sort(base + 0.01 * rng.standard_normal(ORDER) * min(1.0, np.diff(base).min() * 20))
        variance = 1e-6 * v * v * f**0.6
        lines.append(" ".join(repr(float(x)) for x in [v, f, variance, 1.0, *lsf]))
    triangles = Delaunay(points / points.max(0)).simplices
    head = f"{len(points)} {len(triangles)} {ORDER} 0 {points[:, 0].max()} {points[:, 1].max()} 0.3"
    body = [head] + [" ".join(map(str, t)) for t in triangles] + lines
    (folder / "model_ar20.txt").write_text("\n".join(body) + "\n")
    t = np.arange(60_000) * 1e-3
    stroke = np.c_[200 * np.abs(np.sin(2 * t)), 1.5 + 1.2 * np.sin(0.7 * t)]
    stroke.astype("<f4").tofile(folder / "traj_60s_1kHz.f32")


def read(folder):
    rows = [list(map(float, l.split())) for l in (folder / "model_ar20.txt").read_text().splitlines()]
    n_triangles = int(rows[0][1])
    triangles = np.array(rows[1 : 1 + n_triangles], int)
    models = np.array(rows[1 + n_triangles :])
    stroke = np.fromfile(folder / "traj_60s_1kHz.f32", "<f4").reshape(-1, 2).astype(float)
    return triangles, models[:, :2].copy(), models[:, 2].copy(), models[:, 4:].copy(), stroke


def main(folder):
    import numba
    from scipy.signal import lfilter, lfiltic
    from scipy.spatial import Delaunay

    triangles, points, variance, lsf, stroke = read(folder)
    scale = points.max(0)
    n = len(stroke)
    rng = np.random.default_rng(1)

    def polynomial(w):
        q, p = np.array([1.0, 1.0]), np.array([1.0, -1.0])
        for k, x in enumerate(w):
            factor = [1.0, -2.0 * np.cos(x), 1.0]
            if k % 2 == 0:
                q = np.convolve(q, factor)
            else:
                p = np.convolve(p, factor)
        return (0.5 * (p + q))[: len(w) + 1]

    lookup = Delaunay(points / scale)

    def blocks():
        y = np.zeros(n + ORDER)
        for i in range(0, n, TICK):
            at = np.clip(stroke[i] / scale, 0.0, 1.0)
            simplex = int(lookup.find_simplex(at, tol=1e-9))
            b = lookup.transform[simplex, :2] @ (at - lookup.transform[simplex, 2])
            b = np.append(b, 1 - b.sum())
            corners = lookup.simplices[simplex]
            a = polynomial(b @ lsf[corners])
            e = rng.standard_normal(min(TICK, n - i)) * np.sqrt(max(b @ variance[corners], 0.0))
            state = lfiltic([1.0], a, y[i : i + ORDER][::-1])
            y[i + ORDER : i + ORDER + len(e)], _ = lfilter([1.0], a, e, zi=state)
        return y

    neighbors = np.full((len(triangles), 3), -1)
    seen = {}
    for i, t in enumerate(triangles):
        for e in range(3):
            key = tuple(sorted((t[(e + 1) % 3], t[(e + 2) % 3])))
            if key in seen:
                j, f = seen[key]
                neighbors[i, e], neighbors[j, f] = j, i
            seen[key] = (i, e)

    @numba.njit
    def times_factor(poly, length, c):
        poly[length] = poly[length + 1] = 0.0
        for i in range(length + 1, 1, -1):
            poly[i] += c * poly[i - 1] + poly[i - 2]
        poly[1] += c * poly[0]

    @numba.njit
    def render(stroke, points, triangles, neighbors, lsf, variance, tick, y):
        p = lsf.shape[1]
        history, a = np.zeros(p), np.zeros(p)
        even, odd = np.zeros(p + 4), np.zeros(p + 4)
        current, sigma = 0, 0.0
        for n in range(len(stroke)):
            if n % tick == 0:
                x, z = stroke[n]
                w0 = w1 = w2 = 0.0
                for _ in range(len(triangles)):
                    t0, t1, t2 = triangles[current]
                    dx, dz = points[t0, 0] - points[t2, 0], points[t0, 1] - points[t2, 1]
                    ex, ez = points[t1, 0] - points[t2, 0], points[t1, 1] - points[t2, 1]
                    det = dx * ez - ex * dz
                    w0 = ((x - points[t2, 0]) * ez - ex * (z - points[t2, 1])) / det
                    w1 = (dx * (z - points[t2, 1]) - (x - points[t2, 0]) * dz) / det
                    w2 = 1.0 - w0 - w1
                    lowest = 0 if w0 <= w1 and w0 <= w2 else (1 if w1 <= w2 else 2)
                    if min(w0, w1, w2) >= -1e-9 or neighbors[current, lowest] < 0:
                        break
                    current = neighbors[current, lowest]
                t0, t1, t2 = triangles[current]
                even[:] = 0.0
                odd[:] = 0.0
                even[0] = odd[0] = 1.0
                n_even = n_odd = 1
                for k in range(p):
                    c = -2.0 * np.cos(w0 * lsf[t0, k] + w1 * lsf[t1, k] + w2 * lsf[t2, k])
                    if k % 2 == 0:
                        times_factor(even, n_even, c)
                        n_even += 2
                    else:
                        times_factor(odd, n_odd, c)
                        n_odd += 2
                for i in range(1, p + 1):
                    a[i - 1] = 0.5 * (even[i] + even[i - 1] + odd[i] - odd[i - 1])
                sigma = np.sqrt(max(w0 * variance[t0] + w1 * variance[t1] + w2 * variance[t2], 0.0))
            out = np.random.standard_normal() * sigma
            for i in range(p):
                out -= a[i] * history[i]
            for i in range(p - 1, 0, -1):
                history[i] = history[i - 1]
            history[0] = out
            y[n] = out

    y = np.zeros(n)
    case = "one texture, 1 kHz, coefficients every 5 ms"
    bench(case, "numba loop", n, "sample", lambda: render(stroke, points, triangles, neighbors, lsf, variance, TICK, y))
    assert np.isfinite(y).all() and y.std() > 0.0
    bench(case, "scipy lfilter, blocks of 5", n, "sample", blocks)


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
