//! Bounded inverse of a voice coil's resonance.

use core::f64::consts::TAU;

/// Acceleration response of a voice coil under voltage drive: a second-order high-pass,
/// `a/V = K s² / (s² + (ω₀/Q) s + ω₀²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resonance {
    /// Resonance frequency `ω₀/2π`, in Hz.
    pub frequency_hz: f64,
    /// Quality factor `Q` under voltage drive.
    pub q: f64,
    /// Gain `K` far above the resonance, in m/s² per volt.
    pub gain_mps2_per_volt: f64,
}

/// Damping ratio of the equalized actuator's high-pass: Butterworth, to four digits.
#[expect(clippy::approx_constant, reason = "the reference uses four digits, and its values are reproduced")]
const INVERSE_DAMPING: f64 = 0.7071;

/// A second-order IIR filter, `y[n] = b₀x[n] + b₁x[n-1] + b₂x[n-2] - a₁y[n-1] - a₂y[n-2]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Biquad {
    /// Feedforward coefficients `b₀, b₁, b₂`.
    pub b: [f64; 3],
    /// Feedback coefficients `a₁, a₂`.
    pub a: [f64; 2],
}

impl Biquad {
    /// Returns the bounded inverse of a resonance, from m/s² to volts:
    /// `C(s) = (1/K) (s² + (ω₀/Q) s + ω₀²) / (s² + 2·0.7071 ω_h s + ω_h²)`, by the bilinear transform prewarped at the
    /// resonance.
    ///
    /// The equalized actuator is flat above about `1.5 lowest_hz` and falls by 12 dB per octave below `lowest_hz`.
    /// Below `lowest_hz` the gain never exceeds `(ω₀/ω_h)²/K` V per m/s². The resonance must lie below half the sample
    /// rate.
    pub fn bounded_inverse(resonance: Resonance, lowest_hz: f64, rate_hz: f64) -> Self {
        let Resonance { frequency_hz, q, gain_mps2_per_volt } = resonance;
        let (w, wh) = (TAU * frequency_hz, TAU * lowest_hz);
        let c = w / libm::tan(0.5 * w / rate_hz);
        let digital = |linear: f64, constant: f64| {
            let square = c * c;
            [square + linear * c + constant, 2.0 * (constant - square), square - linear * c + constant]
        };
        let n = digital(w / q, w * w);
        let d = digital(2.0 * INVERSE_DAMPING * wh, wh * wh);
        let scale = 1.0 / (d[0] * gain_mps2_per_volt);
        Self { b: n.map(|x| scale * x), a: [d[1] / d[0], d[2] / d[0]] }
    }

    /// Magnitude of the frequency response at a frequency in Hz.
    pub fn gain(&self, hz: f64, rate_hz: f64) -> f64 {
        let angle = TAU * hz / rate_hz;
        let (cos, sin) = (libm::cos(angle), libm::sin(angle));
        let (cos2, sin2) = (libm::cos(2.0 * angle), libm::sin(2.0 * angle));
        let magnitude = |[c0, c1, c2]: [f64; 3]| libm::hypot(c0 + c1 * cos + c2 * cos2, c1 * sin + c2 * sin2);
        magnitude(self.b) / magnitude([1.0, self.a[0], self.a[1]])
    }
}

/// A [`Biquad`] with its state, in `f64`: at 48 kHz its poles are so close to 1 that rounding in `f32` would be audible
/// noise.
#[derive(Clone, Debug)]
pub struct Equalizer {
    biquad: Biquad,
    state: [f64; 2],
}

/// State values below this magnitude are set to zero, because arithmetic with subnormal numbers is slow.
const NOTHING: f64 = 1e-60;

impl Equalizer {
    /// An equalizer with zero state.
    pub fn new(biquad: Biquad) -> Self {
        Self { biquad, state: [0.0; 2] }
    }

    /// Filters a block in place.
    pub fn process(&mut self, block: &mut [f32]) {
        let Self { biquad: Biquad { b, a }, state: [mut s0, mut s1] } = *self;
        for sample in block {
            let x = f64::from(*sample);
            let y = b[0] * x + s0;
            s0 = b[1] * x - a[0] * y + s1;
            s1 = b[2] * x - a[1] * y;
            *sample = y as f32;
        }
        self.remember([s0, s1]);
    }

    /// Adds `gain` times the filter's response to zero input (its ringing) to a block.
    pub fn ring_out(&mut self, block: &mut [f32], gain: f32) {
        let Self { biquad: Biquad { a, .. }, state: [mut s0, mut s1] } = *self;
        if [s0, s1] == [0.0; 2] {
            return;
        }
        for sample in block {
            *sample += gain * s0 as f32;
            (s0, s1) = (s1 - a[0] * s0, -a[1] * s0);
        }
        self.remember([s0, s1]);
    }

    /// Clears the state.
    pub fn reset(&mut self) {
        self.state = [0.0; 2];
    }

    fn remember(&mut self, state: [f64; 2]) {
        self.state = state.map(|s| if s.abs() < NOTHING { 0.0 } else { s });
    }
}

#[cfg(test)]
mod tests {
    extern crate std;
    use super::{Biquad, Equalizer, Resonance};
    use proptest::prelude::{prop_assert, proptest};
    use std::vec;
    use std::vec::Vec;

    /// Haptuator Mark II on 100 g, from its data sheet.
    const MARK_II: Resonance = Resonance {
        frequency_hz: 65.0,
        q: 4.086_340_698_080_68,
        gain_mps2_per_volt: 2.133_938_563_687_484_4,
    };

