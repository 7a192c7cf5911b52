#!/usr/bin/env python3
"""Coefficients in the manner of scripts after the Hidden Markov Model Toolkit, of input.csv: whole frames only, the
signal emphasized before it is framed, Hamming's symmetric window, magnitudes of a transform of 32 samples, 20 triangles
in Hz between edges equally far apart in mel, natural logarithms, cosines whose first row is not scaled down, lifter 22.
Written from these words, sum by sum, with nothing but the standard library. Writes htk_hop10.csv and htk_hop15.csv."""
import cmath
import math
import os

HERE = os.path.dirname(os.path.abspath(__file__))
RATE, N_FRAME, N_TRANSFORM, N_FILTERS, N_COEFFICIENTS, LIFTER = 1000, 25, 32, 20, 13, 22


def mel(hz):
    return 1127 * math.log(1 + hz / 700)


def hz(m):
    return 700 * (math.exp(m / 1127) - 1)


def triangle(f, left, center, right):
    if left <= f <= center:
        return (f - left) / (center - left)
    if center <= f <= right:
        return (right - f) / (right - center)
    return 0.0


def coefficients(frame):
    hamming = [0.54 - 0.46 * math.cos(2 * math.pi * n / (N_FRAME - 1)) for n in range(N_FRAME)]
    y = [s * w for s, w in zip(frame, hamming)]
    magnitudes = []
    for k in range(N_TRANSFORM // 2 + 1):
        terms = [v * cmath.exp(-2j * math.pi * k * n / N_TRANSFORM) for n, v in enumerate(y)]
        magnitudes.append(abs(sum(terms)))
    step = (mel(500) - mel(10)) / (N_FILTERS + 1)
    edges = [hz(mel(10) + step * i) for i in range(N_FILTERS + 2)]
    logs = []
    for j in range(N_FILTERS):
        weights = [triangle(k * RATE / N_TRANSFORM, *edges[j:j + 3]) for k in range(len(magnitudes))]
        total = sum(w * m for w, m in zip(weights, magnitudes))
        logs.append(math.log(total if total > 0 else 2.0 ** -52))
    row = []
    for k in range(N_COEFFICIENTS):
        c = math.sqrt(2 / N_FILTERS) * sum(v * math.cos(math.pi * k * (j + 0.5) / N_FILTERS) for j, v in enumerate(logs))
        row.append(c * (1 + LIFTER / 2 * math.sin(math.pi * k / LIFTER)))
    return row


signal = [float(line) for line in open(HERE + "/input.csv")]
emphasized = [signal[0]] + [b - 0.97 * a for a, b in zip(signal, signal[1:])]
for hop in (10, 15):
    starts = range(0, len(signal) - N_FRAME + 1, hop)
    with open(f"{HERE}/htk_hop{hop}.csv", "w") as out:
        for start in starts:
            out.write(",".join(f"{c!r}" for c in coefficients(emphasized[start:start + N_FRAME])) + "\n")
