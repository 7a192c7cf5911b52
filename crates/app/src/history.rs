//! Undo and redo by snapshots, one step a gesture.
//!
//! A project is small, so a snapshot is cheap and there are no inverses to get wrong. Edits that share a gesture (one
//! drag, one held key) are one step. Limitation: the oldest steps are dropped beyond [`MAX_STEPS`].

use std::borrow::Cow;

use crate::project::{Edit, Project};

/// Steps that are kept.
pub const MAX_STEPS: usize = 1000;

/// Everything between pressing and letting go; edits of one gesture are undone together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gesture(pub u64);

#[derive(Clone, Debug)]
struct Step {
    label: Cow<'static, str>,
    project: Project,
    gesture: Gesture,
}

/// The past and the future of a project.
#[derive(Clone, Debug, Default)]
pub struct History {
    past: Vec<Step>,
    future: Vec<Step>,
}

impl History {
    /// Applies an edit to `project` and remembers how it was.
    pub fn apply(&mut self, project: &mut Project, edit: Edit, gesture: Gesture) {
        let label = edit.label();
        let after = project.edited(edit);
        if after == *project {
            return;
        }
        let continued = self.past.last().filter(|s| s.gesture == gesture && s.label == label);
        if continued.is_some_and(|s| s.project == after) {
            // A drag that comes back to where it began has done nothing.
            self.past.pop();
        } else if continued.is_none() {
            self.past.push(Step { label, project: project.clone(), gesture });
            if self.past.len() > MAX_STEPS {
                self.past.remove(0);
            }
        }
        self.future.clear();
        *project = after;
    }

    /// Takes the last step back. Returns whether there was one.
    pub fn undo(&mut self, project: &mut Project) -> bool {
        Self::travel(&mut self.past, &mut self.future, project)
    }

    /// Takes the last undone step again. Returns whether there was one.
    pub fn redo(&mut self, project: &mut Project) -> bool {
        Self::travel(&mut self.future, &mut self.past, project)
    }

    fn travel(from: &mut Vec<Step>, to: &mut Vec<Step>, project: &mut Project) -> bool {
        let Some(step) = from.pop() else { return false };
        let now = std::mem::replace(project, step.project);
        to.push(Step { label: step.label, project: now, gesture: step.gesture });
        true
    }

    /// What undo would take back.
    pub fn undo_label(&self) -> Option<&str> {
        self.past.last().map(|s| &*s.label)
    }

    /// What redo would do again.
    pub fn redo_label(&self) -> Option<&str> {
        self.future.last().map(|s| &*s.label)
    }
}

#[cfg(test)]
mod tests {
    use super::{Gesture, History};
    use crate::project::{Edit, Project};
    use shagreen_core::blend::Mode;
    use shagreen_core::space::SpacePoint;

    fn point(rs: f64) -> Edit {
        Edit::MovePoint(SpacePoint { rough_smooth: rs, hard_soft: 5.0 })
    }

    #[test]
    fn a_gesture_is_one_step() {
        let (mut history, mut project) = (History::default(), Project::default());
        let start = project.clone();
        for rs in [1.0, 2.0, 3.0] {
            history.apply(&mut project, point(rs), Gesture(1));
        }
        history.apply(&mut project, point(9.0), Gesture(2));
        assert!(history.undo(&mut project));
        assert_eq!(project, start.edited(point(3.0)));
        assert!(history.undo(&mut project));
        assert_eq!(project, start);
        assert!(!history.undo(&mut project));
        assert!(history.redo(&mut project) && history.redo(&mut project) && !history.redo(&mut project));
        assert_eq!(project, start.edited(point(9.0)));
    }

    #[test]
    fn a_drag_that_comes_back_is_no_step() {
        let (mut history, mut project) = (History::default(), Project::default());
        let start = project.point;
        for edit in [point(1.0), point(2.0), Edit::MovePoint(start)] {
            history.apply(&mut project, edit, Gesture(1));
        }
        assert_eq!(history.undo_label(), None);
    }

    #[test]
    fn an_edit_after_undo_forgets_the_future_and_no_change_is_no_step() {
        let (mut history, mut project) = (History::default(), Project::default());
        history.apply(&mut project, Edit::SetMode(Mode::Paper), Gesture(1));
        assert!(history.undo(&mut project));
        history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(2));
        assert_eq!(history.redo_label(), None);
        history.apply(&mut project, Edit::Rename("Oak".to_owned()), Gesture(3));
        assert_eq!(history.undo_label(), Some("Rename"));
        assert!(history.undo(&mut project) && !history.undo(&mut project));
    }

    #[test]
    fn undo_after_a_thousand_random_edits_restores_equality() {
        let (mut history, mut project) = (History::default(), Project::default());
        let start = project.clone();
        let mut state = 1_u64;
        for i in 0..1000 {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let edit = match (state >> 33) % 3 {
                0 => point((state >> 40) as f64 % 100.0),
                1 => Edit::SetMode(Mode::ALL[(state >> 50) as usize % 5]),
                _ => Edit::Rename(format!("{state}")),
            };
            history.apply(&mut project, edit, Gesture(i / 3));
        }
        let end = project.clone();
        while history.undo(&mut project) {}
        assert_eq!(project, start);
        while history.redo(&mut project) {}
        assert_eq!(project, end);
    }
}
