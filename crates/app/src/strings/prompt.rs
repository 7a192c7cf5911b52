//! Prompt box, and textures generated from prompts and photos.

use shagreen_core::surfaces::prompt::{PromptInterpretation, Word};

use crate::strings::sentence;

pub const HINT: &str = "Describe a surface: a rough, soft carpet";
pub const FIELD: &str = "Describe a surface";
pub const FIELD_HELP: &str = "Generates a texture from the description (Enter): a picture, an estimated position in the space, and after some seconds a texture that feels as the picture looks. A photo dropped on the window gives a texture, too.";
pub const MAKE: &str = "Generate";
pub const MAKE_HELP: &str =
    "Generates a texture from this description. You can then refine it with the sliders.";
pub const STOP: &str = "Stop";
pub const SIMULATING: &str = "Simulating";
pub const SIMULATING_HELP: &str = "Strokes the surface of the picture with a simulated pen. Until this is done, the texture is interpolated. Afterwards it feels as its picture looks.";
pub const STOP_SIMULATION: &str = "Stop simulating";
pub const STOP_SIMULATION_HELP: &str = "The texture remains interpolated.";
pub const SIMULATED: &str =
    "The texture is simulated from the heights that the picture shows. The list of textures has it, too.";
pub const SIMULATION_BROKEN_OFF: &str =
    "The simulation of a texture stopped unexpectedly; the texture remains interpolated";
pub const ANOTHER: &str = "Another";
pub const ANOTHER_HELP: &str =
    "Generates another picture and texture from the same description, with the next seed";
pub const EARLIER: &str = "History";
pub const EARLIER_HELP: &str = "Earlier descriptions with their seeds. The same seed gives the same texture.";
pub const NO_EARLIER: &str = "No earlier descriptions";
pub const DISMISS: &str = "Close the estimate";
pub const PROCEDURAL: &str = "Procedural";
pub const DIFFUSION: &str = "Diffusion";
pub const GENERATOR_HELP: &str = "Generator of the picture. The built-in procedural generator takes about a second; the installed diffusion model takes minutes to hours on a CPU.";
pub const NO_DIFFUSION: &str =
    "This entry needs a diffusion model, and none is installed. Install one with \"shagreen model add\".";
pub const BROKEN_OFF: &str = "Generating stopped unexpectedly; try another description";
pub const NO_MODELS: &str = "this system has no folder for models; use the procedural generator";
pub const STILL_BUSY: &str =
    "Another texture is still being generated: wait for it, or press Stop. Then generate again.";
pub const OTHER_AXES: &str = "The axes changed while the texture was generated. Generate it again.";
pub const NOTHING_SAID: &str = "No description";
pub const A_PHOTO: &str = "photo";
/// Words of the lexicon about temperature, which no output of Shagreen renders.
const TEMPERATURES: [&str; 4] = ["warm", "cold", "hot", "icy"];
const NO_TEMPERATURE: &str = "Temperature is not rendered: words such as warm or cold change only roughness, hardness and pleasantness.";
pub const NO_SCALE: &str = "The physical width of the picture is not known.";
pub const BY_WORDS: &str = "Position estimated from the words; nobody rated it.";
pub const LOOKS_LIKE: &str = "Looks like";
pub const NO_ENTRY: &str = "The lexicon has no estimates for this material.";
pub const UNTAKE_HELP: &str = "Moves the point back to the estimate from the picture.";

pub const UNTOLD_HELP: &str = "Neither the words nor the picture say anything of these axes. The point lies at the mean of the textures near it on the other axes.";

/// Estimated position along an axis: the word at its upper end, mean and standard deviation.
pub fn along([low, high]: &[String; 2], mean: f64, deviation: f64) -> String {
    let word = if high.is_empty() { format!("not {low}") } else { high.clone() };
    format!("{word} {mean:.0} ± {deviation:.0}")
}

/// Number of photos in the queue.
pub fn waiting(n: usize) -> String {
    if n == 1 { "1 photo waiting".to_owned() } else { format!("{n} photos waiting") }
}

/// List of the nearest textures.
pub fn near(names: &[String]) -> String {
    format!("near {}", names.join(", "))
}

