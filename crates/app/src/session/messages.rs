//! Messages of the session in the status bar.

use std::time::{Duration, Instant};

use shagreen_studio::short_text::shortened;

use super::Session;

/// Time after which a message counts as read.
const READING_TIME: Duration = Duration::from_secs(3);

/// Message about what the user asked for, and the time at which it appeared.
#[derive(Clone, Debug)]
pub(super) struct Said {
    pub(super) text: String,
    since: Instant,
}

impl Said {
    /// Message that appears now.
    pub(super) fn new(message: String) -> Self {
        Self { text: shortened(message), since: Instant::now() }
    }
}

impl Session {
    /// Shows a message in the status bar.
    pub fn say(&mut self, message: String) {
        self.said = Some(Said::new(message));
    }

    /// Shows a message about the output, in the status bar and in the sheet of the devices.
    pub fn say_of_output(&mut self, message: String) {
        self.sound.player.message = Some(shortened(message));
    }

    /// Message that is about neither the output nor the pen.
    pub fn message(&self) -> Option<&str> {
        self.said.as_ref().map(|said| said.text.as_str())
    }

    /// All messages in the status bar.
    pub fn messages(&self) -> impl Iterator<Item = &str> {
        [self.output_message(), self.message(), self.pen_message()].into_iter().flatten()
    }

    /// Removes the messages from the status bar, except that of the pen.
    pub fn forget_messages(&mut self) {
        (self.said, self.sound.player.message) = (None, None);
    }

    /// Removes a message that was shown long enough before `now`, because the user has gone on. A message about the
    /// output stays until its cause is gone or the user dismisses it.
    pub(crate) fn forget_read_message(&mut self, now: Instant) {
        self.said.take_if(|said| now.saturating_duration_since(said.since) >= READING_TIME);
    }
}
