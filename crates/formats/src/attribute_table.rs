//! The attribute values of the textures of a library as a table: the training data of an attribute predictor.

use shagreen_core::space::LabelSource;
use shagreen_core::space::attribute_predictor::{Known, quantities};
use shagreen_core::words::counted;

use crate::library::{Library, TextureEntry};

/// Textures and the attributes that all of them share.
#[derive(Clone, Debug, PartialEq)]
pub struct AttributeTable {
    /// Attribute names: pairs of adjectives, the one at 0 first.
    pub names: Vec<String>,
    /// Indices of the textures in their library.
    pub textures: Vec<usize>,
    /// Values of each texture, 0..100, in the order of the names.
    pub values: Vec<Vec<f64>>,
    /// Label sources of the values; several if textures differ.
    pub sources: Vec<LabelSource>,
}

/// Why there is no table.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum AttributeTableError {
    /// No texture has attributes or a position.
    #[error(
        "no texture of the library has attributes or a position; assign positions with `shagreen space place` or rate textures"
    )]
    Nothing,
}

/// Returns the attributes that all rated textures share. If no texture is rated, or no attribute is common to all, the
/// table holds the axes of their positions. Estimated values are excluded.
///
/// # Errors
/// See [`AttributeTableError`].
pub fn attribute_table(library: &Library) -> Result<AttributeTable, AttributeTableError> {
    let indexed = || library.textures.iter().enumerate();
    let rated: Vec<(usize, &TextureEntry)> = indexed()
        .filter(|(_, texture)| texture.attributes.as_ref().is_some_and(|of| is_known(of.source)))
        .collect();
    let names: Vec<String> = match rated.first() {
        Some((_, first)) => {
            let of_first = first.attributes.iter().flat_map(|attributes| &attributes.values);
            let has = |texture: &TextureEntry, name: &str| {
                texture.attributes.as_ref().is_some_and(|attributes| attributes.get(name).is_some())
            };
            let shared =
                of_first.filter(|attribute| rated.iter().all(|(_, texture)| has(texture, &attribute.name)));
            shared.map(|attribute| attribute.name.clone()).collect()
        }
        None => Vec::new(),
    };
    let mut table = AttributeTable { names, textures: Vec::new(), values: Vec::new(), sources: Vec::new() };
    if table.names.is_empty() {
        table.names = library.axis_names().into_iter().map(str::to_owned).collect();
        for (index, texture) in indexed() {
            let Some(place) = texture.place.filter(|place| is_known(place.source)) else { continue };
            table.add(index, place.at.on(table.names.len()).coordinates().to_vec(), place.source);
        }
    } else {
        for (index, texture) in rated {
            let Some(attributes) = &texture.attributes else { continue };
            let values = table.names.iter().filter_map(|name| attributes.get(name)).collect();
            table.add(index, values, attributes.source);
        }
    }
    if table.textures.is_empty() { Err(AttributeTableError::Nothing) } else { Ok(table) }
}

/// Returns whether values of this source may serve as training data. Estimates may not: they are predictions
/// themselves.
fn is_known(source: LabelSource) -> bool {
    source != LabelSource::Estimated
}

impl AttributeTable {
    fn add(&mut self, index: usize, values: Vec<f64>, source: LabelSource) {
        self.textures.push(index);
        self.values.push(values);
        if !self.sources.contains(&source) {
            self.sources.push(source);
        }
    }

    /// Returns the physical quantities of each texture with its attribute values.
    ///
    /// # Panics
    /// If the table belongs to another library.
    pub fn known(&self, library: &Library) -> Vec<Known> {
        let of = |(index, values): (&usize, &Vec<f64>)| Known {
            quantities: quantities(&library.textures[*index].model),
            attributes: values.clone(),
        };
        self.textures.iter().zip(&self.values).map(of).collect()
    }

    /// Describes the training data: the number of textures, the name of the library, and the label sources.
    pub fn of_library(&self, name: &str) -> String {
        format!("{} of \"{name}\" ({})", counted(self.textures.len(), "texture"), self.source_words())
    }

    /// Identifiers of the label sources, as library files store them.
    pub fn source_ids(&self) -> impl Iterator<Item = &'static str> {
        self.sources.iter().map(|source| source.id())
    }

    /// Names of the label sources, separated by commas.
    pub fn source_words(&self) -> String {
        let words: Vec<&str> = self.sources.iter().map(|source| source.label()).collect();
        words.join(", ")
    }
}

#[cfg(test)]
mod tests {
    use super::{AttributeTableError, attribute_table};
    use crate::library::Library;
    use crate::starter::{simulated_library, starter_library};
    use shagreen_core::space::LabelSource;
    use shagreen_core::space::attribute_predictor::leave_one_out;

    #[test]
    fn ratings_count_before_places_and_only_what_all_have() {
        let mut library = simulated_library().unwrap();
        let table = attribute_table(&library).unwrap();
        let five = ["rough-smooth", "hard-soft", "flat-bumpy", "sticky-slippery", "irritating-pleasant"];
        assert_eq!((table.names.as_slice(), table.textures.len()), (five.map(str::to_owned).as_slice(), 25));
        assert_eq!(table.sources, [LabelSource::SimulatedRaters]);
        assert_eq!(
            table.values[0][1],
            library.textures[0].attributes.as_ref().unwrap().get("hard-soft").unwrap()
        );
        library.textures[4].attributes.as_mut().unwrap().values.remove(2);
        library.textures[5].attributes = None;
        let fewer = attribute_table(&library).unwrap();
        assert_eq!((fewer.names.len(), fewer.textures.len()), (4, 24));

        let starter = attribute_table(&starter_library().unwrap()).unwrap();
        assert_eq!((starter.names.len(), starter.sources), (2, vec![LabelSource::PhysicalLabels]));
        let mut estimated = starter_library().unwrap();
        estimated.textures[3].place.as_mut().unwrap().source = LabelSource::Estimated;
        let known = attribute_table(&estimated).unwrap();
        assert!(!known.textures.contains(&3) && known.sources == [LabelSource::PhysicalLabels]);
        // Positions on any number of axes.
        for n_axes in [1, 3] {
            let mut library = starter_library().unwrap();
            library.axes =
                Some(["a-b", "c-d", "e-f"][..n_axes].iter().map(|name| (*name).to_owned()).collect());
            for place in library.textures.iter_mut().filter_map(|texture| texture.place.as_mut()) {
                place.at = place.at.on(n_axes);
            }
            let table = attribute_table(&library).unwrap();
            assert_eq!((table.names.len(), table.values[0].len()), (n_axes, n_axes));
            assert_eq!(table.values[0], library.textures[0].at().unwrap().coordinates());
        }
        assert_eq!(attribute_table(&Library::default()), Err(AttributeTableError::Nothing));
    }

    #[test]
    fn five_attributes_of_the_simulated_library_are_told_to_ten_points() {
        let library = simulated_library().unwrap();
        let table = attribute_table(&library).unwrap();
        let estimates = leave_one_out(&table.known(&library)).unwrap();
        for (attribute, name) in table.names.iter().enumerate() {
            let pairs = table.values.iter().zip(&estimates);
            let errors: Vec<f64> =
                pairs.map(|(of, told)| (of[attribute] - told[attribute].mean).abs()).collect();
            let mae = errors.iter().sum::<f64>() / errors.len() as f64;
            assert!(mae < 10.0, "{name}: {mae}");
        }
    }
}
