//! Reasons to doubt attributes predicted from a picture: the picture shows no surface, or not clearly.
//!
//! Doubts of the pixels come from the energy of details by size (Haar wavelets). The others come from what a model
//! predicts. Each doubt widens the standard deviation of a prediction.

use crate::surfaces::picture_features::{Square, detail_energies};
use crate::surfaces::prompt::OPEN;

/// RMS of luma in details of up to 16 pixels, 0 to 1, below which a picture shows no detail: one step of 8 bits. The noise of
/// a camera is less in a picture that is reduced to the square.
const LEAST_DETAIL: f64 = 1.0 / 255.0;
/// Number of detail sizes of [`LEAST_DETAIL`]: larger details are also those of the light.
const N_SIZES_OF_DETAIL: usize = 4;
/// Energy of details of 2 pixels below which a picture is blurred, in dB relative to details of 8 to 32 pixels. A sharp
/// picture whose power falls with the square of the frequency has about -5 dB; Gaussian blur of 2 pixels lowers that to
/// about -18 dB. A small picture that is enlarged to the square counts as blurred, too.
const LEAST_SHARPNESS_DB: f64 = -15.0;
/// Distance from the training pictures above which a picture is unlike them, relative to the distance that 95 % of the
/// pictures that are left out of the training do not exceed.
const MOST_UNLIKE: f64 = 1.25;
/// Probability of the most likely material below which no material is clear.
const LEAST_PROBABILITY: f64 = 0.2;

/// Reason to doubt a prediction from a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PictureDoubt {
    /// The picture has almost no detail, such as that of a gray card.
    NoDetail,
    /// The picture has little fine detail, compared with its coarse detail.
    Blurred,
    /// The picture differs from all training pictures, such as that of a face or a page of text.
    UnlikeTraining,
    /// No material is much more likely than others.
    NoClearMaterial,
}

impl PictureDoubt {
    /// Returns the doubt as a short sentence without a period.
    pub fn words(self) -> &'static str {
        match self {
            Self::NoDetail => "the picture shows almost no detail",
            Self::Blurred => "the picture is blurred",
            Self::UnlikeTraining => "the picture is unlike all training pictures",
            Self::NoClearMaterial => "no material can be recognized clearly",
        }
    }

    /// Fraction of the way to the variance of an unknown attribute by which the doubt widens a prediction, 0 to 1.
    fn widening(self) -> f64 {
        match self {
            Self::NoDetail => 0.8,
            Self::UnlikeTraining => 0.5,
            Self::Blurred => 0.3,
            Self::NoClearMaterial => 0.1,
        }
    }
}

/// Amount of detail in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Detail {
    /// RMS of luma in details of 2 to 16 pixels of the central square, 0 to 1.
    pub rms: f64,
    /// Energy of details of 2 pixels, in dB relative to details of 8 to 32 pixels; 0 without such details.
    pub sharpness_db: f64,
}

impl Detail {
    /// Measures the detail of a picture.
    pub fn of(square: &Square) -> Self {
        let energies = detail_energies(square);
        // The sum of the energies is four times the variance.
        let rms = (0.25 * energies.iter().take(N_SIZES_OF_DETAIL).sum::<f64>()).sqrt();
        let (fine, coarse) = (energies.iter().take(1).sum::<f64>(), energies.iter().skip(2).sum::<f64>());
        let sharpness_db = if coarse > 0.0 { 10.0 * (fine / coarse).max(1e-12).log10() } else { 0.0 };
        Self { rms, sharpness_db }
    }

    /// Returns the doubt about a picture with this detail. Whether a picture without detail is sharp cannot be known.
    pub fn doubt(self) -> Option<PictureDoubt> {
        if self.rms < LEAST_DETAIL {
            Some(PictureDoubt::NoDetail)
        } else {
            (self.sharpness_db < LEAST_SHARPNESS_DB).then_some(PictureDoubt::Blurred)
        }
    }
}

/// Returns the doubt about a picture that lies `unlikeness` (0 or more) from the training pictures; 1 is the distance that
/// 95 % of the pictures that were left out of the training do not exceed.
pub fn doubt_of_unlikeness(unlikeness: f64) -> Option<PictureDoubt> {
    (unlikeness > MOST_UNLIKE).then_some(PictureDoubt::UnlikeTraining)
}

/// Returns the doubt about a picture with these probabilities of materials, 0 to 1.
pub fn doubt_of_materials(probabilities: &[f64]) -> Option<PictureDoubt> {
    let most = probabilities.iter().copied().fold(0.0, f64::max);
    (most < LEAST_PROBABILITY).then_some(PictureDoubt::NoClearMaterial)
}

/// Returns the standard deviation of a prediction, in points of 0 to 100, after these doubts. Each doubt moves the
/// variance part of the way to that of an unknown attribute ([`OPEN`]), which it never exceeds.
pub fn widened(deviation: f64, doubts: &[PictureDoubt]) -> f64 {
    let most = OPEN.deviation * OPEN.deviation;
    let known = (deviation * deviation).min(most);
    let left: f64 = doubts.iter().map(|doubt| 1.0 - doubt.widening()).product();
    (known + (1.0 - left) * (most - known)).sqrt()
}

