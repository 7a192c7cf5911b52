//! Random materials drawn from classes of everyday surfaces, for unlimited training data with known labels.
//!
//! Each material gives a picture with known physical roughness and hardness. A class sets a range for each parameter of
//! [`Material`]. Moduli are handbook orders of magnitude and appearance is typical for such surfaces. The other ranges
//! are wider than any single material of the class. No drawn material is in the starter library.

mod classes;
pub mod palette;
mod table;

pub use crate::surfaces::random_material::classes::Class;
pub use crate::surfaces::random_material::table::CLASSES;

use crate::maths::rng::{Random, derive_seed};
use crate::surfaces::material::{Bumps, Material, Pattern, cover, validate};
use crate::surfaces::random_material::classes::{Amplitude, PatternClass, ScatterClass};

/// Smallest and largest value of a parameter.
pub type Range = (f64, f64);

/// Largest coverage drawn for scattered bumps, as [`validate`] counts it; [`validate`] allows slightly more.
const MOST_COVER: f64 = 8.0;

/// Returns material `number` and its class; deterministic for a seed.
pub fn draw(seed: u64, number: u64) -> (Material, &'static Class) {
    let id = format!("drawn-{number}");
    let mut random = Random::new(derive_seed(seed, &id));
    let class = choose(&mut random);
    let mut draw = Draw { random };
    let height_rms_m = draw.spread(class.heights_m);
    let period_m = class.pattern.as_ref().map(|pattern| draw.spread(pattern.periods_m));
    let pattern = class
        .pattern
        .as_ref()
        .zip(period_m)
        .map(|(class, period_m)| draw.pattern(class, period_m, height_rms_m));
    let bumps = class.scatters.iter().map(|scatter| draw.bumps(scatter, height_rms_m)).collect();
    let (valley_srgb, peak_srgb) = draw.colors(class);
    let modulus = draw.random.log_normal(class.modulus_spread);
    let mottle = if draw.random.uniform() < class.mottled_share { draw.between(class.mottle) } else { 0.0 };
    let material = Material {
        id,
        name: format!("{} {number}", class.name),
        tags: Vec::new(),
        youngs_modulus_pa: class.modulus_pa * modulus,
        height_rms_m,
        hurst: draw.between(class.hurst),
        roll_off_m: draw.spread(class.roll_offs_m),
        stretch: draw.spread(class.stretch),
        pattern,
        bumps,
        friction_coefficient: draw.between(class.friction),
        friction_heterogeneity: draw.between(class.heterogeneity),
        stick_slip: None,
        patch_share: draw.between(class.patch_share),
        contact_damping_ratio: class.damping_ratio,
        load_exponent: draw.between(class.load_exponent),
        valley_srgb,
        peak_srgb,
        gloss: draw.between(class.gloss).max(0.0),
        metallic: draw.between(class.metallic),
        mottle,
        mottle_scale_m: draw.spread(class.mottle_scales_m),
    };
    debug_assert_eq!(validate(&material), Ok(()), "a class draws an invalid material");
    (material, class)
}

fn choose(random: &mut Random) -> &'static Class {
    let total: f64 = CLASSES.iter().map(|class| class.weight).sum();
    let mut left = random.uniform() * total;
    for class in CLASSES {
        left -= class.weight;
        if left < 0.0 {
            return class;
        }
    }
    &CLASSES[CLASSES.len() - 1]
}

struct Draw {
    random: Random,
}

impl Draw {
    /// Uniform between the bounds.
    fn between(&mut self, (low, high): Range) -> f64 {
        low + (high - low) * self.random.uniform()
    }

    /// Log-uniform between the bounds.
    fn spread(&mut self, (low, high): Range) -> f64 {
        self.between((low.ln(), high.ln())).exp()
    }

    fn pattern(&mut self, class: &PatternClass, period_m: f64, height_rms_m: f64) -> Pattern {
        let kind = class.kinds[self.random.below(class.kinds.len())];
        let amplitude_m = match class.amplitude {
            Amplitude::Meters(range) => self.spread(range),
            Amplitude::OfHeight(range) => self.between(range) * height_rms_m,
            Amplitude::OfPeriod(range) => self.between(range) * period_m,
        };
        Pattern { kind, period_m, amplitude_m, jitter: self.between(class.jitter) }
    }

    fn bumps(&mut self, class: &ScatterClass, height_rms_m: f64) -> Bumps {
        let radius_m = self.spread(class.radii_m);
        let elongation = self.between(class.elongation);
        let height = self.between(class.heights);
        // Sandpaper grains are about as high as wide; all other bumps scale with the height of the fractal part.
        let height_m = if class.is_of_radius { height * radius_m } else { height * height_rms_m };
        let sign = if self.random.uniform() < class.pits_share { -1.0 } else { 1.0 };
        let spread_rad = self.between(class.spread_rad);
        let one = Bumps { height_m: sign * height_m, radius_m, elongation, spread_rad, density_per_m2: 1.0 };
        let most = MOST_COVER / cover(&one);
        Bumps { density_per_m2: self.spread(class.densities_per_m2).min(most), ..one }
    }

    /// Returns the colors of valleys and peaks.
    fn colors(&mut self, class: &Class) -> ([u8; 3], [u8; 3]) {
        let palette = class.palettes[self.random.below(class.palettes.len())];
        let peak = palette.draw(&mut self.random);
        if self.random.uniform() < class.two_colored_share {
            let valley = palette::Palette::Any.draw(&mut self.random);
            return (valley.srgb(), peak.srgb());
        }
        let darker = 1.0 - class.contrast * self.between((0.6, 1.3));
        (peak.darkened(darker, &mut self.random).srgb(), peak.srgb())
    }
}

#[cfg(test)]
mod tests {
    use super::{CLASSES, draw};
    use crate::surfaces::material::validate;
    use std::collections::BTreeMap;

    #[test]
    fn a_thousand_are_valid_differ_and_are_the_same_again() {
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for number in 0..1000 {
            let (material, class) = draw(7, number);
            assert_eq!(validate(&material), Ok(()), "{}", class.name);
            assert_eq!(draw(7, number).0, material);
            *counts.entry(class.name).or_default() += 1;
        }
        assert_ne!(draw(7, 3).0.height_rms_m, draw(8, 3).0.height_rms_m);
        assert_ne!(draw(7, 3).0.height_rms_m, draw(7, 4).0.height_rms_m);
        let total: f64 = CLASSES.iter().map(|class| class.weight).sum();
        for class in CLASSES {
            let (expected, n) = (1000.0 * class.weight / total, counts[class.name] as f64);
            // Within five standard deviations of a Poisson count.
            assert!((n - expected).abs() < 5.0 * expected.sqrt(), "{}: {n} for {expected}", class.name);
        }
    }

    #[test]
    fn classes_are_ranges() {
        for class in CLASSES {
            let ranges = [
                class.heights_m,
                class.hurst,
                class.roll_offs_m,
                class.stretch,
                class.friction,
                class.heterogeneity,
                class.patch_share,
                class.load_exponent,
                class.gloss,
                class.metallic,
                class.mottle,
                class.mottle_scales_m,
            ];
            assert!(ranges.iter().all(|(low, high)| low <= high), "{}", class.name);
            assert!(!class.palettes.is_empty() && class.weight > 0.0);
        }
    }
}
