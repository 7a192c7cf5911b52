//! Parameters of a physical material.
//!
//! They define the height field ([`crate::surfaces::height_field`]), the stroke simulation
//! ([`crate::surfaces::contact_model`]) and the picture ([`crate::surfaces::shading`]).

use std::f64::consts::FRAC_PI_2;

use crate::texture::stick_slip::{STATIC_RATIOS, STRIBECK_MPS, StickSlip};

/// Physical and optical properties of a surface.
///
/// The grain of a stretched surface runs along y; strokes run along x, across the grain.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// Kebab-case identifier, unique in a library; every random seed depends on it.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Search terms.
    pub tags: Vec<String>,
    /// Plane-strain elastic modulus of the surface, above 0.
    pub youngs_modulus_pa: f64,
    /// Root mean square (RMS) height of the fractal part, 0 or more.
    pub height_rms_m: f64,
    /// Hurst exponent H of the fractal part, 0.05 to 1: its line spectrum falls as frequency^-(2H+1).
    pub hurst: f64,
    /// Wavelength above which the spectrum of the fractal part is flat, above 0.
    pub roll_off_m: f64,
    /// Ratio of feature length along y to along x, for the fractal part and for ridges, 1 or more.
    pub stretch: f64,
    /// Regular part of the surface relief.
    pub pattern: Option<Pattern>,
    /// Scattered grains, fibers and pits.
    pub bumps: Vec<Bumps>,
    /// Coefficient of kinetic friction, 0 or more.
    pub friction_coefficient: f64,
    /// RMS variation of the friction coefficient along the path, relative to its mean, 0 or more.
    pub friction_heterogeneity: f64,
    /// Friction over speed, for surfaces on which a dry tip sticks and slips.
    pub stick_slip: Option<StickSlip>,
    /// Averaging radius of relief and friction, as a fraction (above 0 to 1) of the Hertz patch radius.
    ///
    /// It is 1 for a continuous solid, and less where fibers, struts or slip waves make and break contact one by one.
    pub patch_share: f64,
    /// Damping ratio of the contact resonance, 0 or more.
    pub contact_damping_ratio: f64,
    /// Exponent γ, 0 to 1, with which the transmitted relief grows with load, as (force / 1 N)^γ.
    ///
    /// It stands for effects that a rigid ball on a linear contact spring leaves out. A soft cover is pressed onto what
    /// lies beneath, a rough contact engages more asperities, and a hand that presses harder grips harder.
    pub load_exponent: f64,
    /// Color of the lowest parts, sRGB.
    pub valley_srgb: [u8; 3],
    /// Color of the highest parts, sRGB.
    pub peak_srgb: [u8; 3],
    /// Gloss, from 0 (matte) to 1 (mirror).
    pub gloss: f64,
    /// Fraction of light reflected as by bare metal, 0 to 1.
    pub metallic: f64,
    /// Strength of color flecks without relief, 0 to 1.
    pub mottle: f64,
    /// Size of the color flecks, above 0.
    pub mottle_scale_m: f64,
}

/// Smallest order parameter at which bumps count as aligned.
const LEAST_ORDER: f64 = 0.1;

impl Material {
    /// Whether a stroke along the lay (y) differs from one across it (x).
    ///
    /// It does if one of the three parts of the surface has a direction: a fractal part that is stretched, a pattern in
    /// rows or threads, or elongated bumps that are aligned. Bumps are aligned if the order parameter of their long axes,
    /// the mean of cos 2φ over the angle φ from y, is at least a tenth. Pebbles and cells lie at random, so they have no
    /// direction. A plain weave has two: its warp and its weft.
    pub fn is_directional(&self) -> bool {
        let has_rows = |pattern: &Pattern| match pattern.kind {
            PatternKind::Ridges
            | PatternKind::PlainWeave
            | PatternKind::Twill
            | PatternKind::Domes
            | PatternKind::Loops => pattern.amplitude_m > 0.0,
            PatternKind::Pebbles | PatternKind::Cells => false,
        };
        let is_stretched = self.stretch > 1.0 && self.height_rms_m > 0.0;
        is_stretched
            || self.pattern.as_ref().is_some_and(has_rows)
            || self.bumps.iter().any(Bumps::is_aligned)
    }
}

