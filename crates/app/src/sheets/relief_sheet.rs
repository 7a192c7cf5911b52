//! Sheet that makes the relief of a texture from a picture: the picture, its size, and what a tip makes of it. A worker
//! reads the picture and computes the heights.

use std::sync::Arc;

use egui::{
    Button, Color32, Context, DragValue, Grid, Key, Label, Pos2, Rect, RichText, Role, Sense, TextEdit, Ui,
    WidgetInfo, vec2,
};
use shagreen_core::texture::height_map::HeightMapOptions;
use shagreen_formats::height_picture::PictureTile;
use shagreen_formats::picture::{PHOTO_ENDINGS, Picture};
use shagreen_studio::height_map::{HEIGHTS_UM, PictureRelief, ReliefSize, SIDES_MM, relief};

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::command::Command;
use crate::command::relief::{ReliefCommand, ReliefOf};
use crate::look::motion::busy_ui;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, GROUP_GAP, RADIUS, tokens};
use crate::look::together::at_right_ui;
use crate::state::background::{JobPanicked, LatestJob};
use crate::state::own_surface::{OwnSurface, SurfacePicture};
use crate::state::pad_surface::USUAL_LIGHT;
use crate::state::source::{Source, paths_in};
use crate::strings::relief as strings;
use crate::strings::sentence;

/// Width of the sheet, side of the picture, and width of the button beside the path, in points.
const WIDTH: f32 = 600.0;
const PICTURE: f32 = 200.0;
const READ_WIDTH: f32 = 58.0;
/// Size before the user states one: a photo of a hand's width, with heights that a finger notices.
const USUAL_SIZE: ReliefSize = ReliefSize { side_mm: 50.0, height_um: 100.0 };

/// Texture that gets the relief.
pub(crate) struct ReliefTarget {
    pub(crate) of: ReliefOf,
    /// What happens to the texture.
    pub(crate) note: String,
    /// Its own picture, which is read first.
    pub(crate) picture: Option<Arc<Picture>>,
    /// Why the texture cannot have a relief.
    pub(crate) refusal: Option<&'static str>,
}

/// State of the open sheet.
pub(crate) struct ReliefSheet {
    target: ReliefTarget,
    path: String,
    is_focused: bool,
    browse: Browse,
    reading: LatestJob<Result<ReadPicture, String>>,
    picture: Option<ReadPicture>,
    preview: OwnSurface,
    size: ReliefSize,
    /// Whether the user has stated side and height.
    is_stated: [bool; 2],
    making: LatestJob<Result<PictureRelief, String>>,
    made: Option<Result<Arc<PictureRelief>, String>>,
    failure: Option<String>,
}

/// Picture that was read.
struct ReadPicture {
    name: String,
    tile: Arc<PictureTile>,
    /// Picture of the tile, for the preview.
    shown: Arc<Picture>,
}

impl ReliefSheet {
    /// Sheet for a texture, with a picture if there is one, or else with that of the texture.
    pub(crate) fn new(target: ReliefTarget, picture: Option<Source>, ctx: &Context) -> Self {
        let own = target.picture.clone();
        let mut sheet = Self {
            target,
            path: String::new(),
            is_focused: picture.is_some(),
            browse: Browse::default(),
            reading: LatestJob::default(),
            picture: None,
            preview: OwnSurface::default(),
            size: USUAL_SIZE,
            is_stated: [false; 2],
            making: LatestJob::default(),
            made: None,
            failure: None,
        };
        match (picture, own) {
            (Some(picture), _) => sheet.read(picture, ctx),
            (None, Some(own)) => {
                sheet.reading.ask(ctx, move || tile_of(strings::OWN_PICTURE.to_owned(), &own.bytes));
            }
            (None, None) => sheet.browse.begin(ctx, &asked()),
        }
        sheet
    }

    /// Texture that gets the relief.
    pub(crate) fn of(&self) -> &ReliefOf {
        &self.target.of
    }

    /// Reads another picture. The present one stays until it is read.
    pub(crate) fn read(&mut self, source: Source, ctx: &Context) {
        self.failure = None;
        self.reading.ask(ctx, move || read_picture(&source));
    }

