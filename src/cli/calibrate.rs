//! `shagreen calibrate`: measures what an actuator does on its load.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::actuator::Drive;
use shagreen_core::calibration::calibrate;
use shagreen_core::units::Volts;
use shagreen_device::engine::ChannelMask;
use shagreen_device::measure::Listener;
use shagreen_device::serial::USUAL_BAUD;
use shagreen_formats::actuator_toml::{read_actuator, write_actuator};
use shagreen_formats::calibration_report::calibration_figures;
use shagreen_formats::recording::Ask;

use crate::cli::actuator_source::{grams, load_actuator, positive, volts};
use crate::cli::calibrate_doubts::{advised, other_sound};
use crate::cli::calibrate_live::record_live;
use crate::cli::calibrate_recording::recorded_file;
use crate::cli::calibrate_result::{print, profile};
use crate::cli::calibrate_sweep::{SweepArgs, write_sweep};
use crate::cli::figures_folder::{check_figures, check_together, figure_files, write_together};
use crate::cli::guard::{refuse_foreign, refuse_inputs};
use crate::cli::output;
use crate::cli::recording_answers::parse_answer;
use crate::cli::rig::channels;

/// Names of the figures, without the endings.
const FIGURES: [&str; 3] = ["gain", "residual", "distortion"];

/// What says nothing about a sweep that is written.
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

/// Fits an actuator's response to a sweep.
///
/// Either play it here: --output names what drives the actuator, --input or --serial-sensor what feels it. Or write the
/// sweep with --make-sweep, play it through the amplifier with the actuator on its load, record the acceleration from a
/// second before to a second after, and give the recording.
#[derive(clap::Args)]
#[command(group(clap::ArgGroup::new("what").required(true).args(["make_sweep", "recording", "output"])))]
#[command(group(clap::ArgGroup::new("named").multiple(true).args(["out", "plots"])))]
pub(crate) struct Args {
    /// Write the sweep to play, and nothing else.
    #[arg(long, value_name = "OUT.wav", conflicts_with_all = NOT_OF_A_SWEEP)]
    make_sweep: Option<PathBuf>,
    /// Rate of the sweep to write, in Hz.
    #[arg(long, value_name = "HZ", default_value_t = 48_000, value_parser = clap::value_parser!(u32).range(1..=768_000), conflicts_with_all = ["recording", "output"])]
    rate: u32,
    /// The recorded sweep: WAV, or a table with a column of acceleration.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["input", "serial_sensor", "baud", "output_channel"])]
    recording: Option<PathBuf>,
    /// Output to play the sweep on, by its id; `shagreen devices` lists them.
    #[arg(long, value_name = "ID", conflicts_with = "answers")]
    output: Option<String>,
    /// The only channel of that output to drive, from 1; without it the first two.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=64))]
    output_channel: Option<u16>,
    /// Input of the system's sound that an accelerometer is on, by its id.
    #[arg(long, value_name = "ID", requires_all = ["output", "sensitivity"])]
    input: Option<String>,
    /// Serial port of a receiver with an accelerometer: docs/serial-protocol.md.
    #[arg(long, value_name = "PORT", requires = "output", conflicts_with_all = ["input", "sensitivity", "channel"])]
    serial_sensor: Option<String>,
    /// Baud rate of that port.
    #[arg(long, value_name = "N", default_value_t = USUAL_BAUD, requires = "serial_sensor", conflicts_with = "input", value_parser = clap::value_parser!(u32).range(1..))]
    baud: u32,
    /// Acceleration of a sample of 1.0 of a WAV file or an input, in m/s².
    #[arg(long, value_name = "MPS2", value_parser = |text: &str| positive(text, "an acceleration in m/s²"))]
    sensitivity: Option<f64>,
    /// The axis of acceleration to take, or the channel of an input, from 1; without it the one that moves most, or the first.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    channel: Option<u16>,
    /// Answers what a table does not say, as in acceleration_unit=g.
    #[arg(long = "set", value_name = "KEY=VALUE", value_parser = parse_answer)]
    answers: Vec<(Ask, String)>,
    /// Voltage at the actuator for a sample of 1.0, at the volume that was used: of a sine of full scale the peak, 1.414 times
    /// what a voltmeter shows. Without it a volt is taken: the profile is
    /// then right for this output at this volume, and its limits in volts mean nothing.
    #[arg(long, value_name = "V", value_parser = volts)]
    pub(crate) full_scale_volts: Option<f64>,
    /// Mass of what the actuator was fixed to, in g, without the actuator.
    #[arg(long, value_name = "G", value_parser = grams)]
    pub(crate) load_g: Option<f64>,
    /// The actuator that was measured, where there is a profile of it: maker, limits and masses are taken from there.
    #[arg(long, value_name = "ID_OR_FILE")]
    actuator: Option<String>,
    /// What to call it, in the profile and in the figures.
    #[arg(long, value_name = "NAME", requires = "named")]
    pub(crate) name: Option<String>,
    /// Profile to write.
    #[arg(long, value_name = "PROFILE.toml")]
    pub(crate) out: Option<PathBuf>,
    /// Folder for figures, as SVG and CSV.
    #[arg(long, value_name = "FOLDER")]
    plots: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
    #[command(flatten)]
    sweep: SweepArgs,
}

