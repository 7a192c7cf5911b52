#!/usr/bin/env python3
"""Peers of benches/mfcc.rs: MFCCs of the same 25 signals.

Usage: mfcc.py INPUTS        prints one JSON line per measurement
       mfcc.py --make INPUTS writes generated signals
Input: `mfcc_25x25s_1kHz.f32`, 25 signals of 25 s at 1 kHz.

Settings of all peers: Hamming frames of 25 samples every 10 ms, FFT of 256 samples, 26 mel filters from 10 to 500 Hz,
13 coefficients. Filters and logarithm are those of each library, as none offers those of another.
"""
import sys
from pathlib import Path

import numpy as np

from measure import bench

SIGNALS, SAMPLES, RATE = 25, 25_000, 1000
FRAME, HOP, TRANSFORM, FILTERS, COEFFICIENTS = 25, 10, 256, 26, 13


def make(folder):
    """Noise with two resonances whose frequencies change from signal to signal."""
    from scipy.signal import lfilter

    rng = np.random.default_rng(11)
    out = []
    for i in range(SIGNALS):
        a = [1.0]
        for f, r in [(50 + 4 * i, 0.95), (220 + 6 * i, 0.9)]:
            a = np.convolve(a, [1.0, -2 * r * np.cos(2 * np.pi * f / RATE), r * r])
        out.append(lfilter([1.0], a, rng.standard_normal(SAMPLES + 500))[500:])
    np.concatenate(out).astype("<f4").tofile(folder / "mfcc_25x25s_1kHz.f32")


def filters():
    """Triangular filters on the HTK mel scale, as a bins x filters matrix."""
    def mel(hz):
        return 2595 * np.log10(1 + hz / 700)

    edges = 700 * (10 ** (np.linspace(mel(10), mel(500), FILTERS + 2) / 2595) - 1)
    hz = np.arange(TRANSFORM // 2 + 1) * RATE / TRANSFORM
    rise = (hz - edges[:-2, None]) / np.diff(edges)[:-1, None]
    fall = (edges[2:, None] - hz) / np.diff(edges)[1:, None]
    return np.maximum(0, np.minimum(rise, fall)).T


def main(folder):
    import librosa
    import python_speech_features
    from scipy.fft import dct, rfft

    signals = np.fromfile(folder / "mfcc_25x25s_1kHz.f32", "<f4").reshape(SIGNALS, SAMPLES)

    def by_librosa(x):
        return librosa.feature.mfcc(y=x, sr=RATE, n_mfcc=COEFFICIENTS, n_mels=FILTERS, fmin=10, fmax=500,
                                    window="hamming", center=False, n_fft=TRANSFORM, hop_length=HOP, win_length=FRAME)

    def by_psf(x):
        return python_speech_features.mfcc(x, samplerate=RATE, winlen=0.025, winstep=0.01, numcep=COEFFICIENTS,
                                           nfilt=FILTERS, nfft=TRANSFORM, lowfreq=10, highfreq=500, preemph=0,
                                           ceplifter=0, appendEnergy=False, winfunc=np.hamming)

    # Single precision: the fastest numpy variant.
    bank, window = filters().astype("f4"), np.hamming(FRAME).astype("f4")
    cosines = dct(np.eye(FILTERS), axis=0, norm="ortho")[:COEFFICIENTS].T.astype("f4")
    angles = 2 * np.pi * np.outer(np.arange(FRAME), np.arange(TRANSFORM // 2 + 1)) / TRANSFORM
    waves = np.concatenate([np.cos(angles), np.sin(angles)], 1).astype("f4") * window[:, None]

    def frames(x):
        return np.lib.stride_tricks.sliding_window_view(x, FRAME)[::HOP]

    def by_transform(x):
        s = rfft(frames(x) * window, TRANSFORM, axis=1)
        return np.log(np.maximum((s.real**2 + s.imag**2) @ bank, 1e-10)) @ cosines

    def by_matrix(x):
        z = frames(x) @ waves
        z *= z
        half = TRANSFORM // 2 + 1
        return np.log(np.maximum((z[:, :half] + z[:, half:]) @ bank, 1e-10)) @ cosines

    assert np.allclose(by_transform(signals[0]), by_matrix(signals[0]), rtol=1e-3, atol=1e-3)

    def each(peer, take):
        bench("MFCC, 25 signals of 25 s at 1 kHz", peer, SIGNALS, "signal", lambda: [take(x) for x in signals])
        bench("MFCC, 1 signal of 25 s at 1 kHz", peer, 1, "signal", lambda: take(signals[0]))

    each("librosa.feature.mfcc", by_librosa)
    bench("MFCC, 25 signals of 25 s at 1 kHz", "librosa, all at once", SIGNALS, "signal", lambda: by_librosa(signals))
    each("python_speech_features", by_psf)
    each("numpy, FFT", by_transform)
    each("numpy, matrix product", by_matrix)


if __name__ == "__main__":
    if sys.argv[1] == "--make":
        make(Path(sys.argv[2]))
    else:
        main(Path(sys.argv[1]))
