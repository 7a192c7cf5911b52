//! State of the window that the import sheet needs.

use shagreen_formats::library::Library;

/// Library and sample rate that the import sheet compares with.
#[derive(Clone, Copy)]
pub struct ImportContext<'a> {
    /// Library to which the textures will be added.
    pub library: &'a Library,
    /// Sample rate of the textures in the space, in Hz.
    pub space_rate_hz: f64,
}
