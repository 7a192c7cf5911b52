#!/usr/bin/env python3
"""Peers of benches/quality.rs: features of pairs of signals, in numpy.

Usage: quality.py INPUTS        prints one JSON line per measurement
       quality.py --make INPUTS writes generated pairs
Input: `quality_32pairs_2240.f32`, 32 pairs of 0.8 s at 2.8 kHz.

Features: spectral centroid, power, autocorrelation, skewness, 100 frequency channels of the skin, envelope correlation.
"plain" filters each channel in the time domain, as published. "lean" computes its energy from the spectrum (Parseval)
and reuses transforms.
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

PAIRS, SAMPLES, RATE = 32, 2240, 2800
LAGS = 280
HZ = np.fft.rfftfreq(SAMPLES, 1 / RATE)
CENTERS = np.geomspace(10, 1000, 100)
CHANNELS = np.exp(-0.5 * ((HZ - CENTERS[:, None]) / (0.15 * CENTERS[:, None])) ** 2)
WINDOW = np.hanning(SAMPLES)


def make(folder):
    """Noise with one resonance, and the same signal with added noise."""
    from scipy.signal import lfilter

    rng = np.random.default_rng(3)
    pairs = []
    for i in range(PAIRS):
        f, r = 60 + 10 * i, 0.95
        x = lfilter([1.0], [1.0, -2 * r * np.cos(2 * np.pi * f / RATE), r * r], rng.standard_normal(SAMPLES))
        pairs += [x, x + 0.1 * (1 + i / 8) * rng.standard_normal(SAMPLES)]
    np.concatenate(pairs).astype("<f4").tofile(folder / "quality_32pairs_2240.f32")


def compared(a, b):
    """Feature distances, in this order: centroid, power, autocorrelation, skewness, channels."""
    return np.array([a[0] - b[0], a[1] - b[1], np.abs(a[2] - b[2]).mean(), a[3] - b[3],
                     np.abs(np.log(a[4] / b[4])).mean()])


def plain(x):
    from scipy.signal import correlate, hilbert
    from scipy.stats import skew

    power = np.abs(np.fft.rfft(x * WINDOW)) ** 2
    channels = np.fft.irfft(np.fft.rfft(x) * CHANNELS, SAMPLES, axis=1)
    middle = SAMPLES - 1
    auto = correlate(x, x, "full", "fft")[middle:middle + LAGS] / (x @ x)
    return ((HZ * power).sum() / power.sum(), 10 * np.log10((x ** 2).mean()), auto, skew(x),
            np.sqrt((channels ** 2).mean(1)), np.abs(hilbert(x)))


def plain_pair(a, b):
    from scipy.signal import correlate

    a, b = plain(a), plain(b)
    x, y = a[5] - a[5].mean(), b[5] - b[5].mean()
    return np.append(compared(a, b), (correlate(x, y, "full", "fft") / np.sqrt((x @ x) * (y @ y))).max())


SQUARES = CHANNELS ** 2


def lean(x):
    spectrum = np.fft.rfft(x)
    both_sides = np.abs(spectrum) ** 2
    both_sides[1:-1] *= 2
    power = np.abs(np.fft.rfft(x * WINDOW)) ** 2
    analytic = np.zeros(SAMPLES, complex)
    analytic[:SAMPLES // 2 + 1] = spectrum
    analytic[1:SAMPLES // 2] *= 2
    centered = x - x.mean()
    variance = (centered * centered).mean()
    auto = np.fft.irfft(np.abs(np.fft.rfft(x, 2 * SAMPLES)) ** 2)[:LAGS]
    return ((HZ * power).sum() / power.sum(), 10 * np.log10((x @ x) / SAMPLES), auto / auto[0],
            (centered ** 3).mean() / variance ** 1.5, np.sqrt(SQUARES @ both_sides) / SAMPLES,
            np.abs(np.fft.ifft(analytic)))


def lean_pair(a, b):
    a, b = lean(a), lean(b)
    x, y = a[5] - a[5].mean(), b[5] - b[5].mean()
    n = 2 * SAMPLES
    cross = np.fft.irfft(np.fft.rfft(x, n) * np.fft.rfft(y, n).conj()) / np.sqrt((x @ x) * (y @ y))
    return np.append(compared(a, b), cross.max())


def main(folder):
    pairs = np.fromfile(folder / "quality_32pairs_2240.f32", "<f4").reshape(PAIRS, 2, SAMPLES).astype("f8")
    assert np.allclose(plain_pair(*pairs[0]), lean_pair(*pairs[0]), rtol=1e-4, atol=1e-4)
    case = "quality of 32 pairs of 0.8 s at 2.8 kHz"
    bench(case, "numpy and scipy, plain", PAIRS, "pair", lambda: [plain_pair(*pair) for pair in pairs])
    bench(case, "numpy, lean", PAIRS, "pair", lambda: [lean_pair(*pair) for pair in pairs])


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
