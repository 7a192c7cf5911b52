//! Editing of spatial spectrograms: paint, erase, copy and paste, stretch.
//!
//! Painting changes the spectra of a profile and keeps their phases, so unpainted parts of the profile stay unchanged.
//! Stretching works on the spectrogram without phases, since phases depend on position.

use std::ops::Range;

use rustfft::num_complex::Complex;

use super::{Edges, Frames, Framing, SpatialSpectrogram, Spectra};

/// Largest gain of one brush stroke, in dB; larger gains are limited to it.
pub const MAX_GAIN_DB: f64 = 60.0;
/// Largest bin magnitude that a brush can produce, above that of any real profile.
const MAX_AMPLITUDE: f64 = 1e12;
/// Allowed stretch factors.
pub const STRETCHES: std::ops::RangeInclusive<f64> = 0.1..=10.0;

/// A brush that amplifies or attenuates the bins under it, with a soft edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Brush {
    /// Half-width along the profile, in m.
    pub radius_m: f64,
    /// Half-height, in octaves of spatial frequency.
    pub radius_octaves: f64,
    /// Gain at the center, in dB.
    pub gain_db: f64,
}

/// A region of a spectrogram: positions in m by spatial frequencies in 1/m.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Range of window centers, in m.
    pub places_m: Range<f64>,
    /// Range of spatial frequencies, in 1/m.
    pub per_m: Range<f64>,
}

/// A copied region: a range of frequencies from consecutive windows.
#[derive(Clone, Debug, PartialEq)]
pub struct Patch {
    first_bin: usize,
    /// Window by window.
    windows: Vec<Vec<Complex<f64>>>,
    framing: Framing,
    step_m: f64,
}

/// Reasons why a paste or stretch is not possible.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EditError {
    /// Framing or sample spacing differ.
    #[error(
        "the copied region has other windows or sample spacing than this spectrogram; copy a matching one"
    )]
    Windows,
    /// The stretch factor is out of range.
    #[error("the stretch factor is {factor}; use 0.1 to 10")]
    Factor {
        /// Given factor.
        factor: f64,
    },
}

impl Spectra {
    /// Applies a brush at a position in m and a spatial frequency in 1/m; samples are `step_m` apart.
    ///
    /// The brush multiplies, so silence stays silent. A gain that is not finite has no effect.
    pub fn paint(&mut self, brush: &Brush, step_m: f64, place_m: f64, per_m: f64) {
        if !brush.gain_db.is_finite() {
            return;
        }
        let gain_db = brush.gain_db.clamp(-MAX_GAIN_DB, MAX_GAIN_DB);
        let octave = per_m.log2();
        let places_m = place_m - brush.radius_m..place_m + brush.radius_m;
        self.each(step_m, &places_m, |at_m, at_per_m, bin| {
            let across = (at_m - place_m) / brush.radius_m;
            let up = (at_per_m.log2() - octave) / brush.radius_octaves;
            let distance = across.hypot(up);
            if distance < 1.0 {
                let share = 0.5 + 0.5 * (std::f64::consts::PI * distance).cos();
                let before = bin.norm();
                let most = if before > 0.0 { (MAX_AMPLITUDE / before).max(1.0) } else { 1.0 };
                *bin *= 10.0_f64.powf(0.05 * gain_db * share).min(most);
            }
        });
    }

    /// Sets all bins in a region to zero.
    pub fn erase(&mut self, region: &Region, step_m: f64) {
        self.each(step_m, &region.places_m, |_, at_per_m, bin| {
            if region.per_m.contains(&at_per_m) {
                *bin = Complex::ZERO;
            }
        });
    }

    /// Returns a copy of a region; `None` if it contains no window center or no frequency.
    pub fn copy(&self, region: &Region, step_m: f64) -> Option<Patch> {
        let framing = self.framing;
        let frames: Vec<usize> = (0..self.n_frames())
            .filter(|frame| region.places_m.contains(&(step_m * framing.center(*frame))))
            .collect();
        let bins: Vec<usize> = (0..framing.n_bins())
            .filter(|bin| region.per_m.contains(&per_m(*bin, framing.window(), step_m)))
            .collect();
        let (first, last, first_bin, last_bin) =
            (*frames.first()?, *frames.last()?, *bins.first()?, *bins.last()?);
        let windows = self.frames().skip(first).take(last - first + 1);
        let windows = windows.map(|bins| bins[first_bin..=last_bin].to_vec()).collect();
        Some(Patch { first_bin, windows, framing, step_m })
    }

