#!/usr/bin/env python3
"""Peers of benches/arfit.rs: AR models fitted to the same 100 segments.

Usage: arfit.py INPUTS        prints one JSON line per measurement
       arfit.py --make INPUTS writes generated segments
Input: `arfit_100x2000.f32`, 100 segments of 2,000 samples.
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

ORDER, SEGMENTS, SAMPLES = 20, 100, 2000


def make(folder):
    """Noise with two resonances whose frequencies change from segment to segment."""
    from scipy.signal import lfilter

    rng = np.random.default_rng(7)
    out = []
    for i in range(SEGMENTS):
        a = [1.0]
        for f, r in [(60 + i, 0.97), (200 + i, 0.92)]:
            a = np.convolve(a, [1.0, -2 * r * np.cos(2 * np.pi * f / 1000), r * r])
        out.append(lfilter([1.0], a, rng.standard_normal(SAMPLES + 500))[500:])
    np.concatenate(out).astype("<f4").tofile(folder / "arfit_100x2000.f32")


def main(folder):
    import librosa
    import spectrum
    from scipy.linalg import solve_toeplitz
    from statsmodels.regression.linear_model import burg, yule_walker

    segments = np.fromfile(folder / "arfit_100x2000.f32", "<f4").reshape(SEGMENTS, SAMPLES).astype(float)

    def by_transform(x):
        n = len(x)
        f = np.fft.rfft(x, 4096)
        r = np.fft.irfft(f * f.conj())[: ORDER + 1] / n
        return solve_toeplitz(r[:ORDER], -r[1:])

    def by_products(x):
        n = len(x)
        r = np.array([x[: n - k] @ x[k:] for k in range(ORDER + 1)]) / n
        return solve_toeplitz(r[:ORDER], -r[1:])

    def each(name, peer, fit, part=segments):
        bench(f"{name}, {SAMPLES} samples, order {ORDER}", peer, len(part), "fit", lambda: [fit(x) for x in part])

    each("Burg", "librosa.lpc (numba)", lambda x: librosa.lpc(x, order=ORDER))
    bench(f"Burg, {SAMPLES} samples, order {ORDER}", "librosa.lpc, all at once", SEGMENTS, "fit",
          lambda: librosa.lpc(segments, order=ORDER))
    each("Burg", "statsmodels burg", lambda x: burg(x, order=ORDER, demean=False))
    each("Burg", "spectrum.arburg", lambda x: spectrum.arburg(x, ORDER), segments[:5])
    each("Yule-Walker", "numpy transform, scipy", by_transform)
    each("Yule-Walker", "numpy products, scipy", by_products)
    each("Yule-Walker", "statsmodels yule_walker",
         lambda x: yule_walker(x, order=ORDER, method="mle", demean=False))
    each("Yule-Walker", "spectrum.aryule", lambda x: spectrum.aryule(x, ORDER), segments[:20])


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
