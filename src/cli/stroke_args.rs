//! Options for reading a recorded stroke, where its file does not state them.

use anyhow::bail;
use shagreen_device::pressure::PressureMap;

use crate::cli::hid_files::size_mm;
use crate::cli::output;
use crate::cli::quantity::quantity;

#[derive(Default, clap::Args)]
#[command(next_help_heading = "Options for recorded strokes")]
pub(crate) struct StrokeArgs {
    /// Length of one unit of x and y in a .svc file, in mm. The file does not state it. Default: 0.005 (5080 lines per
    /// inch) for whole numbers, 1 for fractions.
    #[arg(long, value_name = "MM", value_parser = quantity)]
    pub(crate) mm_per_count: Option<f64>,
    /// Length of one unit of time in a .svc file, in ms. The file does not state it. Default: 1 for whole numbers, 1000
    /// for fractions.
    #[arg(long, value_name = "MS", value_parser = quantity)]
    pub(crate) ms_per_tick: Option<f64>,
    /// Value of full pressure in a .svc file. The file does not state it. Default: 32767 (15 bits) for whole
    /// numbers, 1 for fractions.
    #[arg(long, value_name = "P", value_parser = quantity)]
    pub(crate) pressure_max: Option<f64>,
    /// Width and height of the active area of a recorded HID pen in mm, such as 216x135, if the pen declares none or
    /// wrong ones.
    #[arg(long, value_name = "WxH", value_parser = size_mm)]
    pub(crate) size_mm: Option<[f64; 2]>,
    /// Force at the lowest pressure, in N, if the pen declares no force. Default: 0.03.
    #[arg(long, value_name = "N", value_parser = quantity)]
    force_min: Option<f64>,
    /// Force at full pressure, in N, if the pen declares no force. Default: 4.
    #[arg(long, value_name = "N", value_parser = quantity)]
    force_max: Option<f64>,
    /// Curvature of the map from pressure to force: 0 is a straight line, higher values are steeper toward full
    /// pressure. Default: 2.
    #[arg(long, value_name = "C", value_parser = bend)]
    pressure_curve: Option<f64>,
}

/// Options for a `.svc` file.
pub(crate) const OF_SVC: [&str; 3] = ["--mm-per-count", "--ms-per-tick", "--pressure-max"];
/// Option for a recorded HID pen.
pub(crate) const OF_HID: &str = "--size-mm";
/// Options of the map from pressure to force.
pub(crate) const OF_PRESSURE: [&str; 3] = ["--force-min", "--force-max", "--pressure-curve"];

impl StrokeArgs {
    /// Returns the map from pressure to force.
    pub(crate) fn pressure_map(&self) -> PressureMap {
        let usual = PressureMap::USUAL;
        PressureMap {
            activation_n: self.force_min.unwrap_or(usual.activation_n),
            full_n: self.force_max.unwrap_or(usual.full_n),
            bend: self.pressure_curve.unwrap_or(usual.bend),
        }
    }

    /// Returns the names of the options that were given.
    pub(crate) fn given(&self) -> impl Iterator<Item = &'static str> {
        let [mm_per_count, ms_per_tick, pressure_max] = OF_SVC;
        let [force_min, force_max, pressure_curve] = OF_PRESSURE;
        let options = [
            (mm_per_count, self.mm_per_count.is_some()),
            (ms_per_tick, self.ms_per_tick.is_some()),
            (pressure_max, self.pressure_max.is_some()),
            (OF_HID, self.size_mm.is_some()),
            (force_min, self.force_min.is_some()),
            (force_max, self.force_max.is_some()),
            (pressure_curve, self.pressure_curve.is_some()),
        ];
        options.into_iter().filter(|(_, is_given)| *is_given).map(|(name, _)| name)
    }

    /// Returns an error if an option was given that is not among `known` and would be ignored. `what` names the stroke.
    pub(crate) fn refuse_but(&self, known: &[&str], what: &str) -> anyhow::Result<()> {
        match self.given().find(|option| !known.contains(option)) {
            Some(option) => bail!(output::Usage(format!("{option} does not apply to {what}; leave it out"))),
            None => Ok(()),
        }
    }
}

fn bend(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= 20.0 => Ok(value),
        _ => Err("it must be a number from -20 to 20".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::{PressureMap, StrokeArgs};
    use clap::{Args as _, Command};

    #[test]
    fn the_help_says_the_usual_forces() {
        let help = StrokeArgs::augment_args(Command::new("stroke")).render_long_help().to_string();
        // Independent of line breaks.
        let help = help.split_whitespace().chain([""]).collect::<Vec<_>>().join(" ");
        let usual = PressureMap::USUAL;
        for words in [
            format!("lowest pressure, in N, if the pen declares no force. Default: {} ", usual.activation_n),
            format!("full pressure, in N, if the pen declares no force. Default: {} ", usual.full_n),
            format!("toward full pressure. Default: {} ", usual.bend),
        ] {
            assert!(help.contains(&words), "{words} is not in {help}");
        }
    }
}
