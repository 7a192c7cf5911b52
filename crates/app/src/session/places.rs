//! What a library states of its textures, and the names and words of its axes.

use shagreen_formats::library::{Attributes, Library, Place};
use shagreen_studio::axes::axis_poles;

/// Names, positions, attributes and header of a library as opened, to be restored.
pub(super) struct Opened {
    /// Library without its textures.
    header: Library,
    textures: Vec<(String, Option<Place>, Option<Attributes>)>,
}

impl Opened {
    pub(super) fn new(library: &Library) -> Self {
        let header = Library {
            name: library.name.clone(),
            description: library.description.clone(),
            origin: library.origin.clone(),
            license: library.license.clone(),
            created_by: library.created_by.clone(),
            seed: library.seed,
            axes: library.axes.clone(),
            space_report: library.space_report.clone(),
            textures: Vec::new(),
            unknown: library.unknown.clone(),
        };
        let textures =
            library.textures.iter().map(|t| (t.name.clone(), t.place, t.attributes.clone())).collect();
        Self { header, textures }
    }

    pub(super) fn n_textures(&self) -> usize {
        self.textures.len()
    }

    /// Removes added textures, and restores the names, positions and attributes of the others.
    pub(super) fn restore(&self, library: &mut Library) {
        let mut textures = std::mem::take(&mut library.textures);
        textures.truncate(self.textures.len());
        for (texture, (name, place, attributes)) in textures.iter_mut().zip(&self.textures) {
            texture.name.clone_from(name);
            (texture.place, texture.attributes) = (*place, attributes.clone());
        }
        *library = Library { textures, ..self.header.clone() };
    }
}

/// Names of the axes in use: those of the project if it chooses any, or else those of the positions.
pub(super) fn names_of(library: &Library, axes: Option<&[String]>) -> Vec<String> {
    match axes {
        Some(axes) => axes.to_vec(),
        None => library.axis_names().into_iter().map(str::to_owned).collect(),
    }
}

/// Words at both ends of the axes with these names. An attribute may have one word only.
pub(super) fn poles_of(names: &[String]) -> Vec<[String; 2]> {
    names.iter().map(|name| axis_poles(name)).collect()
}

#[cfg(test)]
mod tests {
    use super::{Opened, names_of, poles_of};
    use shagreen_core::space::LabelSource;
    use shagreen_core::space::signal_axes::SignalAxis;
    use shagreen_formats::library::{Attribute, Attributes, Library, Place};
    use shagreen_formats::project::AddedCoordinates;
    use shagreen_formats::starter::starter_library;
    use shagreen_studio::axes::{AxisColumns, list_places};

    fn attributes(values: &[(&str, f64)]) -> Attributes {
        let value = |(name, value): &(&str, f64)| Attribute { name: (*name).to_owned(), value: *value };
        Attributes { source: LabelSource::SimulatedRaters, values: values.iter().map(value).collect() }
    }

    fn names(axes: &[&str]) -> Vec<String> {
        axes.iter().map(|name| (*name).to_owned()).collect()
    }

    fn placed(library: &Library, axes: Option<&[String]>) -> Vec<Option<Place>> {
        list_places(library, axes, &mut AxisColumns::default(), &AddedCoordinates::default())
    }

    #[test]
    fn attributes_are_axes_where_all_are_known() {
        let mut library = starter_library().unwrap();
        library.textures[0].attributes = Some(attributes(&[("flat-bumpy", 3.0), ("warm-cold", 70.0)]));
        library.textures[1].attributes = Some(attributes(&[("flat-bumpy", 5.0)]));
        let axes = names(&["warm-cold", "flat-bumpy"]);
        let found = placed(&library, Some(&axes));
        let first = found[0].unwrap();
        assert_eq!((first.at.x(), first.at.y()), (70.0, 3.0));
        assert_eq!(first.source, LabelSource::SimulatedRaters);
        assert!(found[1..].iter().all(Option::is_none));
        assert_eq!(placed(&library, None)[1], library.textures[1].place);
        let of = |axes: Option<&[String]>| poles_of(&names_of(&library, axes));
        assert_eq!(of(Some(&axes)), [["warm", "cold"], ["flat", "bumpy"]]);
        let odd = names(&["non-stick - sticky", "warm"]);
        assert_eq!(of(Some(&odd)), [["non-stick", "sticky"], ["warm", ""]]);
        let computed = names(&["centroid", "dimension 2", "attribute:hard-soft"]);
        assert_eq!(
            of(Some(&computed)),
            [["dull", "bright"], ["low dimension 2", "high dimension 2"], ["hard", "soft"]]
        );
        assert_eq!(of(None), [["rough", "smooth"], ["hard", "soft"]]);
        library.axes = Some(axes);
        assert_eq!(poles_of(&names_of(&library, None)), [["warm", "cold"], ["flat", "bumpy"]]);
    }

    #[test]
    fn further_axes_are_added_to_those_of_the_positions() {
        let mut library = starter_library().unwrap();
        library.textures[2].attributes = Some(attributes(&[("sticky-slippery", 64.0)]));
        let own = library.textures[2].place.unwrap();
        let axes = names(&["hard-soft", "rough-smooth", "sticky-slippery", "centroid"]);
        let found = placed(&library, Some(&axes));
        let centroid = SignalAxis::Centroid.of(&library.textures[2].model).unwrap();
        let at = found[2].unwrap().at;
        assert_eq!(at.coordinates(), [own.at.y(), own.at.x(), 64.0, centroid]);
        assert_eq!((found[2].unwrap().source, found.iter().flatten().count()), (own.source, 1));
        // The names of the library's own axes change nothing.
        let usual = names(&["rough-smooth", "hard-soft"]);
        assert_eq!(placed(&library, Some(&usual)), placed(&library, None));
        assert!(placed(&library, Some(&names(&["rough-smooth", "sour-sweet"]))).iter().all(Option::is_none));
        // Axes of the vibration alone are physical.
        let physical = placed(&library, Some(&names(&["centroid"])));
        assert!(physical.iter().flatten().all(|place| place.source == LabelSource::PhysicalLabels));
        assert_eq!(physical.len(), library.textures.len());
    }

    #[test]
    fn a_texture_on_another_number_of_axes_has_no_position() {
        let mut library = starter_library().unwrap();
        if let Some(place) = &mut library.textures[4].place {
            place.at = place.at.on(3);
        }
        let found = placed(&library, None);
        assert!(found[4].is_none() && found.iter().flatten().count() == library.textures.len() - 1);
    }

    #[test]
    fn what_was_opened_comes_back_exactly() {
        let before = starter_library().unwrap();
        let opened = Opened::new(&before);
        let mut library = before.clone();
        library.textures[2].place = None;
        library.textures[3].attributes = Some(attributes(&[("a-b", 1.0)]));
        library.textures[4].name.push('!');
        library.textures.push(before.textures[0].clone());
        opened.restore(&mut library);
        assert_eq!(library, before);
    }
}
