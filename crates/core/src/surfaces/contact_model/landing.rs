//! Landing: the tap transient of a pen that hits a material, by contact mechanics.
//!
//! A ball of radius `R` and effective mass `m` that hits an elastic half-space at speed `v` is stopped by the Hertz force
//! `F = κ δ^{3/2}` with `κ = 4/3 E* √R` (K. L. Johnson, "Contact Mechanics", 1985, section 11.4):
//!
//! - deepest indentation `δ = (5 m v² / 4κ)^{2/5}`
//! - peak acceleration `κ δ^{3/2} / m`
//! - contact time `T = 2.943 δ / v`, close to half a period: the frequency is `1 / 2T`
//!
//! The transient is the decaying sinusoid of [`Tap`] with this frequency and this peak. It decays by the damping of the
//! hand and by that of the contact.

use std::f64::consts::TAU;

use shagreen_synth::tap::REFERENCE_IMPACT_MPS;

use crate::surfaces::contact_model::{Tool, effective_modulus_pa};
use crate::surfaces::material::Material;
use crate::texture::tap::Tap;
use crate::units::{Hertz, MetersPerSecond};

/// Impact speed at which the tap transient of a texture is stated. Rendering scales it from there by the same law, except
/// that it also scales the decay by the hand, because a [`Tap`] does not state it separately.
pub const REFERENCE_LANDING: MetersPerSecond = MetersPerSecond(REFERENCE_IMPACT_MPS);

/// Ratio of contact time to deepest indentation over speed, in an elastic Hertz impact.
const CONTACT_TIME: f64 = 2.943;

/// Decay rate from the hand, in 1/s. Published transients under a held stylus decay with 60 (rubber, 18 Hz), 80 (wood,
/// 100 Hz) and 90 1/s (aluminium, 300 Hz), little faster at higher frequencies: most of the damping is the hand's.
const HAND_DECAY_PER_SEC: f64 = 55.0;

/// Share of the damping ratio of the sliding contact that remains in a landing, so that the decay rates of the three
/// published transients are met within a quarter. In sliding, the ratio contains the grip.
const DAMPING_SHARE: f64 = 0.12;

/// Returns the tap transient of a tool that hits a material at this speed; the speed must be above 0.
///
/// The frequency grows as `v^{1/5}`, the peak as `v^{6/5}`. Values are bounded as by [`Tap::bounded`].
pub fn landing(material: &Material, tool: &Tool, speed: MetersPerSecond) -> Tap {
    let hertz = 4.0 / 3.0 * effective_modulus_pa(material, tool) * tool.tip_radius_m.sqrt();
    let mass_kg = tool.landing_mass_kg;
    let depth_m = (5.0 * mass_kg * speed.0.powi(2) / (4.0 * hertz)).powf(0.4);
    let peak_mps2 = hertz * depth_m.powf(1.5) / mass_kg;
    let frequency_hz = speed.0 / (2.0 * CONTACT_TIME * depth_m);
    let angular_per_s = TAU * frequency_hz;
    let decay_per_sec = HAND_DECAY_PER_SEC + DAMPING_SHARE * material.contact_damping_ratio * angular_per_s;
    Tap {
        frequency: Hertz(frequency_hz),
        decay_per_sec,
        amplitude_mps2: peak_mps2 / unit_peak(angular_per_s, decay_per_sec),
    }
    .bounded()
}

/// Highest value of `e^{-Bt} sin ωt`, at `tan ωt = ω/B`.
fn unit_peak(angular_per_s: f64, decay_per_sec: f64) -> f64 {
    let phase = (angular_per_s / decay_per_sec).atan();
    (-decay_per_sec * phase / angular_per_s).exp() * phase.sin()
}

#[cfg(test)]
mod tests {
    use shagreen_synth::tap::Taps;

    use super::{REFERENCE_LANDING, landing};
    use crate::surfaces::contact_model::{PEN, Tool, effective_modulus_pa};
    use crate::surfaces::material::Material;
    use crate::surfaces::material::tests::plain;
    use crate::units::MetersPerSecond;

    fn material(youngs_modulus_pa: f64, contact_damping_ratio: f64) -> Material {
        Material { youngs_modulus_pa, contact_damping_ratio, ..plain() }
    }

    /// Peak acceleration and contact time of an undamped Hertz impact, integrated in small steps.
    fn impact(material: &Material, tool: &Tool, speed_mps: f64) -> (f64, f64) {
        let hertz = 4.0 / 3.0 * effective_modulus_pa(material, tool) * tool.tip_radius_m.sqrt();
        let (mut depth_m, mut toward_mps, mut peak, mut time) = (0.0_f64, speed_mps, 0.0_f64, 0.0);
        let dt = 1e-8;
        while depth_m >= 0.0 {
            let mps2 = hertz * depth_m.powf(1.5) / tool.landing_mass_kg;
            peak = peak.max(mps2);
            toward_mps -= mps2 * dt;
            depth_m += toward_mps * dt;
            time += dt;
        }
        (peak, time)
    }

