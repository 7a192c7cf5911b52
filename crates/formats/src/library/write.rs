//! From a library to bytes, always the same for the same library.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::Map;
use shagreen_core::space::LabelSource;
use shagreen_core::tap::Tap;
use shagreen_core::texture::Interpolation;
use shagreen_core::texture_path::TexturePath;

use crate::layout;
use crate::library::anchors::{anchors, interpolation_word};
use crate::library::v1::{LibraryV1, PhysicalV1, PictureV1, SpaceV1, TapV1, TextureV1, UnitsV1};
use crate::library::{FORMAT, Library, Place, Provenance, TextureEntry, VERSION_MAJOR};
use crate::library::{attributes, path, relief};
use crate::picture::Picture;

/// The word for [`Provenance::Restricted`].
pub(super) const RESTRICTED: &str = "restricted";

/// Quantities of the format and their units, in the order of [`UnitsV1`].
pub(super) const UNITS: [(&str, &str); 6] = [
    ("speed", "mm/s"),
    ("force", "N"),
    ("acceleration", "m/s^2"),
    ("rate", "Hz"),
    ("lsf", "rad"),
    ("length", "mm"),
];

/// An anchor stands on one line: it lies in library, textures, texture, anchors.
const OPEN_DEPTH: usize = 4;

/// Decimals of line spectral frequencies and positions in a file.
const DECIMALS: usize = 6;
/// Frequencies closer than this stand in full: a resonance as narrow as they make it would change by more than a
/// thousandth if they were rounded, and by a gap that a model must keep.
const CLOSE_RAD: f64 = 1e-3;
/// Significant digits of levels and labels in a file: far finer than anyone can measure.
pub(crate) const DIGITS: usize = 6;
/// Significant digits of speeds, forces and rates: takes the dust of unit conversion off, and nothing else.
pub(crate) const CONVERSION_DIGITS: usize = 12;

/// The minor version that brought estimates.
const WITH_ESTIMATES: u32 = 6;
/// The minor version that brought reliefs.
const WITH_RELIEFS: u32 = 5;
/// The minor version that brought paths.
const WITH_PATHS: u32 = 4;
/// The minor version that brought names of axes.
const WITH_AXES: u32 = 3;
/// The minor version that brought attributes and the report of a space.
const WITH_ATTRIBUTES: u32 = 2;

/// Writes a library, with numbers as long as they mean something: line spectral frequencies to six decimals, levels to
/// six digits. Reading it back and writing it again gives the same bytes.
pub fn write_library(library: &Library) -> Vec<u8> {
    layout::to_bytes(&wire(library), OPEN_DEPTH)
}

/// A library as a file, or a part of another file, has it.
pub(crate) fn wire(library: &Library) -> LibraryV1 {
    let units = UNITS.map(|(_, unit)| unit.to_owned());
    let [speed, force, acceleration, rate, lsf, length] = units;
    LibraryV1 {
        format: FORMAT.to_owned(),
        version: format!("{VERSION_MAJOR}.{}", minor_version(library)),
        units: UnitsV1 {
            speed,
            force,
            acceleration,
            rate,
            lsf,
            length,
            unknown: library.unknown.units.clone(),
        },
        name: library.name.clone(),
        description: library.description.clone(),
        origin: library.origin.clone(),
        licence: library.license.clone(),
        created_by: library.created_by.clone(),
        seed: library.seed,
        axes: library.axes.clone().map(Vec::from),
        space_report: library.space_report.clone(),
        unknown: library.unknown.library.clone(),
        textures: library.textures.iter().map(texture).collect(),
    }
}

/// A texture as a file has it.
pub(crate) fn texture(entry: &TextureEntry) -> TextureV1 {
    let unknown = &entry.unknown;
    TextureV1 {
        id: entry.id.clone(),
        name: entry.name.clone(),
        tags: entry.tags.clone(),
        licence: entry.license.clone(),
        origin: entry.origin.clone(),
        description: entry.description.clone(),
        space: entry.place.map(|at| SpaceV1 { unknown: unknown.space.clone(), ..place(at) }),
        attributes: entry.attributes.as_ref().map(|a| attributes::write(a, unknown)),
        physical: entry.physical.map(|labels| PhysicalV1 {
            roughness_log10_mps2: digits(labels.roughness_log10_mps2, DIGITS),
            hardness_log10_n_per_m: digits(labels.hardness_log10_n_per_m, DIGITS),
            unknown: unknown.physical.clone(),
        }),
        provenance: (entry.provenance == Provenance::Restricted).then(|| RESTRICTED.to_owned()),
        rate_hz: digits(entry.model.rate().0, CONVERSION_DIGITS),
        mu: entry.model.friction().map(|mu| digits(mu, DIGITS)),
        unknown: unknown.texture.clone(),
        interpolation: interpolation_word(&entry.model).map(str::to_owned),
        tap: entry.model.tap().map(|measured| TapV1 { unknown: unknown.tap.clone(), ..tap(measured) }),
        anchors: anchors(&entry.model, &unknown.anchors),
        path: entry.path.as_ref().map(|way| path::write(way, unknown)),
        relief: entry.model.relief().map(|of| relief::write(of, &unknown.relief)),
        picture: entry
            .picture
            .as_ref()
            .map(|shown| PictureV1 { unknown: unknown.picture.clone(), ..picture(shown) }),
    }
}

