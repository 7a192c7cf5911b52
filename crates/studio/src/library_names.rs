//! Names and descriptions of the libraries that a project can use.

use std::borrow::Cow;

use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::ProjectLibrary;

use crate::file::shown_name;

/// Returns the name of a built-in library.
pub fn built_in_name(built_in: BuiltIn) -> &'static str {
    match built_in {
        BuiltIn::Starter => "Starter library",
        BuiltIn::Simulated => "Starter library, simulated raters",
    }
}

/// Returns the description of a built-in library, with the source of its positions.
pub fn built_in_help(built_in: BuiltIn) -> &'static str {
    match built_in {
        BuiltIn::Starter => {
            "25 everyday materials. Their positions are physical labels, computed from the model of each material."
        }
        BuiltIn::Simulated => {
            "The same materials, positioned from the sorts and ratings of SIMULATED raters. No person felt or rated them."
        }
    }
}

/// Returns the name of a library.
pub fn name(library: &ProjectLibrary) -> Cow<'_, str> {
    let named = |name: &'_ str, other: &dyn Fn() -> String| {
        if name.trim().is_empty() { other() } else { name.to_owned() }
    };
    match library {
        ProjectLibrary::BuiltIn(built_in) => built_in_name(*built_in).into(),
        ProjectLibrary::Inside(library) => named(&library.name, &|| "Unnamed library".to_owned()).into(),
        ProjectLibrary::File(file) => named(&file.library.name, &|| shown_name(&file.path)).into(),
    }
}

/// Returns the description or the path of a library.
pub fn help(library: &ProjectLibrary) -> String {
    match library {
        ProjectLibrary::BuiltIn(built_in) => built_in_help(*built_in).to_owned(),
        ProjectLibrary::Inside(_) => "This library is stored in the project file.".to_owned(),
        ProjectLibrary::File(file) => file.path.display().to_string(),
    }
}
