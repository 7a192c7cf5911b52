//! Channels of an output that carry the vibration and the friction of an actuator, and their names.

use anyhow::bail;
use shagreen_core::actuator::{Actuator, MAX_CHANNEL, NamedChannel};
use shagreen_device::engine::{ChannelMask, FrictionConfig, FrictionWave};

/// Names of the channels of an output with four, in the usual order.
const OF_FOUR: [&str; 4] = ["front left", "front right", "rear left", "rear right"];

/// Channels of the vibration, and the channel of the friction display if the profile of the actuator has one. `only` is
/// the only channel of the vibration, counted from zero. With `None`, these are the named channels of the profile, or
/// else the first two without that of the display.
///
/// A serial receiver has one channel, and friction is a mode of its own: the profile names no channel there.
pub fn driven_channels(
    actuator: Option<&Actuator>,
    only: Option<usize>,
    is_serial: bool,
) -> (ChannelMask, Option<FrictionConfig>) {
    let profile = actuator.filter(|_| !is_serial);
    let friction = profile.and_then(|actuator| actuator.friction).map(|display| FrictionConfig {
        channel_idx: index_of(display.channel),
        wave: FrictionWave::Carrier { frequency_hz: display.carrier.0 as f32 },
    });
    let named = named(profile);
    let channels = match (only, friction) {
        (Some(only), _) => ChannelMask::only(only),
        (None, _) if !named.is_empty() => {
            let masks = named.iter().map(|channel| ChannelMask::only(index_of(channel.number)));
            masks.fold(ChannelMask::NONE, ChannelMask::and)
        }
        (None, Some(friction)) => ChannelMask::FIRST_TWO.without(friction.channel_idx),
        (None, None) => ChannelMask::FIRST_TWO,
    };
    (channels, friction)
}

/// Name of a channel, counted from zero, of an output with `n_channels`: by the profile of the actuator, or by the usual
/// order of four channels. `None` if it has no name.
pub fn channel_name(actuator: Option<&Actuator>, n_channels: usize, channel_idx: usize) -> Option<&str> {
    let named = named(actuator);
    if named.is_empty() {
        return OF_FOUR.get(channel_idx).copied().filter(|_| n_channels == OF_FOUR.len());
    }
    named.iter().find(|channel| index_of(channel.number) == channel_idx).map(|channel| channel.name.as_str())
}

/// Channels, counted from zero, to which the actuator on an output with `n_channels` can be connected: those that its profile
/// names, or all if it names none.
pub fn possible_channels(actuator: Option<&Actuator>, n_channels: usize) -> Vec<usize> {
    let named = named(actuator);
    let is_possible = |channel_idx: &usize| {
        named.is_empty() || named.iter().any(|channel| index_of(channel.number) == *channel_idx)
    };
    (0..n_channels).filter(is_possible).collect()
}

/// Number of channels that an output needs for all named channels of a profile; 0 if it names none.
pub fn n_named_channels(actuator: &Actuator) -> usize {
    actuator.channels.iter().map(|channel| usize::from(channel.number)).max().unwrap_or(0)
}

/// Channel with this number, counted from 1, or with this name, as an index from zero.
///
/// # Errors
/// The profile of the actuator names channels, and not this one: it may be that of headphones. Or neither the profile the profile of the actuator nor the usual order of four channels has a channel of this name.
pub fn channel_of(actuator: Option<&Actuator>, text: &str) -> anyhow::Result<usize> {
    if let Some(number) = text.trim().parse::<u16>().ok().filter(|number| (1..=MAX_CHANNEL).contains(number))
    {
        let named = named(actuator);
        if named.is_empty() || named.iter().any(|channel| channel.number == number) {
            return Ok(index_of(number));
        }
        let known: Vec<String> =
            named.iter().map(|channel| format!("{} ({})", channel.number, channel.name)).collect();
        bail!(
            "the profile of the actuator names no channel {number}, which may drive something else, such as headphones; choose one of: {}",
            known.join(", ")
        );
    }
    let named = named(actuator);
    let names: Vec<(usize, &str)> = if named.is_empty() {
        OF_FOUR.into_iter().enumerate().collect()
    } else {
        named.iter().map(|channel| (index_of(channel.number), channel.name.as_str())).collect()
    };
    if let Some((index, _)) = names.iter().find(|(_, name)| name.eq_ignore_ascii_case(text.trim())) {
        return Ok(*index);
    }
    let known: Vec<&str> = names.iter().map(|(_, name)| *name).collect();
    bail!(
        "there is no channel \"{text}\"; give a number from 1 to {MAX_CHANNEL}, or one of: {}",
        known.join(", ")
    )
}

