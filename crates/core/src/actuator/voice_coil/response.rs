//! Second-order high-pass response of a voice coil.

use std::f64::consts::TAU;

use realfft::RealFftPlanner;
use realfft::num_complex::Complex;

use crate::actuator::ActuatorError;
use crate::actuator::voice_coil::check_positive;
use crate::units::Hertz;

/// Lowest valid quality factor; there the two poles of the suspension are far apart.
const MIN_Q: f64 = 0.1;
/// Highest valid quality factor.
const MAX_Q: f64 = 1000.0;

/// Fraction of the ringing that may wrap around in circular convolution.
const LEFT: f64 = 1e-9;

/// Acceleration of the case for a voltage: `a/V = K s² / (s² + s ω₀/Q + ω₀²)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    resonance: Hertz,
    q: f64,
    gain_mps2_per_v: f64,
}

impl From<&Response> for shagreen_synth::equalizer::Resonance {
    fn from(response: &Response) -> Self {
        Self {
            frequency_hz: response.resonance.0,
            q: response.q,
            gain_mps2_per_volt: response.gain_mps2_per_v,
        }
    }
}

impl Response {
    /// Creates a response with this resonance frequency `ω₀ / 2π`, quality factor Q (0.1 to 1000), and gain K far above
    /// the resonance in (m/s²)/V.
    ///
    /// # Errors
    /// [`ActuatorError::Number`] if a value is out of range.
    pub fn new(resonance: Hertz, q: f64, gain_mps2_per_v: f64) -> Result<Self, ActuatorError> {
        check_positive("the resonance in Hz", resonance.0)?;
        check_positive("the gain in (m/s²)/V", gain_mps2_per_v)?;
        if !(MIN_Q..=MAX_Q).contains(&q) {
            return Err(ActuatorError::Number { what: "Q", value: q, needs: "0.1 to 1000" });
        }
        Ok(Self { resonance, q, gain_mps2_per_v })
    }

    /// Resonance frequency; for high Q, the frequency of the maximum.
    pub fn resonance(&self) -> Hertz {
        self.resonance
    }

    /// Quality factor: ratio of the gain at the resonance to the gain far above it.
    pub fn q(&self) -> f64 {
        self.q
    }

    /// Gain far above the resonance, in (m/s²)/V.
    pub fn gain_mps2_per_v(&self) -> f64 {
        self.gain_mps2_per_v
    }

    /// Complex gain at a frequency, in (m/s²)/V.
    pub fn at(&self, frequency: Hertz) -> Complex<f64> {
        let x = frequency.0 / self.resonance.0;
        Complex::new(-self.gain_mps2_per_v * x * x, 0.0) / Complex::new(1.0 - x * x, x / self.q)
    }

    /// Magnitude of the gain at a frequency, in (m/s²)/V.
    pub fn magnitude_at(&self, frequency: Hertz) -> f64 {
        self.at(frequency).norm()
    }

    /// Acceleration of the case in m/s² for a voltage in V, starting at rest. Exact below half of the sample rate. The
    /// result has the length of `volts`.
    pub fn drive(&self, volts: &[f64], rate: Hertz) -> Vec<f64> {
        if volts.is_empty() {
            return Vec::new();
        }
        let decay_per_sec = TAU * self.resonance.0 / (2.0 * self.q.max(0.5));
        let ring = ((1.0 / LEFT).ln() / decay_per_sec * rate.0).ceil() as usize;
        let n = (volts.len() + ring).next_power_of_two();
        let mut planner = RealFftPlanner::<f64>::new();
        let (forward, back) = (planner.plan_fft_forward(n), planner.plan_fft_inverse(n));
        let (mut signal, mut bins) = (forward.make_input_vec(), forward.make_output_vec());
        signal[..volts.len()].copy_from_slice(volts);
        let done = forward.process(&mut signal, &mut bins).and_then(|()| {
            for (k, bin) in bins.iter_mut().enumerate() {
                *bin *= self.at(Hertz(k as f64 * rate.0 / n as f64)) / n as f64;
            }
            // The bin at half of the sample rate must be real.
            bins[n / 2].im = 0.0;
            back.process(&mut bins, &mut signal)
        });
        assert!(done.is_ok(), "the buffers have the lengths of the plan: {done:?}");
        signal.truncate(volts.len());
        signal
    }
}
