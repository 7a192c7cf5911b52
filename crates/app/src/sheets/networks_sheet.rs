//! Sheet that chooses the networks that predict attributes from photos: an image network, and the heads that belong to it.
//! A worker reads and checks the files before they are used.

use std::path::PathBuf;

use egui::{ComboBox, Context, Grid, Label, RichText, TextEdit, Ui};
use shagreen_formats::photo_networks::{ImageNetwork, PhotoNetworks};
use shagreen_studio::file::one_line;
use shagreen_studio::models::ModelFolder;
use shagreen_studio::photo_predictor::{described, photo_predictor};

use crate::browse::{Asked, BROWSE_WIDTH, Browse};
use crate::choices::networks::NetworkChoice;
use crate::command::Command;
use crate::command::networks::NetworksCommand;
use crate::look::list::ShowList as _;
use crate::look::motion::busy_ui;
use crate::look::primary::primary_ui;
use crate::look::sheet_frame::sheet;
use crate::look::theme::{GAP, tokens};
use crate::look::together::at_right_ui;
use crate::state::background::{JobPanicked, LatestJob};
use crate::strings::{help, networks as strings, sentence};

/// Width of the sheet, and of the column of paths, in points.
const WIDTH: f32 = 620.0;
const PATH_WIDTH: f32 = 470.0;

/// Field for the path of a file, with the button for the dialog of the system.
struct FileField {
    path: String,
    browse: Browse,
}

/// State of the open sheet.
pub(crate) struct NetworksSheet {
    models: Option<ModelFolder>,
    /// Path of EfficientNet-Lite0, if it is on this computer.
    downloaded: Option<String>,
    choice: NetworkChoice,
    file: FileField,
    heads: FileField,
    checking: LatestJob<Result<String, String>>,
    /// Networks that are being checked, unless the user has changed the choice since.
    checked: Option<PhotoNetworks>,
    /// Description of the networks that were checked last, or why they cannot be used.
    outcome: Option<Result<String, String>>,
}

impl NetworksSheet {
    /// Sheet that begins with the networks in use; `None` are those that are used without a choice. `models` is the folder
    /// of downloaded networks.
    pub(crate) fn new(in_use: Option<&PhotoNetworks>, models: Option<ModelFolder>) -> Self {
        let downloaded = models.as_ref().map(ModelFolder::efficientnet_lite0).filter(|path| path.is_file());
        let (choice, file) = match in_use.map(|networks| &networks.network) {
            Some(ImageNetwork::Resnet50(path)) => (NetworkChoice::Resnet50, path.display().to_string()),
            Some(ImageNetwork::EfficientnetLite0) => (NetworkChoice::EfficientnetLite0, String::new()),
            None if downloaded.is_some() => (NetworkChoice::EfficientnetLite0, String::new()),
            Some(ImageNetwork::Statistics) | None => (NetworkChoice::Statistics, String::new()),
        };
        let heads = in_use.and_then(|networks| networks.heads.as_ref());
        let heads = heads.map_or_else(String::new, |path| path.display().to_string());
        let field = |path: String| FileField { path, browse: Browse::default() };
        Self {
            models,
            downloaded: downloaded.map(|path| path.display().to_string()),
            choice,
            file: field(file),
            heads: field(heads),
            checking: LatestJob::default(),
            checked: None,
            outcome: None,
        }
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        let mut commands: Vec<Command> = self.collect(ctx).into_iter().collect();
        let shown = sheet(ctx, "networks sheet", |ui| {
            ui.set_width(WIDTH);
            self.content_ui(ui)
        });
        commands.extend(shown.inner);
        commands
    }

    /// Takes in what the worker has found; returns the command that uses the networks.
    fn collect(&mut self, ctx: &Context) -> Option<Command> {
        let done = self.checking.collect(ctx)?;
        let checked = self.checked.take()?;
        let outcome = done.unwrap_or_else(|JobPanicked| Err(strings::BROKEN.to_owned()));
        let is_sound = outcome.is_ok();
        self.outcome = Some(outcome);
        is_sound.then(|| Command::Networks(NetworksCommand::Use(checked)))
    }

    /// Networks in the fields, or which file is missing.
    fn networks(&self) -> Result<PhotoNetworks, String> {
        let network = match self.choice {
            NetworkChoice::EfficientnetLite0 => ImageNetwork::EfficientnetLite0,
            NetworkChoice::Resnet50 => {
                ImageNetwork::Resnet50(self.file.file().ok_or_else(|| strings::NO_FILE.to_owned())?)
            }
            NetworkChoice::Statistics => ImageNetwork::Statistics,
        };
        Ok(PhotoNetworks { network, heads: self.heads.file() })
    }

    /// Reads and checks the networks in the background.
    fn check(&mut self, ctx: &Context) {
        match self.networks() {
            Err(reason) => (self.checked, self.outcome) = (None, Some(Err(reason))),
            Ok(networks) => {
                (self.checked, self.outcome) = (Some(networks.clone()), None);
                let models = self.models.clone();
                self.checking.ask(ctx, move || {
                    photo_predictor(Some(&networks), models.as_ref())
                        .map(|predictor| described(&predictor))
                        .map_err(|error| one_line(&error))
                });
            }
        }
    }

