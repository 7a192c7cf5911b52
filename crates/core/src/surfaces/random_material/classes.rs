//! Types that describe a class of surfaces.

use crate::surfaces::material::PatternKind;
use crate::surfaces::random_material::Range;
use crate::surfaces::random_material::palette::Palette;

/// A class of everyday surfaces: the range of each material parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Name of the class.
    pub name: &'static str,
    /// Relative frequency with which the class is drawn.
    pub weight: f64,
    /// Median of Young's modulus, in Pa; the next field is the standard deviation of its natural logarithm.
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
    /// Negative values count as 0, so that part of the class is fully matte.
    pub(super) gloss: Range,
    pub(super) metallic: Range,
    /// Fraction of materials with color flecks.
    pub(super) mottled_share: f64,
    pub(super) mottle: Range,
    pub(super) mottle_scales_m: Range,
    /// Drawn with equal probability; repeat an entry to weight it.
    pub(super) palettes: &'static [Palette],
    /// Fraction of materials whose valleys have an independent color.
    pub(super) two_colored_share: f64,
    /// Relative darkening of valleys, 0 to 1.
    pub(super) contrast: f64,
    pub(super) pattern: Option<PatternClass>,
    pub(super) scatters: &'static [ScatterClass],
}

/// Ranges of a regular pattern.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct PatternClass {
    /// Drawn with equal probability; repeat an entry to weight it.
    pub(super) kinds: &'static [PatternKind],
    pub(super) periods_m: Range,
    pub(super) amplitude: Amplitude,
    pub(super) jitter: Range,
}

/// Pattern amplitude: half the peak-to-valley height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Amplitude {
    Meters(Range),
    /// As a multiple of the RMS height of the fractal part.
    OfHeight(Range),
    /// As a multiple of the period.
    OfPeriod(Range),
}

/// Ranges of scattered bumps or pits.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct ScatterClass {
    /// As a multiple of the RMS height of the fractal part, or of the bump radius if `is_of_radius`.
    pub(super) heights: Range,
    pub(super) is_of_radius: bool,
    /// Fraction of materials on which the bumps are pits.
    pub(super) pits_share: f64,
    pub(super) radii_m: Range,
    pub(super) elongation: Range,
    pub(super) spread_rad: Range,
    pub(super) densities_per_m2: Range,
}
