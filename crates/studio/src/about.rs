//! Name, version and licenses of the program and of the parts that it contains.

use crate::models::EFFICIENTNET_LITE0_LICENSE;

/// Name of the program.
pub const NAME: &str = "Shagreen";
/// Version of the program.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");
/// License of the program, as an SPDX expression.
pub const LICENSE: &str = env!("CARGO_PKG_LICENSE");

/// Part of the program with a license.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Part {
    /// Name of the part.
    pub name: &'static str,
    /// Use of the part.
    pub purpose: &'static str,
    /// License: an SPDX expression, or a list of them.
    pub license: &'static str,
}

/// All parts: fonts, then data and networks, then libraries.
pub const PARTS: [Part; 8] = [
    Part { name: "Ubuntu Light", purpose: "font of texts", license: "Ubuntu-font-1.0" },
    Part { name: "Hack", purpose: "font of code", license: "MIT AND Bitstream-Vera" },
    Part { name: "emoji-icon-font", purpose: "five symbols", license: "MIT" },
    Part { name: "Material Symbols", purpose: "icons of buttons", license: "Apache-2.0" },
    Part { name: "Starter library", purpose: "simulated textures and their pictures", license: LICENSE },
    Part { name: "Picture predictors", purpose: "networks trained on drawn materials", license: LICENSE },
    Part {
        name: "EfficientNet-Lite0",
        purpose: "image network; only if you download it",
        license: EFFICIENTNET_LITE0_LICENSE,
    },
    Part {
        name: "Rust libraries",
        purpose: "listed in Cargo.lock of the source code",
        license: "MIT, Apache-2.0, BSD, MPL-2.0 and others",
    },
];

/// Returns the address of the source code; `None` if the manifest of this crate states none.
pub fn repository() -> Option<&'static str> {
    stated(env!("CARGO_PKG_REPOSITORY"))
}

/// The text, or `None` if it is empty, as a key is that the manifest lacks.
fn stated(text: &'static str) -> Option<&'static str> {
    (!text.is_empty()).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::{LICENSE, PARTS, stated};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn each_part_has_a_name_of_its_own_a_purpose_and_a_license() {
        for (index, part) in PARTS.iter().enumerate() {
            assert!([part.name, part.purpose, part.license].iter().all(|text| !text.is_empty()), "{part:?}");
            assert!(PARTS[..index].iter().all(|other| other.name != part.name), "{part:?}");
        }
    }

    #[test]
    fn the_starter_library_states_the_license_that_is_listed() {
        assert_eq!(starter_library().unwrap().license, LICENSE);
    }

    #[test]
    fn a_key_that_the_manifest_lacks_is_not_stated() {
        assert_eq!([stated(""), stated("https://example.org")], [None, Some("https://example.org")]);
    }
}
