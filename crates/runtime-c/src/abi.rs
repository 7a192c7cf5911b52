//! The C interface. `include/shagreen.h` is generated from this module.
//!
//! # Rules
//!
//! - Functions check every pointer for null and alignment, and every number of values. They return a status instead of
//!   panicking; a panic inside is caught and becomes [`ShagreenStatus::Internal`].
//! - Textures and voices are opaque. `load` and `create` allocate them, `destroy` frees them. A texture may be destroyed
//!   before its voices. No other function allocates.
//! - A texture may be used by any number of threads, a voice by one thread at a time.

mod textures;
mod voices;

use std::ffi::c_char;
use std::panic::{AssertUnwindSafe, catch_unwind};

use shagreen_synth::contact::Contact;
use shagreen_synth::runtime_voice::Touch;

pub use self::textures::{
    ShagreenInfo, ShagreenTexture, shagreen_texture_destroy, shagreen_texture_info, shagreen_texture_load,
    shagreen_texture_name, shagreen_texture_origin, shagreen_texture_terms,
};
pub use self::voices::{
    ShagreenVoice, shagreen_voice_create, shagreen_voice_destroy, shagreen_voice_latency_secs,
    shagreen_voice_process, shagreen_voice_reset, shagreen_voice_size_bytes, shagreen_voice_tap,
};
pub use crate::status::ShagreenStatus;

/// Version of this interface. It changes when a function, a struct or the meaning of one changes.
pub const SHAGREEN_ABI_VERSION: u32 = 1;
/// The texture has a tap transient.
pub const SHAGREEN_TEXTURE_TAP: u32 = 1;
/// The texture feels different along its lay.
pub const SHAGREEN_TEXTURE_ALONG: u32 = 2;
/// The texture has a relief.
pub const SHAGREEN_TEXTURE_RELIEF: u32 = 4;
/// The texture has a height map.
pub const SHAGREEN_TEXTURE_HEIGHT_MAP: u32 = 8;
/// The friction of the texture is known.
pub const SHAGREEN_TEXTURE_FRICTION: u32 = 16;
/// The texture must not be redistributed.
pub const SHAGREEN_TEXTURE_RESTRICTED: u32 = 32;

/// Tip at one moment. A speed or force that is negative or not finite counts as zero, and a position that is not finite as the
/// last one.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShagreenTouch {
    /// Position to the right, in m.
    pub x_m: f64,
    /// Position upwards, in m.
    pub y_m: f64,
    /// Speed over the surface, in m/s.
    pub speed_mps: f32,
    /// Normal force in N; zero while the tip is lifted.
    pub force_n: f32,
}

impl From<ShagreenTouch> for Touch {
    fn from(touch: ShagreenTouch) -> Self {
        let ShagreenTouch { x_m, y_m, speed_mps, force_n } = touch;
        Self { x_m, y_m, contact: Contact { speed_mps, force_n } }
    }
}

/// Version of the interface of this library. Compare it with `SHAGREEN_ABI_VERSION` of the header.
#[unsafe(no_mangle)]
pub extern "C" fn shagreen_abi_version() -> u32 {
    SHAGREEN_ABI_VERSION
}

/// One sentence in English about a status, in UTF-8: what is wrong, and what to do. The text is never freed.
#[unsafe(no_mangle)]
pub extern "C" fn shagreen_status_text(status: i32) -> *const c_char {
    let known = ShagreenStatus::ALL.into_iter().find(|known| *known as i32 == status);
    known.map_or(c"an unknown status", ShagreenStatus::text).as_ptr()
}

/// Runs the body of an exported function. A panic in it gives `fallback`: it must not reach a caller in another language.
fn guarded<T>(fallback: T, body: impl FnOnce() -> T) -> T {
    // What a panic leaves behind is memory-safe, and the caller learns that the object may be in any state.
    catch_unwind(AssertUnwindSafe(body)).unwrap_or(fallback)
}

/// Status of a body that ends at its first error.
fn status_of(body: impl FnOnce() -> Result<(), ShagreenStatus>) -> ShagreenStatus {
    guarded(ShagreenStatus::Internal, || body().err().unwrap_or(ShagreenStatus::Ok))
}

#[cfg(test)]
mod tests;
