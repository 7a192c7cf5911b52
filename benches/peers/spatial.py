#!/usr/bin/env python3
"""Peers of benches/spatial.rs: STFT of one profile, its inverse, and Griffin-Lim.

Usage: spatial.py INPUTS        prints one JSON line per measurement
       spatial.py --make INPUTS writes a generated profile
Input: `profile_100mm_1um.f32`, 100 mm in steps of 1 micrometer.

Periodic Hann windows of 20 to 0.2 mm with a hop of a quarter window. "FFT only" is one real FFT per window without
windowing, framing or overlap-add: not a peer, but a lower bound for all of them.
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

SAMPLES = 100_000
WINDOWS = [20_000, 10_000, 5_000, 2_000, 1_000, 500, 200]
REFINED, STEPS = 2_000, 32


def make(folder):
    """Two sines (13 mm and 0.4 mm) and noise."""
    rng = np.random.default_rng(5)
    x = np.arange(SAMPLES) * 1e-3
    y = 0.5 + 0.2 * np.sin(2 * np.pi * x / 13) + 0.1 * np.sin(2 * np.pi * x / 0.4) + 0.05 * rng.standard_normal(SAMPLES)
    y.astype("<f4").tofile(folder / "profile_100mm_1um.f32")


def decibels(a, b):
    return f"{10 * np.log10((abs(a.astype(complex)) ** 2).sum() / (abs(a - b) ** 2).sum()):.1f} dB"


def main(folder):
    import librosa
    import scipy.fft
    from scipy.signal import ShortTimeFFT
    from scipy.signal.windows import hann

    single = np.fromfile(folder / "profile_100mm_1um.f32", "<f4")
    double = single.astype("f8")
    there, back = "spatial spectrogram of 100 mm, 7 windows", "inverse spatial spectrogram of 100 mm, 7 windows"

    for profile in (double, single):
        name = f"scipy ShortTimeFFT, {profile.dtype}"
        plans = [ShortTimeFFT(hann(w, sym=False).astype(profile.dtype), hop=w // 4, fs=1e6) for w in WINDOWS]
        bench(there, name, 1, "profile", lambda: [p.stft(profile) for p in plans])
        spectra = [p.stft(profile) for p in plans]
        worst = min(decibels(profile, p.istft(s, k1=SAMPLES)) for p, s in zip(plans, spectra))
        bench(back, name, 1, "profile", lambda: [p.istft(s, k1=SAMPLES) for p, s in zip(plans, spectra)], note=lambda _: worst)

    for profile in (double, single):
        name = f"librosa stft, {profile.dtype}"
        bench(there, name, 1, "profile", lambda: [librosa.stft(profile, n_fft=w, hop_length=w // 4) for w in WINDOWS])
        spectra = [librosa.stft(profile, n_fft=w, hop_length=w // 4) for w in WINDOWS]

        def turned():
            return [librosa.istft(s, n_fft=w, hop_length=w // 4, length=SAMPLES) for w, s in zip(WINDOWS, spectra)]

        bench(back, name, 1, "profile", turned, note=lambda back: min(decibels(profile, y) for y in back))

    for profile in (double, single):
        name = f"scipy.fft, FFT only, {profile.dtype}"
        cuts = [np.ascontiguousarray(np.lib.stride_tricks.sliding_window_view(np.pad(profile, w // 2), w)[:: w // 4])
                for w in WINDOWS]
        bench(there, name, 1, "profile", lambda: [scipy.fft.rfft(c, axis=1) for c in cuts])
        spectra = [scipy.fft.rfft(c, axis=1) for c in cuts]
        bench(back, name, 1, "profile", lambda: [scipy.fft.irfft(s, axis=1) for s in spectra])

    magnitudes = np.abs(librosa.stft(single, n_fft=REFINED, hop_length=REFINED // 4))

    def refined():
        return librosa.griffinlim(magnitudes, n_iter=STEPS, hop_length=REFINED // 4, n_fft=REFINED, length=SAMPLES,
                                  random_state=0)

    reached = np.abs(librosa.stft(refined(), n_fft=REFINED, hop_length=REFINED // 4))
    bench("Griffin-Lim, 32 iterations, windows of 2 mm", "librosa.griffinlim", 1, "profile", refined,
          note=lambda _: decibels(magnitudes, reached))


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
