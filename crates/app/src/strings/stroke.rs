//! Words of strokes that are recorded on the pad.

/// Begins a recording.
pub const RECORD: &str = "Record";
/// What recording does.
pub const RECORD_HELP: &str = "Keeps what the mouse or the pen does on the pad, from the first touch on. The hand can then repeat it \
                               while you change the texture. A new recording takes the place of the one before.";
/// Ends a recording.
pub const FINISH: &str = "Finish";
/// What ending a recording does.
pub const FINISH_HELP: &str =
    "Ends the recording. Press \"Stroke\" (Space) then, and the hand repeats it again and again.";
/// The stroke as a path of the hand.
pub const RECORDED: &str = "recorded";
/// What the choice of paths does.
pub const PATH_HELP: &str = "What the hand does when it strokes by itself. A stroke that was recorded on the pad, or opened from a \
                             file, can be one of them.";
/// Accessible name of the tempo.
pub const TEMPO: &str = "Tempo of the stroke";
/// What the tempo does.
pub const TEMPO_HELP: &str =
    "Tempo of the recorded stroke: at 100 % it is as fast as it was, at 50 % half as fast.";
/// Accessible name of the factor of the force.
pub const FORCE: &str = "Force of the stroke";
/// What the factor of the force does.
pub const FORCE_HELP: &str =
    "Force of the recorded stroke: at 100 % it presses as it did, at 50 % half as hard.";
/// Opens a stroke.
pub const OPEN: &str = "Open stroke…";
/// What opening a stroke does.
pub const OPEN_HELP: &str = "Reads a stroke from a table (CSV): time, place and force, or time, speed and force. Such a file can also \
                             be dropped on the window.";
/// Saves the stroke.
pub const SAVE: &str = "Save stroke…";
/// What saving the stroke does.
pub const SAVE_HELP: &str = "Writes the recorded stroke into a table (CSV), which \"shagreen render --stroke\" and \"play --stroke\" \
                             take too.";
/// Shown on the pad before the first touch of a recording.
pub const WAITS: &str = "stroke here: it is recorded from the first touch on";
/// The title of the sheet that saves a stroke.
pub const SAVE_TITLE: &str = "Save the stroke";
/// Accessible name of the field for its path.
pub const SAVE_PATH: &str = "Path of the stroke's file";
/// Hint in the field for its path.
pub const SAVE_HINT: &str = "/path/to/stroke.csv";
/// Name of the file unless another is chosen.
pub const FILE_NAME: &str = "stroke.csv";
/// There is a stroke at the path.
pub const EXISTS: &str = "There is a stroke at this path already. Replace it, or choose another path.";
/// Why a file of another kind is not replaced.
pub const NO_STROKE: &str =
    "Choose another path: what is there is no table of a stroke, so it is not replaced.";
/// The title of the sheet that opens a stroke.
pub const OPEN_TITLE: &str = "Open a stroke";
/// What the field for its path takes.
pub const OPEN_HINT: &str = "stroke.csv";
/// Reading broke off.
pub const BROKE_OFF: &str = "Reading the stroke broke off; try again";
/// The tip never touches.
pub const NEVER_TOUCHES: &str = "the tip never touches in this stroke; choose another file";

/// A stroke took the place of another.
pub const REPLACED: &str = "the stroke before is replaced";
/// A recording that has ended by itself is the stroke now.
pub const KEPT: &str = "it is kept";

/// A recording has ended by itself.
pub fn full(longest_secs: f64) -> String {
    format!("The recording has ended, for a stroke lasts {longest_secs:.0} s at most")
}

/// Of several strokes one is read.
pub fn only_one(name: &str, others: &[String]) -> String {
    format!("the hand repeats one stroke at a time, so {name} was read and not {}", others.join(", "))
}

/// How long a recording is so far, and may be.
pub fn recording(secs: f64, longest_secs: f64) -> String {
    format!("recording: {secs:.1} of {longest_secs:.0} s")
}

/// What is saved.
pub fn to_save(secs: f64) -> String {
    format!("{secs:.1} s of time, place and force go into one CSV file.")
}

/// A stroke is too long to be repeated.
pub fn too_long(secs: f64, longest_secs: f64) -> String {
    format!("the stroke lasts {secs:.0} s, and at most {longest_secs:.0} s can be repeated; cut it shorter")
}