    /// Shows why the relief could not be added.
    pub(crate) fn say(&mut self, reason: String) {
        self.failure = Some(reason);
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        self.collect(ctx);
        sheet(ctx, "relief sheet", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        })
        .inner
    }

    /// Takes in what the workers have finished.
    fn collect(&mut self, ctx: &Context) {
        match self.reading.collect(ctx) {
            Some(Ok(Ok(picture))) => {
                self.picture = Some(picture);
                self.make(ctx);
            }
            Some(Ok(Err(reason))) => self.failure = Some(reason),
            Some(Err(JobPanicked)) => self.failure = Some(strings::BROKEN.to_owned()),
            None => {}
        }
        match self.making.collect(ctx) {
            Some(Ok(made)) => self.made = Some(made.map(Arc::new)),
            Some(Err(JobPanicked)) => self.made = Some(Err(strings::BROKEN.to_owned())),
            None => {}
        }
    }

    /// Computes the relief of the picture in the present size.
    fn make(&mut self, ctx: &Context) {
        let Some(picture) = &self.picture else { return };
        let (tile, size) = (Arc::clone(&picture.tile), self.size);
        self.making.ask(ctx, move || {
            relief(&tile, size, HeightMapOptions::HARD_PLASTIC).map_err(|error| format!("{error:#}"))
        });
    }

    fn is_busy(&self) -> bool {
        self.reading.is_busy() || self.making.is_busy()
    }

    fn content_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let t = tokens(ui.ctx());
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add(Label::new(RichText::new(&self.target.note).color(t.text_weak)).wrap());
        ui.add_space(GAP);
        self.path_ui(ui);
        ui.add_space(GAP);
        ui.horizontal_top(|ui| {
            self.picture_ui(ui);
            ui.add_space(GROUP_GAP - GAP);
            ui.vertical(|ui| {
                ui.set_width(ui.available_width());
                self.size_ui(ui);
            });
        });
        ui.add_space(GAP);
        let failure = self.target.refusal.or(self.failure.as_deref());
        if let Some(failure) = failure {
            ui.add(Label::new(RichText::new(sentence(failure)).color(t.error)).wrap());
            ui.add_space(GAP);
        }
        self.foot_ui(ui)
    }

    fn path_ui(&mut self, ui: &mut Ui) {
        let mut wanted = Vec::new();
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.path).hint_text(strings::PATH_HINT);
            let room = ui.available_width() - READ_WIDTH - BROWSE_WIDTH;
            let field = ui.add(field.desired_width(room)).accessible_name(strings::PATH);
            if !std::mem::replace(&mut self.is_focused, true) {
                field.request_focus();
            }
            let is_entered = field.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
            let is_named = !self.path.trim().is_empty();
            let is_asked = ui.add_enabled(is_named, Button::new(strings::READ)).clicked();
            if is_entered || is_asked {
                wanted = paths_in(&self.path);
            }
            let chosen = self.browse.show(ui, strings::PATH, &asked());
            wanted.extend(chosen.into_iter().map(Source::Path));
        });
        self.browse.missing_ui(ui);
        if let Some(source) = wanted.into_iter().next() {
            self.read(source, ui.ctx());
        }
    }

    /// Draws the picture as the pad will show it, with its name.
    fn picture_ui(&mut self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        let own = self
            .picture
            .as_ref()
            .map(|picture| SurfacePicture { picture: Arc::clone(&picture.shown), is_felt: true });
        let surface = self.preview.follow(own, ui.ctx(), USUAL_LIGHT);
        let name = self.picture.as_ref().map_or(strings::NO_PICTURE, |picture| &picture.name);
        ui.vertical(|ui| {
            ui.set_width(PICTURE);
            let (area, response) = ui.allocate_exact_size(vec2(PICTURE, PICTURE), Sense::hover());
            response.widget_info(|| WidgetInfo::labeled(Role::Image, true, strings::PREVIEW));
            match surface {
                Some((surface, _)) => {
                    let all = Rect::from_min_max(Pos2::ZERO, Pos2::new(1.0, 1.0));
                    ui.painter().image(surface, area, all, Color32::WHITE);
                }
                None => {
                    ui.painter().rect_filled(area, f32::from(RADIUS), t.raised);
                }
            }
            let name = RichText::new(name).small().color(t.text_weak);
            ui.add(Label::new(name).truncate().selectable(false));
        });
    }

    /// Draws side and height, and what a tip makes of them.
    fn size_ui(&mut self, ui: &mut Ui) {
        let t = tokens(ui.ctx());
        let before = self.size;
        Grid::new("size of the relief").num_columns(3).spacing([2.0 * GAP, GAP]).show(ui, |ui| {
            let ReliefSize { side_mm, height_um } = &mut self.size;
            let side = DragValue::new(side_mm)
                .range(SIDES_MM)
                .speed(0.5)
                .min_decimals(1)
                .max_decimals(2)
                .suffix(" mm");
            self.is_stated[0] |= number_ui(ui, strings::SIDE, strings::SIDE_HELP, side, self.is_stated[0]);
            let height = DragValue::new(height_um).range(HEIGHTS_UM).max_decimals(2).suffix(" µm");
            self.is_stated[1] |=
                number_ui(ui, strings::HEIGHT, strings::HEIGHT_HELP, height, self.is_stated[1]);
        });
        if self.size != before {
            self.failure = None;
            self.make(ui.ctx());
        }
        let mut say = |text: &str, color: Color32| {
            ui.add_space(GAP);
            ui.add(Label::new(RichText::new(sentence(text)).color(color)).wrap());
        };
        match &self.made {
            Some(Ok(relief)) => {
                say(&relief.assumption, t.text_weak);
                if let Some(warning) = &relief.warning {
                    say(warning, t.warning);
                }
            }
            Some(Err(reason)) => say(reason, t.error),
            None => {}
        }
    }

    fn foot_ui(&self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal(|ui| {
            if self.is_busy() {
                busy_ui(ui);
            }
            at_right_ui(ui, |ui| {
                let can_apply = !self.is_busy() && self.target.refusal.is_none();
                let relief = self.made.as_ref().and_then(|made| made.as_ref().ok()).filter(|_| can_apply);
                let is_applied = primary_ui(ui, strings::APPLY, relief.is_some()).clicked();
                if let Some(relief) = relief.filter(|_| is_applied) {
                    commands.push(Command::Relief(ReliefCommand::Apply(Arc::clone(relief))));
                }
                if ui.button(strings::CANCEL).clicked() {
                    commands.push(Command::CloseSheet);
                }
            });
        });
        commands
    }
}

