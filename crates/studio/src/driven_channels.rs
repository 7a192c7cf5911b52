//! Channels of an output that carry the vibration and the friction of an actuator.

use shagreen_core::actuator::Actuator;
use shagreen_device::engine::{ChannelMask, FrictionConfig, FrictionWave};

/// Channels of the vibration, and the channel of the friction display if the profile of the actuator has one. `only` is
/// the only channel of the vibration, counted from zero; with `None`, these are the first two without that of the display.
///
/// A serial receiver has one channel, and friction is a mode of its own: the display of the profile is ignored there.
pub fn driven_channels(
    actuator: Option<&Actuator>,
    only: Option<usize>,
    is_serial: bool,
) -> (ChannelMask, Option<FrictionConfig>) {
    let display = actuator.filter(|_| !is_serial).and_then(|actuator| actuator.friction);
    let friction = display.map(|display| FrictionConfig {
        channel_idx: usize::from(display.channel).saturating_sub(1),
        wave: FrictionWave::Carrier { frequency_hz: display.carrier.0 as f32 },
    });
    let channels = match (only, friction) {
        (Some(only), _) => ChannelMask::only(only),
        (None, Some(friction)) => ChannelMask::FIRST_TWO.without(friction.channel_idx),
        (None, None) => ChannelMask::FIRST_TWO,
    };
    (channels, friction)
}

#[cfg(test)]
mod tests {
    use super::{ChannelMask, FrictionConfig, FrictionWave, driven_channels};
    use shagreen_core::actuator::FrictionDisplay;
    use shagreen_core::units::Hertz;
    use shagreen_formats::actuator_toml::built_in_actuators;

    #[test]
    fn a_friction_display_has_its_own_channel_except_on_a_serial_receiver() {
        let mut actuator = built_in_actuators().unwrap().remove(0);
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
}