#[cfg(test)]
mod tests {
    use super::{Detail, PictureDoubt, doubt_of_materials, doubt_of_unlikeness, widened};
    use crate::maths::rng::lcg_noise;
    use crate::surfaces::picture_features::{SIDE, Square};
    use crate::surfaces::prompt::OPEN;

    fn gray(value: impl Fn(usize, usize) -> f64) -> Square {
        let pixel = |i: usize| [value(i % SIDE, i / SIDE).clamp(0.0, 1.0) as f32; 3];
        Square { rgb: (0..SIDE * SIDE).flat_map(pixel).collect() }
    }

    /// Noise of equal power per octave, from grids of 2, 4, … 64 pixels whose values are interpolated linearly; the finest
    /// grids are left out.
    fn surface(finest: u32) -> Square {
        let noise = lcg_noise(SIDE * SIDE, 7);
        gray(|x, y| {
            let octave = |level: u32| {
                let cell = 2_usize.pow(level);
                let at = |i: usize, j: usize| noise[(j * 131 + i + 977 * level as usize) % noise.len()];
                let (i, j) = (x / cell, y / cell);
                let (u, v) = ((x % cell) as f64 / cell as f64, (y % cell) as f64 / cell as f64);
                let top = at(i, j) * (1.0 - u) + at(i + 1, j) * u;
                let bottom = at(i, j + 1) * (1.0 - u) + at(i + 1, j + 1) * u;
                top * (1.0 - v) + bottom * v
            };
            0.5 + 0.05 * (finest..=6).map(octave).sum::<f64>()
        })
    }

    #[test]
    fn detail_has_its_closed_form() {
        // Columns of two grays, each one pixel wide: all detail is horizontal and of the finest size.
        let columns = Detail::of(&gray(|x, _| if x % 2 == 0 { 0.4 } else { 0.6 }));
        assert!((columns.rms - 0.1).abs() < 1e-6, "{columns:?}");
        // Columns of 16 pixels: detail of 32 pixels alone, which is not counted.
        let wide = Detail::of(&gray(|x, _| if (x / 16) % 2 == 0 { 0.4 } else { 0.6 }));
        assert!(wide.rms < 1e-6 && wide.sharpness_db < -100.0, "{wide:?}");
    }

    #[test]
    fn a_gray_card_has_no_detail_in_uneven_light_and_with_noise() {
        let noise = lcg_noise(SIDE * SIDE, 3);
        for value in [0.02, 0.5, 0.98] {
            let card =
                gray(|x, y| value + 0.15 * (x as f64 / SIDE as f64 - 0.5) + 0.002 * noise[y * SIDE + x]);
            assert_eq!(Detail::of(&card).doubt(), Some(PictureDoubt::NoDetail), "{value}");
        }
        assert_eq!(Detail::of(&gray(|_, _| 0.5)).doubt(), Some(PictureDoubt::NoDetail));
    }

    #[test]
    fn a_surface_is_sharp_unless_its_fine_detail_is_missing() {
        let sharp = Detail::of(&surface(0));
        assert_eq!(sharp.doubt(), None, "{sharp:?}");
        let blurred = Detail::of(&surface(4));
        assert_eq!(blurred.doubt(), Some(PictureDoubt::Blurred), "{blurred:?}");
        assert!(blurred.sharpness_db < sharp.sharpness_db);
    }

    #[test]
    fn doubts_of_a_model_begin_at_their_limits() {
        assert_eq!(doubt_of_unlikeness(1.0), None);
        assert_eq!(doubt_of_unlikeness(1.3), Some(PictureDoubt::UnlikeTraining));
        assert_eq!(doubt_of_materials(&[0.1, 0.8, 0.1]), None);
        assert_eq!(doubt_of_materials(&[0.1; 10]), Some(PictureDoubt::NoClearMaterial));
        assert_eq!(doubt_of_materials(&[]), Some(PictureDoubt::NoClearMaterial));
    }

    #[test]
    fn doubts_widen_a_deviation_up_to_that_of_an_unknown_attribute() {
        let all = [
            PictureDoubt::NoDetail,
            PictureDoubt::Blurred,
            PictureDoubt::UnlikeTraining,
            PictureDoubt::NoClearMaterial,
        ];
        for deviation in [0.0, 5.0, 20.0, OPEN.deviation, 80.0] {
            let mut before = widened(deviation, &[]);
            assert!((before - deviation.min(OPEN.deviation)).abs() < 1e-9);
            for n in 1..=all.len() {
                let after = widened(deviation, &all[..n]);
                assert!(after >= before - 1e-9 && after <= OPEN.deviation + 1e-9, "{deviation}");
                before = after;
            }
        }
        assert!(widened(5.0, &[PictureDoubt::NoDetail]) > 0.85 * OPEN.deviation);
        assert!(all.iter().all(|doubt| !doubt.words().is_empty()));
    }
}
