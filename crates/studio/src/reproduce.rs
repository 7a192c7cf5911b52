//! The procedures of the five papers, repeated on built-in or given data, with the printed results beside ours.
//!
//! Each paper has a file. It computes every table and figure of the paper that the program can compute, and gives a reason
//! for every number that is missing or differs: other data, simulated raters in the place of people, networks that were not
//! trained, errors in print. What only people can tell has no number. Raters and participants are simulated unless judgments
//! are given, and every table and figure says so.

mod charts;
mod files;
mod s0;
mod s1;
mod s2;
mod s3;
mod s4;
mod simulated;
#[cfg(test)]
mod tests;
mod work;

use std::time::Instant;

use shagreen_core::people::ratings::Rating;
use shagreen_core::people::sorting::Sort;
use shagreen_core::space::LabelSource;
use shagreen_formats::library::Library;
use shagreen_formats::printed_results::Paper;
use shagreen_formats::reproduction_report::Reproduction;
use shagreen_learn::backbone::Backbone;

use crate::report::Reporter;

use self::work::Work;

pub use self::files::{check_reproduction_folder, write_reproductions};

/// Judgments of textures in the place of those of simulated raters.
#[derive(Clone, Debug)]
pub struct GivenJudgments {
    /// Sorts of the textures; may be empty.
    pub sorts: Vec<Sort>,
    /// Ratings of the textures.
    pub ratings: Vec<Rating>,
    /// Who judged.
    pub source: LabelSource,
}

/// What is repeated, and on which data.
#[derive(Clone, Debug)]
pub struct ReproduceOptions<'a> {
    /// Textures; `None` for the built-in library that suits the paper.
    pub library: Option<&'a Library>,
    /// Judgments; `None` for simulated raters.
    pub judgments: Option<&'a GivenJudgments>,
    /// Network whose features pictures are predicted from; `None` for statistics of the pictures.
    pub backbone: Option<&'a Backbone>,
    /// Whether all networks are trained, which takes hours to days.
    pub is_full: bool,
    /// How much is computed.
    pub extent: Extent,
    /// Seed of all random numbers.
    pub seed: u64,
    /// The command that repeats this.
    pub command: String,
}

/// How much is computed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Largest number of textures; of more, some are left out evenly.
    pub n_textures: usize,
    /// Further rendered pictures of each texture.
    pub n_pictures: usize,
    /// Largest number of epochs of a network; `None` for that of its paper.
    pub n_epochs: Option<usize>,
    /// Compared segments of 0.8 s of each coded signal.
    pub n_segments: usize,
    /// Fraction of each training stroke of 1 s, 0.2 to 1.
    pub stroke_share: f64,
}

impl Extent {
    /// As much as in the papers.
    pub fn paper() -> Self {
        Self { n_textures: usize::MAX, n_pictures: 5, n_epochs: None, n_segments: 3, stroke_share: 1.0 }
    }

    /// So little that it takes seconds, to try the procedures; its numbers mean nothing.
    pub fn small() -> Self {
        Self { n_textures: 10, n_pictures: 0, n_epochs: Some(1), n_segments: 1, stroke_share: 0.2 }
    }
}

/// Repeats the procedure of a paper. `on_step` receives what is computed next, as a phrase, and returns whether to continue.
///
/// # Errors
/// The data do not suffice for the procedure, or `on_step` ended the work.
pub fn reproduce(
    paper: Paper,
    options: &ReproduceOptions<'_>,
    on_step: &mut dyn FnMut(&'static str) -> bool,
    reporter: &dyn Reporter,
) -> anyhow::Result<Reproduction> {
    let begun = Instant::now();
    let mut work = Work::new(paper, options, on_step, reporter)?;
    match paper {
        Paper::S0 => s0::run(&mut work)?,
        Paper::S1 => s1::run(&mut work)?,
        Paper::S2 => s2::run(&mut work)?,
        Paper::S3 => s3::run(&mut work)?,
        Paper::S4 => s4::run(&mut work)?,
    }
    Ok(Reproduction {
        paper,
        items: work.finish()?,
        command: options.command.clone(),
        seed: options.seed,
        is_full: options.is_full,
        seconds: begun.elapsed().as_secs_f64(),
    })
}
