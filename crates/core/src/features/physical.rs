//! A few quantities of physics: of the model itself, without noise.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::features::error::{FeatureError, FeatureWarning};
use crate::features::{FeatureTable, NamedTexture, check_names, table};
use crate::patterns::{clamped, is_within};
use crate::plane::Plane;
use crate::spectrum;
use crate::tap::Tap;
use crate::texture::TextureModel;
use crate::units::{Contact, Hertz};

/// Where spectra count, as in the authoring paper; up to half of a model's rate where that is less.
pub const PHYSICAL_BAND: (Hertz, Hertz) = (Hertz(10.0), Hertz(500.0));

/// Steps of frequency within the band, in Hz: a fifth of the narrowest resonance that a second shows.
const STEP_HZ: f64 = 2.0;

/// Physical quantities of one texture; `None` where it has no such quantity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physical {
    /// Mean over the patterns of the level, in dB re 1 m/s².
    pub level_db: Option<f64>,
    /// `a` of the power law `level ~ speed^a force^b`.
    pub speed_exponent: Option<f64>,
    /// `b` of it.
    pub force_exponent: Option<f64>,
    /// Mean over the patterns of the spectral centroid, in Hz.
    pub centroid_hz: Option<f64>,
    /// Kinetic friction coefficient.
    pub friction: Option<f64>,
    /// Frequency at which a landing rings, in Hz: it rises with hardness.
    pub tap_frequency_hz: Option<f64>,
    /// Decay of a landing, in 1/s.
    pub tap_decay_per_sec: Option<f64>,
    /// Spectral centroid of a landing, in Hz.
    pub tap_centroid_hz: Option<f64>,
}

/// Physical quantities of a texture over patterns.
///
/// A pattern beyond the texture counts as its highest, but not for the exponents; one in which the texture is silent does
/// not count.
pub fn physical(model: &TextureModel, contacts: &[Contact]) -> Physical {
    let plane = Plane::new(model);
    let within: Vec<Contact> = contacts.iter().copied().filter(|c| is_within(model, *c)).collect();
    let exponents = level_exponents(&plane, &within);
    Physical {
        level_db: level_db(&plane, contacts),
        speed_exponent: exponents.map(|(speed, _)| speed),
        force_exponent: exponents.map(|(_, force)| force),
        centroid_hz: centroid(&plane, contacts).map(|f| f.0),
        friction: model.friction(),
        tap_frequency_hz: model.tap().map(|tap| tap.frequency.0),
        tap_decay_per_sec: model.tap().map(|tap| tap.decay_per_sec),
        tap_centroid_hz: model.tap().and_then(|tap| tap_centroid(&tap)).map(|f| f.0),
    }
}