/// Where the recording comes from.
enum Source<'a> {
    /// A file that was recorded by whatever.
    File(&'a Path),
    /// A sweep that is played now.
    Live(&'a str, ChannelMask, Listener),
}

impl Source<'_> {
    /// The file that is read, where it is one.
    fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Live(..) => None,
        }
    }

    /// What people call it.
    fn name(&self) -> String {
        match self {
            Self::File(path) => output::file_name(path),
            Self::Live(id, ..) => format!("played on {id}"),
        }
    }

    /// Says where something went wrong.
    fn told<T, E: Into<anyhow::Error>>(&self, result: Result<T, E>) -> anyhow::Result<T> {
        let result = result.map_err(Into::into);
        match self.path() {
            Some(path) => result.with_context(|| output::in_file(path)),
            None => result,
        }
    }
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let sweep = args.sweep.sweep()?;
    if let Some(out) = &args.make_sweep {
        return write_sweep(&sweep, args.rate, out, args.json);
    }
    let source = source(args)?;
    let inputs = [source.path(), args.actuator.as_deref().map(Path::new)];
    if let Some(out) = &args.out {
        refuse_inputs(&[out], &inputs)?;
        refuse_foreign(out, "the profile", |bytes| read_actuator(bytes).is_ok())?;
    }
    if let Some(folder) = &args.plots {
        check_figures(folder, &FIGURES, &inputs)?;
    }
    // Before anything sounds: a measurement that cannot be kept has to be made again.
    let out: Vec<&Path> = args.out.iter().map(PathBuf::as_path).collect();
    check_together(&out, args.plots.as_deref(), &FIGURES)?;
    let base = args.actuator.as_deref().map(|name| load_actuator(name, None)).transpose()?;
    if args.full_scale_volts.is_none() {
        output::note(
            "a volt is taken for digital full scale: the profile is right for this output at this volume; measure it and say --full-scale-volts for limits in volts",
        );
    }
    let drive = args.full_scale_volts.map_or(Ok(Drive::ASSUMED), |full| Drive::new(Volts(full)))?;
    let recorded = match &source {
        Source::File(path) => {
            recorded_file(path, args.sensitivity, args.channel.map(usize::from), &args.answers)?
        }
        Source::Live(id, channels, listener) => {
            record_live((id, *channels), listener, &sweep, base.as_ref(), drive)?
        }
    };
    let calibration = calibrate(&recorded.acceleration_mps2, recorded.rate, &sweep, drive);
    let calibration = source.told(calibration.map_err(|error| advised(&error, &recorded, &sweep)))?;
    let mut warnings: Vec<String> = calibration.warnings.iter().map(ToString::to_string).collect();
    warnings.extend(other_sound(&recorded, calibration.begins_secs, &sweep));
    for warning in &warnings {
        output::warn(warning);
    }
    let fit = source.told(calibration.fit.clone())?;
    let actuator = profile(args, &source.name(), base, &fit, drive);
    let mut files = Vec::new();
    let mut figures = Vec::new();
    if let Some(out) = &args.out {
        files.push((out.clone(), write_actuator(&actuator)));
    }
    if let Some(folder) = &args.plots {
        // The whole source of a profile is too long for a title.
        let measured = format!("{}, {}", actuator.name, source.name());
        for (name, figure) in calibration_figures(&calibration, &measured) {
            figures.push(folder.join(format!("{name}.svg")).display().to_string());
            files.extend(figure_files(folder, name, &figure));
        }
    }
    write_together(&files, args.plots.as_deref())?;
    print(args, &recorded, &calibration, &fit, (&warnings, &figures));
    Ok(())
}

fn source(args: &Args) -> anyhow::Result<Source<'_>> {
    let Some(id) = &args.output else {
        let Some(file) = &args.recording else {
            bail!(output::Usage("give --recording, or --output and what listens".to_owned()));
        };
        return Ok(Source::File(file));
    };
    let listener = match (&args.input, &args.serial_sensor, args.sensitivity) {
        (_, Some(port), _) => Listener::Serial { port: port.clone(), baud: args.baud },
        (Some(id), None, Some(sensitivity_mps2)) => {
            let channel_idx = args.channel.map_or(0, |channel| usize::from(channel) - 1);
            Listener::Input { id: id.clone(), channel_idx, sensitivity_mps2 }
        }
        _ => bail!(output::Usage(
            "say what listens: --input ID and its --sensitivity, or --serial-sensor PORT".to_owned()
        )),
    };
    Ok(Source::Live(id, channels(args.output_channel), listener))
}
