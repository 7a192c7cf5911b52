//! `shagreen calibrate`: measures the response of an actuator on its load.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use shagreen_core::actuator::Drive;
use shagreen_core::actuator::calibration::calibrate;
use shagreen_core::units::Volts;
use shagreen_device::engine::ChannelMask;
use shagreen_device::measure::Listener;
use shagreen_formats::actuator_toml::{read_actuator, write_actuator};
use shagreen_formats::calibration_report::calibration_figures;

use crate::cli::actuator_source::load_actuator;
use crate::cli::calibrate_args::Args;
use crate::cli::calibrate_live::record_live;
use crate::cli::calibrate_recording::recorded_file;
use crate::cli::calibrate_result::{print, profile};
use crate::cli::calibrate_sweep::write_sweep;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::rig::channels;
use crate::cli::sweep_checks::{advised, other_sound};
use shagreen_studio::figure_files::{check_figures, check_together, figure_files, write_together};
use shagreen_studio::file;
use shagreen_studio::replace::{refuse_foreign, refuse_inputs};

/// Names of the figures, without file endings.
const FIGURES: [&str; 3] = ["gain", "residual", "distortion"];

/// Source of the recorded acceleration.
enum Source<'a> {
    /// A file, recorded with any equipment.
    File(&'a Path),
    /// A sweep that is played now on this output and these channels, recorded by this sensor.
    Live(&'a str, ChannelMask, Listener),
}

impl Source<'_> {
    /// Returns the recorded file; `None` if the sweep is played now.
    fn path(&self) -> Option<&Path> {
        match self {
            Self::File(path) => Some(path),
            Self::Live(..) => None,
        }
    }

    /// Returns the name of the source in reports.
    fn name(&self) -> String {
        match self {
            Self::File(path) => file::file_name(path),
            Self::Live(id, ..) => format!("played on {id}"),
        }
    }

    /// Adds the recorded file to an error.
    fn told<T, E: Into<anyhow::Error>>(&self, result: Result<T, E>) -> anyhow::Result<T> {
        let result = result.map_err(Into::into);
        match self.path() {
            Some(path) => result.with_context(|| file::in_file(path)),
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
    // Before the sweep is played: a measurement that cannot be written must be repeated.
    let out: Vec<&Path> = args.out.iter().map(PathBuf::as_path).collect();
    check_together(&out, args.plots.as_deref(), &FIGURES)?;
    let base = args.actuator.as_deref().map(|name| load_actuator(name, None)).transpose()?;
    if args.full_scale_volts.is_none() {
        output::note(
            "1 V is assumed at digital full scale: the profile is valid only for this output at this volume, and its voltage limits are meaningless; measure the peak voltage and give --full-scale-volts",
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
    let progress = Progress::endless("computing the response");
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
        // The complete source text of a profile is too long for a title.
        let measured = format!("{}, {}", actuator.name, source.name());
        for (name, figure) in calibration_figures(&calibration, &measured) {
            figures.push(folder.join(format!("{name}.svg")).display().to_string());
            files.extend(figure_files(folder, name, &figure));
        }
    }
    write_together(&files, args.plots.as_deref())?;
    progress.finish();
    print(args, &recorded, &calibration, &fit, (&warnings, &figures));
    Ok(())
}

fn source(args: &Args) -> anyhow::Result<Source<'_>> {
    let Some(id) = &args.output else {
        let Some(file) = &args.recording else {
            bail!(output::Usage(
                "give --recording FILE, or --output ID and a sensor (--input or --serial-sensor)".to_owned()
            ));
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
            "the sensor is missing; give --input ID and --sensitivity MPS2, or --serial-sensor PORT"
                .to_owned()
        )),
    };
    Ok(Source::Live(id, channels(args.output_channel), listener))
}
