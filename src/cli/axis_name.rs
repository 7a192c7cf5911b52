//! Names of axes as the command line accepts them.

use shagreen_core::space::signal_axes::SignalAxis;
use shagreen_formats::library::{Library, TextureEntry};

/// Returns the name of an axis as a library writes it: the name of an axis that is computed from the vibration may have
/// hyphens instead of spaces. An unknown name stays as it is.
pub(crate) fn axis_name(library: &Library, name: &str) -> String {
    let name = name.trim();
    let is_attribute =
        |texture: &TextureEntry| texture.attributes.as_ref().is_some_and(|all| all.get(name).is_some());
    let is_of_library = library.axis_names().contains(&name) || library.textures.iter().any(is_attribute);
    let signal = SignalAxis::from_name(name).filter(|_| !is_of_library);
    signal.map_or_else(|| name.to_owned(), |axis| axis.name().to_owned())
}

/// Returns names of axes as a library writes them ([`axis_name`]).
pub(crate) fn axis_names(library: &Library, names: &[String]) -> Vec<String> {
    names.iter().map(|name| axis_name(library, name)).collect()
}

#[cfg(test)]
mod tests {
    use super::axis_name;
    use shagreen_core::space::LabelSource;
    use shagreen_formats::library::{Attribute, Attributes};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn computed_axes_may_have_hyphens_unless_an_attribute_has_the_name() {
        let mut library = starter_library().unwrap();
        for (given, name) in [
            ("tap-frequency", "tap frequency"),
            (" centroid", "centroid"),
            ("rough-smooth", "rough-smooth"),
            ("warm-cold", "warm-cold"),
        ] {
            assert_eq!(axis_name(&library, given), name);
        }
        let value = Attribute { name: "tap-frequency".to_owned(), value: 3.0 };
        library.textures[4].attributes =
            Some(Attributes { source: LabelSource::HumanRatings, values: vec![value] });
        assert_eq!(axis_name(&library, "tap-frequency"), "tap-frequency");
    }
}
