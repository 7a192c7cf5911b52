//! Undo and redo by snapshots, one step per gesture.
//!
//! Snapshots share the large parts of a project, so they are cheap and need no inverse edits. Edits of one kind within
//! one gesture (one drag, one held key, one visit of a text field) form one step, and so do consecutive selections and
//! consecutive solos: listening to several textures is one step.
//! Limitation: the oldest steps are dropped beyond [`MAX_STEPS`].

use std::borrow::Cow;

use shagreen_formats::project::Project;

use crate::state::edit::{Edit, EditKind, edited};

/// Maximum number of undo steps.
pub const MAX_STEPS: usize = 1000;

/// Everything between press and release. Edits of one kind within one gesture are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gesture(pub u64);

#[derive(Clone, Debug)]
struct Step {
    label: Cow<'static, str>,
    kind: EditKind,
    project: Project,
    gesture: Gesture,
    /// Whether a drag made the edit.
    is_dragged: bool,
}

/// Undo and redo steps of a project.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Step>,
    future: Vec<Step>,
    /// Undone steps that the last step has cleared, if a drag made it: they come back when it is abandoned.
    cleared: Vec<Step>,
    revision: u64,
}

impl History {
    /// Applies an edit to `project` and records the previous state.
    pub fn apply(&mut self, project: &mut Project, edit: Edit, gesture: Gesture) {
        let (label, kind) = (edit.label(project), edit.kind());
        let is_selection = matches!(edit, Edit::Select(_) | Edit::Solo(_));
        let is_dragged = edit.is_dragged();
        let after = edited(project, edit);
        if after == *project {
            return;
        }
        let continued = self.past.last().filter(|s| s.kind == kind && (is_selection || s.gesture == gesture));
        if continued.is_some_and(|s| s.project == after) {
            // A drag that returns to its start is not a step.
            self.past.pop();
            self.future = std::mem::take(&mut self.cleared);
        } else if continued.is_none() {
            let cleared = std::mem::take(&mut self.future);
            self.cleared = if is_dragged { cleared } else { Vec::new() };
            self.past.push(Step { label, kind, project: project.clone(), gesture, is_dragged });
            if self.past.len() > MAX_STEPS {
                self.past.remove(0);
            }
        } else {
            self.future.clear();
        }
        self.revision += 1;
        *project = after;
    }

    /// Applies an edit and adds it to the last step. One undo reverts both.
    pub fn add_to_last(&mut self, project: &mut Project, edit: Edit) {
        *project = edited(project, edit);
        self.future.clear();
        self.revision += 1;
    }

    /// Reverts what a drag has done in this gesture, also to the undone steps, and forgets it. Returns whether there was
    /// anything.
    pub fn abandon_drag(&mut self, project: &mut Project, gesture: Gesture) -> bool {
        let is_of_drag = |step: &mut Step| step.is_dragged && step.gesture == gesture;
        let Some(step) = self.past.pop_if(is_of_drag) else { return false };
        *project = step.project;
        self.future = std::mem::take(&mut self.cleared);
        self.revision += 1;
        true
    }

    /// Undoes the last step. Returns whether there was one.
    pub fn undo(&mut self, project: &mut Project) -> bool {
        self.cleared.clear();
        let is_done = Self::travel(&mut self.past, &mut self.future, project);
        self.revision += u64::from(is_done);
        is_done
    }

    /// Redoes the last undone step. Returns whether there was one.
    pub fn redo(&mut self, project: &mut Project) -> bool {
        self.cleared.clear();
        let is_done = Self::travel(&mut self.future, &mut self.past, project);
        self.revision += u64::from(is_done);
        is_done
    }

    fn travel(from: &mut Vec<Step>, to: &mut Vec<Step>, project: &mut Project) -> bool {
        let Some(mut step) = from.pop() else { return false };
        std::mem::swap(project, &mut step.project);
        to.push(step);
        true
    }

    /// Number that changes with every change of the project.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Name of the step that undo reverts.
    pub fn undo_label(&self) -> Option<&str> {
        self.past.last().map(|s| &*s.label)
    }

    /// Name of the step that redo applies.
    pub fn redo_label(&self) -> Option<&str> {
        self.future.last().map(|s| &*s.label)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Gesture, History};
    use crate::state::edit::{Edit, PathChange, edited};
    use shagreen_core::space::SpacePoint;
    use shagreen_core::space::authoring::{Outside, Weights};
    use shagreen_core::space::texture_path::UserPath;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::shape::ShapeControl;
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
    use shagreen_formats::starter::starter_library;
    use shagreen_studio::height_map::ReliefPlace;