/// Sentences about the words of a prompt: understood, unknown and contradictory ones.
pub fn said_of_words(understood: &PromptInterpretation) -> Vec<String> {
    let mut said = Vec::new();
    if understood.is_about_touch() {
        let of = |word: &Word| {
            let not = if word.is_denied { "not " } else { "" };
            // "deep" counts as "dark": without the word of the prompt, it would be in neither list.
            let typed =
                if word.text == word.taken_for { String::new() } else { format!(" (\"{}\")", word.text) };
            format!("{not}{}{typed}", word.taken_for)
        };
        let words: Vec<String> = understood.words.iter().map(of).collect();
        said.push(format!("Understood: {}.", words.join(", ")));
    } else {
        said.push("No word describes how a surface feels: any surface is equally likely.".to_owned());
    }
    let felt_warm = |word: &Word| TEMPERATURES.contains(&word.taken_for.as_str());
    if understood.words.iter().any(felt_warm) {
        said.push(NO_TEMPERATURE.to_owned());
    }
    if !understood.unknown.is_empty() {
        said.push(format!("Not understood: {}.", understood.unknown.join(", ")));
    }
    if !understood.disputed.is_empty() {
        said.push(format!("The words contradict each other about {}.", understood.disputed.join(", ")));
    }
    said
}

/// Sentence about the axes on which description and picture disagree.
pub fn disputed(axes: &[String]) -> String {
    format!("Estimates from the words and from the picture disagree about {}.", axes.join(" and "))
}

/// Sentence about the axes on which a procedural picture, which was made from the words, looks different.
pub fn picture_differs(axes: &[String]) -> String {
    format!("The picture looks different about {}; the position is that of the words.", axes.join(" and "))
}

/// Sentence about the generator of the picture.
pub fn made_by(made_by: &str, seed: u64) -> String {
    format!("Picture: {made_by}, seed {seed}.")
}

/// Sentence about the model that estimated the position from the picture.
pub fn seen_by(eyes: &str) -> String {
    format!("Position estimated from the picture by {eyes}; nobody rated it.")
}

/// Sentence about the sources of a position that was estimated from words and from an independent picture.
pub fn seen_with_words(eyes: &str) -> String {
    format!("Position estimated from the words, and from the picture by {eyes}; nobody rated it.")
}

/// Sentence about a doubt about the picture.
pub fn doubt(text: &str) -> String {
    format!("{}.", sentence(text))
}

/// Sentence about the source of a position that the user has taken from the lexicon.
pub fn by_material(material: &str) -> String {
    format!("Position of {material} in the lexicon, an estimate of the authors; nobody rated it.")
}

/// What a click on a likely material does.
pub fn take_help(material: &str) -> String {
    format!("Moves the point to the lexicon's estimate of {material}, instead of the one from the picture.")
}

/// Note of a texture that was generated from a prompt.
pub fn note_of_words(made_by: &str, seed: u64, prompt: &str) -> String {
    format!("Generated from a prompt by the {made_by}, seed {seed}: {prompt}")
}

/// Note of a texture that was made from a photo, and from words if there were any.
pub fn note_of_photo(name: &str, prompt: Option<&str>) -> String {
    match prompt {
        None => format!("Position estimated from the photo {name}; nobody rated it."),
        Some(prompt) => {
            format!("Position estimated from the photo {name} and the words \"{prompt}\"; nobody rated it.")
        }
    }
}

/// Note of a texture at the position of a material that its photo is likely to show.
pub fn note_of_material_in_photo(name: &str, material: &str) -> String {
    format!("Photo {name}. {}", by_material(material))
}

/// Menu entry of an earlier prompt.
pub fn earlier(prompt: &str, seed: u64, by_diffusion: bool) -> String {
    let by = if by_diffusion { " · diffusion" } else { "" };
    format!("{prompt} · seed {seed}{by}")
}

/// Accessible name of the row with an estimate.
pub fn guessed(name: &str) -> String {
    format!("Estimate: {name}")
}

/// Name of the edit that adds the simulated texture of a picture.
pub fn simulated(name: &str) -> String {
    format!("Simulate {name}")
}

/// Name of the edit that takes the lexicon entry of a material, or again the estimate from the picture.
pub fn took(name: &str, material: Option<&str>) -> String {
    match material {
        Some(material) => format!("Move {name} to {material}"),
        None => format!("Move {name} to estimate from picture"),
    }
}

/// Name of the edit that replaces a generated texture.
pub fn remade(name: &str) -> String {
    format!("Regenerate {name}")
}

#[cfg(test)]
mod tests {
    use super::said_of_words;
    use shagreen_core::surfaces::prompt::interpret;
    use shagreen_formats::lexicon_toml::built_in_lexicon;

    #[test]
    fn every_word_that_counts_is_named_as_it_was_typed() {
        let said = said_of_words(&interpret("deep velvet", built_in_lexicon().unwrap()));
        assert_eq!(said, ["Understood: dark (\"deep\"), velvet."]);
    }
}