    /// Replaces bins by a copied patch, starting at the window nearest to a position in m.
    ///
    /// Parts of the patch beyond the end are discarded.
    ///
    /// # Errors
    /// [`EditError::Windows`] if framing or sample spacing differ.
    pub fn paste(&mut self, patch: &Patch, step_m: f64, place_m: f64) -> Result<(), EditError> {
        let framing = self.framing;
        // Spacings may differ by round-off.
        if patch.framing != framing || (patch.step_m / step_m - 1.0).abs() > 1e-6 {
            return Err(EditError::Windows);
        }
        let at = ((place_m / step_m - framing.center(0)) / framing.hop() as f64).round();
        // A position before the first window selects the first window.
        let first = at.max(0.0) as usize;
        for (to, from) in self.frames_mut().skip(first).zip(&patch.windows) {
            to[patch.first_bin..patch.first_bin + from.len()].copy_from_slice(from);
        }
        Ok(())
    }

    /// Calls `change` for every bin of the windows centered in a range, with position in m and frequency in 1/m.
    fn each(
        &mut self,
        step_m: f64,
        places_m: &Range<f64>,
        mut change: impl FnMut(f64, f64, &mut Complex<f64>),
    ) {
        let framing = self.framing;
        for (frame, bins) in self.frames_mut().enumerate() {
            let at_m = step_m * framing.center(frame);
            if !places_m.contains(&at_m) {
                continue;
            }
            for (k, bin) in bins.iter_mut().enumerate() {
                change(at_m, per_m(k, framing.window(), step_m), bin);
            }
        }
    }
}

impl SpatialSpectrogram {
    /// Returns the spectrogram stretched along the profile by a factor; spatial frequencies stay the same.
    ///
    /// # Errors
    /// [`EditError::Factor`] outside [`STRETCHES`].
    pub fn stretched(&self, factor: f64) -> Result<Self, EditError> {
        if !STRETCHES.contains(&factor) {
            return Err(EditError::Factor { factor });
        }
        let Frames { framing, n_samples, .. } = self.power;
        let hop = framing.hop();
        let wanted = factor * n_samples as f64;
        let n_samples = match framing.edges {
            Edges::Mirrored => (wanted.round() as usize).max(2),
            // A whole number of hops, and at least one window.
            Edges::Cut => ((wanted / hop as f64).round() as usize).max(framing.window() / hop) * hop,
        };
        let Ok(n_frames) = framing.n_frames(n_samples) else {
            return Err(EditError::Factor { factor });
        };
        let before: Vec<&[f64]> = self.power.frames().collect();
        let values = (0..n_frames).flat_map(|frame| {
            // Interpolated between the two windows whose centers surround the source position.
            let center = framing.center(frame) / factor;
            let at = ((center - framing.center(0)) / hop as f64).clamp(0.0, (before.len() - 1) as f64);
            let (low, share) = (at as usize, at.fract());
            let (a, b) = (before[low], before[(low + 1).min(before.len() - 1)]);
            a.iter().zip(b).map(move |(a, b)| {
                // Interpolates magnitudes rather than powers, as half the power is not half the perceived strength.
                ((1.0 - share) * a.max(0.0).sqrt() + share * b.max(0.0).sqrt()).powi(2)
            })
        });
        Ok(Self { power: Frames { framing, n_samples, values: values.collect() }, offset: self.offset })
    }
}