    fn begin() -> (History, Project) {
        (History::default(), Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "New texture"))
    }

    fn point(rs: f64) -> Edit {
        Edit::MovePoint(SpacePoint::plane(rs, 5.0))
    }

    #[test]
    fn a_gesture_is_one_step() {
        let (mut history, mut project) = begin();
        let start = project.clone();
        for rs in [1.0, 2.0, 3.0] {
            history.apply(&mut project, point(rs), Gesture(1));
        }
        history.apply(&mut project, point(9.0), Gesture(2));
        assert!(history.undo(&mut project));
        assert_eq!(project, edited(&start, point(3.0)));
        assert!(history.undo(&mut project));
        assert_eq!(project, start);
        assert!(!history.undo(&mut project));
        assert!(history.redo(&mut project) && history.redo(&mut project) && !history.redo(&mut project));
        assert_eq!(project, edited(&start, point(9.0)));
    }

    #[test]
    fn a_drag_that_comes_back_is_no_step() {
        let (mut history, mut project) = begin();
        let start = project.texture().at;
        for edit in [point(1.0), point(2.0), Edit::MovePoint(start)] {
            history.apply(&mut project, edit, Gesture(1));
        }
        assert_eq!(history.undo_label(), None);
    }

    #[test]
    fn a_drag_that_is_abandoned_leaves_nothing() {
        let (mut history, mut project) = begin();
        history.apply(&mut project, point(9.0), Gesture(1));
        let start = project.clone();
        for rs in [1.0, 2.0] {
            history.apply(&mut project, point(rs), Gesture(2));
        }
        assert!(!history.abandon_drag(&mut project, Gesture(3)), "another gesture");
        assert!(history.abandon_drag(&mut project, Gesture(2)));
        assert_eq!((&project, history.redo_label()), (&start, None));
        history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(4));
        assert!(!history.abandon_drag(&mut project, Gesture(4)), "typing is no drag");
    }

    /// Escape, or a drag back to the start.
    #[test]
    fn a_drag_without_effect_keeps_what_was_undone() {
        for is_abandoned in [true, false] {
            let (mut history, mut project) = begin();
            history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(1));
            let renamed = project.clone();
            assert!(history.undo(&mut project));
            let start = project.texture().at;
            for edit in [point(1.0), point(2.0)] {
                history.apply(&mut project, edit, Gesture(2));
            }
            assert_eq!(history.redo_label(), None, "not during the drag");
            if is_abandoned {
                assert!(history.abandon_drag(&mut project, Gesture(2)));
            } else {
                history.apply(&mut project, Edit::MovePoint(start), Gesture(2));
            }
            assert!(history.redo(&mut project));
            assert_eq!(project, renamed, "{is_abandoned}");
            assert!(!history.redo(&mut project) && history.undo(&mut project));
            // A drag that stays ends it.
            history.apply(&mut project, point(3.0), Gesture(3));
            history.apply(&mut project, Edit::SetMode(Mode::Paper), Gesture(4));
            assert!(!history.abandon_drag(&mut project, Gesture(4)) && !history.redo(&mut project));
        }
    }

    #[test]
    fn what_is_added_to_a_step_is_undone_with_it() {
        let (mut history, mut project) = begin();
        let start = project.clone();
        history.apply(&mut project, point(9.0), Gesture(1));
        history.add_to_last(&mut project, Edit::Rename("Oak".to_owned()));
        let both = project.clone();
        assert!(history.undo(&mut project) && !history.undo(&mut project));
        assert_eq!(project, start);
        assert!(history.redo(&mut project));
        assert_eq!(project, both);
    }

    #[test]
    fn listening_to_several_textures_is_one_step() {
        let (mut history, mut project) = begin();
        let start = project.clone();
        for (gesture, id) in [Some("cork"), Some("oak"), None].into_iter().enumerate() {
            history.apply(&mut project, Edit::Solo(id.map(str::to_owned)), Gesture(gesture as u64));
        }
        assert_eq!((&project, history.undo_label()), (&start, None), "back where it began");
    }

    #[test]
    fn an_edit_after_undo_forgets_the_future_and_no_change_is_no_step() {
        let (mut history, mut project) = begin();
        history.apply(&mut project, Edit::SetMode(Mode::Paper), Gesture(1));
        assert!(history.undo(&mut project));
        history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(2));
        assert_eq!(history.redo_label(), None);
        history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(3));
        assert_eq!(history.undo_label(), Some("Rename New texture"));
        assert!(history.undo(&mut project) && !history.undo(&mut project));
    }

    #[test]
    fn a_word_that_is_typed_is_one_step() {
        let (mut history, mut project) = begin();
        for typed in ["O", "Oa", "Oak"] {
            history.apply(&mut project, Edit::Rename(typed.to_owned()), Gesture(1));
        }
        assert_eq!(history.undo_label(), Some("Rename New texture"));
        assert!(history.undo(&mut project) && !history.undo(&mut project));
    }

    #[test]
    fn selections_that_follow_each_other_are_one_step() {
        let (mut history, mut project) = begin();
        for (gesture, name) in ["A", "B"].into_iter().enumerate() {
            let texture = AuthoredTexture::new(0, name);
            history.apply(&mut project, Edit::Author(Box::new(texture)), Gesture(gesture as u64));
        }
        let three = project.clone();
        for (gesture, key) in [1, 2, 1].into_iter().enumerate() {
            history.apply(&mut project, Edit::Select(key), Gesture(10 + gesture as u64));
        }
        assert_eq!(project.texture().key, 1);
        assert!(history.undo(&mut project));
        assert_eq!(project, three);
        assert!(history.redo(&mut project));
        history.apply(&mut project, Edit::Select(3), Gesture(20));
        assert_eq!((&project, history.undo_label()), (&three, Some("Add B")), "back where it began");
    }

    /// Edit of one of many kinds, chosen by `number`.
    fn any_edit(
        number: u64,
        project: &Project,
        joined: &Arc<shagreen_formats::library::TextureEntry>,
    ) -> Edit {
        let share = (number >> 40) as f64 / (1_u64 << 24) as f64;
        let at = SpacePoint::plane(100.0 * share, 100.0 * (7.0 * share).fract());
        let key = project.authored[(number >> 20) as usize % project.authored.len()].key;
        let (id, name, is_on) = (format!("id{}", number >> 61), format!("{share}"), number & 64 == 0);
        let built_in = BuiltIn::ALL[(number >> 50) as usize % 2];
        match (number >> 33) % 34 {
            0..=3 => Edit::MovePoint(at),
            4 => Edit::SetMode(Mode::ALL[(number >> 50) as usize % 5]),
            5 => Edit::Lock { id, name, is_locked: is_on },
            6 => Edit::SetOutside(if is_on { Outside::Clamped } else { Outside::Extrapolated }),
            7 => Edit::SetWeights(if is_on { Weights::Barycentric } else { Weights::Natural }),
            8 => Edit::Rename(name),
            9 => Edit::SetColor((number >> 60) as u8 % 8),
            10 => Edit::SetNotes(name),
            11 => Edit::SetTags(vec![name]),
            12 => Edit::SetPicture(joined.picture.clone().map(Arc::new).filter(|_| is_on)),
            13 => {
                let path = UserPath { points: vec![at, at.with(0, 1.0)], ..UserPath::default() };
                Edit::ChangePath(PathChange::Draw, is_on.then_some(path))
            }
            14 => Edit::Author(Box::new(AuthoredTexture { at, ..AuthoredTexture::new(0, &name) })),
            15 => Edit::Remove(key),
            16 | 17 => Edit::Select(key),
            18 => Edit::KeepSnapshot,
            19 => Edit::RestoreSnapshot((number >> 55) as usize % 8),
            20 => Edit::RemoveSnapshot((number >> 55) as usize % 8),
            21 => Edit::OpenLibrary(ProjectLibrary::BuiltIn(built_in)),
            22 => Edit::AddTextures(vec![Arc::clone(joined)]),
            23 => Edit::RemoveTexture((number >> 55) as usize % 4),
            25 => match joined.picture.clone().map(Arc::new) {
                Some(picture) => Edit::Remake { at, picture, notes: name },
                None => Edit::SetNotes(name),
            },
            24 => Edit::Star { id, name, is_starred: is_on },
            26 => Edit::SetShape(ShapeControl::ALL[(number >> 50) as usize % 7], 4.0 * share),
            27 => Edit::ResetShape,
            28 => Edit::SetOwn { joined: (number >> 55) as usize % 4, name, is_own: is_on },
            29 => Edit::TakeTexture { id, name, at },
            30 => {
                let index = (number >> 55) as usize % 4;
                let places = [ReliefPlace::Added, ReliefPlace::InPlaceOf(index), ReliefPlace::Pinned(key)];
                let place = places[(number >> 50) as usize % 3];
                Edit::AddRelief { entry: Arc::clone(joined), place }
            }
            31 => Edit::SetCompared([key, (number >> 61) as u32]),
            32 => Edit::Solo(is_on.then_some(id)),
            _ => Edit::RenameTexture { id, name },
        }
    }

    #[test]
    fn undo_after_a_thousand_random_edits_restores_equality() {
        let joined = Arc::new(starter_library().unwrap().textures[0].clone());
        for seed in 1..=8_u64 {
            let (mut history, mut project) = begin();
            let start = project.clone();
            let mut state = seed;
            let mut sorts = std::collections::HashSet::new();
            for i in 0..1000 {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                let edit = any_edit(state, &project, &joined);
                sorts.insert(edit.kind().0);
                history.apply(&mut project, edit, Gesture(i / 3));
                assert!(project.selected < project.authored.len());
            }
            assert!(sorts.len() >= 24, "the control: {} sorts of edits", sorts.len());
            let end = project.clone();
            assert_ne!(start, end);
            while history.undo(&mut project) {}
            assert_eq!(project, start, "seed {seed}");
            while history.redo(&mut project) {}
            assert_eq!(project, end, "seed {seed}");
        }
    }
}
