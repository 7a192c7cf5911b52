//! The spaces in which authored textures are interpolated, with their models. Authored textures that use different textures
//! have different spaces; recent ones are kept, so that switching between authored textures computes nothing again.

use std::borrow::Cow;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::sync::Arc;

use shagreen_core::space::authoring::{Authoring, Models};
use shagreen_core::space::{Space, SpacePoint};

/// Maximum number of spaces that are kept beside the current one.
const MOST_OTHERS: usize = 8;

/// One space.
#[derive(Debug)]
struct UsedSpace {
    authoring: Authoring,
    /// Number that changes whenever an interpolated texture at any point may have changed.
    generation: u64,
    /// Whether the models are there, or cannot be computed, or are not needed.
    is_done: bool,
}

/// The space of the audible authored texture, and recent ones.
#[derive(Debug)]
pub(super) struct Spaces {
    current: UsedSpace,
    /// Whether the current space names textures that have changed.
    is_stale: bool,
    /// Other spaces, the most recent one first.
    others: Vec<UsedSpace>,
    /// Space for which models are being computed.
    asked: Option<Space>,
    n_changes: u64,
}

impl UsedSpace {
    fn new(space: Space, generation: u64) -> Self {
        let is_done = space.sites().is_empty();
        Self { authoring: Authoring::new(space), generation, is_done }
    }

    fn space(&self) -> &Space {
        self.authoring.space()
    }

    fn found(&self) -> Found<'_> {
        let Self { authoring, generation, is_done } = self;
        Found { authoring: Cow::Borrowed(authoring), generation: *generation, is_done: *is_done }
    }
}

impl Spaces {
    pub(super) fn new(space: Space) -> Self {
        let current = UsedSpace::new(space, 1);
        Self { current, is_stale: false, others: Vec::new(), asked: None, n_changes: 1 }
    }

    /// Interpolation in the current space.
    pub(super) fn current(&self) -> &Authoring {
        &self.current.authoring
    }

    /// Whether models of the current space are still being computed.
    pub(super) fn is_waiting(&self) -> bool {
        !self.current.is_done
    }

    /// The current space.
    pub(super) fn found_current(&self) -> Found<'_> {
        self.current.found()
    }

    /// This space, if it is kept.
    pub(super) fn find(&self, space: &Space) -> Option<Found<'_>> {
        let current = Some(&self.current).filter(|_| !self.is_stale);
        current.into_iter().chain(&self.others).find(|used| used.space() == space).map(UsedSpace::found)
    }

    /// Makes a space the current one. Returns whether it was not.
    pub(super) fn select(&mut self, space: Space) -> bool {
        if !self.is_stale && *self.current.space() == space {
            return false;
        }
        let known = self.others.iter().position(|used| *used.space() == space);
        let next = match known {
            Some(index) => self.others.remove(index),
            None => self.begun(space),
        };
        let before = std::mem::replace(&mut self.current, next);
        if !std::mem::take(&mut self.is_stale) {
            self.keep_beside(before);
        }
        true
    }

    /// Keeps this space beside the current one, so that its models are computed.
    pub(super) fn ensure(&mut self, space: Space) {
        if self.find(&space).is_none() {
            let begun = self.begun(space);
            self.keep_beside(begun);
        }
    }

    /// Forgets spaces with textures that have changed; those marked in `is_kept` have not. Returns whether the models that
    /// are being computed are for one of the forgotten spaces.
    pub(super) fn forget_changed(&mut self, is_kept: &[bool]) -> bool {
        let is_there =
            |(texture, _): &(usize, SpacePoint)| is_kept.get(*texture).copied().unwrap_or_default();
        let is_same = |space: &Space| space.sites().iter().all(is_there);
        self.others.retain(|used| is_same(used.space()));
        self.is_stale |= !is_same(self.current.space());
        self.asked.take_if(|space| !is_same(space)).is_some()
    }

    /// The space whose models are to be computed now, if they are not being computed: the current one, or else the most
    /// recent one that waits for models.
    pub(super) fn next_to_ask(&mut self) -> Option<Space> {
        if self.is_stale {
            return None;
        }
        let next = if self.current.is_done {
            self.others.iter().find(|used| !used.is_done).filter(|_| self.asked.is_none())?
        } else {
            &self.current
        };
        let space = next.space();
        if self.asked.as_ref() == Some(space) {
            return None;
        }
        self.asked = Some(space.clone());
        self.asked.clone()
    }

    /// Takes over the models of the space that was asked for; `None` if they cannot be computed. Returns whether that is the
    /// current space.
    pub(super) fn put(&mut self, models: Option<Arc<Models>>) -> bool {
        let Some(space) = self.asked.take() else { return false };
        self.n_changes += 1;
        let is_current = !self.is_stale && *self.current.space() == space;
        let used = if is_current {
            &mut self.current
        } else {
            let Some(other) = self.others.iter_mut().find(|used| *used.space() == space) else {
                return false;
            };
            other
        };
        (used.is_done, used.generation) = (true, self.n_changes);
        if let Some(models) = models {
            used.authoring = used.authoring.clone().with_models(models);
        }
        is_current
    }

    fn begun(&mut self, space: Space) -> UsedSpace {
        self.n_changes += 1;
        UsedSpace::new(space, self.n_changes)
    }

    fn keep_beside(&mut self, used: UsedSpace) {
        self.others.insert(0, used);
        self.others.truncate(MOST_OTHERS);
    }
}

