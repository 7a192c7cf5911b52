//! Color palettes of surface classes.

use crate::maths::rng::Random;

/// A range of colors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Palette {
    /// Any hue, saturation 0 to 0.9, value 0.15 to 1.
    Any,
    /// Any hue, value 0.1 to 0.5.
    Dark,
    /// Wood, leather, cardboard.
    Brown,
    /// Dark to light gray.
    Gray,
    /// Fired clay.
    Red,
    /// Sand and limestone.
    Sand,
    /// White paper.
    White,
    /// Background seen through clear glass.
    Glass,
    /// Steel and silver.
    Steel,
    /// Brass and gold.
    Brass,
    /// Copper.
    Copper,
    /// Soot and tires.
    Black,
}

/// Hue, saturation and value, each 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Color {
    hue: f64,
    saturation: f64,
    value: f64,
}

impl Palette {
    pub(super) fn draw(self, random: &mut Random) -> Color {
        // (min, max) of hue, saturation and value.
        let [hue, saturation, value] = match self {
            Self::Any => [(0.0, 1.0), (0.0, 0.9), (0.15, 1.0)],
            Self::Dark => [(0.0, 1.0), (0.0, 0.8), (0.1, 0.5)],
            Self::Brown => [(0.05, 0.1), (0.25, 0.65), (0.35, 0.9)],
            Self::Gray => [(0.05, 0.65), (0.0, 0.12), (0.3, 0.95)],
            Self::Red => [(0.0, 0.06), (0.35, 0.65), (0.35, 0.75)],
            Self::Sand => [(0.05, 0.13), (0.15, 0.5), (0.4, 0.85)],
            Self::White => [(0.05, 0.18), (0.0, 0.08), (0.9, 1.0)],
            Self::Glass => [(0.3, 0.6), (0.05, 0.35), (0.45, 0.85)],
            Self::Steel => [(0.5, 0.65), (0.0, 0.06), (0.6, 0.9)],
            Self::Brass => [(0.1, 0.14), (0.25, 0.6), (0.7, 0.9)],
            Self::Copper => [(0.03, 0.07), (0.35, 0.6), (0.6, 0.85)],
            Self::Black => [(0.0, 1.0), (0.0, 0.1), (0.12, 0.4)],
        };
        let mut between = |(low, high): (f64, f64)| low + (high - low) * random.uniform();
        Color { hue: between(hue), saturation: between(saturation), value: between(value) }
    }
}

impl Color {
    /// Returns the color of a valley: value scaled by `factor`, hue slightly shifted.
    pub(super) fn darkened(self, factor: f64, random: &mut Random) -> Self {
        let hue = self.hue + 0.02 * random.normal();
        let saturation = (self.saturation * (0.9 + 0.3 * random.uniform())).min(1.0);
        Self { hue, saturation, value: (self.value * factor).clamp(0.0, 1.0) }
    }

    /// Returns the color in sRGB.
    pub(super) fn srgb(self) -> [u8; 3] {
        let Self { hue, saturation, value } = self;
        // Each channel is a trapezoidal function of hue.
        [5.0, 3.0, 1.0].map(|phase| {
            let k = (phase + 6.0 * hue).rem_euclid(6.0);
            let share = k.min(4.0 - k).clamp(0.0, 1.0);
            (255.0 * (value - value * saturation * share)).round().clamp(0.0, 255.0) as u8
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Color;

    #[test]
    fn hues_are_those_of_the_wheel() {
        let of = |hue, saturation, value| Color { hue, saturation, value }.srgb();
        assert_eq!(of(0.0, 1.0, 1.0), [255, 0, 0]);
        assert_eq!(of(1.0 / 3.0, 1.0, 1.0), [0, 255, 0]);
        assert_eq!(of(2.0 / 3.0, 1.0, 1.0), [0, 0, 255]);
        assert_eq!(of(1.0 / 6.0, 1.0, 0.4), [102, 102, 0]);
        assert_eq!(of(-0.4, 0.0, 0.5), [128, 128, 128]);
    }
}
