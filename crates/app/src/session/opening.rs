//! An output that is being opened: one at a time, and of those that wait only the newest.

use std::sync::mpsc::{Receiver, TryRecvError};

use shagreen_device::engine::Handle;
use shagreen_device::error::{DeviceError, DeviceErrorKind};
use shagreen_device::output::{NULL_ID, OpenOptions, Running, list_outputs, open};

use crate::background::in_background;
use crate::strings;

/// What came of opening an output, and why it is not the one that was meant.
pub(super) type Opened = (Result<(Handle, Running), DeviceError>, Option<String>);

/// Which output to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputChoice {
    /// The one that the system calls its default now, held by its identity from then on; without sound, the silent one.
    SystemDefault,
    /// The one with this identity, or none.
    Id(String),
}

impl OutputChoice {
    fn open(&self, options: OpenOptions) -> Opened {
        match self {
            Self::Id(id) => (open(id, options), None),
            Self::SystemDefault => {
                let Some(found) = list_outputs().into_iter().find(|o| o.is_default && o.id != NULL_ID) else {
                    return (open(NULL_ID, options), Some(strings::NO_SOUND.to_owned()));
                };
                match open(&found.id, options) {
                    Err(error) => (open(NULL_ID, options), Some(format!("{}: {error}", strings::NO_SOUND))),
                    opened => (opened, None),
                }
            }
        }
    }
}

/// An output that was asked for.
#[derive(Debug)]
pub(super) struct Request {
    pub(super) choice: OutputChoice,
    pub(super) options: OpenOptions,
    pub(super) ctx: egui::Context,
}

/// What becomes of an output that is being opened.
#[derive(Debug, Default)]
enum Then {
    /// It takes the place of the one before.
    #[default]
    Use,
    /// It is closed.
    Close,
    /// It is closed, and then another is opened.
    Open(Box<Request>),
}

/// What has come of opening.
#[derive(Debug)]
pub(super) enum Came {
    /// Nothing yet, or nothing that is wanted any more.
    Nothing,
    /// An output, or why there is none.
    Opened(Box<Opened>),
    /// What was opened is closed again: this one is wanted.
    Next(Box<Request>),
}

/// The output that is being opened, if one is.
#[derive(Debug, Default)]
pub(super) struct Opening {
    receiver: Option<Receiver<Opened>>,
    then: Then,
}

impl Opening {
    /// Begins, where nothing is being opened.
    pub(super) fn begin(&mut self, request: Request) {
        let Request { choice, options, ctx } = request;
        self.receiver = Some(in_background(ctx, move || choice.open(options)));
        self.then = Then::Use;
    }

    /// Whether an output is being opened.
    pub(super) fn is_busy(&self) -> bool {
        self.receiver.is_some()
    }

    /// The one that is being opened is not wanted any more, but this one.
    pub(super) fn wait_with(&mut self, request: Request) {
        self.then = Then::Open(Box::new(request));
    }

    /// The one that is being opened is not wanted any more.
    pub(super) fn discard(&mut self) {
        self.then = Then::Close;
    }

    /// What has come since this was asked last.
    pub(super) fn take(&mut self) -> Came {
        let Some(receiver) = &self.receiver else { return Came::Nothing };
        let opened = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return Came::Nothing,
            Err(TryRecvError::Disconnected) => {
                (Err(DeviceError::new(DeviceErrorKind::Backend, strings::OPENING_FAILED)), None)
            }
            Ok(opened) => opened,
        };
        self.receiver = None;
        match std::mem::take(&mut self.then) {
            Then::Use => Came::Opened(Box::new(opened)),
            Then::Close => Came::Nothing,
            // What came is closed before: some devices can be held only once.
            Then::Open(request) => Came::Next(request),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Came, Opening, OutputChoice, Request};
    use shagreen_device::engine::ChannelMask;
    use shagreen_device::output::{NULL_ID, OpenOptions};
    use shagreen_device::synth::drive::DriveConfig;

    fn request(buffer_frames: u32) -> Request {
        let options = OpenOptions {
            model_rate_hz: 1000.0,
            preferred_rate_hz: None,
            buffer_frames: Some(buffer_frames),
            seed: 0,
            drive: DriveConfig::proportional(10.0, 0.9),
            channels: ChannelMask::FIRST_TWO,
        };
        Request { choice: OutputChoice::Id(NULL_ID.to_owned()), options, ctx: egui::Context::default() }
    }

    /// What comes in the end, once something does or nothing is being opened.
    fn came(opening: &mut Opening) -> Came {
        loop {
            let came = opening.take();
            if !matches!(came, Came::Nothing) || !opening.is_busy() {
                return came;
            }
            std::thread::yield_now();
        }
    }

    #[test]
    fn of_those_that_wait_only_the_newest_is_opened() {
        let mut opening = Opening::default();
        opening.begin(request(64));
        opening.wait_with(request(128));
        opening.wait_with(request(512));
        let Came::Next(next) = came(&mut opening) else { panic!("the first is not wanted") };
        assert_eq!(next.options.buffer_frames, Some(512));
        assert!(!opening.is_busy());
        opening.begin(*next);
        let Came::Opened(opened) = came(&mut opening) else { panic!("the last is") };
        assert_eq!(opened.0.unwrap().1.buffer_frames(), Some(512));
    }

    #[test]
    fn what_is_discarded_is_closed_and_does_not_come() {
        let mut opening = Opening::default();
        opening.begin(request(64));
        opening.wait_with(request(128));
        opening.discard();
        assert!(opening.is_busy());
        assert!(matches!(came(&mut opening), Came::Nothing));
        assert!(!opening.is_busy());
    }
}
