//! Levels of a rendered signal.

use shagreen_core::dsp::spectrum::median;

/// Length of the windows of [`contact_level`], in seconds.
pub const WINDOW_SECS: f64 = 0.1;
/// Points of a window at which contact is checked, without its end.
const CHECKS: u32 = 10;

/// Level and peak of a whole signal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Levels {
    /// Root mean square, in the unit of the samples.
    pub rms: f64,
    /// Highest absolute value, in the unit of the samples.
    pub peak: f64,
}

/// Returns level and peak of a signal; zero for an empty one.
pub fn levels(samples: &[f32]) -> Levels {
    // Accumulated here: a copy of one hour in `f64` would need gigabytes.
    let wide = samples.iter().map(|sample| f64::from(*sample));
    let peak = wide.clone().fold(0.0, |peak: f64, sample| peak.max(sample.abs()));
    let rms = (wide.map(|sample| sample * sample).sum::<f64>() / samples.len().max(1) as f64).sqrt();
    Levels { rms, peak }
}

/// Returns the level of a texture in contact: the median of the root mean squares of all windows of [`WINDOW_SECS`] during
/// which the tip touches. `None` if there is no such window. The median is that of the usual motion: single events, such
/// as the vibration of one fast movement, do not change it.
pub fn contact_level(samples: &[f32], rate_hz: u32, is_touching: impl Fn(f64) -> bool) -> Option<f64> {
    let n_window = (WINDOW_SECS * f64::from(rate_hz)).round().max(1.0) as usize;
    let touches = |window: usize| {
        let begin_secs = (window * n_window) as f64 / f64::from(rate_hz);
        (0..=CHECKS).all(|i| is_touching(begin_secs + f64::from(i) * WINDOW_SECS / f64::from(CHECKS)))
    };
    let windows = samples.chunks_exact(n_window).enumerate().filter(|(window, _)| touches(*window));
    let rms: Vec<f64> = windows.map(|(_, window)| levels(window).rms).collect();
    (!rms.is_empty()).then(|| median(rms))
}

#[cfg(test)]
mod tests {
    use super::{Levels, contact_level, levels};

    #[test]
    fn level_and_peak_are_those_of_the_samples() {
        assert_eq!(levels(&[3.0, -4.0]), Levels { rms: 12.5_f64.sqrt(), peak: 4.0 });
        assert_eq!(levels(&[]), Levels::default());
    }

    #[test]
    fn the_level_in_contact_leaves_out_lifts_and_single_events() {
        // One second of a square wave of 2 m/s², with a strong event in one window and silence in the last half.
        let mut samples: Vec<f32> = (0..1000).map(|i| if i % 2 == 0 { 2.0 } else { -2.0 }).collect();
        samples[210] = 500.0;
        samples[500..].fill(0.0);
        assert_eq!(contact_level(&samples, 1000, |secs| secs < 0.5), Some(2.0));
        assert_eq!(contact_level(&samples, 1000, |_| false), None);
        // A window that is only partly in contact does not count, nor one that is not complete.
        assert_eq!(contact_level(&samples, 1000, |secs| secs < 0.09), None);
        assert_eq!(contact_level(&samples[..99], 1000, |_| true), None);
        assert_eq!(contact_level(&samples[..400], 1000, |_| true), Some(2.0));
    }
}
