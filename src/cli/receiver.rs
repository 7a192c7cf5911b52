//! A receiver on a serial port: what it is called, and what it says beside the stream.

use shagreen_device::serial::Heard;

use crate::cli::output;

/// A receiver that is played on.
pub(crate) struct Receiver {
    name: String,
    port: String,
    /// What it has said and nobody has heard yet.
    next: Box<dyn FnMut() -> Option<Heard>>,
    /// Warnings that were passed on.
    told: Vec<String>,
}

/// Most different warnings of a receiver that are passed on: firmware may count in them.
const MOST_WARNINGS: usize = 20;

impl Receiver {
    /// A receiver by its own name, which may be empty, on the port of an output, and what it says.
    pub(crate) fn new(name: String, port: String, next: Box<dyn FnMut() -> Option<Heard>>) -> Self {
        Self { name, port, next, told: Vec::new() }
    }

    /// What to call it.
    pub(crate) fn in_words(&self) -> String {
        if self.name.is_empty() {
            format!("the receiver on `{}`", self.port)
        } else {
            format!("the receiver `{}` on `{}`", self.name, self.port)
        }
    }

    /// Says what it has warned of since, each thing once.
    pub(crate) fn tell_warnings(&mut self) {
        while let Some(heard) = (self.next)() {
            if let Some(warning) = self.new_warning(heard) {
                output::warn(&warning);
            }
        }
    }

    /// The sentence for a warning, where it is one that has not been told.
    fn new_warning(&mut self, heard: Heard) -> Option<String> {
        let Heard::Warning(text) = heard else { return None };
        if self.told.len() > MOST_WARNINGS || self.told.contains(&text) {
            return None;
        }
        self.told.push(text.clone());
        let what = if self.told.len() > MOST_WARNINGS { "more, which is not shown" } else { &text };
        Some(format!("{} warns: {what}", self.in_words()))
    }
}

#[cfg(test)]
mod tests {
    use super::{MOST_WARNINGS, Receiver};
    use shagreen_device::serial::{Heard, SensorBlock};

    fn receiver(name: &str) -> Receiver {
        Receiver::new(name.to_owned(), "serial:x".to_owned(), Box::new(|| None))
    }

    #[test]
    fn a_warning_is_told_once_with_the_receiver_s_name() {
        let mut receiver = receiver("board");
        let mut warn = |text: &str| receiver.new_warning(Heard::Warning(text.to_owned()));
        assert_eq!(warn("hot").as_deref(), Some("the receiver `board` on `serial:x` warns: hot"));
        assert_eq!(warn("hot"), None);
        for i in 1..MOST_WARNINGS {
            assert!(warn(&format!("hot {i}")).is_some_and(|told| told.ends_with(&i.to_string())));
        }
        assert!(warn("hotter").is_some_and(|told| told.ends_with("more, which is not shown")));
        assert_eq!(warn("hottest"), None);
        let block = SensorBlock { seq: 0, rate_hz: 1000, time_us: 0, scale_mps2: 1.0, counts: vec![1] };
        assert_eq!(receiver.new_warning(Heard::Sensor(block)), None);
    }

    #[test]
    fn one_without_a_name_is_called_by_its_port() {
        assert_eq!(receiver("").in_words(), "the receiver on `serial:x`");
    }
}
