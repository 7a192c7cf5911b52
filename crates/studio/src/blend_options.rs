//! Interpolation options of a user, checked against a library.

use anyhow::{Context as _, bail};
use shagreen_core::space::authoring::{Blending, Outside, Weights};
use shagreen_core::texture::blend::Mode;
use shagreen_formats::library::Library;

use crate::near_names::unknown_texture;
use crate::report::Reporter;

/// Interpolation options, with pinned textures by their identifiers.
#[derive(Clone, Copy, Debug, Default)]
pub struct BlendOptions<'a> {
    /// Interpolation mode.
    pub mode: Mode,
    /// Weighting of the textures.
    pub weights: Weights,
    /// Behavior outside the convex hull.
    pub outside: Outside,
    /// Identifiers of pinned textures.
    pub pinned: &'a [String],
}

impl BlendOptions<'_> {
    /// Returns the interpolation options for a library. Pinned textures that share a position are reported.
    ///
    /// # Errors
    /// A pinned texture is not in the library or has no position, or the mode does not support the options or the number of
    /// axes.
    pub fn in_library(&self, library: &Library, reporter: &dyn Reporter) -> anyhow::Result<Blending> {
        let index = |id: &String| {
            let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
            if library.textures[index].place.is_none() {
                bail!(
                    "\"{id}\" has no position in the space and cannot be pinned; assign one with `shagreen space place`"
                );
            }
            Ok(index)
        };
        let blending = Blending {
            mode: self.mode,
            weights: self.weights,
            outside: self.outside,
            locked: self.pinned.iter().map(index).collect::<anyhow::Result<_>>()?,
        };
        blending.check_in(library.axis_names().len())?;
        warn_of_hidden_locks(library, &blending.locked, reporter);
        Ok(blending)
    }
}

/// Warns of pinned textures that share a position: the field passes only through the first.
fn warn_of_hidden_locks(library: &Library, locked: &[usize], reporter: &dyn Reporter) {
    for (i, later) in locked.iter().enumerate() {
        let at = library.textures[*later].at();
        let first =
            locked[..i].iter().find(|first| **first != *later && library.textures[**first].at() == at);
        if let Some(first) = first {
            let [first, later] = [first, later].map(|texture| library.textures[*texture].id.as_str());
            reporter.warn(&format!(
                "\"{first}\" and \"{later}\" have the same position: the field passes only through \"{first}\"; pin only one of them"
            ));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::BlendOptions;
    use crate::report::Warnings;
    use shagreen_core::texture::blend::Mode;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn pins_are_found_checked_and_reported_where_they_hide_each_other() {
        let mut library = starter_library().unwrap();
        library.textures[1].place = library.textures[0].place;
        library.textures[2].place = None;
        let id = |index: usize| library.textures[index].id.clone();
        let made = |mode: Mode, pinned: &[String]| {
            let reporter = Warnings::default();
            let options = BlendOptions { mode, pinned, ..BlendOptions::default() };
            (options.in_library(&library, &reporter), reporter.into_vec())
        };
        let (blending, warnings) = made(Mode::Field, &[id(0), id(3)]);
        assert!(blending.unwrap().locked == [0, 3] && warnings.is_empty());
        assert!(made(Mode::Field, &[id(0), id(1)]).1[0].contains("have the same position"));
        for (mode, pinned, words) in [
            (Mode::Field, id(2), "has no position"),
            (Mode::Field, "crok".to_owned(), "did you mean cork?"),
            (Mode::Shared, id(0), "only in mode field"),
        ] {
            let error = made(mode, &[pinned]).0.unwrap_err().to_string();
            assert!(error.contains(words), "{error}");
        }
    }
}
