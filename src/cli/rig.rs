//! Device setup: an output, the actuator on it, and its limits.

use anyhow::{Context as _, bail};
use shagreen_core::actuator::{Actuator, Drive, MAX_CHANNEL, drive_config};
use shagreen_core::units::Volts;
use shagreen_device::engine::{ChannelMask, Handle};
use shagreen_device::haptic_pen;
use shagreen_device::output::{
    NULL_ID, OpenOptions, Running, UNCALIBRATED_FULL_SCALE_MPS2, USUAL_CEILING, open,
};
use shagreen_device::serial::message::Mode;
use shagreen_device::serial::{self, Connection, SerialOptions, USUAL_BAUD};
use shagreen_device::synth::drive::DriveConfig;
use shagreen_studio::driven_channels::{channel_of, driven_channels, n_named_channels};

use crate::cli::actuator_source::{grams, load_actuator, volts};
use crate::cli::output;
use crate::cli::quantity::quantity;
use crate::cli::receiver::Receiver;
use crate::cli::watch::Watch;

#[derive(clap::Args)]
#[command(next_help_heading = "Output and actuator")]
pub(crate) struct RigArgs {
    /// Output to play on, by id; `shagreen devices` lists them. Default: an output that plays nothing. The command
    /// never selects an audio output by itself: the drive signal of an actuator must not reach headphones.
    #[arg(long, value_name = "ID", default_value = NULL_ID)]
    output: String,
    /// Serial port to play on, by id or name. A microcontroller with the protocol of docs/serial-protocol.md must be
    /// connected to it.
    #[arg(long, value_name = "PORT", conflicts_with = "output")]
    serial: Option<String>,
    /// Baud rate of the serial port, the same at both ends; USB ignores it.
    #[arg(long, value_name = "N", requires = "serial", conflicts_with = "output", default_value_t = USUAL_BAUD, value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
    /// Data to send to the serial port: `stream` sends the samples of the drive signal; `control` sends speed, force
    /// and texture to firmware that renders the texture itself; `friction` sends the level of friction to a display that
    /// renders friction.
    #[arg(
        long,
        value_name = "MODE",
        requires = "serial",
        conflicts_with = "output",
        default_value = "stream"
    )]
    serial_mode: SerialMode,
    /// Drive only this output channel: a number counted from 1, or a name. Names are those of the profile of --actuator,
    /// otherwise "front left", "front right", "rear left" and "rear right". Default: the named channels of the profile,
    /// otherwise the first two.
    #[arg(long, value_name = "N_OR_NAME", value_parser = channel)]
    channel: Option<String>,
    /// Take the output over from another Shagreen that plays on it; the other one then goes silent.
    #[arg(long, conflicts_with = "serial")]
    take_over: bool,
    /// Buffer size to request from the output, in frames. A smaller buffer reduces latency but increases the risk of
    /// dropouts.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(16..=65_536))]
    buffer: Option<u32>,
    /// Actuator, by id or profile file: its response is equalized and its electrical limits are enforced. If its profile
    /// has a friction display, the friction of the texture is played on the channel of the display.
    #[arg(long, value_name = "ID_OR_FILE", conflicts_with = "full_scale")]
    actuator: Option<String>,
    /// Mass of the load on the actuator, in g, without the actuator itself. Default: the load of its profile.
    #[arg(long, value_name = "G", requires = "actuator", value_parser = grams)]
    load_g: Option<f64>,
    /// Peak voltage at the actuator when the output is at digital full scale, in V; all limits depend on it. Default: the
    /// voltage at which the profile of --actuator was measured; a profile that was not measured needs this option.
    #[arg(long, value_name = "V", requires = "actuator", value_parser = volts)]
    full_scale_volts: Option<f64>,
    /// Do not equalize the actuator's response; enforce only its limits.
    #[arg(long, requires = "actuator")]
    no_equalizer: bool,
    /// Acceleration at which the output reaches digital full scale, in m/s²; only without --actuator.
    #[arg(long, value_name = "A", value_parser = quantity, default_value_t = f64::from(UNCALIBRATED_FULL_SCALE_MPS2), conflicts_with_all = ["full_scale_volts", "load_g", "no_equalizer"])]
    full_scale: f64,
}

/// Open output.
pub(crate) struct Rig {
    /// Controls the output.
    pub(crate) handle: Handle,
    /// Plays until it is dropped.
    pub(crate) running: Running,
    /// Monitors the output.
    pub(crate) watch: Watch,
}

/// Renderer for a serial port.
#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum SerialMode {
    Stream,
    Control,
    Friction,
}

/// Parses a channel: a number from 1, or a name that is resolved later.
fn channel(text: &str) -> Result<String, String> {
    let is_number =
        |text: &str| text.trim_start_matches(['-', '+']).chars().all(|c| c.is_ascii_digit() || c == '.');
    let is_valid = text.parse::<u16>().is_ok_and(|number| (1..=MAX_CHANNEL).contains(&number));
    if is_valid || !is_number(text) {
        Ok(text.to_owned())
    } else {
        Err(format!("it must be 1 to {MAX_CHANNEL}, or the name of a channel"))
    }
}

/// Returns the driven channels: the first two, or only the one with this number, from 1.
pub(crate) fn channels(only: Option<u16>) -> ChannelMask {
    driven_channels(None, index_of(only), false).0
}

/// Returns the index of the channel with this number, from 1.
fn index_of(channel: Option<u16>) -> Option<usize> {
    channel.map(|channel| usize::from(channel).saturating_sub(1))
}

