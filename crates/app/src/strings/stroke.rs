//! Stroke recordings.

pub const RECORD: &str = "Record";
pub const RECORD_HELP: &str = "Records a stroke of the mouse or the pen on the stroke pad, starting with the first touch. The automatic stroke can then repeat it while you change the texture. A new recording replaces the previous one.";
pub const FINISH: &str = "Finish";
pub const FINISH_HELP: &str = "Ends the recording. Then press \"Stroke\" (Space) to repeat it in a loop.";
pub const RECORDED: &str = "recorded";
pub const PATH_HELP: &str = "Path of the automatic stroke: line, circle, scribble, or a stroke that was recorded on the stroke pad or opened from a file.";
pub const SPEED: &str = "Speed";
pub const NORMAL_FORCE: &str = "Force";
pub const TEMPO: &str = "Speed of the recorded stroke";
pub const TEMPO_HELP: &str = "Speed of the recorded stroke, in percent of the recorded speed";
pub const FORCE: &str = "Force of the recorded stroke";
pub const FORCE_HELP: &str = "Normal force of the recorded stroke, in percent of the recorded force";
pub const OPEN: &str = "Open stroke…";
pub const OPEN_HELP: &str = "Opens a stroke from a CSV table of time, position and force, or of time, speed and force. The file can also be dropped on the window.";
pub const SAVE: &str = "Save stroke…";
pub const SAVE_HELP: &str = "Saves the recorded stroke as a CSV table. \"shagreen render --stroke\" and \"shagreen play --stroke\" can read it.";
pub const WAITS: &str = "stroke here: recording starts with the first touch";
pub const SAVE_TITLE: &str = "Save the stroke";
pub const SAVE_PATH: &str = "Path of the stroke file";
pub const SAVE_HINT: &str = "e.g. /path/to/stroke.csv";
pub const FILE_NAME: &str = "stroke.csv";
pub const EXISTS: &str = "A stroke file exists at this path. Replace it, or choose another path.";
pub const NO_STROKE: &str =
    "The file at this path is not a stroke table and is not replaced. Choose another path.";
pub const OPEN_TITLE: &str = "Open a stroke";
/// Kind of file in the dialog of the system.
pub const OPEN_KIND: &str = "Stroke recordings";
pub const OPEN_HINT: &str = "e.g. stroke.csv";
pub const CANCELED: &str = "Opening the stroke was canceled";
pub const BROKE_OFF: &str = "Reading the stroke stopped unexpectedly; try again";
pub const NEVER_TOUCHES: &str = "the tip never touches the surface in this stroke; choose another file";

pub const REPLACED: &str = "the previous stroke is replaced";
pub const KEPT: &str = "the recording is kept";

/// Message that the recording ended because it reached its longest duration.
pub fn full(longest_secs: f64) -> String {
    format!("The recording has ended: a stroke can last {longest_secs:.0} s at most")
}

/// Message that several files were given, but only one stroke was read.
pub fn only_one(name: &str, others: &[String]) -> String {
    format!("only one stroke can be repeated at a time: {name} was read and not {}", others.join(", "))
}

/// Duration of the recording so far, and the longest possible.
pub fn recording(secs: f64, longest_secs: f64) -> String {
    format!("recording: {secs:.1} of {longest_secs:.0} s")
}

pub fn to_save(secs: f64) -> String {
    format!("Saves time, position and force of {secs:.1} s as a CSV file.")
}

/// Error about a stroke that is too long to repeat.
pub fn too_long(secs: f64, longest_secs: f64) -> String {
    format!("the stroke lasts {secs:.0} s, but at most {longest_secs:.0} s can be repeated; shorten it")
}
