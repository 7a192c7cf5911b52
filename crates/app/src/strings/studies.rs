//! Studies workspace, and what participants of a study read.

use shagreen_core::people::study::trial::Task;
use shagreen_core::words::counted;
use shagreen_studio::study::session::SessionCounts;

// The plan.
pub const PLAN: &str = "Plan";
/// Kind of file in the dialog of the system.
pub const PLANS: &str = "Plans of studies";
pub const PLAN_PATH: &str = "Path of the plan";
pub const PLAN_HINT: &str = "Path of a .toml plan…";
pub const OPEN: &str = "Open";
pub const OPEN_PLAN: &str = "Open the plan";
pub const READ_AGAIN: &str = "Read again";
pub const READ_AGAIN_HELP: &str = "Reads the plan file again after you have changed it in an editor.";
pub const READING: &str = "Reading the plan…";
pub const TEMPLATES: &str = "Built-in plans";
pub const TEMPLATES_HELP: &str = "Plans of published experiments and of further designs. A copy is saved when you start a session, so that you can change it.";
pub const RATE_PROJECT: &str = "Rate the authored textures";
pub const RATE_PROJECT_HELP: &str =
    "Makes a study in which participants rate the authored textures of this project on adjective pairs.";
pub const SAVED_TO: &str = "Path at which the plan is saved";
pub const SAVED_TO_HELP: &str = "The plan is saved here when you start a session. The logs of the participants are saved in a folder beside it.";
pub const NO_PLAN: &str = "Open a plan first.";
pub const NO_PATH: &str = "State the path at which the plan is to be saved.";
pub const PROBLEMS: &str = "The plan cannot be run";
pub const CORRECT: &str = "Correct the plan in a text editor, save it, then read it again.";
pub const DROP_HERE: &str = "Drop to open the plan of a study";
pub const DROP_KINDS: &str = "Plans of studies (.toml)";

// Before a plan is opened.
pub const EMPTY_TITLE: &str = "From a plan to results";
pub const EMPTY_STEPS: [&str; 3] = [
    "Choose a built-in plan on the left, open a .toml plan, or rate the authored textures of this project.",
    "Check the preview and the devices, then start a session for each participant. Each answer is saved at once.",
    "Analyze the answers. Sorts and ratings can build a space in the Build workspace.",
];
pub const ETHICS: &str = "Participants have pseudonyms, and nothing leaves this computer. Obtain the approval that a study with people needs.";

// Preview.
pub const PREVIEW: &str = "Preview";
pub const RESULTS: &str = "Results";
pub const SCALE: &str = "Screen scale";
pub const PARTS: &str = "Parts";
pub const STIMULI: &str = "Stimuli";
pub const CONSENT_TEXT: &str = "Consent text";
pub const NO_CONSENT_TEXT: &str = "none; participants begin without one";

// Sessions.
pub const SESSIONS: &str = "Sessions";
pub const START: &str = "Start";
pub const START_HELP: &str =
    "Starts the session of the next participant over the whole window. The participant gets a pseudonym.";
pub const PRACTICE_ONLY: &str = "Practice only";
pub const PRACTICE_ONLY_HELP: &str = "Shows the practice trials. Their answers are not saved.";
pub const RESUME: &str = "Resume";
pub const RESUME_HELP: &str = "Goes on with this session at its first trial without an answer.";
pub const ANALYZE: &str = "Analyze";
pub const ANALYZE_HELP: &str = "Computes the results of all logs of this study.";
pub const ANALYZING: &str = "Analyzing…";
pub const NO_SESSIONS: &str = "No session yet.";
pub const PREPARING: &str = "Preparing the textures…";
pub const CANCEL: &str = "Cancel";
pub const DONE_LOG: &str = "done";
pub const REFUSED_LOG: &str = "did not agree";
pub const SIMULATED_LOG: &str = "simulated";
pub const OTHER_PLAN: &str = "of another study, or of an earlier version of the plan";
pub const LOGS: &str = "Folder of the logs";
pub const OTHER_PLAN_HERE: &str = "The folder has logs of another study, or of an earlier version of the plan. New sessions need another folder.";
pub const NEW_FOLDER: &str = "Use a new folder";
pub const NEW_FOLDER_HELP: &str = "Saves the logs of this version of the plan in a new folder beside the plan. The earlier logs stay where they are.";
pub const PLACEHOLDER_CONSENT: &str =
    "The consent text is the placeholder of the built-in plans. Write your own text into the plan file.";