/// A periodic relief with heights of ±`amplitude_m` about its mean plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pattern {
    /// Shape of the relief.
    pub kind: PatternKind,
    /// Period, above 0; rounded so that a whole number of periods fits the tile.
    pub period_m: f64,
    /// Half the height from valley to peak, 0 or more.
    pub amplitude_m: f64,
    /// Irregularity of position (in periods, RMS) and of height (relative), 0 to 1.
    pub jitter: f64,
}

/// The shape of a [`Pattern`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatternKind {
    /// Rounded ridges along y, like wood grain, brushed metal or corrugated cardboard.
    Ridges,
    /// Plain weave: threads that pass alternately over and under each other.
    PlainWeave,
    /// Twill weave: threads pass over two and under one, shifted by one thread per row, which gives diagonal ribs.
    Twill,
    /// Round studs in staggered rows.
    Domes,
    /// Arched loops of yarn in staggered rows.
    Loops,
    /// Flat-topped patches separated by creases.
    Pebbles,
    /// Hollows separated by thin walls.
    Cells,
}

impl PatternKind {
    /// Number of periods after which the pattern repeats, along x and along y.
    pub(crate) fn n_periods(self) -> u32 {
        match self {
            Self::Twill => 3,
            Self::PlainWeave | Self::Domes | Self::Loops => 2,
            Self::Ridges | Self::Pebbles | Self::Cells => 1,
        }
    }
}

/// A random scatter of Gaussian bumps; elongated bumps model fibers, negative heights model pits.
///
/// Heights and radii are log-normal about these medians. Where bumps of one scatter overlap, the larger counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bumps {
    /// Median height; negative for pits.
    pub height_m: f64,
    /// Median standard deviation of the Gaussian cross-section, above 0.
    pub radius_m: f64,
    /// Ratio of length to width, 1 or more.
    pub elongation: f64,
    /// Largest angle between the long axis and y: 0 (along the grain) to π/2 (isotropic).
    pub spread_rad: f64,
    /// Mean number per square meter, 0 or more.
    pub density_per_m2: f64,
}

impl Bumps {
    /// Whether the bumps are long and their axes share a direction.
    fn is_aligned(&self) -> bool {
        // Mean of cos 2φ over a uniform distribution of φ up to the spread.
        let twice_rad = 2.0 * self.spread_rad;
        let order = if twice_rad > 0.0 { twice_rad.sin() / twice_rad } else { 1.0 };
        let is_there = self.density_per_m2 > 0.0 && self.height_m != 0.0;
        is_there && self.elongation > 1.0 && order >= LEAST_ORDER
    }
}

/// Reasons why material parameters do not define a surface.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialError {
    /// The identifier is empty or contains anything but lower-case letters, digits and single hyphens.
    #[error("the material id \"{id}\" is not kebab-case; use lower-case words joined by single hyphens")]
    Id {
        /// Given identifier.
        id: String,
    },
    /// A parameter is outside its meaningful range.
    #[error("{field} of {id} is {value}; set it to a value from {low} to {high}")]
    OutOfRange {
        /// Identifier of the material.
        id: String,
        /// Name of the parameter's field, or the product of several parameters.
        field: &'static str,
        /// Given value.
        value: f64,
        /// Smallest allowed value.
        low: f64,
        /// Largest allowed value.
        high: f64,
    },
}

/// Smallest length accepted as above zero.
const TINY: f64 = 1e-9;

/// Shortest period of a pattern: a tile stores random numbers for each period, and its points resolve no finer pattern.
const SHORTEST_PERIOD_M: f64 = 1e-4;

/// Bump width below which the cost stays constant: about the point spacing of a tile.
const POINT_M: f64 = 40e-6;

/// Largest coverage of a scatter: at this value bumps overlap about thirty deep.
const MOST_COVER: f64 = 10.0;

/// Coverage of a scatter: density times length and width at one standard deviation.
///
/// The cost of a scatter is proportional to this: time goes into the points under each bump.
pub(crate) fn cover(bumps: &Bumps) -> f64 {
    bumps.density_per_m2 * bumps.radius_m * bumps.elongation * bumps.radius_m.max(POINT_M)
}

