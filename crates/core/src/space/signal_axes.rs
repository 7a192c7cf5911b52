//! Axes that are computed from the vibration of a texture, such as its spectral centroid.
//!
//! They have fixed scales, so that a texture keeps its position when others are added.

use crate::space::features::{Physical, physical};
use crate::texture::TextureModel;
use crate::texture::patterns::paper_patterns;

/// Feature of the vibration of a texture that can be an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SignalAxis {
    /// Spectral centroid in Hz, on a logarithmic scale.
    Centroid,
    /// Exponent of the level over the tip speed.
    SpeedExponent,
    /// Exponent of the level over the normal force.
    ForceExponent,
    /// Frequency of the tap transient in Hz, on a logarithmic scale.
    TapFrequency,
}

impl SignalAxis {
    /// All signal axes.
    pub const ALL: [Self; 4] = [Self::Centroid, Self::SpeedExponent, Self::ForceExponent, Self::TapFrequency];

    /// Name for files, scripts and display.
    pub fn name(self) -> &'static str {
        match self {
            Self::Centroid => "centroid",
            Self::SpeedExponent => "speed exponent",
            Self::ForceExponent => "force exponent",
            Self::TapFrequency => "tap frequency",
        }
    }

    /// Signal axis with this [`SignalAxis::name`]; hyphens and underscores count as spaces.
    pub fn from_name(name: &str) -> Option<Self> {
        let name = name.to_lowercase().replace(['-', '_'], " ");
        Self::ALL.into_iter().find(|axis| axis.name() == name)
    }

    /// Meaning of 0 and of 100.
    pub fn poles(self) -> [&'static str; 2] {
        match self {
            Self::Centroid => ["dull", "bright"],
            Self::SpeedExponent => ["same at any speed", "louder when fast"],
            Self::ForceExponent => ["same at any force", "louder when pressed"],
            Self::TapFrequency => ["low tap", "high tap"],
        }
    }

    /// Values of the feature at 0 and at 100.
    pub fn range(self) -> [f64; 2] {
        match self {
            Self::Centroid => [30.0, 400.0],
            Self::SpeedExponent => [0.0, 2.0],
            Self::ForceExponent => [0.0, 1.5],
            Self::TapFrequency => [10.0, 1000.0],
        }
    }

    /// Coordinate of a texture, 0 to 100; `None` if it does not have the feature.
    pub fn of(self, model: &TextureModel) -> Option<f64> {
        self.of_features(&physical(model, &paper_patterns()))
    }

    /// Coordinates of a texture on all signal axes, in the order of [`SignalAxis::ALL`].
    pub fn all_of(model: &TextureModel) -> [Option<f64>; 4] {
        let features = physical(model, &paper_patterns());
        Self::ALL.map(|axis| axis.of_features(&features))
    }

    fn of_features(self, features: &Physical) -> Option<f64> {
        let [low, high] = self.range();
        let (value, [low, high]) = match self {
            Self::Centroid => (features.centroid_hz?.ln(), [low.ln(), high.ln()]),
            Self::SpeedExponent => (features.speed_exponent?, [low, high]),
            Self::ForceExponent => (features.force_exponent?, [low, high]),
            Self::TapFrequency => (features.tap_frequency_hz?.ln(), [low.ln(), high.ln()]),
        };
        Some((100.0 * (value - low) / (high - low)).clamp(0.0, 100.0)).filter(|value| value.is_finite())
    }
}

#[cfg(test)]
mod tests {
    use super::SignalAxis;
    use crate::texture::tap::Tap;
    use crate::texture::test_textures::two_resonances;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::Hertz;

    /// A texture whose level is a power of speed and force.
    fn power_law(speed: f64, force: f64) -> TextureModel {
        let base = two_resonances(&[0.03, 0.08, 0.16, 0.3], &[0.1, 0.3, 0.6]);
        let nodes = base.nodes().iter().map(|node| GrainNode {
            level_mps2: node.speed.0.powf(speed) * node.force.0.powf(force),
            ..node.clone()
        });
        TextureModel::new(base.rate(), nodes.collect(), None).unwrap()
    }

    #[test]
    fn coordinates_follow_from_the_features() {
        let model = power_law(1.0, 0.75);
        let [centroid, speed, force, tap] = SignalAxis::all_of(&model);
        // Between measured speeds the level is interpolated linearly, so the exponents are not exact.
        assert!(
            (speed.unwrap() - 50.0).abs() < 8.0 && (force.unwrap() - 50.0).abs() < 8.0,
            "{speed:?} {force:?}"
        );
        assert!(centroid.is_some_and(|x| x > 0.0 && x < 100.0) && tap.is_none());
        assert_eq!(SignalAxis::Centroid.of(&model), centroid);
        let tap = Tap { frequency: Hertz(100.0), decay_per_sec: 50.0, amplitude_mps2: 1.0 };
        let tapped = SignalAxis::TapFrequency.of(&model.with_tap(Some(tap))).unwrap();
        assert!((tapped - 50.0).abs() < 1e-9);
        // Beyond the scale, its end.
        assert_eq!(SignalAxis::SpeedExponent.of(&power_law(3.0, 0.5)), Some(100.0));
    }

    #[test]
    fn names_are_read_as_written() {
        for axis in SignalAxis::ALL {
            assert_eq!(SignalAxis::from_name(axis.name()), Some(axis));
            assert_eq!(SignalAxis::from_name(&axis.name().replace(' ', "-")), Some(axis));
        }
        assert_eq!(SignalAxis::from_name("rough-smooth"), None);
    }
}
