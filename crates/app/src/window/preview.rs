//! Preview: the point plays while it is dragged or shaped, a texture plays for a moment after a click on it, and while the
//! pointer rests on it. All use the automatic stroke, and can be turned off. A project of the gallery plays while the pointer rests on it, too.

use std::borrow::Cow;
use std::sync::Arc;
use std::time::{Duration, Instant};

use egui::Context;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::project::{AuthoredTexture, Project};

use super::Window;
use crate::command::Command;
use crate::sheets::Sheet;
use crate::state::edit::Edit;
use crate::workspace::Workspace;

/// Time for which the pointer must rest on a texture.
const REST: Duration = Duration::from_millis(350);
/// Time for which a texture plays after a click on it.
const LISTENED: Duration = Duration::from_millis(1500);

/// What can play under the pointer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Pointed {
    /// Texture of the list, by index.
    Texture(usize),
    /// Project of the gallery, by index.
    Project(usize),
}

/// What is previewed.
#[derive(Default)]
pub(super) struct Preview {
    /// Whether the point or a control of its shape is being dragged.
    is_dragging: bool,
    /// When a texture was last chosen to play alone, while it plays for a moment.
    listened: Option<Instant>,
    /// What is under the pointer, and when the pointer came to it.
    pointed: Option<(Pointed, Instant)>,
    /// Selected texture of the project of the gallery under the pointer.
    in_gallery: Option<Arc<AuthoredTexture>>,
    /// Whether the automatic stroke was started by the preview, which will stop it.
    is_stroking: bool,
}

impl Preview {
    /// What plays because the pointer rests on it.
    fn auditioned(&self) -> Option<Pointed> {
        self.pointed.filter(|(_, since)| since.elapsed() >= REST).map(|(pointed, _)| pointed)
    }

    /// Texture of the gallery that plays instead of the texture of the open project.
    pub(super) fn gallery_texture(&self) -> Option<Arc<AuthoredTexture>> {
        let is_played = matches!(self.auditioned(), Some(Pointed::Project(_)));
        self.in_gallery.clone().filter(|_| is_played)
    }

    /// The project as it plays: with the texture under the pointer alone, if it is previewed.
    pub(super) fn applied_to<'a>(&self, project: &'a Project, textures: &[TextureEntry]) -> Cow<'a, Project> {
        let entry = match self.auditioned() {
            Some(Pointed::Texture(texture)) => textures.get(texture),
            Some(Pointed::Project(_)) | None => None,
        };
        match entry {
            Some(entry) => Cow::Owned(Project { solo: Some(entry.id.clone()), ..project.clone() }),
            None => Cow::Borrowed(project),
        }
    }
}

impl Window {
    /// Index and selected texture of the project of the gallery under the pointer. `None` if the textures of the open
    /// project have other positions, because the session then cannot play it.
    fn pointed_in_gallery(&self) -> Option<(usize, Arc<AuthoredTexture>)> {
        let Sheet::Gallery(sheet) = &self.sheet else { return None };
        let (index, chosen) = sheet.pointed()?;
        let open = &self.project;
        let can_play = open.library == chosen.library
            && open.axes == chosen.axes
            && open.joined.is_empty()
            && open.space.is_none();
        can_play.then(|| (index, Arc::clone(&chosen.authored[chosen.selected])))
    }

    /// Starts and stops the stroke of the preview. `commands` are those of this frame.
    pub(super) fn follow_preview(&mut self, commands: &mut Vec<Command>, ctx: &Context) {
        let is_author = self.pages.workspace == Workspace::Author && !self.sheet.is_open();
        let is_held = ctx.input(|i| i.pointer.primary_down());
        let is_moved =
            |command: &Command| matches!(command, Command::Edit(Edit::MovePoint(_) | Edit::SetShape(..)));
        let may_drag = is_author && !self.files.settings.is_silent_while_dragging;
        let dragged = self.preview.is_dragging || commands.iter().any(is_moved);
        self.preview.is_dragging = may_drag && is_held && dragged && ctx.dragged_id().is_some();
        let listens = |command: &Command| matches!(command, Command::Edit(Edit::Solo(Some(_))));
        let toggles = |command: &Command| matches!(command, Command::ToggleHand);
        let is_toggled = commands.iter().any(toggles);
        if commands.iter().any(listens) {
            self.preview.listened = Some(Instant::now());
        } else if is_toggled || is_held || self.project.solo.is_none() || self.compare.heard().is_some() {
            self.preview.listened = None;
        }
        self.preview.listened = self.preview.listened.filter(|since| may_drag && since.elapsed() < LISTENED);
        let may_point = is_author && self.files.settings.plays_on_hover && !is_held;
        let pointed = self.pages.author.canvas.pointed.filter(|_| may_point).map(Pointed::Texture);
        let in_gallery = self.pointed_in_gallery().filter(|_| !is_held);
        let pointed = in_gallery.as_ref().map(|(index, _)| Pointed::Project(*index)).or(pointed);
        self.preview.in_gallery = in_gallery.map(|(_, texture)| texture);
        if self.preview.pointed.map(|(before, _)| before) != pointed {
            self.preview.pointed = pointed.map(|pointed| (pointed, Instant::now()));
        }
        if self.preview.pointed.is_some() {
            ctx.request_repaint_after(REST);
        }
        let is_wanted = self.preview.is_dragging
            || self.preview.listened.is_some()
            || self.preview.auditioned().is_some();
        if self.preview.is_stroking && is_toggled {
            // The user takes the stroke over, which is running already.
            commands.retain(|command| !toggles(command));
            self.preview.is_stroking = false;
        } else if is_wanted && !self.session.hand_is_running() && !self.preview.is_stroking {
            self.session.set_hand(Some(self.pages.stage.pad.input()));
            self.preview.is_stroking = true;
        } else if !is_wanted && std::mem::take(&mut self.preview.is_stroking) {
            self.session.set_hand(None);
        }
        self.pages.stage.pad.is_preview = self.preview.is_stroking;
    }
}
