//! Physical features, computed from the texture model, without noise.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use crate::dsp::spectrum;
use crate::space::features::error::{FeatureError, FeatureWarning};
use crate::space::features::{FeatureTable, NamedTexture, check_names, table};
use crate::texture::TextureModel;
use crate::texture::patterns::{clamped, is_within};
use crate::texture::plane::Plane;
use crate::texture::tap::Tap;
use crate::units::{Contact, Hertz};

/// Frequency band of the spectral features, as in the authoring paper; limited to half of a model's sample rate.
pub const PHYSICAL_BAND: (Hertz, Hertz) = (Hertz(10.0), Hertz(500.0));

/// Frequency step within the band, in Hz: a fifth of the narrowest resonance that one second of signal resolves.
const STEP_HZ: f64 = 2.0;

/// Physical features of one texture; an entry is `None` if the texture lacks it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physical {
    /// Mean level over the patterns, in dB re 1 m/s².
    pub level_db: Option<f64>,
    /// Exponent `a` of the power law `level ~ speed^a force^b`.
    pub speed_exponent: Option<f64>,
    /// Exponent `b` of that power law.
    pub force_exponent: Option<f64>,
    /// Mean spectral centroid over the patterns, in Hz.
    pub centroid_hz: Option<f64>,
    /// Kinetic friction coefficient.
    pub friction: Option<f64>,
    /// Frequency of the tap transient, in Hz; it rises with hardness.
    pub tap_frequency_hz: Option<f64>,
    /// Decay rate of the tap transient, in 1/s.
    pub tap_decay_per_sec: Option<f64>,
    /// Spectral centroid of the tap transient, in Hz.
    pub tap_centroid_hz: Option<f64>,
}

/// Physical features of a texture over stroke patterns.
///
/// A pattern above the highest measured speed or force of the texture is evaluated at that limit, but does not enter
/// the exponents. Patterns in which the texture is silent are ignored.
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

/// Table of the [`Physical`] features that all textures have.
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

/// Mean level in dB re 1 m/s² over the contacts where the texture is not silent; `None` if it always is.
pub fn level_db(plane: &Plane, contacts: &[Contact]) -> Option<f64> {
    let levels = contacts.iter().map(|c| plane.at(*c).level_mps2).filter(|level| *level > 0.0);
    mean(levels.map(|level| 20.0 * level.log10()))
}

/// Exponents of speed and force in the power law that fits the levels, by least squares on logarithms. `None` if there
/// are too few different speeds and forces with a level above zero.
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
    // Collinear speeds and forces give only rounding error; no points give NaN, which also fails this comparison.
    if determinant > 1e-9 * vv * ff {
        Some(((ff * vl - vf * fl) / determinant, (vv * fl - vf * vl) / determinant))
    } else {
        None
    }
}

/// Spectral centroid within [`PHYSICAL_BAND`], averaged over the contacts where the texture is not silent; `None` if it
/// always is.
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

/// Centroid of the energy spectrum of a tap transient over all frequencies; `None` if it does not oscillate or decay.
///
/// The energy spectrum of `e^{-Bt} sin ωt` is `ω² / ((s - ω² + B²)² + 4 B² ω²)`, where `s` is the squared angular
/// frequency. Its centroid has the closed form `(B² + ω²) / (π ω) (π/2 + atan((ω² - B²) / 2 B ω))`.
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
