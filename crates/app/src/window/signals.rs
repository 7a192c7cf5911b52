//! Execution of commands of the Signals workspace.

use std::sync::Arc;

use egui::Context;
use shagreen_core::units::Hertz;
use shagreen_formats::library::ReliefSource;

use super::Window;
use crate::choices::signals::Slot;
use crate::command::Command;
use crate::command::signals::SignalsCommand;
use crate::panel::Panel;
use crate::sheets::Sheet;
use crate::sheets::open_sheet::OpenSheet;
use crate::state::bench_signal::BenchSignal;
use crate::state::edit::Edit;
use crate::state::signal_file::{SIGNAL_RATE_HZ, SignalFile, SignalOptions};
use crate::strings::signals as strings;

impl Window {
    pub(super) fn carry_out_signals(&mut self, command: SignalsCommand, ctx: &Context) {
        match command {
            SignalsCommand::AskWhatToOpen(slot) => {
                self.sheet = Sheet::Open(OpenSheet::of_signals(slot, &self.usual_folder(), ctx));
            }
            SignalsCommand::Read(slot, source) => {
                // The slot shows the result.
                self.sheet = Sheet::Closed;
                self.pages.signals.read(slot, source, ctx);
            }
            SignalsCommand::ReadAll(sources) => self.pages.signals.read_all(sources, ctx),
            SignalsCommand::TakeHeard(slot) => self.take_heard(slot, ctx),
            SignalsCommand::Feel(slot) => self.pages.signals.feel(slot),
            SignalsCommand::Play(slot) => {
                if let Some(signal) = self.pages.signals.signal(slot) {
                    self.session.play_samples(signal.profile.values(), signal.rate());
                    self.pages.signals.note_playing(slot);
                }
            }
            SignalsCommand::MakeB(how) => self.pages.signals.make_b(how, ctx),
            SignalsCommand::Keep(slot) => self.keep_relief(slot, ctx),
            SignalsCommand::AskWhichModel => {
                self.sheet = Sheet::Open(OpenSheet::of_models(&self.usual_folder(), ctx));
            }
            SignalsCommand::ReadModel(path) => {
                // The page shows the result.
                self.sheet = Sheet::Closed;
                self.pages.signals.open_model(path, ctx);
            }
            SignalsCommand::UseBuiltInModel => self.pages.signals.use_built_in_model(),
            SignalsCommand::NoteExported(signal) => self.pages.signals.note_exported(signal),
        }
    }

    /// Renders the audible texture as a signal, at the speed and force of the automatic stroke.
    fn take_heard(&mut self, slot: Slot, ctx: &Context) {
        // The authored texture must be audible again if a signal was playing.
        self.pages.signals.feel(None);
        self.follow_project(ctx);
        let compared = self.compared_texture();
        let contact = self.pages.stage.pad.contact(&self.session);
        match self.session.signal(&self.project, compared.as_deref(), contact) {
            Ok(file) => {
                let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
                let name = panel.heard_name();
                self.pages.signals.make(slot, ctx, move || rendered(&name, file));
            }
            Err(reason) => self.pages.signals.say(slot, reason),
        }
    }

    /// Adds a signal to the list of textures, as a relief.
    fn keep_relief(&mut self, slot: Slot, ctx: &Context) {
        let Some((signal, over)) = self.pages.signals.kept(slot) else { return };
        let over = over.and_then(|id| self.session.index_of(&id));
        let entry = signal.relief().and_then(|relief| {
            let is_restricted = !signal.restricted.is_empty();
            let library = self.session.library();
            let of =
                over.and_then(|texture| library.textures.get(texture)).map(|texture| texture.name.as_str());
            let name = strings::kept_name(&signal.name, of);
            let source = ReliefSource { terms: &signal.terms, is_restricted };
            let entry = library.entry_of_relief(&name, Arc::new(relief), over, &source);
            entry.map_err(|error| error.to_string())
        });
        match entry {
            Ok(entry) => {
                self.pages.signals.note_kept(&entry.name);
                self.carry_out(Command::Edit(Edit::AddTextures(vec![Arc::new(entry)])), ctx);
            }
            Err(reason) => self.pages.signals.say(slot, reason),
        }
    }
}

/// Renders a signal and converts it to an acceleration profile.
fn rendered(name: &str, file: SignalFile) -> Result<BenchSignal, String> {
    let samples = file.samples(&SignalOptions::default())?;
    let samples: Vec<f64> = samples.into_iter().map(f64::from).collect();
    let (rate, contact) = (Hertz(f64::from(SIGNAL_RATE_HZ)), file.contact);
    let made = BenchSignal::of_samples(name, &samples, rate, contact.speed, contact.force)?;
    let mut terms: Vec<String> = file.sidecar.parents.into_iter().map(|parent| parent.licence).collect();
    terms.dedup();
    Ok(BenchSignal { restricted: file.restricted, terms, ..made.value })
}
