//! Comparison of two authored textures under the same stroke, openly or blind (ABX).
//!
//! A and B are two textures; X is one of them, drawn at random for every answer. The result states the probability of
//! at least as many correct answers by chance. In a blind comparison A and B are swapped with a probability of one
//! half, until they are revealed.

use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};

use shagreen_core::maths::rng::Random;
use shagreen_core::maths::statistics::binomial_upper_tail;
use shagreen_formats::project::{AuthoredTexture, Project};

/// Side of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// First texture.
    A,
    /// Second texture.
    B,
    /// One of the two, drawn at random.
    X,
}

impl Side {
    /// All sides, in the order of their buttons.
    pub const ALL: [Self; 3] = [Self::A, Self::B, Self::X];

    /// Letter of the side.
    pub fn letter(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
            Self::X => "X",
        }
    }
}

/// Command of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CompareCommand {
    /// Plays this side. If it is already playing, the comparison ends.
    Hear(Side),
    /// Hides or reveals which texture is on which side.
    SetBlind(bool),
    /// Records the answer that X is A, or B.
    Answer(Side),
}

type Compared = Option<Arc<AuthoredTexture>>;

/// Comparison: the two textures, the audible side, and the answers.
#[derive(Clone, Debug)]
pub struct Compare {
    keys: [u32; 2],
    /// Keys that were chosen, or else the first ones: undo of a deletion brings them back.
    chosen: [u32; 2],
    /// Keys that the project stores, as of the last frame.
    stored: Option<[u32; 2]>,
    /// Textures with these keys, as of the last frame.
    compared: [Compared; 2],
    heard: Option<Side>,
    is_blind: bool,
    /// Whether A and B are swapped.
    is_swapped: bool,
    x_is_a: bool,
    n_answers: u64,
    n_right: u64,
    random: Random,
}

impl Compare {
    /// Comparison with this random seed.
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let x_is_a = random.uniform() < 0.5;
        Self {
            keys: [0, 0],
            chosen: [0, 0],
            stored: None,
            compared: [None, None],
            heard: None,
            is_blind: false,
            is_swapped: false,
            x_is_a,
            n_answers: 0,
            n_right: 0,
            random,
        }
    }

    /// Comparison with a random seed from the clock.
    pub fn by_chance() -> Self {
        let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Self::new(now.as_nanos() as u64)
    }

    /// Updates the comparison to the project. Textures that the project newly assigns to A and B take their sides. A deleted
    /// texture is replaced by the first other one, until it comes back. If the sound of a texture has changed, the answers are
    /// discarded.
    pub fn follow(&mut self, project: &Project) {
        if self.stored != project.compared {
            self.stored = project.compared;
            self.chosen = project.compared.unwrap_or_default();
            self.assign(self.chosen);
        }
        let is_there = |key: u32| project.authored.iter().any(|texture| texture.key == key);
        if self.chosen[0] != self.chosen[1] && self.chosen.into_iter().all(is_there) {
            self.assign(self.chosen);
        }
        let texture = |key: u32| project.authored.iter().find(|texture| texture.key == key).cloned();
        let compared = self.keys.map(texture);
        let is_same = |(before, now): (&Compared, &Compared)| match (before, now) {
            (Some(before), Some(now)) => before.sounds_like(now),
            (before, now) => before.is_none() && now.is_none(),
        };
        if !self.compared.iter().zip(&compared).all(is_same) {
            self.forget_answers();
        }
        self.compared = compared;
        if self.keys.iter().all(|key| is_there(*key)) && self.keys[0] != self.keys[1] {
            return;
        }
        for side in 0..2 {
            if !is_there(self.keys[side]) || (side == 1 && self.keys[0] == self.keys[1]) {
                let other = self.keys[1 - side];
                let free = project.authored.iter().map(|texture| texture.key).find(|key| *key != other);
                self.keys[side] = free.unwrap_or(0);
            }
        }
        if self.chosen.contains(&0) {
            self.chosen = self.keys;
        }
        self.end();
        self.forget_answers();
    }

    /// Whether there are two textures to compare.
    pub fn is_possible(&self) -> bool {
        self.keys[0] != self.keys[1] && self.keys.iter().all(|key| *key != 0)
    }

    /// Textures on both sides, as of the last frame.
    pub fn textures(&self) -> impl Iterator<Item = &AuthoredTexture> {
        self.compared.iter().flatten().map(Arc::as_ref)
    }

    /// Audible side, or `None` outside a comparison.
    pub fn heard(&self) -> Option<Side> {
        self.heard
    }

    /// Key of the texture that plays instead of the selected one.
    pub fn heard_key(&self) -> Option<u32> {
        let is_first = match self.heard? {
            Side::A => !self.is_swapped,
            Side::B => self.is_swapped,
            Side::X => self.x_is_a != self.is_swapped,
        };
        Some(self.keys[usize::from(!is_first)])
    }

    /// Side of an authored texture, or `None` if it is on no side or the comparison is blind.
    pub fn side_of(&self, key: u32) -> Option<Side> {
        if self.is_blind || !self.is_possible() {
            return None;
        }
        [Side::A, Side::B].into_iter().zip(self.keys).find(|(_, on)| *on == key).map(|(side, _)| side)
    }

    /// Whether the identity of the audible texture is hidden.
    pub fn is_hidden(&self) -> bool {
        self.heard == Some(Side::X) || (self.heard.is_some() && self.is_blind)
    }

    /// Whether the comparison is blind.
    pub fn is_blind(&self) -> bool {
        self.is_blind
    }

    /// Number of answers, and number of correct ones.
    pub fn answers(&self) -> (u64, u64) {
        (self.n_answers, self.n_right)
    }

    /// Probability of at least as many correct answers by chance, 0..1.
    pub fn chance(&self) -> f64 {
        binomial_upper_tail(self.n_right, self.n_answers, 0.5)
    }

    /// Ends the comparison, so that the selected texture plays.
    pub fn end(&mut self) {
        self.heard = None;
    }

    /// Keys on the sides A and B after the authored texture with this key is assigned to A or B. If it is on the other side,
    /// the two textures swap sides.
    pub fn assigned(&self, side: Side, key: u32) -> [u32; 2] {
        let index = usize::from(side == Side::B);
        let mut keys = self.keys;
        if keys[1 - index] == key {
            keys.swap(0, 1);
        }
        keys[index] = key;
        keys
    }

    /// Executes a command.
    pub fn carry_out(&mut self, command: CompareCommand) {
        match command {
            CompareCommand::Hear(side) => {
                self.heard = (self.heard != Some(side) && self.is_possible()).then_some(side);
            }
            CompareCommand::SetBlind(is_blind) => {
                self.is_blind = is_blind;
                self.is_swapped = is_blind && self.random.uniform() < 0.5;
            }
            CompareCommand::Answer(side) => {
                self.n_answers += 1;
                self.n_right += u64::from((side == Side::A) == self.x_is_a);
                self.x_is_a = self.random.uniform() < 0.5;
            }
        }
    }

    fn assign(&mut self, keys: [u32; 2]) {
        if self.keys != keys {
            self.keys = keys;
            self.end();
            self.forget_answers();
        }
    }

    fn forget_answers(&mut self) {
        (self.n_answers, self.n_right) = (0, 0);
    }
}

