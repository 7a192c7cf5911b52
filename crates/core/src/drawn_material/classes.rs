//! What the classes are.

use crate::drawn_material::Range;
use crate::drawn_material::palette::Palette;
use crate::material::PatternKind;

/// A kind of everyday surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// What it is.
    pub name: &'static str,
    /// How often it is drawn.
    pub weight: f64,
    /// Median of Young's modulus, in Pa, and the standard deviation of its logarithm.
    pub modulus_pa: f64,
    pub(super) modulus_spread: f64,
    pub(super) heights_m: Range,
    pub(super) hurst: Range,
    pub(super) roll_offs_m: Range,
    pub(super) stretch: Range,
    pub(super) friction: Range,
    pub(super) heterogeneity: Range,
    pub(super) patch_share: Range,
    pub(super) damping_ratio: f64,
    pub(super) load_exponent: Range,
    /// Below 0 counts as 0, so that some are quite matte.
    pub(super) gloss: Range,
    pub(super) metallic: Range,
    /// Share of them that have flecks.
    pub(super) mottled_share: f64,
    pub(super) mottle: Range,
    pub(super) mottle_scales_m: Range,
    /// Each as often as any other.
    pub(super) palettes: &'static [Palette],
    /// Share of them whose valleys have a color of their own.
    pub(super) two_colored_share: f64,
    /// How much darker valleys are, as a share.
    pub(super) contrast: f64,
    pub(super) pattern: Option<PatternClass>,
    pub(super) scatters: &'static [ScatterClass],
}

/// A regular relief.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PatternClass {
    /// Each as often as any other.
    pub(super) kinds: &'static [PatternKind],
    pub(super) periods_m: Range,
    pub(super) amplitude: Amplitude,
    pub(super) jitter: Range,
}

/// Half the height of a pattern.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Amplitude {
    Meters(Range),
    /// As a factor of the height of the fractal part.
    OfHeight(Range),
    /// As a factor of the period.
    OfPeriod(Range),
}

/// Scattered bumps or pits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ScatterClass {
    /// As a factor of the height of the fractal part, or of their radius.
    pub(super) heights: Range,
    pub(super) is_of_radius: bool,
    /// Share of surfaces on which they are pits.
    pub(super) pits_share: f64,
    pub(super) radii_m: Range,
    pub(super) elongation: Range,
    pub(super) spread_rad: Range,
    pub(super) densities_per_m2: Range,
}