fn named(actuator: Option<&Actuator>) -> &[NamedChannel] {
    actuator.map_or(&[][..], |actuator| actuator.channels.as_slice())
}

/// Index of the channel with this number, from 1.
fn index_of(number: u16) -> usize {
    usize::from(number).saturating_sub(1)
}

#[cfg(test)]
mod tests {
    use super::{
        Actuator, ChannelMask, FrictionConfig, FrictionWave, channel_name, channel_of, driven_channels,
        n_named_channels, possible_channels,
    };
    use shagreen_core::actuator::FrictionDisplay;
    use shagreen_core::units::Hertz;
    use shagreen_formats::actuator_toml::built_in_actuators;

    fn built_in(id: &str) -> Actuator {
        built_in_actuators().unwrap().into_iter().find(|actuator| actuator.id == id).unwrap()
    }

    #[test]
    fn only_named_channels_are_possible_if_there_are_any() {
        let dualsense = built_in("dualsense");
        let numbers: Vec<usize> =
            dualsense.channels.iter().map(|channel| usize::from(channel.number) - 1).collect();
        assert_eq!(possible_channels(Some(&dualsense), 8), numbers);
        assert_eq!(possible_channels(Some(&dualsense), 2), [0; 0]);
        assert_eq!(possible_channels(Some(&built_in("mm1c")), 3), [0, 1, 2]);
        assert_eq!(possible_channels(None, 2), [0, 1]);
    }

    #[test]
    fn a_friction_display_has_its_own_channel_except_on_a_serial_receiver() {
        let mut actuator = built_in("haptuator-mark-ii");
        actuator.friction = Some(FrictionDisplay { carrier: Hertz(120.0), channel: 1 });
        let wave = FrictionWave::Carrier { frequency_hz: 120.0 };
        let friction = Some(FrictionConfig { channel_idx: 0, wave });
        assert_eq!(driven_channels(Some(&actuator), None, false), (ChannelMask::only(1), friction));
        assert_eq!(driven_channels(Some(&actuator), Some(2), false), (ChannelMask::only(2), friction));
        // The vibration keeps the only channel of the receiver.
        assert_eq!(driven_channels(Some(&actuator), None, true), (ChannelMask::FIRST_TWO, None));
        actuator.friction = None;
        for of in [None, Some(&actuator)] {
            assert_eq!(driven_channels(of, None, false), (ChannelMask::FIRST_TWO, None));
        }
    }

    #[test]
    fn the_named_channels_of_a_controller_are_driven_and_not_its_headphones() {
        let controller = built_in("dualsense");
        let (channels, friction) = driven_channels(Some(&controller), None, false);
        assert_eq!((channels, friction), (ChannelMask::only(2).and(ChannelMask::only(3)), None));
        assert!(!channels.contains(0) && !channels.contains(1));
        let one = channel_of(Some(&controller), "Right grip").unwrap();
        assert_eq!(driven_channels(Some(&controller), Some(one), false).0, ChannelMask::only(3));
        assert_eq!(driven_channels(Some(&controller), None, true).0, ChannelMask::FIRST_TWO);
    }

    #[test]
    fn channels_are_found_by_number_and_by_name() {
        let controller = built_in("dualsense");
        for (of, text, index) in [
            (None, "1", 0),
            (None, "64", 63),
            (None, "rear left", 2),
            (None, " Front Right ", 1),
            (Some(&controller), "left grip", 2),
            (Some(&controller), "3", 2),
        ] {
            assert_eq!(channel_of(of, text).unwrap(), index, "{text}");
        }
        for (of, text) in [(None, "0"), (None, "65"), (None, "left grip"), (Some(&controller), "rear left")] {
            assert!(channel_of(of, text).is_err(), "{text}");
        }
        let error = channel_of(Some(&controller), "tail").unwrap_err().to_string();
        assert!(error.contains("left grip, right grip"), "{error}");
        let error = channel_of(Some(&controller), "1").unwrap_err().to_string();
        assert!(error.contains("no channel 1") && error.contains("3 (left grip), 4 (right grip)"), "{error}");
        assert_eq!(n_named_channels(&controller), 4);
        assert_eq!(n_named_channels(&built_in("haptuator-mark-ii")), 0);
        assert_eq!(channel_name(Some(&controller), 4, 3), Some("right grip"));
        assert_eq!(channel_name(Some(&controller), 4, 0), None);
        assert_eq!(channel_name(None, 4, 3), Some("rear right"));
        assert_eq!(channel_name(None, 2, 1), None);
    }
}
