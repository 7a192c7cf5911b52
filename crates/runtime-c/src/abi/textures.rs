//! Textures of the C interface.

use std::ffi::{CStr, c_char};
use std::ptr;
use std::sync::Arc;

use super::{
    SHAGREEN_TEXTURE_ALONG, SHAGREEN_TEXTURE_FRICTION, SHAGREEN_TEXTURE_HEIGHT_MAP, SHAGREEN_TEXTURE_RELIEF,
    SHAGREEN_TEXTURE_RESTRICTED, SHAGREEN_TEXTURE_TAP, ShagreenStatus, guarded, status_of,
};
use crate::pointers::{exclusive, items, shared};
use crate::texture::RuntimeTexture;

/// A texture in memory. Any number of threads may use it at the same time, until it is freed.
#[derive(Debug)]
pub struct ShagreenTexture {
    pub(super) texture: Arc<RuntimeTexture>,
}

/// Numbers of a texture.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ShagreenInfo {
    /// Memory that the texture takes, in bytes.
    pub memory_bytes: u64,
    /// Sample rate of the texture model, in Hz. It is the lowest sample rate of a voice.
    pub rate_hz: f32,
    /// Speed in m/s above which the texture no longer changes.
    pub speed_max_mps: f32,
    /// Normal force in N above which the texture no longer changes.
    pub force_max_n: f32,
    /// Nodes over speed and force, across the lay.
    pub n_nodes: u32,
    /// Triangles between the nodes.
    pub n_triangles: u32,
    /// Properties of the texture: the sum of values such as `SHAGREEN_TEXTURE_TAP`.
    pub flags: u32,
}

/// Loads a texture from the bytes of a runtime table, which are not needed afterwards. On an error, `texture` becomes null. The
/// function allocates memory, so no audio callback may call it.
///
/// # Safety
/// `bytes` points to `n_bytes` bytes, and `texture` to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_load(
    bytes: *const u8,
    n_bytes: usize,
    texture: *mut *mut ShagreenTexture,
) -> ShagreenStatus {
    status_of(|| {
        // SAFETY: the caller promises it.
        let texture = unsafe { exclusive(texture) }.ok_or(ShagreenStatus::Pointer)?;
        *texture = ptr::null_mut();
        // SAFETY: the caller promises it.
        let bytes = unsafe { items(bytes, n_bytes) }?;
        let loaded = ShagreenTexture { texture: Arc::new(RuntimeTexture::load(bytes)?) };
        *texture = Box::into_raw(Box::new(loaded));
        Ok(())
    })
}

/// Frees a texture; null is ignored. Voices of the texture stay valid. No audio callback may call the function.
///
/// # Safety
/// `texture` is null, or comes from `shagreen_texture_load` and was not freed before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_destroy(texture: *mut ShagreenTexture) {
    guarded((), || {
        if !texture.is_null() {
            // SAFETY: the caller promises that the pointer is one of `Box::into_raw`, and that nobody uses it any more.
            drop(unsafe { Box::from_raw(texture) });
        }
    });
}

/// Writes the numbers of a texture.
///
/// # Safety
/// `texture` comes from `shagreen_texture_load` and is not freed. `info` points to a struct.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_info(
    texture: *const ShagreenTexture,
    info: *mut ShagreenInfo,
) -> ShagreenStatus {
    status_of(|| {
        // SAFETY: the caller promises it.
        let texture = unsafe { shared(texture) }.ok_or(ShagreenStatus::Pointer)?;
        // SAFETY: the caller promises it.
        let info = unsafe { exclusive(info) }.ok_or(ShagreenStatus::Pointer)?;
        *info = info_of(&texture.texture);
        Ok(())
    })
}

/// Name of a texture in UTF-8; null for a null pointer. The text is valid until the texture is freed.
///
/// # Safety
/// `texture` is null, or comes from `shagreen_texture_load` and is not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_name(texture: *const ShagreenTexture) -> *const c_char {
    // SAFETY: the caller promises it.
    unsafe { text(texture, RuntimeTexture::name) }
}

/// Terms of use of a texture in UTF-8; empty if they are not known, null for a null pointer. The text is valid until the
/// texture is freed.
///
/// # Safety
/// `texture` is null, or comes from `shagreen_texture_load` and is not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_terms(texture: *const ShagreenTexture) -> *const c_char {
    // SAFETY: the caller promises it.
    unsafe { text(texture, RuntimeTexture::terms) }
}

/// Origin of a texture in UTF-8; empty if it is not known, null for a null pointer. The text is valid until the texture is
/// freed.
///
/// # Safety
/// `texture` is null, or comes from `shagreen_texture_load` and is not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_texture_origin(texture: *const ShagreenTexture) -> *const c_char {
    // SAFETY: the caller promises it.
    unsafe { text(texture, RuntimeTexture::origin) }
}

/// Returns a text of a texture; null for a null pointer.
///
/// # Safety
/// The pointer is null or misaligned, or that of a texture.
unsafe fn text(texture: *const ShagreenTexture, of: fn(&RuntimeTexture) -> &CStr) -> *const c_char {
    guarded(ptr::null(), || {
        // SAFETY: the caller promises it.
        let texture = unsafe { shared(texture) };
        texture.map_or(ptr::null(), |texture| of(&texture.texture).as_ptr())
    })
}

fn info_of(texture: &RuntimeTexture) -> ShagreenInfo {
    let parts = texture.view().parts();
    let flags = [
        (texture.tap().is_some(), SHAGREEN_TEXTURE_TAP),
        (parts.along.is_some(), SHAGREEN_TEXTURE_ALONG),
        (parts.relief.is_some(), SHAGREEN_TEXTURE_RELIEF),
        (parts.height_map.is_some(), SHAGREEN_TEXTURE_HEIGHT_MAP),
        (parts.friction.is_some(), SHAGREEN_TEXTURE_FRICTION),
        (texture.is_restricted(), SHAGREEN_TEXTURE_RESTRICTED),
    ];
    ShagreenInfo {
        memory_bytes: texture.memory_bytes() as u64,
        rate_hz: parts.rate_hz,
        speed_max_mps: parts.speed_max_mps,
        force_max_n: parts.force_max_n,
        n_nodes: parts.nodes.len() as u32,
        n_triangles: parts.triangles.len() as u32,
        flags: flags.into_iter().filter_map(|(has_it, flag)| has_it.then_some(flag)).sum(),
    }
}