/// Interpolation in one space.
pub(super) struct Found<'a> {
    pub(super) authoring: Cow<'a, Authoring>,
    /// Number that changes whenever an interpolated texture at any point may have changed.
    pub(super) generation: u64,
    /// Whether the models are there, or cannot be computed, or are not needed.
    pub(super) is_done: bool,
}

impl Found<'_> {
    /// A space that is not kept.
    pub(super) fn without_models(space: Space) -> Self {
        let is_done = space.sites().is_empty();
        let generation = generation_without_models(&space);
        Self { authoring: Cow::Owned(Authoring::new(space)), generation, is_done }
    }
}

/// Generation of a space that is not kept: another one for other textures, and none of those that count up.
fn generation_without_models(space: &Space) -> u64 {
    let mut hasher = DefaultHasher::new();
    for (texture, at) in space.sites() {
        texture.hash(&mut hasher);
        for coordinate in at.coordinates() {
            coordinate.to_bits().hash(&mut hasher);
        }
    }
    hasher.finish() | (1 << 63)
}

#[cfg(test)]
mod tests {
    use super::{Found, MOST_OTHERS, Spaces};
    use shagreen_core::space::{Space, SpacePoint};

    /// A space of one texture, with this index.
    fn space(texture: usize) -> Space {
        let mut places = vec![None; texture + 1];
        places[texture] = Some(SpacePoint::plane(10.0, 20.0));
        Space::new(&places).unwrap()
    }

    #[test]
    fn the_models_of_recent_spaces_are_kept() {
        let mut spaces = Spaces::new(space(0));
        assert!(spaces.is_waiting() && spaces.next_to_ask() == Some(space(0)));
        assert_eq!(spaces.next_to_ask(), None, "they are being computed");
        assert!(spaces.put(None) && !spaces.is_waiting());
        let first = spaces.find(&space(0)).unwrap().generation;
        assert!(!spaces.select(space(0)) && spaces.select(space(1)));
        assert!(spaces.is_waiting() && spaces.next_to_ask() == Some(space(1)));
        assert!(spaces.select(space(0)) && !spaces.is_waiting());
        assert_eq!(spaces.find(&space(0)).unwrap().generation, first);
        assert!(!spaces.put(None), "models of another space");
        assert!(spaces.find(&space(1)).is_some_and(|found| found.is_done));
        for texture in 2..=MOST_OTHERS + 2 {
            spaces.ensure(space(texture));
        }
        assert!(spaces.find(&space(1)).is_none() && spaces.find(&space(0)).is_some());
        let generations = [0, 1, 1].map(|texture| Found::without_models(space(texture)).generation);
        assert!(generations[0] != generations[1] && generations[1] == generations[2]);
        assert!(!generations.contains(&first));
    }

    #[test]
    fn the_current_space_comes_first_and_changed_ones_are_forgotten() {
        let mut spaces = Spaces::new(space(0));
        spaces.ensure(space(1));
        assert_eq!(spaces.next_to_ask(), Some(space(0)));
        spaces.select(space(2));
        assert_eq!(spaces.next_to_ask(), Some(space(2)), "in place of the job before");
        assert!(!spaces.forget_changed(&[true, false, true]));
        assert!(spaces.find(&space(1)).is_none());
        assert!(spaces.put(None) && spaces.next_to_ask() == Some(space(0)));
        assert!(spaces.forget_changed(&[false, true, false]), "nobody waits for these models any more");
        assert!(spaces.next_to_ask().is_none() && spaces.find(&space(2)).is_none());
        assert!(spaces.select(space(2)) && spaces.is_waiting());
        assert!(spaces.find(&space(0)).is_none());
    }
}
