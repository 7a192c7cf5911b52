//! The option `--axes`.

use anyhow::bail;
use shagreen_core::words::counted;
use shagreen_formats::library::Library;
use shagreen_formats::project::{Project, plain_axis_name};
use shagreen_studio::axes::placed_with;

use crate::cli::axis_name::{axis_name, axis_names};
use crate::cli::output::{self, Usage};
use crate::cli::point::PointArg;

#[derive(clap::Args)]
pub(crate) struct AxesArgs {
    /// Axes of the space: one to six names, separated by commas, as in rough-smooth,hard-soft,centroid. An axis is an
    /// attribute of the textures, or computed from their vibration: centroid, speed-exponent, force-exponent and
    /// tap-frequency. `shagreen library list` shows all axes of a library. Default: the axes of the positions of the library.
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    axes: Vec<String>,
}

impl AxesArgs {
    /// Whether the arguments name no axes.
    pub(crate) fn is_empty(&self) -> bool {
        self.axes.is_empty()
    }

    /// Returns the textures with positions on the axes of the arguments. If the arguments give none, the axes are those of the
    /// project, or else those of the library, and after them all others that points name.
    pub(crate) fn place(
        &self,
        library: Library,
        project: Option<&Project>,
        points: &[&PointArg],
    ) -> anyhow::Result<Library> {
        let of_library: Vec<String> = library.axis_names().into_iter().map(str::to_owned).collect();
        let mut axes = if self.is_empty() {
            project.and_then(|project| project.axes.clone()).unwrap_or_else(|| of_library.clone())
        } else {
            axis_names(&library, &self.axes)
        };
        for name in points.iter().flat_map(|point| point.names()) {
            let name = axis_name(&library, name);
            if axes.iter().any(|axis| plain_axis_name(axis) == plain_axis_name(&name)) {
                continue;
            }
            if !self.is_empty() {
                bail!(Usage(format!(
                    "\"{name}\" is not one of the axes {}; add it to --axes, or leave --axes out",
                    axes.join(", ")
                )));
            }
            axes.push(name);
        }
        if axes == of_library {
            return Ok(library);
        }
        let added = project.map(|project| project.coordinates.clone()).unwrap_or_default();
        let placed = placed_with(&library, &axes, &added)?;
        note_unplaced(&library, &placed);
        Ok(placed)
    }
}

/// Notes textures that have a position in the library, but none on other axes.
fn note_unplaced(library: &Library, placed: &Library) {
    let pairs = library.textures.iter().zip(&placed.textures);
    let lost: Vec<&str> = pairs
        .filter(|(before, now)| before.place.is_some() && now.place.is_none())
        .map(|(before, _)| before.id.as_str())
        .collect();
    if !lost.is_empty() {
        output::note(&format!(
            "{} without a value on each of the axes {}, so not used: {}",
            counted(lost.len(), "texture"),
            placed.axis_names().join(", "),
            lost.join(", ")
        ));
    }
}
