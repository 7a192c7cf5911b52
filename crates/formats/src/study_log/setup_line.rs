//! Setup of the devices as a line of a log.

use serde::{Deserialize, Serialize};
use shagreen_core::people::study::setup::{OutputDevice, ScreenScale, Setup};

/// Name of the output of a session without one.
pub(crate) const NO_OUTPUT: &str = "no output";

/// A missing device is written as null, so that a reader of the file sees that there was none.
#[derive(Serialize, Deserialize)]
pub(super) struct SetupV1 {
    pub(super) unix_s: f64,
    /// Name of the output.
    output: String,
    /// Identifier of the output; none for the silent one.
    #[serde(default)]
    output_id: Option<String>,
    #[serde(default)]
    actuator: Option<String>,
    #[serde(default)]
    masking_output: Option<String>,
    #[serde(default)]
    pen: Option<String>,
    screen: ScreenV1,
    pixels_per_mm: f64,
    #[serde(default)]
    program: String,
}

#[derive(Clone, Copy, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum ScreenV1 {
    Measured,
    Assumed,
}

impl SetupV1 {
    pub(super) fn of(setup: &Setup, unix_s: f64) -> Self {
        let output = setup.output.as_ref();
        Self {
            unix_s,
            output: output.map_or(NO_OUTPUT, |output| output.name.as_str()).to_owned(),
            output_id: output.map(|output| output.id.clone()),
            actuator: setup.actuator.clone(),
            masking_output: setup.masking.clone(),
            pen: setup.pen.clone(),
            screen: if setup.screen.is_measured() { ScreenV1::Measured } else { ScreenV1::Assumed },
            pixels_per_mm: setup.screen.pixels_per_mm(),
            program: setup.program.clone(),
        }
    }
}

impl From<SetupV1> for Setup {
    fn from(line: SetupV1) -> Self {
        let SetupV1 { output, output_id, pixels_per_mm, .. } = line;
        Self {
            output: output_id.map(|id| OutputDevice { id, name: output }),
            actuator: line.actuator,
            masking: line.masking_output,
            pen: line.pen,
            screen: match line.screen {
                ScreenV1::Measured => ScreenScale::Measured { pixels_per_mm },
                ScreenV1::Assumed => ScreenScale::Assumed { pixels_per_mm },
            },
            program: line.program,
        }
    }
}
