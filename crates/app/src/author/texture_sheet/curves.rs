//! Data of the plots of a texture, computed once.

use std::sync::Arc;

use shagreen_core::texture::TextureModel;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Number of grid points along each axis of the level map.
pub(super) const SIDE: usize = 33;
/// Maximum number of speeds whose spectra are drawn.
const MOST_SPEEDS: usize = 5;
/// Number of frequencies of a spectrum, and the lowest of them in Hz.
const N_FREQUENCIES: usize = 120;
const LOWEST_HZ: f64 = 10.0;
/// Highest frequency, as a share of the sample rate: just below Nyquist, above which the spectrum of a model repeats.
const BELOW_NYQUIST: f64 = 0.4995;
/// Range of the level map, in dB below the highest level.
const RANGE_DB: f64 = 40.0;
/// Level that counts as no vibration, in m/s².
const LEAST_MPS2: f64 = 1e-9;

/// Level map and spectra of a texture.
pub(super) struct Curves {
    plane: Arc<Plane>,
    /// Highest speed and force of the model.
    pub(super) highest: Contact,
    /// Lowest and highest level of the map, in dB re 1 m/s².
    pub(super) range_db: (f64, f64),
    /// Levels as shares of that range, [`SIDE`] × [`SIDE`], from zero speed and force upwards. The speed varies
    /// fastest.
    pub(super) levels: Vec<f32>,
    /// Normal force of the spectra, in N.
    pub(super) middle_force_n: f64,
    /// Tip speeds of the spectra in mm/s, ascending.
    pub(super) speeds_mm_per_s: Vec<f64>,
    pub(super) frequencies: Vec<Hertz>,
    /// PSD in (m/s²)²/Hz for each speed.
    pub(super) spectra: Vec<Vec<f64>>,
}

impl Curves {
    /// Computes levels and spectra of a plane over the range of speed and force of its model. Cost: about [`SIDE`]²
    /// evaluations of the plane.
    pub(super) fn new(plane: &Arc<Plane>, model: &TextureModel) -> Self {
        let highest = Contact { speed: model.speed_max(), force: model.force_max() };
        let share = |i: usize| i as f64 / (SIDE - 1) as f64;
        let contact = |i: usize| Contact {
            speed: MetersPerSecond(share(i % SIDE) * highest.speed.0),
            force: Newtons(share(i / SIDE) * highest.force.0),
        };
        let level_db = |i: usize| 20.0 * plane.at(contact(i)).level_mps2.max(LEAST_MPS2).log10();
        let levels_db: Vec<f64> = (0..SIDE * SIDE).map(level_db).collect();
        let high_db = levels_db.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let range_db = (high_db - RANGE_DB, high_db);
        let levels = levels_db.iter().map(|db| ((db - range_db.0) / RANGE_DB).max(0.0) as f32).collect();
        let forces = model.contacts().map(|c| c.force.0).filter(|force| *force > 0.0);
        let middle_force_n = 0.5 * (forces.fold(highest.force.0, f64::min) + highest.force.0);
        let speeds_mm_per_s = shown_speeds(model.contacts().map(|c| c.speed.mm_per_s()));
        let low_high = BELOW_NYQUIST * model.rate().0 / LOWEST_HZ;
        let frequency = |i: usize| Hertz(LOWEST_HZ * low_high.powf(i as f64 / (N_FREQUENCIES - 1) as f64));
        let frequencies: Vec<Hertz> = (0..N_FREQUENCIES).map(frequency).collect();
        let at = |speed: &f64| plane.at(Contact::from_mm_per_s_and_n(*speed, middle_force_n));
        let spectra = speeds_mm_per_s.iter().map(|speed| at(speed).psd(&frequencies)).collect();
        Self {
            plane: Arc::clone(plane),
            highest,
            range_db,
            levels,
            middle_force_n,
            speeds_mm_per_s,
            frequencies,
            spectra,
        }
    }

    /// Whether the data was computed from this very plane.
    pub(super) fn are_of(&self, plane: &Arc<Plane>) -> bool {
        Arc::ptr_eq(&self.plane, plane)
    }

    /// Level at a contact, in m/s².
    pub(super) fn level_mps2(&self, contact: Contact) -> f64 {
        self.plane.at(contact).level_mps2
    }
}

/// Distinct speeds above zero, ascending. If there are more than [`MOST_SPEEDS`], that many of them, evenly spaced by
/// index.
fn shown_speeds(speeds: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut speeds: Vec<f64> = speeds.filter(|speed| *speed > 0.0).collect();
    speeds.sort_by(f64::total_cmp);
    // Speeds with the same displayed number count as one.
    speeds.dedup_by_key(|speed| speed.round());
    if speeds.len() <= MOST_SPEEDS {
        return speeds;
    }
    (0..MOST_SPEEDS).map(|i| speeds[i * (speeds.len() - 1) / (MOST_SPEEDS - 1)]).collect()
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Curves, SIDE, shown_speeds};
    use shagreen_core::texture::plane::Plane;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn speeds_go_from_slow_to_fast_and_are_five_at_most() {
        for (speeds, expected) in [
            (&[100.0, 20.0, 100.2, 0.0][..], &[20.0, 100.0][..]),
            (&[7.0, 6.0, 5.0, 4.0, 3.0, 2.0, 1.0], &[1.0, 2.0, 4.0, 5.0, 7.0]),
            (&[], &[]),
        ] {
            assert_eq!(shown_speeds(speeds.iter().copied()), expected);
        }
    }

    /// The drawn levels are those of the plane, and the level on the axes is zero.
    #[test]
    fn levels_and_spectra_are_those_of_the_plane() {
        let library = starter_library().unwrap();
        let model = &library.textures[0].model;
        let plane = Arc::new(Plane::new(model));
        let curves = Curves::new(&plane, model);
        assert!(curves.are_of(&plane) && !curves.are_of(&Arc::new(Plane::new(model))));
        assert!(curves.levels[..SIDE].iter().all(|share| *share == 0.0), "no force, no vibration");
        let loudest = curves.levels.iter().copied().fold(0.0, f32::max);
        assert!((loudest - 1.0).abs() < 1e-6, "{loudest}");
        let corner_db = 20.0 * curves.level_mps2(curves.highest).log10();
        let share = (corner_db - curves.range_db.0) / (curves.range_db.1 - curves.range_db.0);
        assert!((f64::from(curves.levels[SIDE * SIDE - 1]) - share).abs() < 1e-6);
        assert_eq!(curves.spectra.len(), curves.speeds_mm_per_s.len());
        assert!((2..=5).contains(&curves.spectra.len()));
        assert!(curves.spectra.iter().flatten().all(|density| *density > 0.0));
    }
}
