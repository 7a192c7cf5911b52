//! Commands about the signals of the bench.

use std::sync::Arc;

use egui::Context;
use shagreen_core::units::Hertz;
use shagreen_formats::library::ReliefSource;

use super::Window;
use crate::command::Command;
use crate::compare::{CompareCommand, Side};
use crate::edit::Edit;
use crate::open_sheet::OpenSheet;
use crate::panel::Panel;
use crate::save::{SIGNAL_RATE_HZ, SignalFile};
use crate::sheets::Sheet;
use crate::signals::bench_signal::BenchSignal;
use crate::signals::{SignalsCommand, Slot};
use crate::strings::signals as strings;

impl Window {
    /// Does what was asked for about signals.
    pub(super) fn carry_out_signals(&mut self, command: SignalsCommand, ctx: &Context) {
        match command {
            SignalsCommand::AskWhatToOpen(slot) => {
                self.sheet = Sheet::Open(OpenSheet::of_signals(slot, &self.usual_folder(), ctx));
            }
            SignalsCommand::Read(slot, source) => {
                // The place says what came of it.
                self.sheet = Sheet::Closed;
                self.signals.read(slot, source, ctx);
            }
            SignalsCommand::ReadAll(sources) => self.signals.read_all(sources, ctx),
            SignalsCommand::TakeHeard(slot) => self.take_heard(slot, ctx),
            SignalsCommand::Feel(slot) => self.signals.feel(slot),
            SignalsCommand::Play(slot) => {
                if let Some(signal) = self.signals.signal(slot) {
                    self.session.play_samples(signal.profile.values(), signal.rate());
                    self.signals.note_playing(slot);
                }
            }
            SignalsCommand::MakeB(how) => self.signals.make_b(how, ctx),
            SignalsCommand::Keep(slot) => self.keep_relief(slot, ctx),
        }
    }

    /// What the keys of comparing mean where signals are compared; `None` where they mean nothing.
    pub(super) fn of_signals(command: Command) -> Option<Command> {
        let Command::Compare(CompareCommand::Hear(side)) = command else { return Some(command) };
        let slot = match side {
            Side::A => Slot::A,
            Side::B => Slot::B,
            Side::X => return None,
        };
        Some(Command::Signals(SignalsCommand::Feel(Some(slot))))
    }

    /// What is authored becomes a signal, stroked as the hand is set.
    fn take_heard(&mut self, slot: Slot, ctx: &Context) {
        // What is authored is heard again, if a signal was felt.
        self.signals.feel(None);
        self.follow_project(ctx);
        let compared = self.compared_texture();
        let contact = self.pad.contact(&self.session);
        match self.session.signal(&self.project, compared.as_deref(), contact) {
            Ok(file) => {
                let panel = Panel::new(&self.project, &self.session, &self.compare, &self.pictures);
                let name = panel.heard_name();
                self.signals.make(slot, ctx, move || rendered(&name, file));
            }
            Err(reason) => self.signals.say(slot, reason),
        }
    }

    /// A signal becomes a texture of the list.
    fn keep_relief(&mut self, slot: Slot, ctx: &Context) {
        let Some((signal, over)) = self.signals.kept(slot) else { return };
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
                self.signals.note_kept(&entry.name);
                self.carry_out(Command::Edit(Edit::AddTextures(vec![Arc::new(entry)])), ctx);
            }
            Err(reason) => self.signals.say(slot, reason),
        }
    }
}

/// The signal of what was heard.
fn rendered(name: &str, file: SignalFile) -> Result<BenchSignal, String> {
    let samples = file.samples().map_err(|error| error.to_string())?;
    let samples: Vec<f64> = samples.into_iter().map(f64::from).collect();
    let (rate, contact) = (Hertz(f64::from(SIGNAL_RATE_HZ)), file.contact);
    let made = BenchSignal::of_samples(name, &samples, rate, contact.speed, contact.force)?;
    let mut terms: Vec<String> = file.sidecar.parents.into_iter().map(|parent| parent.licence).collect();
    terms.dedup();
    Ok(BenchSignal { restricted: file.restricted, terms, ..made.value })
}