/// Checks that every parameter is in range, and that no combination needs unbounded time or memory.
///
/// # Errors
/// [`MaterialError::Id`], or [`MaterialError::OutOfRange`] for the first parameter out of range; NaN is always out of
/// range.
pub fn validate(material: &Material) -> Result<(), MaterialError> {
    let id = &material.id;
    let is_word = |word: &str| {
        !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_lowercase() || byte.is_ascii_digit())
    };
    if !id.split('-').all(is_word) {
        return Err(MaterialError::Id { id: id.clone() });
    }
    let check = |(field, value, low, high): (&'static str, f64, f64, f64)| {
        if (low..=high).contains(&value) {
            Ok(())
        } else {
            Err(MaterialError::OutOfRange { id: id.clone(), field, value, low, high })
        }
    };
    let numbers = [
        ("youngs_modulus_pa", material.youngs_modulus_pa, 1e3, 1e13),
        ("height_rms_m", material.height_rms_m, 0.0, 1e-2),
        ("hurst", material.hurst, 0.05, 1.0),
        ("roll_off_m", material.roll_off_m, 1e-5, 1e-1),
        ("stretch", material.stretch, 1.0, 1e3),
        ("friction_coefficient", material.friction_coefficient, 0.0, 10.0),
        ("friction_heterogeneity", material.friction_heterogeneity, 0.0, 10.0),
        ("patch_share", material.patch_share, 1e-3, 1.0),
        ("contact_damping_ratio", material.contact_damping_ratio, 0.0, 2.0),
        ("load_exponent", material.load_exponent, 0.0, 1.0),
        ("gloss", material.gloss, 0.0, 1.0),
        ("metallic", material.metallic, 0.0, 1.0),
        ("mottle", material.mottle, 0.0, 1.0),
        ("mottle_scale_m", material.mottle_scale_m, 1e-5, 1.0),
    ];
    numbers.into_iter().try_for_each(check)?;
    if let Some(StickSlip { static_ratio, stribeck_speed }) = material.stick_slip {
        let (ratios, speeds) = (STATIC_RATIOS, STRIBECK_MPS);
        check(("stick_slip.static_ratio", static_ratio, *ratios.start(), *ratios.end()))?;
        check(("stick_slip.stribeck_speed_mps", stribeck_speed.0, *speeds.start(), *speeds.end()))?;
    }
    if let Some(pattern) = &material.pattern {
        check(("pattern.period_m", pattern.period_m, SHORTEST_PERIOD_M, 1.0))?;
        check(("pattern.amplitude_m", pattern.amplitude_m, 0.0, 1e-2))?;
        check(("pattern.jitter", pattern.jitter, 0.0, 1.0))?;
    }
    for bumps in &material.bumps {
        check(("bumps.height_m", bumps.height_m, -1e-2, 1e-2))?;
        check(("bumps.radius_m", bumps.radius_m, TINY, 1e-2))?;
        check(("bumps.elongation", bumps.elongation, 1.0, 1e3))?;
        check(("bumps.spread_rad", bumps.spread_rad, 0.0, FRAC_PI_2))?;
        check(("bumps.density_per_m2", bumps.density_per_m2, 0.0, 1e10))?;
        check(("bumps.density_per_m2 x radius_m² x elongation", cover(bumps), 0.0, MOST_COVER))?;
    }
    Ok(())
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    /// A plain, smooth, valid material for the tests of this crate.
    pub(crate) fn plain() -> Material {
        Material {
            id: "plain".to_owned(),
            name: "Plain".to_owned(),
            tags: Vec::new(),
            youngs_modulus_pa: 1e9,
            height_rms_m: 1e-6,
            hurst: 0.7,
            roll_off_m: 1e-3,
            stretch: 1.0,
            pattern: None,
            bumps: Vec::new(),
            friction_coefficient: 0.3,
            friction_heterogeneity: 0.1,
            stick_slip: None,
            patch_share: 1.0,
            contact_damping_ratio: 0.2,
            load_exponent: 0.1,
            valley_srgb: [60, 60, 60],
            peak_srgb: [200, 200, 200],
            gloss: 0.3,
            metallic: 0.0,
            mottle: 0.0,
            mottle_scale_m: 1e-3,
        }
    }

    fn check(change: impl FnOnce(&mut Material), expected_field: Option<&str>) {
        let mut material = plain();
        change(&mut material);
        let field = match validate(&material) {
            Ok(()) => None,
            Err(MaterialError::Id { .. }) => Some("id"),
            Err(MaterialError::OutOfRange { field, .. }) => Some(field),
        };
        assert_eq!(field, expected_field);
    }

    #[test]
    fn a_meaningful_material_is_valid_and_nonsense_is_named() {
        check(|_| (), None);
        check(|m| m.id = "sandpaper-p320".to_owned(), None);
        check(|m| m.id = String::new(), Some("id"));
        check(|m| m.id = "flat--rubber".to_owned(), Some("id"));
        check(|m| m.id = "Flat rubber".to_owned(), Some("id"));
        check(|m| m.hurst = f64::NAN, Some("hurst"));
        check(|m| m.gloss = 1.5, Some("gloss"));
        check(|m| m.youngs_modulus_pa = 0.0, Some("youngs_modulus_pa"));
        let stick_slip = |static_ratio, mps| {
            Some(StickSlip { static_ratio, stribeck_speed: crate::units::MetersPerSecond(mps) })
        };
        check(|m| m.stick_slip = stick_slip(1.3, 0.02), None);
        check(|m| m.stick_slip = stick_slip(0.9, 0.02), Some("stick_slip.static_ratio"));
        check(|m| m.stick_slip = stick_slip(1.3, f64::NAN), Some("stick_slip.stribeck_speed_mps"));
        let pattern = Pattern { kind: PatternKind::Twill, period_m: 0.0, amplitude_m: 1e-6, jitter: 0.1 };
        check(|m| m.pattern = Some(pattern), Some("pattern.period_m"));
        let bumps =
            Bumps { height_m: 1e-6, radius_m: 1e-4, elongation: 0.5, spread_rad: 0.0, density_per_m2: 1e6 };
        check(|m| m.bumps.push(bumps), Some("bumps.elongation"));
    }

    #[test]
    fn what_would_take_for_ever_is_refused() {
        let lattice =
            |period_m| Pattern { kind: PatternKind::Cells, period_m, amplitude_m: 1e-6, jitter: 0.1 };
        check(|m| m.pattern = Some(lattice(1e-5)), Some("pattern.period_m"));
        check(|m| m.pattern = Some(lattice(SHORTEST_PERIOD_M)), None);
        let bumps = |density_per_m2, radius_m, elongation| Bumps {
            height_m: 1e-6,
            radius_m,
            elongation,
            spread_rad: 0.0,
            density_per_m2,
        };
        let too_much = Some("bumps.density_per_m2 x radius_m² x elongation");
        // Each value alone is in range.
        check(|m| m.bumps.push(bumps(1e10, 1e-2, 1.0)), too_much);
        check(|m| m.bumps.push(bumps(1e10, 1e-6, 1e3)), too_much);
        check(|m| m.bumps.push(bumps(1e6, 1e-3, 1e3)), too_much);
        check(|m| m.bumps.push(bumps(1e10, 1e-6, 1.0)), None);
        check(|m| m.bumps.push(bumps(1e3, 1e-2, 1.0)), None);
        check(|m| m.bumps.push(bumps(40e6, 0.05e-3, 1.0)), None);
    }

    #[test]
    fn a_direction_is_that_of_the_fractal_the_pattern_or_the_bumps() {
        let check = |change: &dyn Fn(&mut Material), expected: bool| {
            let mut material = plain();
            change(&mut material);
            assert_eq!(material.is_directional(), expected, "{material:?}");
        };
        check(&|_| (), false);
        check(&|m| m.stretch = 2.0, true);
        let pattern = |kind, amplitude_m| Some(Pattern { kind, period_m: 1e-3, amplitude_m, jitter: 0.1 });
        for kind in [PatternKind::Ridges, PatternKind::Twill, PatternKind::PlainWeave, PatternKind::Loops] {
            check(&|m| m.pattern = pattern(kind, 1e-6), true);
            check(&|m| m.pattern = pattern(kind, 0.0), false);
        }
        check(&|m| m.pattern = pattern(PatternKind::Pebbles, 1e-6), false);
        let bumps = |elongation, spread_rad| Bumps {
            height_m: 1e-6,
            radius_m: 1e-4,
            elongation,
            spread_rad,
            density_per_m2: 1e6,
        };
        // Fibers along y, fibers in all directions, and round grains.
        check(&|m| m.bumps.push(bumps(12.0, 0.2)), true);
        check(&|m| m.bumps.push(bumps(12.0, 1.57)), false);
        check(&|m| m.bumps.push(bumps(1.0, 0.0)), false);
    }
}
