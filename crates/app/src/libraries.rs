//! Libraries that a project can be made of, in words.

use std::borrow::Cow;

use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::project::ProjectLibrary;

use crate::strings;

/// The name of a library of the program.
pub fn built_in_name(built_in: BuiltIn) -> &'static str {
    match built_in {
        BuiltIn::Starter => strings::STARTER,
        BuiltIn::Simulated => strings::SIMULATED,
    }
}

/// What a library of the program is, and whom its places come from.
pub fn built_in_help(built_in: BuiltIn) -> &'static str {
    match built_in {
        BuiltIn::Starter => strings::STARTER_HELP,
        BuiltIn::Simulated => strings::SIMULATED_HELP,
    }
}

/// The name of a library.
pub fn name(library: &ProjectLibrary) -> Cow<'_, str> {
    let named = |name: &'_ str, other: &dyn Fn() -> String| {
        if name.trim().is_empty() { other() } else { name.to_owned() }
    };
    match library {
        ProjectLibrary::BuiltIn(built_in) => built_in_name(*built_in).into(),
        ProjectLibrary::Inside(library) => {
            named(&library.name, &|| strings::UNNAMED_LIBRARY.to_owned()).into()
        }
        ProjectLibrary::File(file) => {
            let of_file =
                || file.path.file_name().unwrap_or(file.path.as_os_str()).to_string_lossy().into_owned();
            named(&file.library.name, &of_file).into()
        }
    }
}

/// What a library is and where.
pub fn help(library: &ProjectLibrary) -> String {
    match library {
        ProjectLibrary::BuiltIn(built_in) => built_in_help(*built_in).to_owned(),
        ProjectLibrary::Inside(_) => strings::INSIDE_HELP.to_owned(),
        ProjectLibrary::File(file) => file.path.display().to_string(),
    }
}
