//! Parts of a texture that files of other programs may not hold, and their names in lists of what is lost.

use crate::library::TextureEntry;

/// Part of a texture beside its grain and its friction coefficient.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    /// Change along a stroke.
    Path,
    /// Tap transient.
    Tap,
    /// Grain along the lay.
    Direction,
    /// Relief.
    Relief,
    /// Height map.
    HeightMap,
    /// Rotation on the pad.
    Turn,
    /// Stick-slip friction.
    StickSlip,
    /// Position in the space.
    Position,
    /// Attributes.
    Attributes,
    /// Picture.
    Picture,
    /// Physical labels.
    PhysicalLabels,
    /// Tags, description, license and origin.
    Terms,
}

impl Part {
    /// All parts, in the order of lists.
    pub(crate) const ALL: [Self; 12] = [
        Self::Path,
        Self::Tap,
        Self::Direction,
        Self::Relief,
        Self::HeightMap,
        Self::Turn,
        Self::StickSlip,
        Self::Position,
        Self::Attributes,
        Self::Picture,
        Self::PhysicalLabels,
        Self::Terms,
    ];

    /// Whether the texture has this part.
    fn is_in(self, entry: &TextureEntry) -> bool {
        let model = &entry.model;
        match self {
            Self::Path => entry.path.is_some(),
            Self::Tap => model.tap().is_some(),
            Self::Direction => model.along().is_some(),
            Self::Relief => model.relief().is_some(),
            Self::HeightMap => model.height_map().is_some(),
            Self::Turn => model.turn_rad() != 0.0,
            Self::StickSlip => model.stick_slip().is_some(),
            Self::Position => entry.place.is_some(),
            Self::Attributes => entry.attributes.is_some(),
            Self::Picture => entry.picture.is_some(),
            Self::PhysicalLabels => entry.physical.is_some(),
            Self::Terms => {
                let said = [&entry.description, &entry.license, &entry.origin];
                !(entry.tags.is_empty() && said.iter().all(|text| text.is_empty()))
            }
        }
    }

    /// What is lost without this part.
    fn loss(self) -> &'static str {
        match self {
            Self::Path => "the change along the stroke: only the texture at the start of the path is written",
            Self::Tap => "the tap transient",
            Self::Direction => "the direction: only the grain across the lay is written",
            Self::Relief => "the relief (acceleration as a function of position)",
            Self::HeightMap => "the height map",
            Self::Turn => "the rotation on the pad",
            Self::StickSlip => "stick-slip friction (static friction and Stribeck speed)",
            Self::Position => "the position in the space",
            Self::Attributes => "the attributes",
            Self::Picture => "the picture",
            Self::PhysicalLabels => "the physical labels",
            Self::Terms => "tags, description, license and origin",
        }
    }
}

/// Lists the parts that a texture has and a format cannot hold, in the order of [`Part::ALL`]; `kept` are those that it can.
pub(crate) fn lost_parts(entry: &TextureEntry, kept: &[Part]) -> impl Iterator<Item = String> {
    let is_lost = move |part: &Part| !kept.contains(part) && part.is_in(entry);
    Part::ALL.into_iter().filter(is_lost).map(|part| part.loss().to_owned())
}

/// States that tags and description are lost, for a format that keeps license and origin; `None` if there are none.
pub(crate) fn lost_description(entry: &TextureEntry) -> Option<String> {
    let is_empty = entry.tags.is_empty() && entry.description.is_empty();
    (!is_empty).then(|| "tags and description".to_owned())
}

#[cfg(test)]
mod tests {
    use super::{Part, lost_description, lost_parts};
    use crate::library::TextureEntry;
    use crate::starter::starter_library;

    #[test]
    fn only_parts_that_a_texture_has_are_lost() {
        let starter = starter_library().unwrap().textures.swap_remove(0);
        let bare = TextureEntry::new("a", "A", starter.model.clone().with_tap(None));
        assert_eq!(lost_parts(&bare, &[]).count(), 0);
        let lost: Vec<String> = lost_parts(&starter, &[Part::Picture]).collect();
        assert!(lost.contains(&"the tap transient".to_owned()) && !lost.contains(&"the picture".to_owned()));
        assert!(lost.contains(&"tags, description, license and origin".to_owned()), "{lost:?}");
        assert_eq!(lost_description(&bare), None);
        assert_eq!(lost_description(&starter).as_deref(), Some("tags and description"));
    }
}