impl RigArgs {
    /// Opens the output for textures of this rate, with this random seed of the noise.
    pub(crate) fn open(&self, model_rate_hz: f32, seed: u64) -> anyhow::Result<Rig> {
        if self.actuator.is_some() && self.output.starts_with(haptic_pen::ID_PREFIX) {
            bail!(
                "the output `{}` plays waveforms of its own, so that no actuator applies to it; leave --actuator out",
                self.output
            );
        }
        let actuator = self.actuator.as_ref().map(|name| load_actuator(name, self.load_g)).transpose()?;
        let only = self.channel.as_deref().map(|text| channel_of(actuator.as_ref(), text)).transpose()?;
        let (channels, friction) = driven_channels(actuator.as_ref(), only, self.serial.is_some());
        let options = OpenOptions {
            model_rate_hz,
            preferred_rate_hz: None,
            buffer_frames: self.buffer,
            seed,
            drive: self.drive(actuator.as_ref())?,
            channels,
            friction,
            take_over: self.take_over,
        };
        let rig = match &self.serial {
            None => {
                let (handle, running) = open(&self.output, options)?;
                let watch = Watch::new(running.id(), None);
                Rig { handle, running, watch }
            }
            Some(port) => self.open_serial(port, options)?,
        };
        let n_channels = rig.running.channels();
        if let Some(friction) = friction.filter(|friction| friction.channel_idx >= usize::from(n_channels)) {
            output::warn(&format!(
                "friction is not rendered: the profile of the actuator puts it on channel {}, and {} has {n_channels}",
                friction.channel_idx + 1,
                rig.watch.what()
            ));
        }
        let profile = actuator.as_ref().filter(|_| self.serial.is_none());
        let n_needed = profile.map_or(0, n_named_channels);
        if only.is_none() && n_needed > usize::from(n_channels) {
            output::warn(&format!(
                "{} has {n_channels} channels, and the profile of the actuator needs {n_needed}: not all channels of the profile are played",
                rig.watch.what()
            ));
        }
        match only.filter(|channel_idx| *channel_idx >= usize::from(n_channels)) {
            None => Ok(rig),
            Some(_) if n_needed > usize::from(n_channels) => bail!(
                "{} has {n_channels} channels, and the profile of the actuator needs {n_needed}; choose another output",
                rig.watch.what()
            ),
            Some(channel_idx) => bail!(
                "there is no channel {}: {} has {n_channels}; choose another --channel, or leave it out",
                channel_idx + 1,
                rig.watch.what()
            ),
        }
    }

    fn open_serial(&self, port: &str, options: OpenOptions) -> anyhow::Result<Rig> {
        let mode = match self.serial_mode {
            SerialMode::Stream => Mode::Stream,
            SerialMode::Control => Mode::Control,
            SerialMode::Friction => Mode::Friction,
        };
        let serial = SerialOptions { baud: self.baud, mode, ..SerialOptions::default() };
        let Connection { handle, running, receiver, mut heard } = serial::open(port, options, serial)?;
        if !receiver.name.is_empty() {
            output::note(&format!("the receiver is `{}`", receiver.name));
        }
        // An empty queue is polled again later.
        let next = Box::new(move || heard.pop().ok());
        let receiver = Receiver::new(receiver.name, running.id().to_owned(), next);
        let watch = Watch::new(running.id(), Some(receiver));
        Ok(Rig { handle, running, watch })
    }

    /// Returns whether an actuator is given, whose limits apply to the output.
    pub(crate) fn has_actuator(&self) -> bool {
        self.actuator.is_some()
    }

    fn drive(&self, actuator: Option<&Actuator>) -> anyhow::Result<DriveConfig> {
        let Some(actuator) = actuator else {
            return Ok(DriveConfig::proportional(self.full_scale as f32, USUAL_CEILING));
        };
        let name = self.actuator.as_deref().unwrap_or(&actuator.id);
        if actuator.is_proportional() {
            output::note(&format!(
                "the response of the actuator `{name}` is unknown: the drive is proportional to the acceleration, with full scale at {} m/s²; calibrate it for a known acceleration",
                self.full_scale
            ));
            return Ok(DriveConfig::proportional(self.full_scale as f32, USUAL_CEILING));
        }
        let drive = self.full_scale_of(actuator, name)?;
        let config = drive_config(actuator, drive, !self.no_equalizer);
        let config = config.with_context(|| format!("the actuator `{name}` cannot be driven"))?;
        if let Some(warning) = actuator.limits_warning() {
            output::warn(&warning.to_string());
        } else if config.budget.is_none() {
            output::warn(&format!(
                "the profile of the actuator `{name}` states no continuous rating: the actuator is not protected from overheating"
            ));
        }
        Ok(config)
    }

    /// Voltage at digital full scale: as given, or as stated by the measured profile `name`.
    fn full_scale_of(&self, actuator: &Actuator, name: &str) -> anyhow::Result<Drive> {
        if let Some(full_scale) = self.full_scale_volts {
            return Ok(Drive::new(Volts(full_scale))?);
        }
        let Some(calibrated) = actuator.calibrated else {
            let text = format!(
                "the profile of the actuator `{name}` states no voltage at digital full scale: give --full-scale-volts V"
            );
            return Err(output::Usage(text).into());
        };
        let volts = calibrated.full_scale.0;
        output::note(&format!(
            "{volts} V at digital full scale, as stated by the profile of the actuator `{name}`; give --full-scale-volts for another output or volume"
        ));
        Ok(Drive::new(calibrated.full_scale)?)
    }
}