pub const PLACEHOLDER_QUESTION: &str = "The consent text is the placeholder of the built-in plans, and the participant would read it. Write your own text into the plan file, or start only to try the study.";
pub const START_ANYWAY: &str = "Start with the placeholder";

// Devices.
pub const DEVICES: &str = "Before you start";
pub const NO_OUTPUT: &str = "No output is chosen: participants will feel nothing.";
pub const SILENT_OUTPUT: &str = "The silent output is chosen: participants will feel nothing.";
pub const OUTPUT_LOST: &str = "The output is lost: participants will feel nothing.";
pub const OUTPUT_MUTED: &str =
    "The output is muted: participants will feel nothing. Unmute it in the title bar.";
pub const NO_ACTUATOR: &str =
    "No actuator is chosen: levels are not calibrated, and the logs name no device profile.";
pub const NO_LATENCY: &str = "The latency is not measured yet: stroke the pad in Author once. The logs state it after the first stroke.";
pub const OPEN_DEVICES: &str = "Open Devices";
pub const OPEN_DEVICES_HELP: &str =
    "Opens the sheet in which output, actuator and pen are chosen and the latency is shown.";
pub const MASKING: &str = "Masking noise";
pub const MASKING_OUTPUT: &str = "Output of the masking noise";
pub const MASKING_HELP: &str =
    "Second output that plays the noise of the plan during a session: the headphones of the participant.";
pub const NO_MASKING_OUTPUT: &str = "no output";
pub const MASKING_MISSING: &str =
    "The plan asks for masking noise, but no second output is selected: participants may hear the actuator.";
pub const MASKING_SAME: &str =
    "The masking noise needs another output than the textures. Select the headphones of the participant.";
pub const WHITE: &str = "white";
pub const PINK: &str = "pink";
pub const NOT_CALIBRATED: &str =
    "The scale of the screen is not calibrated, so the lines may not have their true length.";
pub const CALIBRATE: &str = "Calibrate the scale…";
pub const CALIBRATE_HELP: &str =
    "Measures the screen with a bank card, so that lines have their true length in mm.";
pub const SCALE_STEPS: &str = "Hold a bank card (85.6 mm wide) to the bar. Move the right end of the bar until both have the same width: drag the slider, or use its arrow keys. Then save.";
pub const CARD_WIDTH: &str = "Width of the bar";
pub const SAVE_SCALE: &str = "Save the scale";

// Results.
pub const NO_RESULTS: &str = "Choose Analyze to compute the results of the sessions.";
pub const PEOPLE: &str = "People";
pub const SIMULATED_PEOPLE: &str = "Simulated participants";
pub const USE_IN_BUILD: &str = "Use in Build";
pub const USE_IN_BUILD_HELP: &str = "Hands the sorts, ratings and votes of these participants to the Build workspace, in place of its tables.";
pub const NOTHING_FOR_BUILD: &str =
    "The study has no sorts, ratings or votes from which a space could be built.";
pub const SAVE_REPORT: &str = "Save report";
pub const REPORT_FOLDER: &str = "Folder of the report";
pub const REPORT_HELP: &str = "Saves the results as JSON, the figures as SVG and CSV, all answers as a tidy table, and the tables that Build reads.";
pub const WARNINGS: &str = "Warnings";

// The runner: pages of text.
pub const LEAVE: &str = "Leave the study";
pub const LEAVE_HELP: &str = "Leaves the study after a question (Escape).";
pub const LEAVE_TITLE: &str = "Leave the study?";
pub const LEAVE_SAVED: &str = "All answers so far are saved. The session can be resumed later at this trial.";
pub const LEAVE_BEFORE: &str =
    "No answer has been given yet, so none is saved. The session can be resumed later.";
