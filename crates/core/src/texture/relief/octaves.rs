//! Relief in the form that the renderer uses.

use realfft::RealFftPlanner;
use rustfft::num_complex::Complex;
use shagreen_synth::relief::{LEAST_SAMPLES, Relief as SynthRelief, length};

use super::Relief;

/// Relief as a series of octaves: each has half as many samples as the one before it. For a faster tip, the renderer
/// reads later octaves, so that it plays no content above the Nyquist frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct ReliefOctaves {
    step_m: f32,
    force_n: f32,
    n: usize,
    octaves: Vec<f32>,
}

impl Relief {
    /// Octaves of the mirrored relief. The number of samples is a power of two with at least two samples per value.
    /// Each octave contains the lower half of its band, because the renderer interpolates with cubics.
    pub fn octaves(&self) -> ReliefOctaves {
        let values = self.profile().values();
        let mut mirrored: Vec<f64> = values.iter().chain(values.iter().rev()).copied().collect();
        let m = mirrored.len();
        let n = (2 * m).next_power_of_two();
        let mut planner = RealFftPlanner::new();
        let forward = planner.plan_fft_forward(m);
        let mut bins = forward.make_output_vec();
        let done = forward.process(&mut mirrored, &mut bins);
        debug_assert!(done.is_ok(), "the buffers have the lengths of the plan");
        // Half of the last bin belongs to its mirror image above the Nyquist frequency.
        bins[m / 2] *= 0.5;
        let mut octaves = Vec::with_capacity(length(n));
        let mut left = n;
        while left >= LEAST_SAMPLES {
            let inverse = planner.plan_fft_inverse(left);
            let (mut part, mut samples) = (inverse.make_input_vec(), inverse.make_output_vec());
            part.fill(Complex::ZERO);
            for (to, from) in part.iter_mut().zip(&bins).take(left / 4 + 1) {
                *to = *from / m as f64;
            }
            part[0].im = 0.0;
            let done = inverse.process(&mut part, &mut samples);
            debug_assert!(done.is_ok(), "the buffers have the lengths of the plan");
            octaves.extend(samples.iter().map(|x| *x as f32));
            left /= 2;
        }
        let length_m = 2.0 * self.profile().length_m();
        ReliefOctaves { step_m: (length_m / n as f64) as f32, force_n: self.force().0 as f32, n, octaves }
    }
}

impl ReliefOctaves {
    /// Relief borrowed by a renderer.
    pub fn view(&self) -> SynthRelief<'_> {
        // Every valid relief gives numbers that the renderer accepts; a property test checks this.
        SynthRelief::checked_before(self.step_m, self.force_n, self.n, &self.octaves)
    }
}