    #[test]
    fn peak_and_frequency_are_those_of_an_integrated_impact() {
        for (modulus, speed) in [(6e10, 0.05), (1e9, 0.1), (4e6, 0.2)] {
            let material = material(modulus, 0.2);
            let tap = landing(&material, &PEN, MetersPerSecond(speed));
            let (peak, contact_s) = impact(&material, &PEN, speed);
            assert!((tap.frequency.0 * 2.0 * contact_s - 1.0).abs() < 0.01, "{tap:?}, {contact_s}");
            let highest = (0..200_000).map(|i| tap.at(f64::from(i) * 1e-6)).fold(0.0, f64::max);
            assert!((highest / peak - 1.0).abs() < 0.01, "{highest} for {peak}");
        }
    }

    #[test]
    fn materials_land_where_measured_ones_do() {
        let hz = |modulus| landing(&material(modulus, 0.2), &PEN, REFERENCE_LANDING).frequency.0;
        let [glass, wood, rubber, foam] = [6e10, 1e9, 4e6, 4e5].map(hz);
        assert!(glass > 500.0 && (200.0..600.0).contains(&wood), "{glass} {wood}");
        assert!((40.0..100.0).contains(&rubber) && (15.0..30.0).contains(&foam), "{rubber} {foam}");
        // Published transients of a stylus: 300, 100 and 18 Hz on aluminium, wood and rubber, with 90, 80 and 60 1/s. Its
        // mass is not stated; an effective 0.3 kg gives such frequencies.
        let heavy = Tool { landing_mass_kg: 0.3, ..PEN };
        for (modulus, damping, hz, decay) in
            [(7e10, 0.15, 300.0, 90.0), (1e9, 0.25, 100.0, 80.0), (4e6, 0.5, 18.0, 60.0)]
        {
            let tap = landing(&material(modulus, damping), &heavy, REFERENCE_LANDING);
            assert!((0.5..2.0).contains(&(tap.frequency.0 / hz)), "{tap:?} for {hz} Hz");
            assert!((0.75..1.25).contains(&(tap.decay_per_sec / decay)), "{tap:?} for {decay} 1/s");
        }
    }

    #[test]
    fn harder_and_faster_landings_are_higher_and_stronger() {
        let mut last = landing(&material(1e4, 0.2), &PEN, REFERENCE_LANDING);
        for modulus in [1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11] {
            let next = landing(&material(modulus, 0.2), &PEN, REFERENCE_LANDING);
            assert!(next.frequency.0 > last.frequency.0 && next.amplitude_mps2 > last.amplitude_mps2);
            last = next;
        }
        let [slow, fast] = [0.05, 0.2].map(|mps| landing(&material(1e7, 0.0), &PEN, MetersPerSecond(mps)));
        assert!((fast.frequency.0 / slow.frequency.0 - 4.0_f64.powf(0.2)).abs() < 1e-9);
        let peak = |tap: crate::texture::tap::Tap| {
            (0..100_000).map(|i| tap.at(f64::from(i) * 1e-6)).fold(0.0, f64::max)
        };
        assert!((peak(fast) / peak(slow) - 4.0_f64.powf(1.2)).abs() < 0.01);
    }

    #[test]
    fn the_renderer_scales_a_landing_as_the_model_does() {
        const RATE_HZ: f32 = 192_000.0;
        let material = material(1e7, 0.2);
        let stated = landing(&material, &PEN, REFERENCE_LANDING);
        for mps in [0.02, 0.05, 0.1, 0.2, 0.3] {
            let model = landing(&material, &PEN, MetersPerSecond(mps));
            let strength = mps / REFERENCE_LANDING.0;
            let mut taps = Taps::new(RATE_HZ);
            taps.strike(stated.into(), strength as f32);
            let mut rendered = vec![0.0_f32; 19_200];
            taps.add_to(&mut rendered);
            let peak = rendered.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
            let expected = (0..100_000).map(|i| model.at(f64::from(i) * 1e-6)).fold(0.0, f64::max);
            assert!((f64::from(peak) / expected - 1.0).abs() < 1e-3, "{peak} for {expected} at {mps} m/s");
            // Half a period of about 5 ms, to one sample.
            let crossing = 1 + rendered[1..].iter().position(|x| *x <= 0.0).unwrap();
            let half_periods = 2.0 * model.frequency.0 * crossing as f64 / f64::from(RATE_HZ);
            assert!((half_periods - 1.0).abs() < 2e-3, "{half_periods} at {mps} m/s");
            // Only the share of the hand differs.
            let off = stated.decay_per_sec * strength.powf(0.2) / model.decay_per_sec - 1.0;
            assert!(off.abs() < 0.3, "{off} at {mps} m/s");
        }
    }
}
