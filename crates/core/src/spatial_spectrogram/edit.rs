//! Painting over spatial spectrograms: louder and softer, away, here and there, longer and shorter.
//!
//! The local mean, frequency zero, is left alone by brush, eraser and paste, and stretched with the rest: its steps tell the
//! phases of everything else.

use std::ops::Range;

use super::{Edges, Frames, Framing, SpatialSpectrogram};

/// Most that one touch of a brush changes, in dB: more counts as this.
pub const MAX_GAIN_DB: f64 = 60.0;
/// Highest power that a brush makes: the square of what no profile has.
const MAX_POWER: f64 = 1e24;
/// Factors by which a spectrogram may be stretched.
pub const STRETCHES: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// A brush that makes what is under it louder or softer, softly at its rim.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Half its width along the profile, in m.
    pub radius_m: f64,
    /// Half its height, in octaves of spatial frequency.
    pub radius_octaves: f64,
    /// What becomes of the power in its middle, in dB.
    pub gain_db: f64,
}

/// A part of a spectrogram: places in m by spatial frequencies in 1/m.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Places of the middles of windows.
    pub places_m: Range<f64>,
    /// Spatial frequencies; zero is never part of it.
    pub per_m: Range<f64>,
}

/// What was copied: power, window by window, of neighboring frequencies.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    first_bin: usize,
    /// Window after window.
    power: Vec<Vec<f64>>,
    framing: Framing,
    step_m: f64,
}

/// Why something cannot be pasted or stretched.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// Windows of another width, other steps, or samples at another distance.
    #[error(
        "what was copied has other windows or another distance of samples than this spectrogram; copy it from one like it"
    )]
    Windows,
    /// A factor beyond reason.
    #[error("a spectrogram can be stretched by 0.1 to 10 times, not by {factor}")]
    Factor {
        /// The factor.
        factor: f64,
    },
}

impl SpatialSpectrogram {
    /// One touch of a brush at a place in m and a spatial frequency in 1/m, on samples of a distance in m. Nothing becomes of
    /// what is not there: a gain of silence is silence.
    pub fn paint(&mut self, brush: &Brush, step_m: f64, place_m: f64, per_m: f64) {
        if !brush.gain_db.is_finite() {
            return;
        }
        let gain_db = brush.gain_db.clamp(-MAX_GAIN_DB, MAX_GAIN_DB);
        let octave = per_m.log2();
        self.each(step_m, |at_m, at_per_m, power| {
            let across = (at_m - place_m) / brush.radius_m;
            let up = (at_per_m.log2() - octave) / brush.radius_octaves;
            let distance = across.hypot(up);
            if distance < 1.0 {
                let share = 0.5 + 0.5 * (std::f64::consts::PI * distance).cos();
                *power = (*power * 10.0_f64.powf(0.1 * gain_db * share)).min(MAX_POWER.max(*power));
            }
        });
    }

    /// Takes everything out of a region.
    pub fn erase(&mut self, region: &Region, step_m: f64) {
        self.each(step_m, |at_m, at_per_m, power| {
            if region.places_m.contains(&at_m) && region.per_m.contains(&at_per_m) {
                *power = 0.0;
            }
        });
    }

    /// What is in a region; `None` where there is no window, or no frequency.
    pub fn copy(&self, region: &Region, step_m: f64) -> Option<Patch> {
        let framing = self.power.framing;
        let frames: Vec<usize> = (0..self.power.n_frames())
            .filter(|frame| region.places_m.contains(&(step_m * framing.center(*frame))))
            .collect();
        let bins: Vec<usize> = (1..framing.n_bins())
            .filter(|bin| region.per_m.contains(&per_m(*bin, framing.window(), step_m)))
            .collect();
        let (first, last, first_bin, last_bin) =
            (*frames.first()?, *frames.last()?, *bins.first()?, *bins.last()?);
        let power = self.power.frames().skip(first).take(last - first + 1);
        let power = power.map(|bins| bins[first_bin..=last_bin].to_vec()).collect();
        Some(Patch { first_bin, power, framing, step_m })
    }

    /// Puts what was copied where its first window is the one nearest to a place in m, in the place of what is there; what
    /// reaches beyond the end is cut.
    ///
    /// # Errors
    /// [`EditError::Windows`].
    pub fn paste(&mut self, patch: &Patch, step_m: f64, place_m: f64) -> Result<(), EditError> {
        let framing = self.power.framing;
        // Lengths come from products.
        if patch.framing != framing || (patch.step_m / step_m - 1.0).abs() > 1e-6 {
            return Err(EditError::Windows);
        }
        let at = ((place_m / step_m - framing.center(0)) / framing.hop() as f64).round();
        // A place before the first window is the first.
        let first = at.max(0.0) as usize;
        for (to, from) in self.power.frames_mut().skip(first).zip(&patch.power) {
            to[patch.first_bin..patch.first_bin + from.len()].copy_from_slice(from);
        }
        Ok(())
    }

