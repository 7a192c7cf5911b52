#!/usr/bin/env python3
"""Designs the 2x interpolator of synth::resampler and writes it beside this file (scipy.signal.ellip).

Order 10, 0.05 dB ripple to 0.92 of the model's Nyquist frequency, 70 dB rejection from just above it, at twice the model rate.
"""
import json, os
import numpy as np
from scipy.signal import ellip, sosfreqz, group_delay, sos2tf

HERE = os.path.dirname(os.path.abspath(__file__))
sos = ellip(10, 0.05, 70, 0.462, output="sos")
w, h = sosfreqz(sos, worN=200_000)
mag = 20 * np.log10(np.abs(h) + 1e-12)
x = w / np.pi  # of the 2x Nyquist frequency; the model's own Nyquist frequency is 0.5
delay = -np.diff(np.unwrap(np.angle(h))) / np.diff(w)
out = dict(
    scipy="ellip(10, 0.05, 70, 0.462)",
    sos=[[float(v) for v in s] for s in sos],
    passband_ripple_db=float(mag[x <= 0.462].max() - mag[x <= 0.462].min()),
    worst_above_model_nyquist_db=float(mag[x >= 0.5].max()),
    stop_edge_of_model_nyquist=float(x[mag < -69.9][0] / 0.5),
    group_delay_low_samples_2x=float(delay[(x[:-1] > 0.01) & (x[:-1] < 0.2)].mean()),
    group_delay_400hz_samples_2x=float(delay[np.argmin(np.abs(x - 0.4))]),
)
json.dump(out, open(HERE + "/resample_vectors.json", "w"), indent=1)
print(json.dumps(out, indent=1))
