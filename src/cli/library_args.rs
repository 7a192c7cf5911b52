//! The option `--library`.

use std::path::{Path, PathBuf};

use shagreen_formats::library::Library;
use shagreen_studio::library;

use crate::cli::output::Printed;

#[derive(clap::Args)]
pub(crate) struct LibraryArgs {
    /// Library file, or a folder of library files. Default: the starter library. "simulated" is the starter library
    /// with positions from the sorts and ratings of a simulated panel.
    #[arg(long, value_name = "L")]
    library: Option<PathBuf>,
}

impl LibraryArgs {
    /// Returns the file or folder that was named.
    pub(crate) fn path(&self) -> Option<&Path> {
        self.library.as_deref()
    }

    /// Loads the library and prints its warnings.
    pub(crate) fn load(&self) -> anyhow::Result<Library> {
        library::load(self.path(), &Printed)
    }
}