    /// Acceleration gain of the coil at a frequency, in m/s² per volt.
    fn coil_gain(r: Resonance, hz: f64) -> f64 {
        let u = hz / r.frequency_hz;
        r.gain_mps2_per_volt * u * u / (1.0 - u * u).hypot(u / r.q)
    }

    #[test]
    fn golden_coefficients_and_gains() {
        let golden: serde_json::Value =
            serde_json::from_str(include_str!("../../../vectors/b_act/actuator_vectors.json")).unwrap();
        let floats = |v: &serde_json::Value| -> Vec<f64> {
            v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
        };
        let mut n = 0;
        for rate_hz in [1000.0, 2000.0, 8000.0, 48_000.0] {
            for lowest_hz in [20.0, 30.0] {
                let expected = &golden["inverse"][&*std::format!("fs{rate_hz}_fh{lowest_hz}")];
                let biquad = Biquad::bounded_inverse(MARK_II, lowest_hz, rate_hz);
                let ours = biquad.b.iter().chain([1.0].iter()).chain(&biquad.a);
                let theirs = floats(&expected["b"]).into_iter().chain(floats(&expected["a"]));
                for (x, y) in ours.zip(theirs) {
                    assert!((x - y).abs() < 1e-11, "{rate_hz} {lowest_hz}: {x} for {y}");
                }
                for (hz, gain) in floats(&expected["f"]).into_iter().zip(floats(&expected["inv_V_per_mps2"]))
                {
                    let ours = biquad.gain(hz, rate_hz);
                    assert!((ours / gain - 1.0).abs() < 1e-8, "{hz} Hz at {rate_hz}: {ours} for {gain}");
                    n += 1;
                }
            }
        }
        assert_eq!(n, 80);
    }

    proptest! {
        #[test]
        fn any_coil_becomes_flat_and_volts_stay_bounded(
            frequency_hz in 30.0_f64..300.0,
            q in 0.5_f64..30.0,
            gain_mps2_per_volt in 0.01_f64..100.0,
        ) {
            let coil = Resonance { frequency_hz, q, gain_mps2_per_volt };
            let biquad = Biquad::bounded_inverse(coil, 20.0, 48_000.0);
            let bound = (frequency_hz / 20.0).powi(2).max(1.0) / gain_mps2_per_volt;
            for i in 0..400 {
                let hz = 5.0 * 1.0121_f64.powi(i);
                let volts = biquad.gain(hz, 48_000.0);
                // A strongly damped coil needs slightly more around its lowest frequency.
                let damping = (coil.q * 20.0 / frequency_hz).recip().max(1.0);
                prop_assert!(volts <= 1.1 * bound * damping, "{volts} V at {hz} Hz, bound {bound}");
                if (40.0..=500.0).contains(&hz) {
                    let db = 20.0 * (volts * coil_gain(coil, hz)).log10();
                    prop_assert!(db.abs() < 0.5, "{db} dB at {hz} Hz");
                }
            }
        }
    }

    #[test]
    fn blocks_of_any_size_give_what_the_definition_gives() {
        let biquad = Biquad::bounded_inverse(MARK_II, 20.0, 48_000.0);
        let input: Vec<f32> = (0..4000).map(|i| ((i * i) as f32 * 0.37).sin()).collect();
        let (mut x, mut y) = ([0.0_f64; 3], [0.0_f64; 3]);
        let expected: Vec<f64> = input
            .iter()
            .map(|&sample| {
                x = [f64::from(sample), x[0], x[1]];
                let next = biquad.b[0] * x[0] + biquad.b[1] * x[1] + biquad.b[2] * x[2]
                    - biquad.a[0] * y[0]
                    - biquad.a[1] * y[1];
                y = [next, y[0], y[1]];
                next
            })
            .collect();
        for block in [1, 7, 128, 4000] {
            let mut equalizer = Equalizer::new(biquad);
            let mut out = input.clone();
            out.chunks_mut(block).for_each(|part| equalizer.process(part));
            for (x, y) in out.iter().zip(&expected) {
                assert!((f64::from(*x) - y).abs() < 1e-6, "{x} for {y}");
            }
        }
    }

    #[test]
    fn what_rings_out_is_what_silence_would_have_rung_with() {
        let mut expected = Equalizer::new(Biquad::bounded_inverse(MARK_II, 20.0, 48_000.0));
        expected.process(&mut vec![1.0; 480]);
        let mut equalizer = expected.clone();
        let mut silence = vec![0.0; 4800];
        expected.process(&mut silence);
        let mut out = vec![0.25; 4800];
        out.chunks_mut(85).for_each(|part| equalizer.ring_out(part, 0.5));
        // The tolerance is the rounding of `f32` at 1.
        assert!(silence.iter().zip(&out).all(|(x, y)| (0.25 + 0.5 * x - y).abs() < 1e-6));
        assert!(silence[0].abs() > 0.1);
        for (x, y) in expected.state.iter().zip(&equalizer.state) {
            assert!((x - y).abs() < 1e-12 * x.abs().max(1e-3), "{x} for {y}");
        }
    }

    #[test]
    fn silence_ends_and_reset_forgets() {
        let mut equalizer = Equalizer::new(Biquad::bounded_inverse(MARK_II, 20.0, 48_000.0));
        equalizer.process(&mut vec![1.0; 480]);
        for _ in 0..2000 {
            equalizer.process(&mut [0.0; 128]);
        }
        assert_eq!(equalizer.state, [0.0; 2]);
        equalizer.process(&mut [f32::NAN]);
        equalizer.reset();
        let mut out = [0.0; 4];
        equalizer.process(&mut out);
        assert_eq!(out, [0.0; 4]);
    }
}