pub const LEAVE_UNSAVED: &str = "The last step is not saved and will be lost. All answers before are saved, and the session can be resumed.";
pub const LEAVE_PRACTICE: &str = "Answers to practice trials are not saved.";
pub const LEAVE_PAGE: &str = "Leave…";
pub const LEAVE_NOW: &str = "Leave";
pub const STAY: &str = "Stay";
pub const NOT_SAVED_TITLE: &str = "The last step is not saved";
pub const TRY_AGAIN: &str = "Try again";
pub const CONSENT: &str = "Consent";
pub const AGREE: &str = "I agree";
pub const DISAGREE: &str = "I do not agree";
pub const REFUSED: &str = "You are not taking part";
pub const REFUSED_HELP: &str =
    "The log states the pseudonym, the devices, and that there was no consent. Nothing else was saved.";
pub const BEGIN: &str = "Begin";
pub const CONTINUE: &str = "Continue";
pub const PRACTICE: &str = "Practice";
pub const PRACTICE_OVER: &str = "The practice is over";
pub const PRACTICE_OVER_HELP: &str = "From now on, your answers count.";
pub const BREAK: &str = "Break";
pub const BREAK_HELP: &str = "You can take a break now. Continue when you are ready.";
pub const RIGHT_ANSWER: &str = "Right";
pub const WRONG_ANSWER: &str = "Wrong";
pub const DONE: &str = "The session is over";
pub const DONE_HELP: &str = "All answers are saved. Thank you for taking part.";
pub const PRACTICE_DONE: &str = "These were all practice trials. Nothing was saved.";
pub const CLOSE: &str = "Close";
pub const BROKEN: &str = "A texture of this trial cannot be made";
pub const BROKEN_OFF: &str =
    "The textures could not be made, because the work stopped unexpectedly; start again";
pub const SIMULATED: &str = "SIMULATED PARTICIPANT";
pub const SIMULATION_FAILED: &str =
    "The simulated participant stopped unexpectedly; leave and resume the session.";

// The runner: trials.
pub const SURFACE: &str = "Surface to stroke";
pub const MOVE_HERE: &str = "Move here to feel the texture";
pub const MOVE_BOTH: &str = "Move here to feel both halves";
pub const MOVE_LATER: &str = "The texture will be here";
pub const SELECT_FIRST: &str = "Select one, then move here";
pub const STROKED: &str = "They are stroked for you";
pub const TOUCH_ONE: &str = "Move over the surface to feel the texture before you answer.";
pub const TOUCH_BOTH: &str = "Move over both halves of the surface before you answer.";
pub const TOUCH_EACH: &str = "Move over the surface while each texture plays, before you answer.";
pub const NOTHING_FELT: &str = "The output is closed, so nothing can be felt. Please call the experimenter.";
pub const NEXT: &str = "Next";
pub const NEXT_HELP: &str = "Saves the answer and goes on (Enter).";
pub const REPEAT: &str = "Repeat";
pub const REPEAT_HELP: &str = "Presents the textures again (R).";
pub const PLAY_HELP: &str =
    "Puts this texture on the surface; stroke the surface to feel it. The key is the letter of the label.";
pub const STROKE_START: &str = "Automatic stroke";
pub const STROKE_STOP: &str = "Stop the stroke";
pub const STROKE_HELP: &str =
    "Strokes the surface at a constant speed, for those who cannot stroke it themselves (Space).";
pub const LEFT: &str = "Left";
pub const RIGHT: &str = "Right";
pub const X_IS_A: &str = "X is A";
pub const X_IS_B: &str = "X is B";
pub const SAME: &str = "Same";
pub const DIFFERENT: &str = "Different";
pub const GRADE: &str = "Grade";
pub const BAD: &str = "bad";
pub const EXCELLENT: &str = "excellent";
pub const PLACE: &str = "Position between the two ends";
pub const NUMBER: &str = "Number for the difference";
pub const NUMBER_HELP: &str =
    "Type a number: 0 if both feel the same, and a larger one the more they differ.";
