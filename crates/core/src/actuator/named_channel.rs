//! Named channels of a device with several actuators.

/// Channel of an output that drives one actuator of a device. A device with named channels has converters and amplifiers
/// of its own, such as a game controller on USB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NamedChannel {
    /// Channel of the output, counted from 1, at most [`MAX_CHANNEL`].
    pub number: u16,
    /// Name of the channel: the place of its actuator.
    pub name: String,
}

/// Highest number of a channel.
pub const MAX_CHANNEL: u16 = 64;

/// Returns why these channels cannot belong to one device; `None` if they can.
pub(crate) fn problem_of_channels(channels: &[NamedChannel], friction: Option<u16>) -> Option<String> {
    for (index, NamedChannel { number, name }) in channels.iter().enumerate() {
        let before = &channels[..index];
        if !(1..=MAX_CHANNEL).contains(number) {
            return Some(format!(
                "the number of the channel \"{name}\" is {number}, needs 1 to {MAX_CHANNEL}"
            ));
        }
        if name.trim().is_empty() || name.trim() != name || name.chars().all(|c| c.is_ascii_digit()) {
            return Some(format!(
                "the name of channel {number} is \"{name}\", needs a word that is no number, without spaces around it"
            ));
        }
        if before.iter().any(|other| other.number == *number) || friction == Some(*number) {
            return Some(format!("channel {number} has two uses"));
        }
        if before.iter().any(|other| other.name.eq_ignore_ascii_case(name)) {
            return Some(format!("two channels have the name \"{name}\""));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{NamedChannel, problem_of_channels};

    fn channels(all: &[(u16, &str)]) -> Vec<NamedChannel> {
        all.iter().map(|(number, name)| NamedChannel { number: *number, name: (*name).to_owned() }).collect()
    }

    #[test]
    fn channels_have_numbers_and_names_of_their_own() {
        assert_eq!(problem_of_channels(&channels(&[(3, "left grip"), (4, "right grip")]), Some(1)), None);
        for (all, words) in [
            (&[(0, "left")][..], "is 0, needs 1 to 64"),
            (&[(65, "left")], "is 65"),
            (&[(1, " ")], "needs a word"),
            (&[(1, "left ")], "needs a word"),
            (&[(1, "2")], "is no number"),
            (&[(1, "left"), (1, "right")], "channel 1 has two uses"),
            (&[(2, "left")], "channel 2 has two uses"),
            (&[(1, "left"), (3, "Left")], "two channels have the name"),
        ] {
            let problem = problem_of_channels(&channels(all), Some(2)).unwrap();
            assert!(problem.contains(words), "{problem}");
        }
    }
}
