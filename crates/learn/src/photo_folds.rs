//! Folds of a validation: groups of whole classes, or of whole sources, that are left out of a training together.
//!
//! Photos of a class have the same label, and photos of a source have much in common, so single photos that are left out
//! would be predicted too well.

use serde::{Deserialize, Serialize};

use crate::photo_set::PhotoSet;

/// What is left out as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LeftOut {
    /// Classes of materials.
    Classes,
    /// Sources of photos.
    Sources,
}

impl LeftOut {
    /// Both, in fixed order.
    pub const ALL: [Self; 2] = [Self::Classes, Self::Sources];

    /// Returns the plural noun.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Classes => "classes",
            Self::Sources => "sources",
        }
    }
}

/// Photos that are left out of a training together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fold {
    /// What is left out as a whole.
    pub kind: LeftOut,
    /// Indices of the photos, in ascending order.
    pub photos: Vec<usize>,
}

/// Returns at most `n_folds` (1 or more) folds of about the same number of photos. Each class or source is in one of them
/// as a whole. With as many folds as groups, each group is a fold of its own.
pub fn folds(set: &PhotoSet, kind: LeftOut, n_folds: usize) -> Vec<Fold> {
    let n_groups = match kind {
        LeftOut::Classes => set.classes.len(),
        LeftOut::Sources => set.sources.len(),
    };
    let mut groups: Vec<Vec<usize>> = vec![Vec::new(); n_groups];
    for (index, photo) in set.photos.iter().enumerate() {
        let group = match kind {
            LeftOut::Classes => photo.class,
            LeftOut::Sources => photo.source,
        };
        groups[group].push(index);
    }
    groups.retain(|group| !group.is_empty());
    // The largest groups first, each into the smallest fold.
    groups.sort_by_key(|group| std::cmp::Reverse(group.len()));
    let mut folds: Vec<Vec<usize>> = vec![Vec::new(); n_folds.max(1).min(groups.len())];
    for group in groups {
        if let Some(smallest) = folds.iter_mut().min_by_key(|fold| fold.len()) {
            smallest.extend(group);
        }
    }
    for fold in &mut folds {
        fold.sort_unstable();
    }
    folds.into_iter().map(|photos| Fold { kind, photos }).collect()
}

impl Fold {
    /// Returns the indices of all other photos.
    pub fn others(&self, n_photos: usize) -> Vec<usize> {
        (0..n_photos).filter(|index| self.photos.binary_search(index).is_err()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{LeftOut, folds};
    use crate::photo_set::made_up::photo_set;
    use std::collections::BTreeSet;

    #[test]
    fn every_photo_is_left_out_once_with_its_whole_group() {
        let mut set = photo_set(47, 1);
        // One large source and three small ones.
        for photo in set.photos.iter_mut().skip(20) {
            photo.source = 0;
        }
        for (kind, n_folds, n) in [
            (LeftOut::Classes, 2, 2),
            (LeftOut::Classes, 9, 3),
            (LeftOut::Sources, 3, 3),
            (LeftOut::Sources, 1, 1),
        ] {
            let folds = folds(&set, kind, n_folds);
            assert_eq!(folds.len(), n);
            let mut all: Vec<usize> = folds.iter().flat_map(|fold| fold.photos.clone()).collect();
            all.sort_unstable();
            assert_eq!(all, (0..47).collect::<Vec<usize>>());
            let group = |index: &usize| match kind {
                LeftOut::Classes => set.photos[*index].class,
                LeftOut::Sources => set.photos[*index].source,
            };
            for fold in &folds {
                let inside: BTreeSet<usize> = fold.photos.iter().map(group).collect();
                let others = fold.others(47);
                assert_eq!(others.len() + fold.photos.len(), 47);
                assert!(others.iter().all(|index| !inside.contains(&group(index))), "{kind:?}");
            }
        }
        // The large source is alone; the small ones share the other fold.
        let two = folds(&set, LeftOut::Sources, 2);
        let sizes: Vec<usize> = two.iter().map(|fold| fold.photos.len()).collect();
        let large = set.photos.iter().filter(|photo| photo.source == 0).count();
        assert_eq!(sizes, [large, 47 - large]);
    }
}
