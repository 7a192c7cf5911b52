//! Parameters of physical materials, read from a TOML file; the source data of the starter library.
//!
//! The keys are the fields of [`Material`], all in SI units; pattern kinds are written in `kebab-case`. An unknown key
//! is an error, because its value would have no effect.

use std::collections::HashSet;

use serde::Deserialize;
use shagreen_core::surfaces::material::{Bumps, Material, MaterialError, Pattern, PatternKind, validate};
use shagreen_core::texture::stick_slip::StickSlip;
use shagreen_core::units::MetersPerSecond;

use crate::toml_text;

/// The materials of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct Materials {
    /// Random seed for the textures synthesized from them.
    pub seed: u64,
    /// At least one material; identifiers are unique.
    pub materials: Vec<Material>,
}

/// Why bytes are not a materials file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MaterialsError {
    /// The file is not UTF-8.
    #[error("the materials file is not valid UTF-8 at byte {at}; save the file as UTF-8")]
    NotText {
        /// Offset of the first invalid byte, from zero.
        at: usize,
    },
    /// Not TOML, or a key is missing, unknown or of the wrong type.
    #[error("cannot read the materials: {reason}; correct that line of the file")]
    Damaged {
        /// The parser's message with its line number, on one line.
        reason: String,
    },
    /// A number of a material is invalid.
    #[error("{0}; correct the material")]
    Material(#[from] MaterialError),
    /// Two materials have the same identifier.
    #[error("two materials have the id \"{id}\"; rename one of them")]
    Duplicate {
        /// The identifier.
        id: String,
    },
    /// The file has no materials.
    #[error("the file has no materials; add a [[material]] table")]
    Empty,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialsV1 {
    seed: u64,
    #[serde(default)]
    material: Vec<MaterialV1>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct MaterialV1 {
    id: String,
    name: String,
    #[serde(default)]
    tags: Vec<String>,
    youngs_modulus_pa: f64,
    height_rms_m: f64,
    hurst: f64,
    roll_off_m: f64,
    stretch: f64,
    pattern: Option<PatternV1>,
    #[serde(default)]
    bumps: Vec<BumpsV1>,
    friction_coefficient: f64,
    friction_heterogeneity: f64,
    stick_slip: Option<StickSlipV1>,
    patch_share: f64,
    contact_damping_ratio: f64,
    load_exponent: f64,
    valley_srgb: [u8; 3],
    peak_srgb: [u8; 3],
    gloss: f64,
    metallic: f64,
    mottle: f64,
    mottle_scale_m: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PatternV1 {
    kind: PatternKindV1,
    period_m: f64,
    amplitude_m: f64,
    jitter: f64,
}

/// The kind of a pattern, by its name in the file.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum PatternKindV1 {
    Ridges,
    PlainWeave,
    Twill,
    Domes,
    Loops,
    Pebbles,
    Cells,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct BumpsV1 {
    height_m: f64,
    radius_m: f64,
    elongation: f64,
    spread_rad: f64,
    density_per_m2: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StickSlipV1 {
    static_ratio: f64,
    stribeck_speed_mps: f64,
}

/// Reads materials.
///
/// # Errors
/// See [`MaterialsError`]; [`validate`] checks every number.
pub fn read_materials(bytes: &[u8]) -> Result<Materials, MaterialsError> {
    let text =
        std::str::from_utf8(bytes).map_err(|error| MaterialsError::NotText { at: error.valid_up_to() })?;
    let wire: MaterialsV1 = toml::from_str(text)
        .map_err(|error| MaterialsError::Damaged { reason: toml_text::reason(&error, text) })?;
    let materials: Vec<Material> = wire.material.into_iter().map(material).collect();
    if materials.is_empty() {
        return Err(MaterialsError::Empty);
    }
    let mut ids = HashSet::new();
    for material in &materials {
        validate(material)?;
        if !ids.insert(&material.id) {
            return Err(MaterialsError::Duplicate { id: material.id.clone() });
        }
    }
    Ok(Materials { seed: wire.seed, materials })
}

fn material(wire: MaterialV1) -> Material {
    Material {
        id: wire.id,
        name: wire.name,
        tags: wire.tags,
        youngs_modulus_pa: wire.youngs_modulus_pa,
        height_rms_m: wire.height_rms_m,
        hurst: wire.hurst,
        roll_off_m: wire.roll_off_m,
        stretch: wire.stretch,
        pattern: wire.pattern.as_ref().map(pattern),
        bumps: wire.bumps.iter().map(bumps).collect(),
        friction_coefficient: wire.friction_coefficient,
        friction_heterogeneity: wire.friction_heterogeneity,
        stick_slip: wire.stick_slip.map(|StickSlipV1 { static_ratio, stribeck_speed_mps }| StickSlip {
            static_ratio,
            stribeck_speed: MetersPerSecond(stribeck_speed_mps),
        }),
        patch_share: wire.patch_share,
        contact_damping_ratio: wire.contact_damping_ratio,
        load_exponent: wire.load_exponent,
        valley_srgb: wire.valley_srgb,
        peak_srgb: wire.peak_srgb,
        gloss: wire.gloss,
        metallic: wire.metallic,
        mottle: wire.mottle,
        mottle_scale_m: wire.mottle_scale_m,
    }
}

fn pattern(wire: &PatternV1) -> Pattern {
    let PatternV1 { kind, period_m, amplitude_m, jitter } = *wire;
    Pattern { kind: kind.into(), period_m, amplitude_m, jitter }
}

impl From<PatternKindV1> for PatternKind {
    fn from(kind: PatternKindV1) -> Self {
        match kind {
            PatternKindV1::Ridges => Self::Ridges,
            PatternKindV1::PlainWeave => Self::PlainWeave,
            PatternKindV1::Twill => Self::Twill,
            PatternKindV1::Domes => Self::Domes,
            PatternKindV1::Loops => Self::Loops,
            PatternKindV1::Pebbles => Self::Pebbles,
            PatternKindV1::Cells => Self::Cells,
        }
    }
}

fn bumps(wire: &BumpsV1) -> Bumps {
    Bumps {
        height_m: wire.height_m,
        radius_m: wire.radius_m,
        elongation: wire.elongation,
        spread_rad: wire.spread_rad,
        density_per_m2: wire.density_per_m2,
    }
}

#[cfg(test)]
mod tests {
    use super::read_materials;
    use shagreen_core::surfaces::material::PatternKind;
    use shagreen_core::texture::stick_slip::StickSlip;
    use shagreen_core::units::MetersPerSecond;

    const STARTER: &str = include_str!("../../../assets/starter/materials.toml");

    /// A file with one material.
    const SMALL: &str = r#"
seed = 1
[[material]]
id = "glass"
name = "Glass"
youngs_modulus_pa = 6e10
height_rms_m = 1e-7
hurst = 0.8
roll_off_m = 3e-3
stretch = 1.0
pattern = { kind = "plain-weave", period_m = 1e-3, amplitude_m = 1e-6, jitter = 0.1 }
bumps = [{ height_m = 1e-6, radius_m = 1e-4, elongation = 1.0, spread_rad = 0.0, density_per_m2 = 1e5 }]
friction_coefficient = 0.15
friction_heterogeneity = 0.1
stick_slip = { static_ratio = 1.4, stribeck_speed_mps = 0.02 }
patch_share = 1.0
contact_damping_ratio = 0.15
load_exponent = 0.05
valley_srgb = [1, 2, 3]
peak_srgb = [4, 5, 6]
gloss = 1.0
metallic = 0.0
mottle = 0.0
mottle_scale_m = 5e-3
"#;

    #[track_caller]
    fn check_error(text: &str, expected: &str) {
        let message = read_materials(text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains(expected) && !message.contains('\n'), "{message}");
    }

    #[test]
    fn the_starter_has_twenty_five_materials() {
        assert_eq!(read_materials(STARTER.as_bytes()).unwrap().materials.len(), 25);
    }

    #[test]
    fn every_key_is_read() {
        let read = read_materials(SMALL.as_bytes()).unwrap();
        assert_eq!(read.seed, 1);
        let glass = &read.materials[0];
        assert_eq!((glass.id.as_str(), glass.youngs_modulus_pa, glass.peak_srgb), ("glass", 6e10, [4, 5, 6]));
        assert_eq!(glass.pattern.unwrap().kind, PatternKind::PlainWeave);
        assert_eq!(glass.bumps[0].density_per_m2, 1e5);
        let stick_slip = StickSlip { static_ratio: 1.4, stribeck_speed: MetersPerSecond(0.02) };
        assert_eq!(glass.stick_slip, Some(stick_slip));
        let without = SMALL.replace("stick_slip = {", "# stick_slip = {");
        assert_eq!(read_materials(without.as_bytes()).unwrap().materials[0].stick_slip, None);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_place() {
        check_error(&SMALL.replace("gloss = ", "glos = "), "glos");
        check_error(&SMALL.replace("hurst = 0.8", "hurst = nan"), "hurst of glass is NaN");
        check_error(&SMALL.replace("ratio = 1.4", "ratio = 0.5"), "stick_slip.static_ratio of glass is 0.5");
        check_error(&format!("{SMALL}{}", &SMALL[SMALL.find("[[").unwrap()..]), "two materials");
        check_error("seed = 1", "no materials");
        check_error("seed = 1\n[[material]]\nid = 5", "line 3");
        check_error(&SMALL.replace("plain-weave", "knit"), "line 11");
        assert!(read_materials(b"seed = \xff").unwrap_err().to_string().contains("byte 7"));
    }
}
