//! Offline rendering of mixtures and paths to samples, for any motion of the tip.

use std::borrow::Borrow;

use shagreen_core::space::texture_path::{PathPlan, TexturePath, render_path};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_core::texture::render::{Hand, RenderError, RenderPlan, render};
use shagreen_core::units::Hertz;

/// Rate, length and seed of rendered samples.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SampleFormat {
    /// Rate of the samples, at least that of the textures.
    pub rate: Hertz,
    /// Length in seconds.
    pub seconds: f64,
    /// Random seed of the noise.
    pub seed: u64,
    /// Whether the end goes on into the beginning, so that the samples can be repeated.
    pub loops: bool,
}

/// Duration of the crossfade at the seam of a loop, in seconds.
pub const SEAM_SECS: f64 = 0.1;

/// Lowest correlation of the two parts of a seam that is made up for. Parts that are still more opposite, such as those of a
/// grating that fits into the loop with half a period left, have a phase that turns in a moment, and a short dip there.
const MOST_OPPOSITE: f64 = -0.9;

/// Renders in a format: a loop is rendered a seam longer, and then closed. `render` takes the seconds to render.
fn rendered(
    format: SampleFormat,
    render: impl FnOnce(f64) -> Result<Vec<f32>, RenderError>,
) -> Result<Vec<f32>, RenderError> {
    let SampleFormat { rate, seconds, .. } = format;
    if !format.loops {
        return render(seconds);
    }
    let n = (seconds * rate.0).round() as usize;
    Ok(looped(render(n_for_loop(n, rate) as f64 / rate.0)?, n, rate))
}

/// Number of samples to render for a loop of `n` samples: the seam is rendered twice.
fn n_for_loop(n: usize, rate: Hertz) -> usize {
    n + seam(n, rate)
}

fn seam(n: usize, rate: Hertz) -> usize {
    ((SEAM_SECS * rate.0) as usize).min(n / 2)
}

/// Makes a loop of `n` samples from [`n_for_loop`] samples: what follows the end is mixed into the beginning, so that the
/// signal goes on over the seam. The two parts are independent noise, so their powers add: the weights are a cosine and a
/// sine, divided by the root of the power of their sum where the parts are alike.
fn looped(mut samples: Vec<f32>, n: usize, rate: Hertz) -> Vec<f32> {
    let n_seam = seam(n, rate).min(samples.len().saturating_sub(n));
    let (begin, end) = (&samples[..n_seam], &samples[n..n + n_seam]);
    let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| f64::from(*a) * f64::from(*b)).sum::<f64>();
    // Parts that are alike, such as those of a grating, would add to more than their power, and opposite ones to less.
    let alike = dot(begin, end) / (dot(begin, begin) * dot(end, end)).sqrt().max(f64::MIN_POSITIVE);
    let alike = alike.clamp(MOST_OPPOSITE, 1.0);
    for i in 0..n_seam {
        let angle = std::f64::consts::FRAC_PI_2 * (i as f64 + 0.5) / n_seam as f64;
        let (sin, cos) = angle.sin_cos();
        let power = 1.0 + 2.0 * alike * sin * cos;
        let sum = f64::from(samples[i]) * sin + f64::from(samples[n + i]) * cos;
        samples[i] = (sum / power.sqrt()) as f32;
    }
    samples.truncate(n);
    samples
}

/// Renders the acceleration in m/s² of a weighted mixture of textures.
///
/// # Errors
/// See [`RenderError`].
pub fn render_mixture<P: Borrow<Plane>>(
    voices: &[(P, f64)],
    mode: Mode,
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let prepared: Vec<(Prepared, f64)> =
        voices.iter().map(|(plane, weight)| (plane.borrow().prepare(), *weight)).collect();
    render_prepared(&prepared, mode, format, hand)
}

/// As [`render_mixture`], for planes that are prepared, which several signals share.
///
/// # Errors
/// See [`RenderError`].
pub fn render_prepared(
    voices: &[(Prepared, f64)],
    mode: Mode,
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let SampleFormat { rate, seed, .. } = format;
    let parents: Vec<(&Prepared, f64)> = voices.iter().map(|(p, weight)| (p, *weight)).collect();
    rendered(format, |seconds| render(&RenderPlan { parents: &parents, mode, rate, seconds, seed }, hand))
}

