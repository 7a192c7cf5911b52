#!/usr/bin/env python3
"""A made-up texture in the XML of the Penn Haptic Texture Toolkit, and the spectra that its published rendering has.

Writes made_up.xml and hatt_vectors.json beside this file. numpy 2.4, scipy 1.17, seed 7. Nothing of a published model is
in it: frequencies, levels and gains are drawn at random.

Rendering: y[t] = -sum a_i y[t-i] + gain (e[t] + sum b_j e[t-j]), e white with variance var. Line spectral frequencies of
both filters, var and gain are each linear in the Delaunay triangles over (speed / maxSpeed, force / maxForce).
One-sided density: 2 gain^2 var |B|^2 / (rate |A|^2).
"""
import json, os
import numpy as np
from scipy.spatial import Delaunay

HERE = os.path.dirname(os.path.abspath(__file__))
RATE, P, Q, V, F = 1000.0, 18, 16, 212.4, 3.7
rng = np.random.default_rng(7)


def poly(lsf):
    """Predictor 1 + a_1 z^-1 + ... of line spectral frequencies."""
    def build(ws):
        c = np.array([1.0])
        for w in ws:
            c = np.convolve(c, [1, -2 * np.cos(w), 1])
        return c
    q, p = build(lsf[0::2]), build(lsf[1::2])
    if len(lsf) % 2 == 0:
        q, p = np.convolve(q, [1, 1]), np.convolve(p, [1, -1])
    else:
        p = np.convolve(p, [1, 0, -1])
    n = max(len(p), len(q))
    return (0.5 * (np.r_[p, np.zeros(n - len(p))] + np.r_[q, np.zeros(n - len(q))]))[: len(lsf) + 1]


def random_lsf(order, base):
    gaps = base + 0.25 * rng.uniform(size=order + 1)
    return np.round(np.cumsum(gaps)[:-1] / gaps.sum() * np.pi, 6)


def fields(name, values, form):
    return f"<{name}>" + "".join(f"<value>{form % v}</value>" for v in values) + f"</{name}>"


inside = [(v, f) for v in (38.0, 91.0, 150.5, 197.0) for f in (0.45, 1.31, 2.6, 3.4)]
inside = [(v + rng.uniform(-9, 9), f + rng.uniform(-0.2, 0.2)) for v, f in inside]
models = []
for v, f in inside:
    models.append(dict(v=v, f=f, ar=random_lsf(P, 0.5), ma=random_lsf(Q, 0.7), var=2e-3 * v / 100 * rng.uniform(0.5, 2), gain=rng.uniform(4, 14)))
nearest = lambda v, f: min(models[: len(inside)], key=lambda m: (m["v"] - v) ** 2 + (m["f"] - f) ** 2)
speeds = [s for s in np.arange(0, V, 40.0)] + [V]
forces = [0.5, 1.75, 3.0, F]
for v in speeds:
    models.append({**nearest(v, 0.0), "v": v, "f": 0.0, "var": 0.0})
for f in forces:
    models.append({**nearest(0.0, f), "v": 0.0, "f": f, "var": 0.0})
for f in forces:
    models.append({**nearest(V, f), "v": V, "f": f})
for v in speeds[1:-1]:
    models.append({**nearest(v, F), "v": v, "f": F})

points = np.array([[m["v"] / V, m["f"] / F] for m in models])
mesh = Delaunay(points)
lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<modelSet texture="1">', "<material>Made-up Slate</material>"]
lines += ["<AccelUnits>m/s^2</AccelUnits><SpeedUnits>mm/s</SpeedUnits><ForceUnits>N</ForceUnits>", f"<SampleRate>{RATE:.0f}</SampleRate><mu>0.347</mu>"]
lines += [f"<numMod>{len(models)}</numMod><numTri>{len(mesh.simplices)}</numTri><maxSpeed>{V}</maxSpeed><maxForce>{F}</maxForce>"]
lines += [fields("speedList", [m["v"] for m in models], "%.10g"), fields("forceList", [m["f"] for m in models], "%.10g")]
lines += [fields("tri", t + 1, "%d") for t in mesh.simplices]
lines += [f"<numARCoeff>{P}</numARCoeff><numMACoeff>{Q}</numMACoeff>"]
for n, m in enumerate(models):
    lines += [
        f"<model><modNum>{n + 1}</modNum>" + fields("ARcoeff", poly(m["ar"]), "%.20g") + fields("ARlsf", m["ar"], "%.6f")
        + fields("MAcoeff", poly(m["ma"]), "%.20g") + fields("MAlsf", m["ma"], "%.6f")
        + f"<var>{m['var']:.12g}</var><gain>{m['gain']:.12g}</gain><speedMod>{m['v']:.10g}</speedMod><forceMod>{m['f']:.10g}</forceMod></model>"
    ]
lines += ["</modelSet>"]
open(f"{HERE}/made_up.xml", "w").write("\n".join(lines) + "\n")

hz = [12.0, 35.0, 60.0, 101.0, 150.0, 222.0, 310.0, 405.0, 480.0]
z = np.exp(-2j * np.pi * np.array(hz) / RATE)
cases = []
for v, f in [(m["v"], m["f"]) for m in models[:3]] + [(100.0, 1.0), (57.3, 0.2), (18.0, 2.2), (180.0, 3.65), (211.0, 1.1), (120.0, 2.0), (75.0, 3.0)]:
    at = np.array([v / V, f / F])
    t = int(mesh.find_simplex(at))
    b = mesh.transform[t, :2] @ (at - mesh.transform[t, 2])
    weights = np.r_[b, 1 - b.sum()]
    mix = lambda key: sum(w * np.asarray(models[i][key]) for w, i in zip(weights, mesh.simplices[t]))
    a, ma = np.polyval(poly(mix("ar"))[::-1], z), np.polyval(poly(mix("ma"))[::-1], z)
    psd = 2 * mix("gain") ** 2 * mix("var") * np.abs(ma) ** 2 / (RATE * np.abs(a) ** 2)
    cases.append(dict(speed_mm_per_s=v, force_n=f, psd=psd.tolist()))
json.dump(dict(hz=hz, cases=cases, tolerance_db=1e-6, reason="both sides work in double precision; the file holds speeds to ten digits"),
          open(f"{HERE}/hatt_vectors.json", "w"), indent=1)
