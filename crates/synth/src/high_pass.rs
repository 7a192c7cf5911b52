//! First-order high-pass of a signal that is read at the tip position, whose input may jump with the tip.

use core::f32::consts::PI;

/// High-pass by the bilinear transform, with its state.
#[derive(Clone, Debug)]
pub(crate) struct HighPass {
    /// Coefficients: `keep` for the last output, `take` for the change of the input.
    keep: f32,
    take: f32,
    input: f32,
    output: f32,
}

impl HighPass {
    /// A high-pass with zero input and output, and this cutoff frequency at this sample rate, in Hz.
    pub(crate) fn new(cutoff_hz: f32, rate_hz: f32) -> Self {
        let corner = PI * cutoff_hz / rate_hz;
        let (keep, take) = ((1.0 - corner) / (1.0 + corner), 1.0 / (1.0 + corner));
        Self { keep, take, input: 0.0, output: 0.0 }
    }

    /// Starts anew as if the input had always had this value: the output is zero.
    pub(crate) fn start_at(&mut self, input: f32) {
        (self.input, self.output) = (input, 0.0);
    }

    /// Continues from another input without a step in the output.
    pub(crate) fn jump_to(&mut self, input: f32) {
        self.input = input;
    }

    /// Returns the next output.
    pub(crate) fn next(&mut self, input: f32) -> f32 {
        self.output = self.keep * self.output + self.take * (input - self.input);
        self.input = input;
        self.output
    }
}

#[cfg(test)]
mod tests {
    use core::f64::consts::TAU;

    use super::HighPass;

    /// Closed form of the bilinear transform: `|H| = t / √(t² + c²)` with `t = tan(π f / rate)` and `c = π cutoff / rate`.
    #[test]
    fn a_sine_has_the_gain_of_a_first_order_high_pass() {
        for hz in [2.0, 10.0, 40.0, 300.0] {
            let mut high_pass = HighPass::new(10.0, 1000.0);
            let (mut cosine, mut sine) = (0.0, 0.0);
            for i in 0..4000 {
                let phase = TAU * hz * f64::from(i) / 1000.0;
                let output = f64::from(high_pass.next(libm::sin(phase) as f32));
                // The first 2 s let the start decay; the last 2 s contain whole periods.
                if i >= 2000 {
                    cosine += output * libm::cos(phase) / 1000.0;
                    sine += output * libm::sin(phase) / 1000.0;
                }
            }
            let tangent = libm::tan(0.5 * TAU * hz / 1000.0);
            let expected = tangent / libm::hypot(tangent, 0.5 * TAU * 10.0 / 1000.0);
            // Rounding of `f32` accumulates over the 16 ms that the state lasts.
            assert!((libm::hypot(cosine, sine) - expected).abs() < 1e-4, "{hz} Hz");
        }
    }

    #[test]
    fn a_start_is_silent_and_a_jump_keeps_the_output() {
        let mut high_pass = HighPass::new(10.0, 1000.0);
        high_pass.start_at(5.0);
        assert!(high_pass.next(5.0) == 0.0);
        let before = high_pass.next(6.0);
        high_pass.jump_to(-80.0);
        let after = high_pass.next(-80.0);
        assert!(before > 0.9 && after < before && after > 0.9 * before);
    }
}
