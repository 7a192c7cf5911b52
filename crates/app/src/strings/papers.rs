//! Papers whose procedures are repeated.

use shagreen_formats::printed_results::Paper;

use crate::strings::sentence;

pub const TITLE: &str = "Papers reproduced";
pub const MENU: &str = "Papers…";
pub const COMMAND: &str = "Repeat the papers";
pub const PURPOSE: &str = "Repeats the procedure of a paper on built-in data, and shows the printed numbers beside ours, with the reason for each difference. Raters and participants are simulated. In a terminal, \"shagreen reproduce\" takes other data and trains all networks.";
pub const PAPER: &str = "Paper";
pub const FOLDER: &str = "Folder for page, tables and figures";
pub const FOLDER_HINT: &str = "e.g. papers; empty to write no files";
pub const START: &str = "Repeat";
pub const START_HELP: &str = "Takes seconds, and about five minutes for S1.";
pub const STOP: &str = "Stop";
pub const STOP_HELP: &str = "Ends the work after its present step.";
pub const BEGINNING: &str = "Beginning…";
pub const BROKEN: &str = "The work stopped unexpectedly. Start it again, or run \"shagreen reproduce\".";
/// Headings of the table of numbers.
pub const COLUMNS: [&str; 5] = ["quantity", "printed", "ours", "equal up to", "remarks"];

/// Name of a paper in the list.
pub fn name(paper: Paper) -> &'static str {
    match paper {
        Paper::S0 => "S0: authoring by interpolation",
        Paper::S1 => "S1: textures from texts",
        Paper::S2 => "S2: attributes from strokes",
        Paper::S3 => "S3: quality of compressed signals",
        Paper::S4 => "S4: spatial spectrograms",
    }
}

/// What is computed.
pub fn step(step: &str) -> String {
    format!("{}…", sentence(step))
}

/// Where our numbers come from.
pub fn ours(source: &str) -> String {
    format!("Ours: {source}")
}

/// Where the files are.
pub fn written(index: &str) -> String {
    format!("Page, tables and figures: {index}")
}
