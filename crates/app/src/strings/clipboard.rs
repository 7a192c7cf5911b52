//! Copying authored textures to the clipboard, and pasting them.

pub const COPY: &str = "Copy";
pub const COPY_HELP: &str =
    "Copies this texture to the clipboard, as text. It can be pasted into another project.";
pub const CUT: &str = "Cut";
pub const CUT_HELP: &str = "Copies this texture to the clipboard and deletes it here.";
pub const PASTE: &str = "Paste";
pub const PASTE_HELP: &str = "Adds the authored texture on the clipboard at its position.";
pub const CANNOT_CUT: &str =
    "Copied, but not deleted: a project needs at least one authored texture. Add another one first.";

pub fn copied(name: &str) -> String {
    format!("Copied {name}")
}

pub fn pasted(name: &str) -> String {
    format!("Pasted {name}")
}

/// Warning that the position was chosen in another space, named by its library and its axes.
pub fn from_another_space(library: &str, axes: &[[String; 2]]) -> String {
    let names: Vec<String> = axes.iter().map(|[low, high]| format!("{low} to {high}")).collect();
    let names = match &names[..] {
        [first @ .., last] if !first.is_empty() => format!("axes {} and {last}", first.join(", ")),
        names => format!("axis {}", names.join("")),
    };
    format!(
        "its position was chosen in another space (library {library}, {names}), so it may feel different here"
    )
}

/// Warning that the library has no textures of these names, which were pinned.
pub fn not_pinned(names: &[String]) -> String {
    format!("not pinned, because this library lacks them: {}", names.join(", "))
}