    /// The same spectra over a length that is so many times as long: what happens is drawn out, frequencies stay.
    ///
    /// # Errors
    /// [`EditError::Factor`].
    pub fn stretched(&self, factor: f64) -> Result<Self, EditError> {
        if !STRETCHES.contains(&factor) {
            return Err(EditError::Factor { factor });
        }
        let Frames { framing, n_samples, .. } = self.power;
        let hop = framing.hop();
        let wanted = factor * n_samples as f64;
        let n_samples = match framing.edges {
            Edges::Mirrored => (wanted.round() as usize).max(2),
            // A whole number of steps, of one window at least.
            Edges::Cut => ((wanted / hop as f64).round() as usize).max(framing.window() / hop) * hop,
        };
        let Ok(n_frames) = framing.n_frames(n_samples) else {
            return Err(EditError::Factor { factor });
        };
        let before: Vec<&[f64]> = self.power.frames().collect();
        let values = (0..n_frames).flat_map(|frame| {
            // Between the two windows whose middles lie around the place that this one comes from.
            let center = framing.center(frame) / factor;
            let at = ((center - framing.center(0)) / hop as f64).clamp(0.0, (before.len() - 1) as f64);
            let (low, share) = (at as usize, at.fract());
            let (a, b) = (before[low], before[(low + 1).min(before.len() - 1)]);
            a.iter().zip(b).map(move |(a, b)| {
                // Magnitudes, since half of a power is no half of what is felt.
                ((1.0 - share) * a.max(0.0).sqrt() + share * b.max(0.0).sqrt()).powi(2)
            })
        });
        Ok(Self { power: Frames { framing, n_samples, values: values.collect() }, offset: self.offset })
    }

    /// Every place in m and spatial frequency in 1/m but zero, with its power.
    fn each(&mut self, step_m: f64, mut change: impl FnMut(f64, f64, &mut f64)) {
        let framing = self.power.framing;
        for (frame, bins) in self.power.frames_mut().enumerate() {
            let at_m = step_m * framing.center(frame);
            for (bin, power) in bins.iter_mut().enumerate().skip(1) {
                change(at_m, per_m(bin, framing.window(), step_m), power);
            }
        }
    }
}

