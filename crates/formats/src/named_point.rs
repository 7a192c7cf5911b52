//! Coordinates of a point by the names of the axes, as sidecars and scripts state them.

use std::collections::BTreeMap;

use shagreen_core::space::SpacePoint;

use crate::project::plain_axis_name;

/// Returns the coordinates of a point by the names of its axes, each 0 to 100. `axes` are in the order of the coordinates, as in a
/// library or a project.
pub fn named_coordinates(
    axes: impl IntoIterator<Item = impl AsRef<str>>,
    at: SpacePoint,
) -> BTreeMap<String, f64> {
    let names = axes.into_iter().map(|axis| plain_axis_name(axis.as_ref()).to_owned());
    names.zip(at.coordinates().iter().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::named_coordinates;
    use shagreen_core::space::SpacePoint;

    #[test]
    fn each_coordinate_has_the_name_of_its_axis() {
        let at = SpacePoint::of(&[30.0, 70.0, 45.0]).unwrap();
        let named = named_coordinates(["warm-cold", "attribute:hard-soft", "centroid"], at);
        let named: Vec<(&str, f64)> = named.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        assert_eq!(named, [("centroid", 45.0), ("hard-soft", 70.0), ("warm-cold", 30.0)]);
    }
}