/// [`Physical`] of textures as a table of those features that all of them have.
///
/// # Errors
/// [`FeatureError::NoTextures`] and [`FeatureError::SameName`].
pub fn physical_table(
    textures: &[NamedTexture<'_>],
    contacts: &[Contact],
) -> Result<FeatureTable, FeatureError> {
    type Take = fn(&Physical) -> Option<f64>;
    let features: [(&'static str, Take); 8] = [
        ("level (dB re 1 m/s²)", |p| p.level_db),
        ("speed exponent of the level", |p| p.speed_exponent),
        ("force exponent of the level", |p| p.force_exponent),
        ("spectral centroid (Hz)", |p| p.centroid_hz),
        ("friction coefficient", |p| p.friction),
        ("frequency of a tap (Hz)", |p| p.tap_frequency_hz),
        ("decay of a tap (1/s)", |p| p.tap_decay_per_sec),
        ("spectral centroid of a tap (Hz)", |p| p.tap_centroid_hz),
    ];
    check_names(textures)?;
    let of_textures: Vec<Physical> = textures.iter().map(|t| physical(t.model, contacts)).collect();
    let (mut names, mut columns) = (Vec::new(), Vec::new());
    let beyond = |texture: &NamedTexture<'_>| {
        let warning = clamped(texture.model, contacts)?;
        Some(FeatureWarning::Pattern { texture: texture.name.to_owned(), warning })
    };
    let mut warnings: Vec<FeatureWarning> = textures.iter().filter_map(beyond).collect();
    for (feature, take) in features {
        let column: Vec<f64> = of_textures.iter().filter_map(take).collect();
        if column.len() == textures.len() {
            names.push(feature.to_owned());
            columns.push(column);
        } else {
            let lacks = textures.iter().zip(&of_textures).filter(|(_, p)| take(p).is_none());
            let textures = lacks.map(|(texture, _)| texture.name.to_owned()).collect();
            warnings.push(FeatureWarning::Absent { feature, textures });
        }
    }
    let values = (0..textures.len()).flat_map(|row| columns.iter().map(move |c| c[row])).collect();
    Ok(FeatureTable {
        label: format!("physical, {} patterns", contacts.len()),
        textures: textures.iter().map(|t| t.name.to_owned()).collect(),
        values: table(textures.len(), names.len(), values),
        names,
        warnings,
    })
}

/// Mean level in dB re 1 m/s² over those contacts where the texture sounds; `None` where it never does.
pub fn level_db(plane: &Plane, contacts: &[Contact]) -> Option<f64> {
    let levels = contacts.iter().map(|c| plane.at(*c).level_mps2).filter(|level| *level > 0.0);
    mean(levels.map(|level| 20.0 * level.log10()))
}

/// Exponents of speed and force of the power law that fits the levels best, by least squares over logarithms; `None` where
/// the texture sounds at too few different speeds and forces to tell.
pub(super) fn level_exponents(plane: &Plane, contacts: &[Contact]) -> Option<(f64, f64)> {
    let point = |c: &Contact| {
        let level = plane.at(*c).level_mps2;
        (level > 0.0 && c.speed.0 > 0.0 && c.force.0 > 0.0)
            .then(|| [c.speed.0.ln(), c.force.0.ln(), level.ln()])
    };
    let points: Vec<[f64; 3]> = contacts.iter().filter_map(point).collect();
    let n = points.len() as f64;
    let means = [0, 1, 2].map(|i| points.iter().map(|p| p[i]).sum::<f64>() / n);
    let product =
        |i: usize, j: usize| points.iter().map(|p| (p[i] - means[i]) * (p[j] - means[j])).sum::<f64>();
    let (vv, ff, vf, vl, fl) = (product(0, 0), product(1, 1), product(0, 1), product(0, 2), product(1, 2));
    let determinant = vv * ff - vf * vf;
    // Speeds and forces on one line leave a rounding; none at all leave a NaN, which is not more either.
    if determinant > 1e-9 * vv * ff {
        Some(((ff * vl - vf * fl) / determinant, (vv * fl - vf * vl) / determinant))
    } else {
        None
    }
}

/// Mean over those contacts where the texture sounds of the centroid of its density within [`PHYSICAL_BAND`]; `None`
/// where it never does.
pub fn centroid(plane: &Plane, contacts: &[Contact]) -> Option<Hertz> {
    let (low, high) = PHYSICAL_BAND;
    let of_contact = |c: &Contact| {
        let grain = plane.at(*c);
        let high = high.0.min(0.5 * grain.rate.0);
        let n = ((high - low.0) / STEP_HZ).floor() as usize;
        let frequencies: Vec<Hertz> = (0..=n).map(|i| Hertz(low.0 + i as f64 * STEP_HZ)).collect();
        let density: Vec<(Hertz, f64)> = frequencies.iter().copied().zip(grain.psd(&frequencies)).collect();
        (grain.level_mps2 > 0.0).then(|| spectrum::centroid(&density, low, Hertz(high)).0)
    };
    mean(contacts.iter().filter_map(of_contact)).map(Hertz)
}

/// Centroid of the energy spectrum of a landing over all frequencies; `None` where it does not ring or decay.
///
/// The spectrum of `e^{-Bt} sin ωt` is `ω² / ((s - ω² + B²)² + 4 B² ω²)` over the square `s` of the angular frequency, which
/// can be integrated: `(B² + ω²) / (π ω) (π/2 + atan((ω² - B²) / 2 B ω))`.
pub(super) fn tap_centroid(tap: &Tap) -> Option<Hertz> {
    let (w, b) = (TAU * tap.frequency.0, tap.decay_per_sec);
    let is_ring = w > 0.0 && b > 0.0 && w.is_finite() && b.is_finite();
    is_ring.then(|| {
        let angle = FRAC_PI_2 + ((w * w - b * b) / (2.0 * b * w)).atan();
        Hertz((b * b + w * w) / (PI * w) * angle / TAU)
    })
}

fn mean(values: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, n) = values.fold((0.0, 0.0), |(sum, n), v| (sum + v, n + 1.0));
    (n > 0.0).then(|| sum / n)
}
