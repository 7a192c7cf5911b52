//! Positions of the textures: from the library file, from a space in use, or from two attributes.

use shagreen_core::people::ratings::poles;
use shagreen_core::space::SpacePoint;
use shagreen_formats::library::{Attributes, Library, Place, TextureEntry, USUAL_AXES};

use crate::strings;

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

/// Position of each texture: from the attributes of the x axis and the y axis if `axes` names them, otherwise the
/// texture's own.
pub(super) fn places(textures: &[TextureEntry], axes: Option<&[String; 2]>) -> Vec<Option<Place>> {
    let by_attributes = |texture: &TextureEntry, [across, up]: &[String; 2]| {
        let attributes = texture.attributes.as_ref()?;
        let at = SpacePoint { rough_smooth: attributes.get(across)?, hard_soft: attributes.get(up)? };
        Some(Place::new(at, attributes.source))
    };
    textures.iter().map(|texture| axes.map_or(texture.place, |axes| by_attributes(texture, axes))).collect()
}

/// Names of the attributes on which textures are rated, without duplicates, in order of first appearance.
pub(super) fn attribute_names(textures: &[TextureEntry]) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for attribute in textures.iter().filter_map(|t| t.attributes.as_ref()).flat_map(|a| &a.values) {
        if !names.contains(&attribute.name.as_str()) {
            names.push(&attribute.name);
        }
    }
    names
}

/// Words at both ends of both axes: of the selected attributes, otherwise of the axes stated by the library, otherwise
/// the usual ones.
pub(super) fn poles_of(library: &Library, axes: Option<&[String; 2]>) -> [[String; 2]; 2] {
    let usual = [[strings::ROUGH, strings::SMOOTH], [strings::HARD, strings::SOFT]];
    let named = library.axis_names();
    [0, 1].map(|axis| match axes {
        Some(axes) => poles(&axes[axis]),
        None if named == USUAL_AXES => usual[axis].map(str::to_owned),
        None => poles(named[axis]),
    })
}

#[cfg(test)]
mod tests {
    use super::{Opened, attribute_names, places, poles_of};
    use shagreen_core::space::LabelSource;
    use shagreen_formats::library::{Attribute, Attributes};
    use shagreen_formats::starter::starter_library;

    fn attributes(values: &[(&str, f64)]) -> Attributes {
        let value = |(name, value): &(&str, f64)| Attribute { name: (*name).to_owned(), value: *value };
        Attributes { source: LabelSource::SimulatedRaters, values: values.iter().map(value).collect() }
    }

    #[test]
    fn attributes_are_axes_where_both_are_known() {
        let mut library = starter_library().unwrap();
        library.textures[0].attributes = Some(attributes(&[("flat-bumpy", 3.0), ("warm-cold", 70.0)]));
        library.textures[1].attributes = Some(attributes(&[("flat-bumpy", 5.0)]));
        let axes = ["warm-cold".to_owned(), "flat-bumpy".to_owned()];
        let found = places(&library.textures, Some(&axes));
        let first = found[0].unwrap();
        assert_eq!((first.at.rough_smooth, first.at.hard_soft), (70.0, 3.0));
        assert_eq!(first.source, LabelSource::SimulatedRaters);
        assert!(found[1..].iter().all(Option::is_none));
        assert_eq!(places(&library.textures, None)[1], library.textures[1].place);
        assert_eq!(attribute_names(&library.textures), ["flat-bumpy", "warm-cold"]);
        assert_eq!(poles_of(&library, Some(&axes)), [["warm", "cold"], ["flat", "bumpy"]]);
        let odd = ["non-stick - sticky".to_owned(), "warm".to_owned()];
        assert_eq!(poles_of(&library, Some(&odd)), [["non-stick", "sticky"], ["warm", ""]]);
        assert_eq!(poles_of(&library, None), [["rough", "smooth"], ["hard", "soft"]]);
        library.axes = Some(axes);
        assert_eq!(poles_of(&library, None), [["warm", "cold"], ["flat", "bumpy"]]);
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
