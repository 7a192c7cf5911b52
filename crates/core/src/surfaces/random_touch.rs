//! Random materials under random tools: how well hardness can be told if the tool is not known.
//!
//! The material is that of [`draw`]. Tip radius and mass of the tool and the damping of the contact are drawn too, so that
//! a tap does not state the stiffness alone. The hardness label belongs to the material, under the tool of all labels
//! ([`PEN`]). Label and tap transient are nevertheless computed from the same elastic modulus; real ratings of hardness
//! will agree less with real taps.

use crate::maths::rng::{Random, derive_seed};
use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
use crate::surfaces::contact_model::{ACROSS, PEN, STARTER_PATH_M, Tool, hardness, prepare};
use crate::surfaces::height_field::{STARTER_TILE, synthesize};
use crate::surfaces::material::{Material, validate};
use crate::surfaces::random_material::{Range, draw};
use crate::surfaces::starter::StarterError;
use crate::surfaces::stroked_grain::{StrokedSurfaces, stroked_grain};
use crate::texture::TextureModel;

/// Effective mass of pen and fingers in a landing, in kg. The mass of the pen is in proportion, as that of [`PEN`].
pub const LANDING_MASSES_KG: Range = (0.010, 0.040);
/// Radius of the ball, in m.
pub const TIP_RADII_M: Range = (0.5e-3, 3e-3);
/// Factor on the damping ratio of the contact.
pub const DAMPING_FACTORS: Range = (0.5, 2.0);

/// A material and the tool that touches it.
#[derive(Clone, Debug, PartialEq)]
pub struct RandomTouch {
    /// The material, with its own damping.
    pub material: Material,
    /// The tool.
    pub tool: Tool,
}

/// Returns touch `number`, deterministic for a seed. All quantities of the tool are log-uniform in their ranges.
pub fn random_touch(seed: u64, number: u64) -> RandomTouch {
    let (mut material, _) = draw(seed, number);
    let mut random = Random::new(derive_seed(derive_seed(seed, &material.id), "tool"));
    let mut spread = |(low, high): Range| low * (high / low).powf(random.uniform());
    let landing_mass_kg = spread(LANDING_MASSES_KG);
    let tip_radius_m = spread(TIP_RADII_M);
    material.contact_damping_ratio *= spread(DAMPING_FACTORS);
    let mass_kg = PEN.mass_kg * landing_mass_kg / PEN.landing_mass_kg;
    RandomTouch { material, tool: Tool { tip_radius_m, mass_kg, landing_mass_kg, ..PEN } }
}

impl RandomTouch {
    /// Hardness label of the material: log₁₀ of its Hertz contact stiffness in N/m at 1 N under [`PEN`].
    pub fn hardness_log10_n_per_m(&self) -> f64 {
        hardness(&self.material, &PEN)
    }

    /// Returns the texture of the material as this tool strokes it across its lay and taps on it, deterministic for a
    /// seed; takes some seconds.
    ///
    /// # Errors
    /// See the variants of [`StarterError`].
    pub fn texture(&self, seed: u64) -> Result<TextureModel, StarterError> {
        let Self { material, tool } = self;
        validate(material)?;
        let field = synthesize(material, STARTER_TILE, seed);
        let across = prepare(material, &field, tool, STARTER_PATH_M, ACROSS, seed);
        let grain = stroked_grain(material, &StrokedSurfaces { across, along: None }, seed, &|| true)?;
        Ok(grain.with_tap(Some(landing(material, tool, REFERENCE_LANDING))))
    }
}

#[cfg(test)]
mod tests {
    use super::{DAMPING_FACTORS, LANDING_MASSES_KG, RandomTouch, TIP_RADII_M, random_touch};
    use crate::maths::least_squares::least_squares;
    use crate::surfaces::contact_model::landing::{REFERENCE_LANDING, landing};
    use crate::surfaces::contact_model::{PEN, hardness};
    use crate::surfaces::material::validate;
    use crate::surfaces::random_material::draw;

    #[test]
    fn tools_vary_in_their_ranges_and_labels_do_not() {
        for number in 0..300 {
            let touch = random_touch(7, number);
            assert_eq!(random_touch(7, number), touch);
            let RandomTouch { material, tool } = &touch;
            let (drawn, _) = draw(7, number);
            assert!((LANDING_MASSES_KG.0..=LANDING_MASSES_KG.1).contains(&tool.landing_mass_kg));
            assert!((TIP_RADII_M.0..=TIP_RADII_M.1).contains(&tool.tip_radius_m));
            let damped = material.contact_damping_ratio / drawn.contact_damping_ratio;
            assert!((DAMPING_FACTORS.0..=DAMPING_FACTORS.1).contains(&damped), "{damped}");
            assert_eq!(validate(material), Ok(()));
            assert_eq!(touch.hardness_log10_n_per_m(), hardness(&drawn, &PEN));
        }
        let [first, second] = [0, 1].map(|number| random_touch(7, number).tool.tip_radius_m);
        assert_ne!(first, second);
    }

    /// The frequency of a tap grows with `(κ/m)^{2/5}`, which a line through its logarithm tells up to the tool.
    #[test]
    fn a_tap_tells_hardness_whatever_the_tool_is() {
        let touches: Vec<RandomTouch> = (0..100).map(|number| random_touch(1, number)).collect();
        let labels: Vec<f64> = touches.iter().map(RandomTouch::hardness_log10_n_per_m).collect();
        let ln_hz =
            |touch: &RandomTouch| landing(&touch.material, &touch.tool, REFERENCE_LANDING).frequency.0.ln();
        let ln_hz: Vec<f64> = touches.iter().map(ln_hz).collect();
        let fit = least_squares(&[vec![1.0; 100], ln_hz.clone()], &labels).unwrap();
        let [constant, slope] = [fit.coefficients[0], fit.coefficients[1]];
        let low = labels.iter().copied().fold(f64::INFINITY, f64::min);
        let high = labels.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let off = labels.iter().zip(&ln_hz).map(|(label, ln_hz)| (constant + slope * ln_hz - label).abs());
        let mae_points = off.sum::<f64>() / 100.0 * 100.0 / (high - low);
        // Mass and radius spread the frequency by 0.08 decades (standard deviation), 4 to 5 points of the axis.
        assert!(mae_points > 1.0 && mae_points < 6.0, "{mae_points}");
    }
}