/// Renders the acceleration in m/s² of a texture that changes along the stroke.
///
/// # Errors
/// See [`RenderError`].
pub fn render_along(
    path: &TexturePath,
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    render_along_prepared(path, &prepared_keys(path), format, hand)
}

/// Textures of the keys of a path, prepared for [`render_along_prepared`].
pub fn prepared_keys(path: &TexturePath) -> Vec<Prepared> {
    path.keys().iter().map(|key| Plane::new(&key.model).prepare()).collect()
}

/// As [`render_along`], with the prepared textures of its keys ([`prepared_keys`]), which several signals share.
///
/// # Errors
/// See [`RenderError`].
pub fn render_along_prepared(
    path: &TexturePath,
    prepared: &[Prepared],
    format: SampleFormat,
    hand: &mut dyn Hand,
) -> Result<Vec<f32>, RenderError> {
    let SampleFormat { rate, seed, .. } = format;
    rendered(format, |seconds| render_path(&PathPlan { path, prepared, rate, seconds, seed }, hand))
}

#[cfg(test)]
mod tests {
    use super::{looped, n_for_loop};
    use shagreen_core::maths::rng::lcg_noise;
    use shagreen_core::units::Hertz;

    #[test]
    fn a_loop_has_no_click_and_no_dip_at_its_seam() {
        let (n, rate) = (4800, Hertz(4800.0));
        // A slow wave: across the seam it must go on as it does elsewhere.
        let wave = |i: usize| (0.01 * i as f32).sin();
        let made = looped((0..n_for_loop(n, rate)).map(wave).collect(), n, rate);
        assert_eq!(made.len(), n);
        assert!((made[0] - made[n - 1]).abs() < 0.011 + 0.01, "{} after {}", made[0], made[n - 1]);
        // A grating with whole periods in the loop keeps its level.
        let grating = |i: usize| (0.1 * std::f32::consts::PI * i as f32).sin();
        let made = looped((0..n_for_loop(n, rate)).map(grating).collect(), n, rate);
        let highest = made.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
        assert!(highest < 1.01, "{highest}");
        // Noise has the same power at the seam as elsewhere, in the mean over many loops.
        let power = |from: usize, to: usize| -> f64 {
            let one = |seed: u64| {
                let noise = lcg_noise(n_for_loop(n, rate), seed).into_iter().map(|x| x as f32).collect();
                let made = looped(noise, n, rate);
                made[from..to].iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / (to - from) as f64
            };
            (1..40).map(one).sum::<f64>() / 39.0
        };
        assert!((power(0, 480) / power(1000, 4000) - 1.0).abs() < 0.05);
        // A wave that does not fit into the loop keeps its level over the seam, unless it is nearly opposite.
        let half_period_powers = |made: &[f32]| -> Vec<f64> {
            made.chunks_exact(48)
                .map(|part| part.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>())
                .collect()
        };
        for turns in [0.1, 0.25, 0.4] {
            let per_sample = (50.0 + turns) / n as f64;
            let wave = |i: usize| (std::f64::consts::TAU * per_sample * i as f64).sin() as f32;
            let made = looped((0..n_for_loop(n, rate)).map(wave).collect(), n, rate);
            let step = |i: usize| (made[(i + 1) % n] - made[i]).abs();
            let highest_step = (0..n - 1).map(step).fold(0.0_f32, f32::max);
            assert!(
                step(n - 1) <= highest_step,
                "{turns}: {} at the wrap, {highest_step} elsewhere",
                step(n - 1)
            );
            // 24 is the sum of squares of half a period of a sine.
            for power in half_period_powers(&made) {
                assert!((10.0 * (power / 24.0).log10()).abs() < 1.0, "{turns}: {power}");
            }
        }
        // A loop that is shorter than two seams still works.
        assert_eq!(looped((0..n_for_loop(10, rate)).map(wave).collect(), 10, rate).len(), 10);
        assert!(looped(Vec::new(), 0, rate).is_empty());
    }
}