pub const NO_NUMBER: &str = "This is not a number of 0 or more; correct it.";
pub const NO_GROUP: &str = "Not sorted yet";
pub const DESCRIBE_HELP: &str = "Describe a texture in a few words.";
pub const TEXT: &str = "Description of a texture";
pub const DESCRIBE: &str = "Make the texture";
pub const MAKING: &str = "The texture is being made…";

/// Title of a built-in plan by its identifier.
pub fn template_title(id: &str) -> String {
    match id {
        "abx" | "mushra" => id.to_uppercase(),
        _ => super::sentence(&id.replace('-', " ")),
    }
}

/// Accessible name of the button of a built-in plan.
pub fn template(name: &str) -> String {
    format!("Built-in plan: {name}")
}

/// Heading of the problems of a plan.
pub fn problems(n: usize) -> String {
    format!("{}: {}", PROBLEMS, counted(n, "problem"))
}

/// Trials and estimated time of a session.
pub fn session_length(n_trials: usize, minutes: f64) -> String {
    format!("{}, about {:.0} min for a participant", counted(n_trials, "trial"), minutes.max(1.0))
}

/// One part of a plan: its design, trials, breaks and time.
pub fn part_line(
    design: &str,
    n_practice: usize,
    (n_scored, is_estimated): (usize, bool),
    minutes: f64,
) -> String {
    let about = if is_estimated { "about " } else { "" };
    let practice = if n_practice > 0 { format!("{n_practice} for practice, then ") } else { String::new() };
    format!("{design}: {practice}{about}{}, about {:.0} min", counted(n_scored, "trial"), minutes.max(1.0))
}

/// Trials that are not listed.
pub fn more_trials(n: usize) -> String {
    format!("and {}", counted(n, "more trial"))
}

/// Number of participants for which the orders are balanced.
pub fn balanced(n: usize) -> String {
    format!("The orders are balanced with a multiple of {}.", counted(n, "participant"))
}

/// State of a log: number of answers.
pub fn answers(n: usize) -> String {
    counted(n, "answer")
}

/// Damaged lines of a log.
pub fn damaged_lines(n: usize) -> String {
    format!("{}, which the analysis names", counted(n, "damaged line"))
}

/// Why a plan is not saved to a path.
pub fn exists(path: &str) -> String {
    format!("there is another file at this path; choose another path: {path}")
}

/// Accessible name of the button that resumes the session of a participant.
pub fn resume(participant: &str) -> String {
    format!("{RESUME} {participant}")
}

/// Level and color of the masking noise.
pub fn masking(color: &str, level_db: f64) -> String {
    format!("{color}, {level_db:.0} dB re full scale")
}

/// Why there was no masking noise.
pub fn masking_failed(reason: &str) -> String {
    format!("There was no masking noise: {reason}")
}

/// Output of a session.
pub fn output(name: &str) -> String {
    format!("Output: {name}")
}

/// Actuator of a session.
pub fn actuator(name: &str) -> String {
    format!("Actuator: {name}")
}

/// Measured latency of a stroke, in ms.
pub fn latency(stroke_ms: f32) -> String {
    format!("Latency: {stroke_ms:.0} ms")
}

/// Measured latency of a stroke above the limit, both in ms.
pub fn late(stroke_ms: f32, limit_ms: f32) -> String {
    format!("{}; above {limit_ms:.0} ms, textures feel detached from the movement.", latency(stroke_ms))
}

/// What the field with the folder of the logs does; `path` is the folder.
pub fn logs_help(path: &str) -> String {
    format!("{path}\nOne file for each participant is saved here. One folder has the logs of one plan.")
}

/// Measured scale of the screen.
pub fn calibrated(pixels_per_mm: f32) -> String {
    format!("Screen scale: {pixels_per_mm:.2} pixels per mm")
}

/// Length of lines that do not fit into the window, in mm.
pub fn too_long(needed_mm: f64, room_mm: f64) -> String {
    format!(
        "The lines need {needed_mm:.0} mm, but the window has room for {room_mm:.0} mm. Use a larger window or screen."
    )
}

