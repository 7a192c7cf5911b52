//! What the plots of a texture show, worked out once.

use std::sync::Arc;

use shagreen_core::plane::Plane;
use shagreen_core::texture::TextureModel;
use shagreen_core::units::{Contact, Hertz, MetersPerSecond, Newtons};

/// Places along each side at which levels are drawn.
pub(super) const SIDE: usize = 33;
/// Speeds whose spectra are drawn, at most.
const MOST_SPEEDS: usize = 5;
/// Frequencies at which a spectrum is drawn, and the lowest of them in Hz.
const N_FREQUENCIES: usize = 120;
const LOWEST_HZ: f64 = 10.0;
/// Half the rate, a little less: beyond it a model only repeats itself.
const BELOW_NYQUIST: f64 = 0.4995;
/// Levels that are told apart by color, in dB below the highest.
const RANGE_DB: f64 = 40.0;
/// What counts as no vibration at all, in m/s².
const LEAST_MPS2: f64 = 1e-9;

/// Levels and spectra of a texture.
pub(super) struct Curves {
    plane: Arc<Plane>,
    /// The highest speed and force.
    pub(super) highest: Contact,
    /// Lowest and highest level that is drawn, in dB re 1 m/s².
    pub(super) range_db: (f64, f64),
    /// Levels as shares of that range, [`SIDE`] × [`SIDE`]: from zero speed and force on, speed by speed.
    pub(super) levels: Vec<f32>,
    /// The force of the spectra.
    pub(super) middle_force_n: f64,
    /// The speeds of the spectra, from slow to fast.
    pub(super) speeds_mm_per_s: Vec<f64>,
    /// Where they are evaluated.
    pub(super) frequencies: Vec<Hertz>,
    /// A density in (m/s²)²/Hz for each speed.
    pub(super) spectra: Vec<Vec<f64>>,
}

impl Curves {
    /// Levels and spectra on a plane, over the speeds and forces that its model knows. Cost: some thousand times that of one
    /// grain.
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

    /// Whether they are of this plane.
    pub(super) fn are_of(&self, plane: &Arc<Plane>) -> bool {
        Arc::ptr_eq(&self.plane, plane)
    }

    /// The level at a contact, in m/s².
    pub(super) fn level_mps2(&self, contact: Contact) -> f64 {
        self.plane.at(contact).level_mps2
    }
}

/// Of speeds above zero each once, from slow to fast; where there are more than [`MOST_SPEEDS`], so many evenly among them.
fn shown_speeds(speeds: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut speeds: Vec<f64> = speeds.filter(|speed| *speed > 0.0).collect();
    speeds.sort_by(f64::total_cmp);
    // Speeds that read the same are the same here.
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
    use shagreen_core::plane::Plane;
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

    /// The levels that are drawn are those of the plane, and nothing sounds on the axes.
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