#[cfg(test)]
mod tests {
    use super::{Compare, CompareCommand, Side};
    use crate::state::edit::{Edit, edited};
    use shagreen_core::space::SpacePoint;
    use shagreen_formats::project::{AuthoredTexture, Project};
    use shagreen_studio::project::new_project;

    /// Project with three authored textures, with keys 1, 2 and 3.
    fn three() -> Project {
        let add = |project: Project, name: &str| {
            edited(&project, Edit::Author(Box::new(AuthoredTexture::new(0, name))))
        };
        add(add(new_project(), "Second"), "Third")
    }

    fn compare(seed: u64) -> Compare {
        let mut compare = Compare::new(seed);
        compare.follow(&three());
        assert!(compare.is_possible());
        compare
    }

    /// Assigns a texture of [`three`] to a side, as the window does.
    fn assign(compare: &mut Compare, side: Side, key: u32) {
        compare.follow(&edited(&three(), Edit::SetCompared(compare.assigned(side, key))));
    }

    #[test]
    fn sides_are_heard_and_left() {
        let mut compare = compare(1);
        assert_eq!(
            (compare.heard_key(), compare.side_of(1), compare.side_of(2)),
            (None, Some(Side::A), Some(Side::B))
        );
        compare.carry_out(CompareCommand::Hear(Side::B));
        assert_eq!((compare.heard_key(), compare.is_hidden()), (Some(2), false));
        compare.carry_out(CompareCommand::Hear(Side::B));
        assert_eq!(compare.heard_key(), None);
        assign(&mut compare, Side::A, 3);
        assert_eq!((compare.side_of(3), compare.side_of(1)), (Some(Side::A), None));
        assign(&mut compare, Side::A, 2);
        assert_eq!(
            (compare.side_of(2), compare.side_of(3)),
            (Some(Side::A), Some(Side::B)),
            "they change sides"
        );
    }

