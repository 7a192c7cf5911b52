//! Recordings of strokes with the number of acceleration signals that a network takes.

use std::path::PathBuf;

use shagreen_core::recording::fit::{self, FitError, Stroke};
use shagreen_core::recording::{Recording, ThreeAxisRecording};
use shagreen_core::texture::patterns::PAPER_RATE;
use shagreen_formats::recording::ColumnMap;

use crate::cli::recording_source::{read_recording_file, read_recording_files, read_three_axis_file};

/// Recordings for a network.
pub(crate) enum StrokeRecordings {
    /// One signal, combined from all axes.
    Combined(Vec<Recording>),
    /// The three axes.
    ThreeAxes(Vec<ThreeAxisRecording>),
}

impl StrokeRecordings {
    /// Reads recordings, and prints their warnings and notes.
    pub(crate) fn read(files: &[PathBuf], map: &ColumnMap, keeps_axes: bool) -> anyhow::Result<Self> {
        Ok(if keeps_axes {
            Self::ThreeAxes(read_recording_files(files, map, read_three_axis_file)?)
        } else {
            Self::Combined(read_recording_files(files, map, read_recording_file)?)
        })
    }

    /// Sample rates in Hz that are too low for the highest frequencies of the networks, each with the index of its
    /// recording.
    pub(crate) fn low_rates_hz(&self) -> Vec<(usize, f64)> {
        let rates_hz: Vec<f64> = match self {
            Self::Combined(recordings) => recordings.iter().map(|recording| recording.rate.0).collect(),
            Self::ThreeAxes(recordings) => recordings.iter().map(|of| of.recording().rate.0).collect(),
        };
        rates_hz.into_iter().enumerate().filter(|(_, rate_hz)| *rate_hz < 0.999 * PAPER_RATE.0).collect()
    }

    /// Strokes at the sample rate of the networks.
    pub(crate) fn strokes(&self) -> Result<Vec<Stroke>, FitError> {
        match self {
            Self::Combined(recordings) => fit::strokes(recordings, PAPER_RATE),
            Self::ThreeAxes(recordings) => fit::three_axis_strokes(recordings, PAPER_RATE),
        }
    }
}