/// Returns the spatial frequency of a bin in 1/m.
fn per_m(bin: usize, window: usize, step_m: f64) -> f64 {
    bin as f64 / (window as f64 * step_m)
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::{Brush, EditError, Region};
    use crate::maths::statistics::correlation;
    use crate::signals::spatial_spectrogram::{
        Framing, SpatialSpectrogram, Spectra, Transform, profile_of, refine,
    };

    const STEP_M: f64 = 1e-5;
    const N: usize = 4000;

    fn transform() -> Transform {
        Transform::new(Framing::of_length(4e-3, STEP_M))
    }

    /// Sines of 1 and 0.25 mm wavelength (1000 and 4000 per m) on a constant.
    fn two_waves() -> Vec<f64> {
        let wave = |i: usize, per_m: f64| (TAU * per_m * STEP_M * i as f64).sin();
        (0..N).map(|i| 2.0 + 0.5 * wave(i, 1000.0) + 0.5 * wave(i, 4000.0)).collect()
    }

    /// Power of a profile near a spatial frequency, between two positions.
    fn power(profile: &[f64], places_m: (f64, f64), per_m: f64) -> f64 {
        let transform = transform();
        let power = transform.power(profile).unwrap();
        let framing = transform.framing();
        let bin = (per_m * framing.window() as f64 * STEP_M).round() as usize;
        let frames = power.frames().enumerate();
        let inside =
            frames.filter(|(frame, _)| (places_m.0..places_m.1).contains(&(STEP_M * framing.center(*frame))));
        inside.map(|(_, bins)| bins[bin - 1..=bin + 1].iter().sum::<f64>()).sum()
    }

    fn difference(a: &[f64], b: &[f64]) -> f64 {
        a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    }

    /// The two-sine profile after an edit.
    fn after(change: impl FnOnce(&mut Spectra)) -> Vec<f64> {
        let transform = transform();
        let mut spectra = transform.spectra(&two_waves()).unwrap();
        change(&mut spectra);
        transform.profile(&spectra)
    }

    #[test]
    fn a_brush_changes_what_is_under_it_and_nothing_else() {
        let (before, brush) = (two_waves(), Brush { radius_m: 6e-3, radius_octaves: 0.5, gain_db: 12.0 });
        let painted = after(|spectra| spectra.paint(&brush, STEP_M, 0.02, 4000.0));
        let ratio = |places_m, per_m| power(&painted, places_m, per_m) / power(&before, places_m, per_m);
        assert!((ratio((0.0195, 0.0205), 4000.0) / 10.0_f64.powf(1.2) - 1.0).abs() < 0.2);
        assert!((ratio((0.015, 0.025), 1000.0) - 1.0).abs() < 0.01);
        // Two windows beyond the edge of the brush, the profile is unchanged.
        let at = |m: f64| (m / STEP_M) as usize;
        assert!(difference(&painted[..at(0.01)], &before[..at(0.01)]) < 1e-12);
        assert!(difference(&painted[at(0.03)..], &before[at(0.03)..]) < 1e-12);
        // The opposite gain undoes the edit.
        let back = after(|spectra| {
            spectra.paint(&brush, STEP_M, 0.02, 4000.0);
            spectra.paint(&Brush { gain_db: -12.0, ..brush }, STEP_M, 0.02, 4000.0);
        });
        assert!(difference(&back, &before) < 1e-12);
        // Extreme gains keep the profile finite.
        let wild = after(|spectra| {
            for _ in 0..100 {
                spectra.paint(&Brush { gain_db: 1e9, ..brush }, STEP_M, 0.02, 4000.0);
            }
            spectra.paint(&Brush { gain_db: f64::NAN, ..brush }, STEP_M, 0.02, 4000.0);
        });
        assert!(wild.iter().all(|x| x.is_finite()));
    }

    #[test]
    fn what_is_erased_is_not_in_the_profile_any_more() {
        let all = -1.0..1.0;
        let high = Region { places_m: all.clone(), per_m: 3000.0..5000.0 };
        let (before, left) = (two_waves(), after(|spectra| spectra.erase(&high, STEP_M)));
        let of = |per_m| power(&left, (0.01, 0.03), per_m) / power(&before, (0.01, 0.03), per_m);
        assert!(of(4000.0) < 1e-6 && (of(1000.0) - 1.0).abs() < 1e-3, "{} {}", of(4000.0), of(1000.0));
        let nothing = after(|spectra| spectra.erase(&Region { places_m: all, per_m: 0.0..1e9 }, STEP_M));
        assert!(nothing.iter().all(|x| *x == 0.0));
    }

    #[test]
    fn what_is_copied_is_pasted_as_it_was() {
        let high = Region { places_m: 0.005..0.015, per_m: 3000.0..5000.0 };
        let everywhere = Region { places_m: -1.0..1.0, ..high.clone() };
        let hop_m = STEP_M * transform().framing().hop() as f64;
        let begin = (0.005 / hop_m).ceil() * hop_m;
        let pasted = after(|spectra| {
            let patch = spectra.copy(&high, STEP_M).unwrap();
            spectra.erase(&everywhere, STEP_M);
            spectra.paste(&patch, STEP_M, begin + 5.0 * hop_m).unwrap();
        });
        // A sine with a whole number of periods per hop is identical five hops later, phase included.
        let fine = |profile: &[f64]| -> Vec<f64> {
            let transform = transform();
            let mut spectra = transform.spectra(profile).unwrap();
            spectra.erase(&Region { places_m: -1.0..1.0, per_m: 0.0..3000.0 }, STEP_M);
            transform.profile(&spectra)
        };
        let inside = |profile: &[f64]| fine(profile)[1700..2300].to_vec();
        let same = correlation(&inside(&pasted), &inside(&two_waves())).unwrap();
        assert!(same > 0.999, "{same}");
        let before = (0.003, 0.009);
        assert!(power(&pasted, before, 4000.0) < 1e-6 * power(&two_waves(), before, 4000.0));
    }

    #[test]
    fn pastes_beyond_the_ends_are_cut_and_those_of_other_windows_refused() {
        let transform = transform();
        let mut spectra = transform.spectra(&two_waves()).unwrap();
        let part = Region { places_m: 0.005..0.01, per_m: 3000.0..5000.0 };
        let patch = spectra.copy(&part, STEP_M).unwrap();
        let n_windows = spectra.n_frames();
        for place_m in [0.0399, 1.0, -1.0] {
            let before = spectra.clone();
            spectra.paste(&patch, STEP_M, place_m).unwrap();
            assert_eq!(spectra.n_frames(), n_windows);
            assert_eq!(spectra == before, place_m == 1.0, "only a paste beyond the end leaves it unchanged");
        }
        assert!(spectra.copy(&Region { places_m: 2.0..3.0, ..part.clone() }, STEP_M).is_none());
        assert!(spectra.copy(&Region { per_m: 1e9..2e9, ..part }, STEP_M).is_none());
        let other = Transform::new(Framing::of_length(1e-3, STEP_M));
        let mut other = other.spectra(&vec![0.5; N]).unwrap();
        assert_eq!(other.paste(&patch, STEP_M, 0.0), Err(EditError::Windows));
        assert_eq!(spectra.paste(&patch, 2.0 * STEP_M, 0.0), Err(EditError::Windows));
    }

    #[test]
    fn what_is_stretched_lasts_longer_at_its_frequencies() {
        let transform = transform();
        // The short sine ends in the middle.
        let half = after(|spectra| {
            spectra.erase(&Region { places_m: 0.02..1.0, per_m: 3000.0..5000.0 }, STEP_M);
        });
        let spectrogram = SpatialSpectrogram::of(&half, &transform).unwrap();
        let (before, end_m) = (power(&half, (0.0, 0.04), 4000.0), 0.04);
        for factor in [0.5, 1.7, 3.0] {
            let stretched = spectrogram.stretched(factor).unwrap();
            // Staircase phases attenuate sustained sines; refinement restores their level.
            let made = refine(&stretched, &profile_of(&stretched, &transform), 32).unwrap();
            assert_eq!(made.len(), stretched.power().n_samples());
            assert!((made.len() as f64 / (factor * N as f64) - 1.0).abs() < 1e-3);
            let after = power(&made, (0.0, factor * end_m), 4000.0);
            assert!((after / before / factor - 1.0).abs() < 0.25, "{after} of {before} at {factor}");
            let late = power(&made, (factor * 0.024, factor * 0.036), 4000.0);
            assert!(late < 0.05 * after, "{late} of {after}");
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