/// Who is analyzed, as the heading of the results.
pub fn results_of(study: &str, who: &str) -> String {
    format!("{study}: {who}")
}

/// Outcome of saving a report.
pub fn report_saved(folder: &str) -> String {
    format!("Report saved in {folder}")
}

/// Name under which Build shows the answers of a study.
pub fn judgments_of(study: &str) -> String {
    format!("study \"{study}\"")
}

/// Heading of a part with its number.
pub fn part_title(number: usize, n_parts: usize, title: &str) -> String {
    format!("Part {number} of {n_parts}: {title}")
}

/// Trial on the screen among all.
pub fn progress(counts: SessionCounts) -> String {
    let now = counts.n_answered + 1;
    match counts.n_trials {
        Some(n_trials) => format!("{} of {n_trials}", now.min(n_trials)),
        None => format!("Trial {now}"),
    }
}

/// Accessible name of the button of a stimulus.
pub fn play(label: &str) -> String {
    format!("Feel {label}")
}

/// Tooltip of a stimulus that can be started so many times.
pub fn plays_left(n: u32) -> String {
    format!("{PLAY_HELP} It can be started {}.", counted(n as usize, "more time"))
}

/// Stimulus that plays by itself.
pub fn playing(label: &str) -> String {
    format!("{label} plays")
}

/// Name of an alternative with its key.
pub fn with_key(name: &str, key: u32) -> String {
    format!("{name} ({key})")
}

/// Ends of a line, for screen readers.
pub fn between(low: &str, high: &str) -> String {
    format!("{low} to {high}")
}

/// Line of the quality of a stimulus, for screen readers.
pub fn quality(label: &str) -> String {
    format!("Quality of {label}")
}

/// Meaning of an end of a scale.
pub fn end_of_scale(grade: u32, meaning: &str) -> String {
    format!("{grade} = {meaning}")
}

/// Accessible name of the button of a grade.
pub fn grade(of: &str, grade: u32) -> String {
    format!("{of}: {grade}")
}

/// Name of a group of a sort, from 0.
pub fn group(group: usize) -> String {
    format!("Group {}", group + 1)
}

/// What a tap on a group does.
pub fn move_here(label: &str, group: &str) -> String {
    format!("Moves {label} here: {group}")
}

/// How textures are sorted into so many groups.
pub fn sort_help(n_groups: usize) -> String {
    format!(
        "Make {n_groups} groups: drag each letter into a group, or select it and press the number of the group."
    )
}

/// Text of a participant, as it is shown again.
pub fn quoted(text: &str) -> String {
    format!("“{}”", text.trim())
}

/// Stimuli that a participant has not felt yet.
pub fn feel_first(labels: &[&str]) -> String {
    format!("Feel each texture before you answer. Still missing: {}.", labels.join(", "))
}

/// Stimuli over which the participant still has to move, by their labels; none if there is only one.
pub fn touch_first(labels: &[&str]) -> String {
    if labels.is_empty() {
        TOUCH_ONE.to_owned()
    } else {
        format!("{TOUCH_EACH} Not yet touched: {}.", labels.join(", "))
    }
}

/// Label of the surface while a stimulus plays.
pub fn move_here_to_feel(label: &str) -> String {
    format!("Move here to feel {label}")
}

/// Keys with which a task is answered.
pub fn keys_of(task: &Task) -> &'static str {
    match task {
        Task::Sort { .. } => "Keys: arrows select, numbers move into a group, Enter answers.",
        Task::Vote { .. } => "Keys: arrows and Space choose, S strokes, Enter answers.",
        Task::Rate { .. } | Task::Page { .. } | Task::Place { .. } => {
            "Keys: Tab and the arrows move the marks, Enter answers."
        }
        Task::Compare { .. } => "Keys: type the number, Enter answers.",
        Task::Discriminate { .. } | Task::Detect { .. } | Task::Match { .. } => "Keys: 1 or 2 answers.",
        Task::Grade { .. } => "Keys: numbers grade, Enter answers.",
        Task::Question { .. } => "Keys: arrows select a statement, numbers grade it, Enter answers.",
    }
}