/// What the dialog of the system asks for.
fn asked() -> Asked<'static> {
    Asked { title: strings::TITLE, kind: strings::KIND, endings: &PHOTO_ENDINGS, ..Asked::default() }
}

/// Draws a number with its label, and whether it is only the default; returns whether it was changed.
fn number_ui(ui: &mut Ui, word: &str, help: &str, value: DragValue<'_>, is_stated: bool) -> bool {
    let t = tokens(ui.ctx());
    let text = RichText::new(word).color(t.text_weak);
    ui.add(Label::new(text).selectable(false)).on_hover_text(help);
    let is_changed = ui.add(value).accessible_name(word).on_hover_text(help).changed();
    let note = if is_stated { "" } else { strings::DEFAULT };
    ui.add(Label::new(RichText::new(note).small().color(t.text_weak)).selectable(false));
    ui.end_row();
    is_changed
}

/// Reads a picture and prepares its tile.
fn read_picture(source: &Source) -> Result<ReadPicture, String> {
    let bytes = source.bytes().map_err(|reason| format!("{reason}: {}", source.name()))?;
    tile_of(source.name(), &bytes)
}

/// Prepares the tile of a picture with this name.
fn tile_of(name: String, bytes: &[u8]) -> Result<ReadPicture, String> {
    let of_file = |reason: String| format!("{reason}: {name}");
    let tile = PictureTile::read(bytes).map_err(|error| of_file(error.to_string()))?;
    // The size of the preview on the screen does not depend on that of the surface.
    let shown = tile.picture(1.0).map_err(|error| of_file(error.to_string()))?;
    Ok(ReadPicture { tile: Arc::new(tile), shown: Arc::new(shown), name })
}