/// The spatial frequency of a bin in 1/m.
fn per_m(bin: usize, window: usize, step_m: f64) -> f64 {
    bin as f64 / (window as f64 * step_m)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::{Brush, EditError, Region};
    use crate::spatial_spectrogram::{Framing, SpatialSpectrogram, Transform, profile_of};

    const STEP_M: f64 = 1e-5;
    const N: usize = 4000;

    /// Two waves, of 1 and 0.25 mm, on a level: 1000 and 4000 in a meter.
    fn two_waves() -> (SpatialSpectrogram, Transform) {
        let wave = |i: usize, per_m: f64| (TAU * per_m * STEP_M * i as f64).sin();
        let profile: Vec<f64> = (0..N).map(|i| 2.0 + 0.5 * wave(i, 1000.0) + 0.5 * wave(i, 4000.0)).collect();
        let transform = Transform::new(Framing::of_length(4e-3, STEP_M));
        (SpatialSpectrogram::of(&profile, &transform).unwrap(), transform)
    }

    /// The power around a spatial frequency between two places.
    fn power(spectrogram: &SpatialSpectrogram, places_m: (f64, f64), per_m: f64) -> f64 {
        let framing = spectrogram.power().framing();
        let bin = (per_m * framing.window() as f64 * STEP_M).round() as usize;
        let frames = spectrogram.power().frames().enumerate();
        let inside =
            frames.filter(|(frame, _)| (places_m.0..places_m.1).contains(&(STEP_M * framing.center(*frame))));
        inside.map(|(_, bins)| bins[bin - 1..=bin + 1].iter().sum::<f64>()).sum()
    }

    #[test]
    fn a_brush_changes_what_is_under_it() {
        let (before, _) = two_waves();
        let mut after = before.clone();
        let brush = Brush { radius_m: 6e-3, radius_octaves: 0.5, gain_db: 12.0 };
        after.paint(&brush, STEP_M, 0.02, 4000.0);
        let ratio = |places_m, per_m| power(&after, places_m, per_m) / power(&before, places_m, per_m);
        assert!((ratio((0.0195, 0.0205), 4000.0) - 10.0_f64.powf(1.2)).abs() < 2.0);
        assert!((ratio((0.0, 0.013), 4000.0) - 1.0).abs() < 1e-12);
        assert!((ratio((0.0, 0.04), 1000.0) - 1.0).abs() < 1e-12);
        // The way back is the same way.
        after.paint(&Brush { gain_db: -12.0, ..brush }, STEP_M, 0.02, 4000.0);
        for (a, b) in after.power().frames().flatten().zip(before.power().frames().flatten()) {
            assert!((a - b).abs() <= 1e-9 * b.abs());
        }
    }

    #[test]
    fn what_is_erased_is_not_in_the_profile_any_more() {
        let (mut spectrogram, transform) = two_waves();
        let left = |spectrogram: &SpatialSpectrogram| {
            let made = profile_of(spectrogram, &transform);
            let again = SpatialSpectrogram::of(&made, &transform).unwrap();
            [1000.0, 4000.0].map(|per_m| power(&again, (0.01, 0.03), per_m))
        };
        let [low, high] = left(&spectrogram);
        spectrogram.erase(&Region { places_m: -1.0..1.0, per_m: 3000.0..5000.0 }, STEP_M);
        let [low_after, high_after] = left(&spectrogram);
        assert!(high_after < 1e-3 * high && (low_after / low - 1.0).abs() < 0.1, "{low_after} {high_after}");
        let level = |s: &SpatialSpectrogram| s.power().frames().map(|bins| bins[0]).sum::<f64>();
        assert!(level(&spectrogram) > 0.0, "the local mean stays");
    }

    #[test]
    fn what_is_copied_is_pasted() {
        let (mut spectrogram, _) = two_waves();
        let patch =
            spectrogram.copy(&Region { places_m: 0.005..0.01, per_m: 3000.0..5000.0 }, STEP_M).unwrap();
        let all = Region { places_m: -1.0..1.0, per_m: 3000.0..5000.0 };
        let there = power(&spectrogram, (0.0199, 0.0225), 4000.0);
        spectrogram.erase(&all, STEP_M);
        spectrogram.paste(&patch, STEP_M, 0.02).unwrap();
        assert!((power(&spectrogram, (0.0199, 0.0225), 4000.0) / there - 1.0).abs() < 1e-6);
        assert!(power(&spectrogram, (0.0, 0.0195), 4000.0) == 0.0);
        // Beyond the end it is cut, and before the beginning it begins there.
        for place_m in [0.0399, 1.0, -1.0] {
            spectrogram.paste(&patch, STEP_M, place_m).unwrap();
        }
        assert!(spectrogram.copy(&Region { places_m: 2.0..3.0, ..all }, STEP_M).is_none());
        let other = Transform::new(Framing::of_length(1e-3, STEP_M));
        let mut other = SpatialSpectrogram::of(&vec![0.5; N], &other).unwrap();
        assert_eq!(other.paste(&patch, STEP_M, 0.0), Err(EditError::Windows));
    }

    #[test]
    fn what_is_stretched_lasts_longer_at_its_frequencies() {
        let (mut spectrogram, transform) = two_waves();
        // The short waves end in the middle.
        spectrogram.erase(&Region { places_m: 0.02..1.0, per_m: 3000.0..5000.0 }, STEP_M);
        let (before, end_m) = (power(&spectrogram, (0.0, 0.04), 4000.0), 0.04);
        for factor in [0.5, 1.7, 3.0] {
            let stretched = spectrogram.stretched(factor).unwrap();
            assert!((stretched.power().n_samples() as f64 / (factor * N as f64) - 1.0).abs() < 1e-3);
            let after = power(&stretched, (0.0, factor * end_m), 4000.0);
            assert!((after / before / factor - 1.0).abs() < 0.1, "{after} of {before} at {factor}");
            let late = power(&stretched, (factor * 0.024, factor * 0.036), 4000.0);
            assert!(late < 0.02 * after, "{late} of {after}");
            let made = profile_of(&stretched, &transform);
            assert_eq!(made.len(), stretched.power().n_samples());
            assert!(made.iter().all(|x| x.is_finite()));
        }
        for factor in [0.0, 11.0, f64::NAN] {
            assert!(matches!(spectrogram.stretched(factor), Err(EditError::Factor { .. })));
        }
        let same = spectrogram.stretched(1.0).unwrap();
        for (a, b) in same.power().frames().flatten().zip(spectrogram.power().frames().flatten()) {
            assert!((a - b).abs() <= 1e-12 * b.abs());
        }
    }
}
