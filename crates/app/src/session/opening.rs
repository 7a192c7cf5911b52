//! Opens outputs, one at a time. A newer request replaces a waiting one.

use std::sync::mpsc::{Receiver, TryRecvError};

use shagreen_device::engine::Handle;
use shagreen_device::error::{DeviceError, DeviceErrorKind};
use shagreen_device::output::{NULL_ID, OpenOptions, Running, list_outputs, open};

use crate::state::background::in_background;
use crate::strings;

/// Result of opening an output.
#[derive(Debug)]
pub(super) struct Opened {
    pub(super) outcome: Result<(Handle, Running), DeviceError>,
    /// Warning, if the silent output was opened instead.
    pub(super) warning: Option<String>,
    /// Id of the wanted output, if another Shagreen plays on it.
    pub(super) claimed: Option<String>,
}

/// Output to open.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum OutputChoice {
    /// System default at the time of opening; from then on it is identified by its id. If there is none or it cannot be
    /// opened, the silent output is opened.
    SystemDefault,
    /// Output with this id, without a fallback.
    Id(String),
}

impl OutputChoice {
    fn open(&self, options: OpenOptions) -> Opened {
        match self {
            Self::Id(id) => {
                let outcome = open(id, options);
                let claimed = outcome.as_ref().is_err_and(is_claimed).then(|| id.clone());
                Opened { outcome, warning: None, claimed }
            }
            Self::SystemDefault => {
                let silent = |warning, claimed| Opened {
                    outcome: open(NULL_ID, options),
                    warning: Some(warning),
                    claimed,
                };
                let Some(found) = list_outputs().into_iter().find(|o| o.is_default && o.id != NULL_ID) else {
                    return silent(strings::NO_SOUND.to_owned(), None);
                };
                match open(&found.id, options) {
                    Err(error) => {
                        let warning = format!("{}: {error}", strings::NO_SOUND);
                        silent(warning, is_claimed(&error).then_some(found.id))
                    }
                    outcome => Opened { outcome, warning: None, claimed: None },
                }
            }
        }
    }
}

fn is_claimed(error: &DeviceError) -> bool {
    error.kind() == DeviceErrorKind::Claimed
}

#[derive(Debug)]
pub(super) struct Request {
    pub(super) choice: OutputChoice,
    pub(super) options: OpenOptions,
    pub(super) ctx: egui::Context,
}

/// Treatment of an output when its opening is complete.
#[derive(Debug, Default)]
enum Then {
    /// It replaces the present output.
    #[default]
    Use,
    /// It is closed.
    Close,
    /// It is closed, and another output is opened.
    Open(Box<Request>),
}

/// Result of [`Opening::take`].
#[derive(Debug)]
pub(super) enum Came {
    /// Nothing yet, or an output that is no longer wanted.
    Nothing,
    /// Opened output, or the error.
    Opened(Box<Opened>),
    /// Request to start next; the output that was opened has been closed.
    Next(Box<Request>),
}

/// Output that is being opened, if any.
#[derive(Debug, Default)]
pub(super) struct Opening {
    receiver: Option<Receiver<Opened>>,
    then: Then,
}

impl Opening {
    /// Starts to open an output. No other may be in progress.
    pub(super) fn begin(&mut self, request: Request) {
        let Request { choice, options, ctx } = request;
        self.receiver = Some(in_background(ctx, move || choice.open(options)));
        self.then = Then::Use;
    }

    pub(super) fn is_busy(&self) -> bool {
        self.receiver.is_some()
    }

    /// Replaces the output that is being opened by this request.
    pub(super) fn wait_with(&mut self, request: Request) {
        self.then = Then::Open(Box::new(request));
    }

    /// Closes the output that is being opened as soon as it is open.
    pub(super) fn discard(&mut self) {
        self.then = Then::Close;
    }

    /// Result since the last call.
    pub(super) fn take(&mut self) -> Came {
        let Some(receiver) = &self.receiver else { return Came::Nothing };
        let opened = match receiver.try_recv() {
            Err(TryRecvError::Empty) => return Came::Nothing,
            Err(TryRecvError::Disconnected) => {
                let outcome = Err(DeviceError::new(DeviceErrorKind::Backend, strings::OPENING_FAILED));
                Opened { outcome, warning: None, claimed: None }
            }
            Ok(opened) => opened,
        };
        self.receiver = None;
        match std::mem::take(&mut self.then) {
            Then::Use => Came::Opened(Box::new(opened)),
            Then::Close => Came::Nothing,
            // The unwanted output is closed first, because some devices can be opened only once.
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
            friction: None,
            take_over: false,
        };
        Request { choice: OutputChoice::Id(NULL_ID.to_owned()), options, ctx: egui::Context::default() }
    }

    /// Waits for a result, or until nothing is being opened.
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
        assert_eq!(opened.outcome.unwrap().1.buffer_frames(), Some(512));
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
