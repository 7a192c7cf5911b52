//! A receiver on a serial port: its name and its warnings.

use shagreen_device::serial::ReceiverEvent;

use crate::cli::output;

/// Receiver that plays the output.
pub(crate) struct Receiver {
    name: String,
    port: String,
    /// Returns the next unread message of the receiver.
    next: Box<dyn FnMut() -> Option<ReceiverEvent>>,
    /// Warnings that were printed.
    told: Vec<String>,
}

/// Largest number of different warnings that are printed: firmware may put counters into them.
const MOST_WARNINGS: usize = 20;

impl Receiver {
    /// Creates a receiver from its own name, which may be empty, the port of the output, and its messages.
    pub(crate) fn new(name: String, port: String, next: Box<dyn FnMut() -> Option<ReceiverEvent>>) -> Self {
        Self { name, port, next, told: Vec::new() }
    }

    /// Returns the name of the receiver for messages.
    pub(crate) fn in_words(&self) -> String {
        if self.name.is_empty() {
            format!("the receiver on `{}`", self.port)
        } else {
            format!("the receiver `{}` on `{}`", self.name, self.port)
        }
    }

    /// Prints the new warnings of the receiver, each text once.
    pub(crate) fn tell_warnings(&mut self) {
        while let Some(heard) = (self.next)() {
            if let Some(warning) = self.new_warning(heard) {
                output::warn(&warning);
            }
        }
    }

    /// Returns the message for a warning, unless it was printed before.
    fn new_warning(&mut self, heard: ReceiverEvent) -> Option<String> {
        let ReceiverEvent::Warning(text) = heard else { return None };
        if self.told.len() > MOST_WARNINGS || self.told.contains(&text) {
            return None;
        }
        self.told.push(text.clone());
        let what = if self.told.len() > MOST_WARNINGS { "more warnings, which are not shown" } else { &text };
        Some(format!("{} warns: {what}", self.in_words()))
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_WARNINGS, Receiver};
    use shagreen_device::serial::{ReceiverEvent, SensorBlock};

    fn receiver(name: &str) -> Receiver {
        Receiver::new(name.to_owned(), "serial:x".to_owned(), Box::new(|| None))
    }

    #[test]
    fn a_warning_is_told_once_with_the_receiver_s_name() {
        let mut receiver = receiver("board");
        let mut warn = |text: &str| receiver.new_warning(ReceiverEvent::Warning(text.to_owned()));
        assert_eq!(warn("hot").as_deref(), Some("the receiver `board` on `serial:x` warns: hot"));
        assert_eq!(warn("hot"), None);
        for i in 1..MOST_WARNINGS {
            assert!(warn(&format!("hot {i}")).is_some_and(|told| told.ends_with(&i.to_string())));
        }
        assert!(warn("hotter").is_some_and(|told| told.ends_with("more warnings, which are not shown")));
        assert_eq!(warn("hottest"), None);
        let block = SensorBlock { seq: 0, rate_hz: 1000, time_us: 0, scale_mps2: 1.0, counts: vec![1] };
        assert_eq!(receiver.new_warning(ReceiverEvent::Sensor(block)), None);
    }

    #[test]
    fn one_without_a_name_is_called_by_its_port() {
        assert_eq!(receiver("").in_words(), "the receiver on `serial:x`");
    }
}