/// A place as a file has it.
pub(crate) fn place(place: Place) -> SpaceV1 {
    SpaceV1 {
        rough_smooth: decimals(place.at.rough_smooth),
        hard_soft: decimals(place.at.hard_soft),
        label_source: place.source.id().to_owned(),
        unknown: Map::new(),
    }
}

/// A picture as a file has it.
pub(crate) fn picture(picture: &Picture) -> PictureV1 {
    PictureV1 {
        media_type: picture.format.media_type().to_owned(),
        width: picture.width,
        height: picture.height,
        millimeters: digits(picture.millimeters, CONVERSION_DIGITS),
        base64: STANDARD.encode(&picture.bytes),
        unknown: Map::new(),
    }
}

/// The lowest minor version that has all that a library uses: older programs read what they can.
fn minor_version(library: &Library) -> u32 {
    let is_estimated = |entry: &TextureEntry| {
        let sources = [entry.place.map(|place| place.source), entry.attributes.as_ref().map(|of| of.source)];
        sources.contains(&Some(LabelSource::Estimated))
    };
    if library.textures.iter().any(is_estimated) {
        return WITH_ESTIMATES;
    }
    let has_relief = |entry: &TextureEntry| {
        let keys = entry.path.iter().flat_map(TexturePath::keys);
        keys.map(|key| &key.model).chain([&entry.model]).any(|model| model.relief().is_some())
    };
    if library.textures.iter().any(has_relief) {
        return WITH_RELIEFS;
    }
    if library.textures.iter().any(|entry| entry.path.is_some()) {
        return WITH_PATHS;
    }
    if library.axes.is_some() {
        return WITH_AXES;
    }
    if library.space_report.is_some() || library.textures.iter().any(|entry| entry.attributes.is_some()) {
        return WITH_ATTRIBUTES;
    }
    let is_new = |entry: &TextureEntry| {
        entry.provenance != Provenance::Free
            || entry.model.interpolation() != Some(Interpolation::Barycentric)
            || entry.model.tap().is_some()
    };
    u32::from(library.textures.iter().any(is_new))
}

pub(super) fn tap(tap: Tap) -> TapV1 {
    TapV1 {
        frequency_hz: digits(tap.frequency.0, DIGITS),
        decay_per_s: digits(tap.decay_per_sec, DIGITS),
        amplitude_mps2: digits(tap.amplitude_mps2, DIGITS),
        unknown: Map::new(),
    }
}

/// Frequencies to [`DECIMALS`], but in full where two lie, or one and an end, within [`CLOSE_RAD`].
pub(crate) fn frequencies(lsf: &[f64]) -> Vec<f64> {
    let ends = [0.0, std::f64::consts::PI];
    let above = ends[..1].iter().chain(lsf).zip(lsf.iter().chain(&ends[1..]));
    let is_close = above.into_iter().any(|(low, high)| high - low < CLOSE_RAD);
    if is_close { lsf.to_vec() } else { lsf.iter().map(|w| decimals(*w)).collect() }
}

/// The nearest number of [`DECIMALS`] decimals; decimal text is the rounding that prints short.
pub(super) fn decimals(value: f64) -> f64 {
    format!("{value:.DECIMALS$}").parse().unwrap_or(value)
}

/// The nearest number of so many significant digits.
pub(crate) fn digits(value: f64, n: usize) -> f64 {
    let after_point = n - 1;
    format!("{value:.after_point$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::{DIGITS, decimals, digits, frequencies};

    #[test]
    fn rounds_as_text_does() {
        assert_eq!(decimals(0.123_456_49), 0.123_456);
        assert_eq!(digits(0.000_123_456_789, DIGITS), 0.000_123_457);
        assert_eq!(digits(0.0, DIGITS), 0.0);
        assert_eq!(digits(30.000_000_000_000_004, 12), 30.0);
    }

    #[test]
    fn close_frequencies_stay_apart() {
        let close = [1e-8, 0.5, 0.5 + 1e-8, 3.0];
        assert_eq!(frequencies(&close), close);
        assert_eq!(frequencies(&[0.500_000_04, 0.6]), [0.5, 0.6]);
    }
}
