#!/usr/bin/env python3
"""How far apart textures are, in decibels: the reference of core::fidelity, in numpy.  Own code.

Textures have nine nodes, one at each condition, each an autoregressive process from resonances; mixtures are by closed
form.  Writes fidelity_vectors.json beside itself.
"""
import json, os
import numpy as np

HERE = os.path.dirname(os.path.abspath(__file__))
RATE = 1000.0
SPEEDS, FORCES = [50.0, 80.0, 110.0], [0.3, 0.6, 0.9]
F = 5 + (0.999 * RATE / 2 - 5) / 255 * np.arange(256)
CENTERS = np.geomspace(20, 480, 40)
G = np.exp(-0.5 * ((F[None] - CENTERS[:, None]) / (0.1 * CENTERS[:, None])) ** 2)
G /= G.sum(1, keepdims=True)
FLOOR = 1e-9
TURN = np.exp(-2j * np.pi * np.arange(1 << 16) / (1 << 16))


def predictor(resonances):
    a = np.array([1.0])
    for f, r in resonances:
        a = np.convolve(a, [1, -2 * r * np.cos(2 * np.pi * f / RATE), r * r])
    return a


def node(texture, v, f):
    """Predictor and level of a made-up texture at v mm/s and f N."""
    shift = {"one": 0.0, "two": 35.0, "quiet": 0.0}[texture]
    loud = {"one": 0.2, "two": 0.35, "quiet": 2e-4}[texture]
    a = predictor([(60 + 0.4 * v + shift, 0.93), (210 + 40 * f + shift, 0.88), (400 - shift, 0.7)])
    return a, loud * v / 50 * f ** 0.4


def on(z, a):
    return np.polynomial.polynomial.polyval(z, a)


def transfer(texture, v, f, z):
    a, level = node(texture, v, f)
    gain = np.mean(1 / np.abs(on(TURN, a)) ** 2)
    return level / np.sqrt(gain) * np.sqrt(2 / RATE) / on(z, a)


def density(parts, mode, v, f, z):
    h = [w * transfer(t, v, f, z) for t, w in parts]
    if mode == "shared":
        return np.abs(sum(h)) ** 2
    s = sum(np.abs(x) ** 2 for x in h)
    if mode == "power":
        levels = np.array([w * node(t, v, f)[1] for t, w in parts])
        s = s * levels.sum() ** 2 / (levels ** 2).sum()
    return s


def profile(parts, mode):
    z = np.exp(-2j * np.pi * F / RATE)
    channels, levels = [], []
    for v in SPEEDS:
        for f in FORCES:
            channels.append(10 * np.log10(np.maximum(G @ density(parts, mode, v, f, z), FLOOR)))
            power = np.mean(density(parts, mode, v, f, TURN)) * RATE / 2
            levels.append(10 * np.log10(power))
    return np.array(channels), np.array(levels)


def compare(a, b):
    return float(np.sqrt(np.mean((a[0] - b[0]) ** 2))), float(np.mean(np.abs(a[1] - b[1])))


cases = {
    "one": ([("one", 1.0)], "shared"),
    "two": ([("two", 1.0)], "shared"),
    "quiet": ([("quiet", 1.0)], "shared"),
    "paper": ([("one", 0.7), ("two", 0.3)], "paper"),
    "power": ([("one", 0.7), ("two", 0.3)], "power"),
    "shared": ([("one", 0.7), ("two", 0.3)], "shared"),
}
profiles = {name: profile(*case) for name, case in cases.items()}
out = {
    "conditions": [[v, f] for v in SPEEDS for f in FORCES],
    "textures": {
        t: [{"a": list(node(t, v, f)[0][1:]), "level": node(t, v, f)[1]} for v in SPEEDS for f in FORCES]
        for t in ["one", "two", "quiet"]
    },
    "parents": [["one", 0.7], ["two", 0.3]],
    "profiles": {
        name: {"channels_db": p[0].tolist(), "levels_db": p[1].tolist()} for name, p in profiles.items()
    },
    "pairs": [[a, b, *compare(profiles[a], profiles[b])] for a in profiles for b in profiles if a < b],
}
with open(os.path.join(HERE, "fidelity_vectors.json"), "w") as file:
    json.dump(out, file, indent=1)
    file.write("\n")