    #[test]
    fn x_is_one_of_both_and_answers_are_counted() {
        let mut compare = compare(7);
        compare.carry_out(CompareCommand::Hear(Side::X));
        assert!(compare.is_hidden());
        let mut n_first = 0;
        for i in 0..200_u64 {
            let is_first = compare.heard_key() == Some(1);
            n_first += u64::from(is_first);
            // Every tenth answer is wrong.
            let right = if is_first { Side::A } else { Side::B };
            let wrong = if is_first { Side::B } else { Side::A };
            compare.carry_out(CompareCommand::Answer(if i % 10 == 0 { wrong } else { right }));
        }
        assert!((70..=130).contains(&n_first), "{n_first} of 200");
        assert_eq!(compare.answers(), (200, 180));
        assert!(compare.chance() < 1e-20);
        assign(&mut compare, Side::B, 3);
        assert_eq!((compare.answers(), compare.chance()), ((0, 0), 1.0), "others are compared now");
    }

    #[test]
    fn sides_that_the_project_stores_are_taken_over() {
        let mut compare = compare(1);
        let chosen = edited(&three(), Edit::SetCompared(compare.assigned(Side::B, 3)));
        assert_eq!(chosen.compared, Some([1, 3]));
        compare.follow(&chosen);
        assert_eq!((compare.side_of(1), compare.side_of(3)), (Some(Side::A), Some(Side::B)));
        let mut later = Compare::new(2);
        later.follow(&chosen);
        assert_eq!((later.side_of(1), later.side_of(3)), (Some(Side::A), Some(Side::B)), "in another window");
        later.follow(&three());
        assert_eq!((later.side_of(2), later.side_of(3)), (Some(Side::B), None), "undone");
        later.follow(&edited(&chosen, Edit::Remove(3)));
        assert_eq!(later.side_of(2), Some(Side::B), "what is gone is replaced");
    }

    /// Both the first ones and chosen ones.
    #[test]
    fn a_texture_that_comes_back_takes_its_side_again() {
        for project in [three(), edited(&three(), Edit::SetCompared([1, 3]))] {
            let mut compare = Compare::new(1);
            compare.follow(&project);
            let before = compare.keys;
            for key in before {
                compare.follow(&edited(&project, Edit::Remove(key)));
                assert!(compare.is_possible() && compare.keys != before);
                compare.follow(&project);
                assert_eq!(compare.keys, before, "{key} is undone");
            }
        }
    }

    /// A new name keeps the answers; a new position discards them.
    #[test]
    fn answers_about_another_sound_are_forgotten() {
        let mut compare = compare(3);
        compare.follow(&three());
        compare.carry_out(CompareCommand::Answer(Side::A));
        let renamed = edited(&edited(&three(), Edit::Select(1)), Edit::Rename("Other".to_owned()));
        compare.follow(&renamed);
        assert_eq!(compare.answers().0, 1);
        let at = SpacePoint::plane(1.0, 2.0);
        compare.follow(&edited(&renamed, Edit::MovePoint(at)));
        assert_eq!(compare.answers().0, 0);
    }

    /// Answers refer to the sound of X, even if A and B are swapped.
    #[test]
    fn blind_sides_are_exchanged_by_chance_and_hold_together() {
        let mut n_swapped = 0;
        for seed in 0..40 {
            let mut compare = compare(seed);
            compare.carry_out(CompareCommand::SetBlind(true));
            let mut key_of = |side| {
                compare.carry_out(CompareCommand::Hear(side));
                assert!(compare.is_hidden());
                compare.heard_key().unwrap()
            };
            let [a, b, x] = Side::ALL.map(&mut key_of);
            assert!(a != b && (x == a || x == b));
            n_swapped += u32::from(a == 2);
            assert_eq!(compare.side_of(1), None, "nothing tells");
            compare.carry_out(CompareCommand::Answer(if x == a { Side::A } else { Side::B }));
            assert_eq!(compare.answers(), (1, 1), "seed {seed}");
        }
        assert!((8..=32).contains(&n_swapped), "{n_swapped} of 40");
    }

    #[test]
    fn what_is_gone_is_not_compared() {
        let mut compare = compare(1);
        compare.carry_out(CompareCommand::Hear(Side::A));
        let two = edited(&three(), Edit::Remove(1));
        compare.follow(&two);
        assert_eq!(
            (compare.heard(), compare.side_of(3), compare.side_of(2)),
            (None, Some(Side::A), Some(Side::B))
        );
        compare.follow(&edited(&two, Edit::Remove(2)));
        assert!(!compare.is_possible());
        compare.carry_out(CompareCommand::Hear(Side::A));
        assert_eq!(compare.heard_key(), None);
    }
}
