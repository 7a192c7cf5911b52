//! Filter and order of the texture list. They are view state, not part of the project.

use crate::choices::textures::{End, Region};
use std::collections::{BTreeMap, BTreeSet};

use shagreen_core::space::{MIDDLE, SpacePoint};

/// Distance from the authored point that still counts as near, in axis units (0 to 100).
pub(crate) const NEAR: f64 = 25.0;

impl Region {
    /// In the order of the menu.
    pub(crate) const ALL: [Self; 7] = [
        Self::Anywhere,
        Self::NearPoint,
        Self::NotPlaced,
        Self::Quarter([End::Low, End::Low]),
        Self::Quarter([End::Low, End::High]),
        Self::Quarter([End::High, End::Low]),
        Self::Quarter([End::High, End::High]),
    ];

    /// Whether the region exists in a space with this number of axes: one axis has two halves, not four quarters. All of its
    /// points lie in the upper half of the canvas.
    pub(crate) fn is_on(self, n_axes: usize) -> bool {
        n_axes > 1 || !matches!(self, Self::Quarter([_, End::Low]))
    }

    /// Whether the region contains a texture at position `at` (`None`: without a position). `point` is the authored
    /// point.
    fn holds(self, at: Option<SpacePoint>, point: SpacePoint) -> bool {
        let is_in = |x: f64, end: End| (x >= MIDDLE) == (end == End::High);
        match self {
            Self::Anywhere => true,
            Self::Quarter([across, up]) => at.is_some_and(|at| is_in(at.x(), across) && is_in(at.y(), up)),
            Self::NearPoint => at.is_some_and(|at| at.distance(point) <= NEAR),
            Self::NotPlaced => at.is_none(),
        }
    }
}

/// Conditions of the texture list. A texture must meet all of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Filter {
    /// Tags that the texture must all have.
    pub(crate) tags: BTreeSet<String>,
    pub(crate) region: Region,
    pub(crate) only_starred: bool,
    /// Only textures that were added to the project.
    pub(crate) only_joined: bool,
}

/// Properties of a texture that the filter needs.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Candidate<'a> {
    pub(crate) name: &'a str,
    /// Words that the search finds in addition to the name.
    pub(crate) tags: &'a [String],
    /// Position in the space, if the texture has one.
    pub(crate) at: Option<SpacePoint>,
    pub(crate) is_starred: bool,
    /// Whether the texture was added to the project.
    pub(crate) is_joined: bool,
}

impl Filter {
    /// Number of active conditions.
    pub(crate) fn n_on(&self) -> usize {
        let others = [self.region != Region::Anywhere, self.only_starred, self.only_joined];
        self.tags.len() + others.into_iter().filter(|is_on| *is_on).count()
    }

    /// Whether a texture meets all conditions; `point` is the authored point.
    fn admits(&self, candidate: &Candidate<'_>, point: SpacePoint) -> bool {
        self.tags.iter().all(|tag| candidate.tags.contains(tag))
            && self.region.holds(candidate.at, point)
            && (!self.only_starred || candidate.is_starred)
            && (!self.only_joined || candidate.is_joined)
    }
}

/// Indices of the textures that match the search and the filter: starred ones first, otherwise in their order. Every
/// word of the search must occur in the name or in a tag.
pub(crate) fn listed(
    candidates: &[Candidate<'_>],
    search: &str,
    filter: &Filter,
    point: SpacePoint,
) -> Vec<usize> {
    let words: Vec<String> = search.to_lowercase().split_whitespace().map(str::to_owned).collect();
    let has = |candidate: &Candidate<'_>, word: &String| {
        let is_in = |text: &str| text.to_lowercase().contains(word);
        is_in(candidate.name) || candidate.tags.iter().any(|tag| is_in(tag))
    };
    let passes = |candidate: &Candidate<'_>| {
        filter.admits(candidate, point) && words.iter().all(|word| has(candidate, word))
    };
    let mut found: Vec<usize> = (0..candidates.len()).filter(|i| passes(&candidates[*i])).collect();
    found.sort_by_key(|i| !candidates[*i].is_starred);
    found
}