    fn content_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let t = tokens(ui.ctx());
        ui.add(Label::new(RichText::new(strings::TITLE).heading().strong()).selectable(false));
        ui.add(Label::new(RichText::new(strings::PURPOSE).color(t.text_weak)).wrap());
        ui.add_space(GAP);
        let before = (self.choice, self.file.path.clone(), self.heads.path.clone());
        Grid::new("networks for photos").num_columns(2).spacing([2.0 * GAP, GAP]).show(ui, |ui| {
            label_ui(ui, strings::NETWORK);
            self.choice_ui(ui);
            ui.end_row();
            if self.choice == NetworkChoice::Resnet50 {
                self.file.show(ui, strings::FILE, strings::FILE_HINT);
            }
            self.heads.show(ui, strings::HEADS, strings::heads_hint(self.choice));
        });
        self.file.browse.missing_ui(ui);
        self.heads.browse.missing_ui(ui);
        if before != (self.choice, self.file.path.clone(), self.heads.path.clone()) {
            // What was checked is no longer what is shown.
            (self.checked, self.outcome) = (None, None);
        }
        ui.add_space(GAP);
        let note = strings::note(self.choice, self.downloaded.as_deref());
        ui.add(Label::new(RichText::new(note).color(t.text_weak)).wrap());
        let (text, color) = match &self.outcome {
            Some(Ok(described)) => (strings::in_use(described), t.text),
            Some(Err(reason)) => (sentence(reason), t.error),
            None if self.checked.is_some() => (strings::CHECKING.to_owned(), t.text_weak),
            None => (String::new(), t.text_weak),
        };
        ui.add(Label::new(RichText::new(text).color(color)).wrap());
        ui.add_space(GAP);
        self.foot_ui(ui)
    }

    fn choice_ui(&mut self, ui: &mut Ui) {
        let list = ComboBox::from_id_salt("image network").width(240.0);
        let list = list.selected_text(strings::name(self.choice)).show_list(ui, |ui| {
            for choice in NetworkChoice::ALL {
                ui.selectable_value(&mut self.choice, choice, strings::name(choice));
            }
        });
        list.response.accessible_name(strings::NETWORK);
    }

    fn foot_ui(&mut self, ui: &mut Ui) -> Vec<Command> {
        let mut commands = Vec::new();
        ui.horizontal(|ui| {
            let is_free = self.checked.is_none();
            if !is_free {
                busy_ui(ui);
            }
            at_right_ui(ui, |ui| {
                if primary_ui(ui, strings::USE, is_free).on_hover_text(strings::USE_HELP).clicked() {
                    self.check(ui.ctx());
                }
                if ui.button(help::CLOSE).clicked() {
                    commands.push(Command::CloseSheet);
                }
            });
        });
        commands
    }
}

impl FileField {
    /// Absolute path in the field, without quotes around it; `None` if the field is empty.
    fn file(&self) -> Option<PathBuf> {
        let path = PathBuf::from(self.path.trim().trim_matches(['"', '\'']));
        // A relative path would have another meaning at the next start.
        (!path.as_os_str().is_empty()).then(|| std::path::absolute(&path).unwrap_or(path))
    }

    /// Draws a row of the grid: the name of the field, the field and its button.
    fn show(&mut self, ui: &mut Ui, name: &str, hint: &str) {
        label_ui(ui, name);
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.path).hint_text(hint);
            ui.add(field.desired_width(PATH_WIDTH - BROWSE_WIDTH)).accessible_name(name);
            let present = self.file();
            let folder = present.as_deref().and_then(std::path::Path::parent);
            let asked = Asked {
                title: name,
                kind: strings::KIND,
                endings: &["safetensors"],
                folder,
                ..Asked::default()
            };
            if let Some(chosen) = self.browse.show(ui, name, &asked).into_iter().next() {
                self.path = chosen.display().to_string();
            }
        });
        ui.end_row();
    }
}

fn label_ui(ui: &mut Ui, text: &str) {
    let text = RichText::new(text).color(tokens(ui.ctx()).text_weak);
    ui.add(Label::new(text).selectable(false));
}

#[cfg(test)]
mod tests {
    use super::{ImageNetwork, NetworkChoice, NetworksSheet, PhotoNetworks};

    #[test]
    fn the_sheet_begins_with_the_networks_in_use() {
        for (network, heads) in [
            (ImageNetwork::EfficientnetLite0, None),
            (ImageNetwork::Resnet50("/n/resnet50.safetensors".into()), Some("/n/heads.safetensors".into())),
            (ImageNetwork::Statistics, None),
        ] {
            let networks = PhotoNetworks { network, heads };
            assert_eq!(NetworksSheet::new(Some(&networks), None).networks(), Ok(networks));
        }
        let unchosen = NetworksSheet::new(None, None);
        assert_eq!(unchosen.choice, NetworkChoice::Statistics);
        let mut resnet = NetworksSheet::new(None, None);
        resnet.choice = NetworkChoice::Resnet50;
        assert!(resnet.networks().is_err(), "its file is missing");
        resnet.file.path = " \"here.safetensors\" ".to_owned();
        let networks = resnet.networks().unwrap();
        let ImageNetwork::Resnet50(path) = networks.network else { panic!("ResNet-50") };
        assert!(path.is_absolute() && path.ends_with("here.safetensors"));
    }
}
