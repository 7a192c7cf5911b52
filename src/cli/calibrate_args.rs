//! The arguments of `shagreen calibrate`.

use std::path::PathBuf;

use shagreen_device::serial::USUAL_BAUD;
use shagreen_formats::recording::Ask;

use crate::cli::actuator_source::{grams, positive, volts};
use crate::cli::calibrate_sweep::SweepArgs;
use crate::cli::recording_answers::parse_answer;

/// Options that do not apply when a sweep is only written.
const NOT_OF_A_SWEEP: [&str; 13] = [
    "input",
    "serial_sensor",
    "baud",
    "output_channel",
    "sensitivity",
    "channel",
    "answers",
    "full_scale_volts",
    "load_g",
    "actuator",
    "name",
    "out",
    "plots",
];

/// Measures the frequency response of an actuator with its load from a sine sweep, and fits a resonance model to it.
///
/// To play and record the sweep with Shagreen, give --output for the actuator, and --input or --serial-sensor for the
/// accelerometer. To use other equipment, write the sweep with --make-sweep and play it through the amplifier, with the
/// load on the actuator. Record the acceleration from one second before to one second after the sweep, and give the
/// file with --recording.
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("what").required(true).args(["make_sweep", "recording", "output"])))]
#[command(group(clap::ArgGroup::new("named").multiple(true).args(["out", "plots"])))]
pub(crate) struct Args {
    /// Only write the sweep, to this WAV file.
    #[arg(long, value_name = "OUT.wav", conflicts_with_all = NOT_OF_A_SWEEP)]
    pub(crate) make_sweep: Option<PathBuf>,
    /// Sample rate of the sweep file, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = 48_000, value_parser = clap::value_parser!(u32).range(1..=768_000), conflicts_with_all = ["recording", "output"])]
    pub(crate) rate: u32,
    /// Recording of the sweep: a WAV file, or a table such as .csv with an acceleration column.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["input", "serial_sensor", "baud", "output_channel"])]
    pub(crate) recording: Option<PathBuf>,
    /// Output to play the sweep on, by id; `shagreen devices` lists them.
    #[arg(long, value_name = "ID", conflicts_with = "answers")]
    pub(crate) output: Option<String>,
    /// Drive only this channel of the output, counted from 1. Default: the first two channels.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=64))]
    pub(crate) output_channel: Option<u16>,
    /// Audio input that the accelerometer is connected to, by id; `shagreen devices` lists them.
    #[arg(long, value_name = "ID", requires_all = ["output", "sensitivity"])]
    pub(crate) input: Option<String>,
    /// Serial port of a microcontroller with an accelerometer, which uses the protocol of docs/serial-protocol.md.
    #[arg(long, value_name = "PORT", requires = "output", conflicts_with_all = ["input", "sensitivity", "channel"])]
    pub(crate) serial_sensor: Option<String>,
    /// Baud rate of the serial port.
    #[arg(long, value_name = "N", default_value_t = USUAL_BAUD, requires = "serial_sensor", conflicts_with = "input", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) baud: u32,
    /// Full-scale acceleration of the WAV file or input, in m/s²: the acceleration that gives a sample value of 1.0. It
    /// is not the sensitivity of the sensor in V per m/s².
    #[arg(long, value_name = "MPS2", value_parser = |text: &str| positive(text, "an acceleration in m/s²"))]
    pub(crate) sensitivity: Option<f64>,
    /// Acceleration axis of the recording, or channel of the input, counted from 1. Default: the axis with the largest
    /// variation, or the first channel of the input.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    pub(crate) channel: Option<u16>,
    /// State a property that the recording does not contain, for example acceleration_unit=g. Can be given several
    /// times.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_answer)]
    pub(crate) answers: Vec<(Ask, String)>,
    /// Peak voltage at the actuator, in V, for a full-scale sine at the volume used: 1.414 times the AC (RMS) reading
    /// of a voltmeter. Default: 1 V is assumed; the profile is then valid only for this output at this volume, and its
    /// voltage limits are meaningless.
    #[arg(long, value_name = "V", value_parser = volts)]
    pub(crate) full_scale_volts: Option<f64>,
    /// Mass of the load on the actuator, in g, without the actuator itself.
    #[arg(long, value_name = "G", value_parser = grams)]
    pub(crate) load_g: Option<f64>,
    /// Existing profile of the measured actuator, by id or file. The new profile copies its maker, limits and masses.
    /// If Shagreen plays the sweep, these limits apply to it.
    #[arg(long, value_name = "ID_OR_FILE")]
    pub(crate) actuator: Option<String>,
    /// Name of the actuator in the profile and in the figures.
    #[arg(long, value_name = "NAME", requires = "named")]
    pub(crate) name: Option<String>,
    /// Profile file to write.
    #[arg(long, value_name = "PROFILE.toml")]
    pub(crate) out: Option<PathBuf>,
    /// Folder for figures, as SVG and CSV.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) plots: Option<PathBuf>,
    /// Print the result as one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    pub(crate) sweep: SweepArgs,
}