/// All tags in alphabetical order, with the number of textures that have each. Tags in `chosen` are included even if no
/// texture has them any more, so that they can be deselected.
pub(crate) fn tag_counts<'a>(
    tags: impl Iterator<Item = &'a [String]>,
    chosen: &'a BTreeSet<String>,
) -> BTreeMap<&'a str, usize> {
    let mut counts: BTreeMap<&str, usize> = chosen.iter().map(|tag| (tag.as_str(), 0)).collect();
    for tag in tags.flatten() {
        *counts.entry(tag).or_default() += 1;
    }
    counts
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::{Candidate, End, Filter, NEAR, Region, listed, tag_counts};
    use shagreen_core::space::SpacePoint;

    fn at(rough_smooth: f64, hard_soft: f64) -> SpacePoint {
        SpacePoint::plane(rough_smooth, hard_soft)
    }

    fn tags(words: &[&str]) -> Vec<String> {
        words.iter().map(|word| (*word).to_owned()).collect()
    }

    /// Checks which of four textures are listed, with the authored point at (50, 50).
    #[track_caller]
    fn check(search: &str, filter: &Filter, expected: &[&str]) {
        let (wood, cloth) = (tags(&["wood", "dry"]), tags(&["Fabric", "dry"]));
        let texture = |name, tags, at| Candidate { name, tags, at, is_starred: false, is_joined: false };
        let all = [
            texture("Oak", &wood, Some(at(20.0, 10.0))),
            texture("Ash", &wood, Some(at(50.0, 49.0))),
            Candidate { is_starred: true, ..texture("Felt", &cloth, Some(at(80.0, 90.0))) },
            Candidate { is_joined: true, ..texture("Denim", &cloth, None) },
        ];
        let names = listed(&all, search, filter, at(50.0, 50.0));
        assert_eq!(names.into_iter().map(|i| all[i].name).collect::<Vec<_>>(), expected);
    }

    fn in_region(region: Region) -> Filter {
        Filter { region, ..Filter::default() }
    }

    #[test]
    fn stars_come_first_and_words_are_found_in_names_and_tags() {
        let all = Filter::default();
        check("", &all, &["Felt", "Oak", "Ash", "Denim"]);
        check("FABRIC", &all, &["Felt", "Denim"]);
        check("dry a", &all, &["Felt", "Oak", "Ash", "Denim"]);
        check("wood ash", &all, &["Ash"]);
        check("steel", &all, &[]);
    }

    #[test]
    fn every_chosen_tag_must_be_there() {
        let with = |words: &[&str]| Filter { tags: tags(words).into_iter().collect(), ..Filter::default() };
        check("", &with(&["wood"]), &["Oak", "Ash"]);
        check("", &with(&["wood", "dry"]), &["Oak", "Ash"]);
        check("", &with(&["wood", "Fabric"]), &[]);
        // A tag filter compares whole words, unlike a search.
        check("", &with(&["fab"]), &[]);
    }

    #[test]
    fn regions_part_what_has_a_place() {
        let quarter = |across, up| in_region(Region::Quarter([across, up]));
        check("", &quarter(End::Low, End::Low), &["Oak"]);
        check("", &quarter(End::High, End::Low), &["Ash"]);
        check("", &quarter(End::High, End::High), &["Felt"]);
        check("", &quarter(End::Low, End::High), &[]);
        check("", &in_region(Region::NearPoint), &["Ash"]);
        check("", &in_region(Region::NotPlaced), &["Denim"]);
    }

    #[test]
    fn one_axis_has_two_halves() {
        let n_regions = |n_axes| Region::ALL.iter().filter(|region| region.is_on(n_axes)).count();
        assert_eq!((n_regions(1), n_regions(2)), (Region::ALL.len() - 2, Region::ALL.len()));
        let one = SpacePoint::of(&[70.0]).unwrap();
        assert!(Region::Quarter([End::High, End::High]).holds(Some(one), one));
    }

    #[test]
    fn near_is_a_circle() {
        let reach = NEAR / 2.0_f64.sqrt();
        let near = |step: f64| Region::NearPoint.holds(Some(at(50.0 + step, 50.0 - step)), at(50.0, 50.0));
        assert!(near(reach - 0.01) && !near(reach + 0.01));
    }

    #[test]
    fn conditions_are_counted_and_all_hold() {
        let filter = Filter { only_joined: true, only_starred: true, ..in_region(Region::NotPlaced) };
        assert_eq!((filter.n_on(), Filter::default().n_on()), (3, 0));
        check("", &filter, &[]);
        check("", &Filter { only_starred: false, ..filter }, &["Denim"]);
        check("", &Filter { only_starred: true, ..Filter::default() }, &["Felt"]);
    }

    #[test]
    fn tags_are_counted_and_a_chosen_one_stays() {
        let lists = [tags(&["wood", "dry"]), tags(&["dry"])];
        let chosen = BTreeSet::from(["gone".to_owned()]);
        let counts = tag_counts(lists.iter().map(Vec::as_slice), &chosen);
        assert_eq!(counts.into_iter().collect::<Vec<_>>(), [("dry", 2), ("gone", 0), ("wood", 1)]);
    }
}
