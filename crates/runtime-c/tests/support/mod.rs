//! Runtime tables of starter textures.

#![allow(dead_code, reason = "no test program uses all of it")]

use shagreen_core::texture::plane::{Plane, Prepared};
use shagreen_formats::library::TextureEntry;
use shagreen_formats::runtime_table::write_runtime_table;
use shagreen_formats::starter::starter_library;
use shagreen_runtime::synth::tap::Tap;

/// A texture in the form that the renderer uses, and its table.
pub(crate) struct Exported {
    pub(crate) id: String,
    pub(crate) prepared: Prepared,
    pub(crate) tap: Option<Tap>,
    pub(crate) table: Vec<u8>,
}

impl Exported {
    pub(crate) fn of(entry: &TextureEntry) -> Self {
        let prepared = Plane::new(&entry.model).prepare();
        let (tap, table) = (entry.model.tap().map(Tap::from), write_runtime_table(entry, "test").unwrap());
        Self { id: entry.id.clone(), tap, table, prepared }
    }

    /// A texture without direction, one with a lay, and one on which a tip sticks and slips.
    pub(crate) fn three() -> [Self; 3] {
        let library = starter_library().unwrap();
        let find = |is_wanted: fn(&TextureEntry) -> bool| {
            Self::of(library.textures.iter().find(|entry| is_wanted(entry)).unwrap())
        };
        [
            find(|entry| entry.model.along().is_none() && entry.model.stick_slip().is_none()),
            find(|entry| entry.model.along().is_some()),
            find(|entry| entry.model.stick_slip().is_some()),
        ]
    }
}
