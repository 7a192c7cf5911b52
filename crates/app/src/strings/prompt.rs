//! Words of the prompt box and of what comes of it.

use shagreen_core::prompt::Understood;

/// What the box is for, while it is empty.
pub const HINT: &str = "Describe a surface: a rough, soft carpet";
/// Accessible name of the box.
pub const FIELD: &str = "Describe a surface";
/// What the box does.
pub const FIELD_HELP: &str = "Words become a picture, a place in the space, and a texture to feel. Enter makes it. Photos dropped on the window find their places, too.";
/// Makes what was described.
pub const MAKE: &str = "Make";
/// What making does.
pub const MAKE_HELP: &str = "Make a texture of these words; the sliders then refine it";
/// Stops making.
pub const STOP: &str = "Stop";
/// Makes another one.
pub const ANOTHER: &str = "Another";
/// What that does.
pub const ANOTHER_HELP: &str = "Another piece of the same surface, by the next seed";
/// Opens the earlier prompts.
pub const EARLIER: &str = "Earlier";
/// What they are.
pub const EARLIER_HELP: &str = "What was described before, with its seed: made again, it is the same texture";
/// There are none.
pub const NO_EARLIER: &str = "Nothing was described yet";
/// Closes the row.
pub const DISMISS: &str = "Close what was guessed";
/// Name of the generator that needs nothing.
pub const PROCEDURAL: &str = "Procedural";
/// Name of the generator of the user.
pub const DIFFUSION: &str = "Diffusion";
/// What they are.
pub const GENERATOR_HELP: &str = "Who makes the picture: the generator of the program in a second, or the diffusion model that was added, which takes minutes to hours on a processor";
/// Why a prompt of before cannot be made again.
pub const NO_DIFFUSION: &str =
    "A diffusion model made it, and none is on this machine any more: shagreen model add";
/// The thread ended.
pub const BROKEN_OFF: &str = "Making it broke off; try other words";
/// The program is damaged.
pub const NO_MATERIALS: &str = "the materials of the starter library are missing; get this program again";
/// There is no folder for networks of others.
pub const NO_MODELS: &str = "this system has no folder for models; use the procedural generator";
/// One thing at a time.
pub const STILL_BUSY: &str = "Something is being made: wait for it, or stop it";
/// The axes changed while it was made.
pub const OTHER_AXES: &str = "What was described was made for other axes: make it again";
/// Name of a texture of an empty prompt.
pub const NOTHING_SAID: &str = "Nothing said";
/// What made the picture of a photo.
pub const A_PHOTO: &str = "photo";
/// A photo does not say how large what it shows is.
pub const NO_SCALE: &str = "How much of a surface the picture shows is not known.";

/// Where something lies along an axis.
pub fn along(ends: &[String; 2], mean: f64, deviation: f64) -> String {
    format!("{} to {} {mean:.0} ± {deviation:.0}", ends[0], ends[1])
}

/// How many photos wait for what is being made.
pub fn waiting(n: usize) -> String {
    format!("{n} waiting")
}

/// The nearest textures.
pub fn near(names: &[String]) -> String {
    format!("near {}", names.join(", "))
}

/// What was understood of words, in sentences.
pub fn said_of_words(understood: &Understood) -> Vec<String> {
    let mut said = Vec::new();
    if understood.is_about_touch() {
        let of = |word: &shagreen_core::prompt::Word| {
            let not = if word.is_denied { "not " } else { "" };
            format!("{not}{}", word.taken_for)
        };
        let words: Vec<String> = understood.words.iter().map(of).collect();
        said.push(format!("Understood: {}.", words.join(", ")));
    } else {
        said.push("Nothing was said that can be felt: any surface is as likely.".to_owned());
    }
    if !understood.unknown.is_empty() {
        said.push(format!("Not understood: {}.", understood.unknown.join(", ")));
    }
    if !understood.disputed.is_empty() {
        said.push(format!("The words disagree about {}.", understood.disputed.join(", ")));
    }
    said
}

/// The words and the picture disagree.
pub fn disputed(axes: &[String]) -> String {
    format!("The words and the picture disagree about {}.", axes.join(" and "))
}

/// What made the picture.
pub fn made_by(made_by: &str, seed: u64) -> String {
    format!("Picture by the {made_by}, seed {seed}.")
}

/// Who looked at the picture.
pub fn seen_by(eyes: &str) -> String {
    format!("The picture was judged by {eyes}; nobody rated it.")
}

/// What is noted of a texture that was made of words.
pub fn note_of_words(made_by: &str, seed: u64, prompt: &str) -> String {
    format!("Made of a prompt by the {made_by}, seed {seed}: {prompt}")
}

/// What is noted of a texture that was made of a photo.
pub fn note_of_photo(name: &str) -> String {
    format!("Placed by the photo {name}; nobody rated it.")
}

/// An earlier prompt in the menu.
pub fn earlier(prompt: &str, seed: u64, by_diffusion: bool) -> String {
    let by = if by_diffusion { " · diffusion" } else { "" };
    format!("{prompt} · seed {seed}{by}")
}

/// Accessible name of the row about a guess.
pub fn guessed(name: &str) -> String {
    format!("Guess: {name}")
}

/// It becomes what a prompt made, as it follows the word undo.
pub fn remade(name: &str) -> String {
    format!("Make {name} anew")
}
