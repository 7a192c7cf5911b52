//! Networks that predict attributes from photos.

use crate::choices::networks::NetworkChoice;

pub const TITLE: &str = "Networks for photos";
pub const MENU: &str = "Networks for photos…";
pub const MENU_HELP: &str =
    "Selects the image network, and its heads, that estimate a position from a photo or a generated picture.";
pub const COMMAND: &str = "Choose the networks for photos";
pub const PURPOSE: &str = "An image network computes features of a photo; its heads predict roughness and hardness from them. They estimate the position of photos and generated pictures.";

pub const NETWORK: &str = "Image network";
pub const FILE: &str = "File of ResNet-50";
pub const FILE_HINT: &str = "e.g. resnet50.safetensors, with the tensor names of torchvision";
pub const HEADS: &str = "File of the heads";
const HEADS_HINT: &str = "built-in; or a model from shagreen train photo";
const HEADS_NEEDED: &str = "a model from shagreen train photo --backbone";
/// Kind of file in the dialog of the system.
pub const KIND: &str = "Networks (safetensors)";

pub const USE: &str = "Use";
pub const USE_HELP: &str =
    "Reads the files, checks that they belong together, and uses them from the next photo on.";
pub const CHECKING: &str = "Reading the networks…";
pub const NO_FILE: &str = "The file of ResNet-50 is missing; give its path.";
pub const BROKEN: &str = "Reading the networks stopped unexpectedly; choose other files.";
const NOT_DOWNLOADED: &str = "EfficientNet-Lite0 is not on this computer. Download it with \"shagreen model fetch\" in a terminal (17 MB, Apache-2.0).";
const RESNET: &str =
    "ResNet-50 has no built-in heads. Train them with \"shagreen train photo --backbone FILE --out HEADS\".";
const STATISTICS: &str =
    "Without a network, the features are statistics of the picture. No other file is needed.";

pub fn name(choice: NetworkChoice) -> &'static str {
    match choice {
        NetworkChoice::EfficientnetLite0 => "EfficientNet-Lite0",
        NetworkChoice::Resnet50 => "ResNet-50",
        NetworkChoice::Statistics => "None",
    }
}

/// Hint in the field of the heads.
pub fn heads_hint(choice: NetworkChoice) -> &'static str {
    match choice {
        NetworkChoice::Resnet50 => HEADS_NEEDED,
        NetworkChoice::EfficientnetLite0 | NetworkChoice::Statistics => HEADS_HINT,
    }
}

/// Sentence about a choice; `downloaded` is the path of EfficientNet-Lite0, if it is on this computer.
pub fn note(choice: NetworkChoice, downloaded: Option<&str>) -> String {
    match (choice, downloaded) {
        (NetworkChoice::EfficientnetLite0, Some(path)) => format!("Downloaded: {path}"),
        (NetworkChoice::EfficientnetLite0, None) => NOT_DOWNLOADED.to_owned(),
        (NetworkChoice::Resnet50, _) => RESNET.to_owned(),
        (NetworkChoice::Statistics, _) => STATISTICS.to_owned(),
    }
}

/// Sentence about networks that were checked and are used now.
pub fn in_use(described: &str) -> String {
    format!("In use from the next photo on: {described}.")
}
