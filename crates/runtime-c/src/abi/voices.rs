//! Voices of the C interface.

use std::ptr;
use std::sync::Arc;

use shagreen_synth::runtime_voice::{RuntimeVoice, VoiceSettings};

use super::{ShagreenStatus, ShagreenTexture, ShagreenTouch, guarded, status_of};
use crate::pointers::{exclusive, items, items_mut, shared};
use crate::texture::RuntimeTexture;

/// A texture under one tip. One thread at a time may use it. It stays valid when its texture is freed.
#[derive(Debug)]
pub struct ShagreenVoice {
    texture: Arc<RuntimeTexture>,
    voice: RuntimeVoice,
}

/// Memory of a voice in bytes, without its texture.
#[unsafe(no_mangle)]
pub extern "C" fn shagreen_voice_size_bytes() -> usize {
    size_of::<ShagreenVoice>()
}

/// Makes a voice: a lifted tip on a texture. On an error, `voice` becomes null.
///
/// `sample_rate_hz` is at least the rate of the texture. No sample is above `max_mps2` in m/s², and those above four fifths of
/// it are attenuated. The same `seed` gives the same noise. The function allocates memory, so no audio callback may call it.
///
/// # Safety
/// `texture` comes from `shagreen_texture_load` and is not freed. `voice` points to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_create(
    texture: *const ShagreenTexture,
    sample_rate_hz: f32,
    max_mps2: f32,
    seed: u64,
    voice: *mut *mut ShagreenVoice,
) -> ShagreenStatus {
    status_of(|| {
        // SAFETY: the caller promises it.
        let made = unsafe { exclusive(voice) }.ok_or(ShagreenStatus::Pointer)?;
        *made = ptr::null_mut();
        // SAFETY: the caller promises it.
        let texture = unsafe { shared(texture) }.ok_or(ShagreenStatus::Pointer)?;
        let texture = Arc::clone(&texture.texture);
        let settings = VoiceSettings { sample_rate_hz, max_mps2, seed };
        let voice = RuntimeVoice::new(&texture.view(), texture.tap(), settings)?;
        *made = Box::into_raw(Box::new(ShagreenVoice { texture, voice }));
        Ok(())
    })
}

/// Frees a voice; null is ignored. No audio callback may call the function.
///
/// # Safety
/// `voice` is null, or comes from `shagreen_voice_create` and was not freed before.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_destroy(voice: *mut ShagreenVoice) {
    guarded((), || {
        if !voice.is_null() {
            // SAFETY: the caller promises that the pointer is one of `Box::into_raw`, and that nobody uses it any more.
            drop(unsafe { Box::from_raw(voice) });
        }
    });
}

/// Fills `samples` with the next accelerations in m/s². On an error they are all zero.
///
/// The touches are evenly spaced over the block, and the last one is reached at its last sample. With `n_touches` 0, the tip
/// stays. `friction_n` may be null; otherwise it becomes the kinetic friction force in N at the last touch, zero for a
/// texture whose friction is not known. The function neither allocates nor waits, so an audio callback may call it.
///
/// # Safety
/// `voice` comes from `shagreen_voice_create` and is not freed. `touches` points to `n_touches` structs, `samples` to
/// `n_samples` floats, and they do not overlap. No other function uses the voice at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_process(
    voice: *mut ShagreenVoice,
    touches: *const ShagreenTouch,
    n_touches: usize,
    samples: *mut f32,
    n_samples: usize,
    friction_n: *mut f32,
) -> ShagreenStatus {
    let status = status_of(|| {
        // SAFETY: the caller promises it.
        let samples = unsafe { items_mut(samples, n_samples) }?;
        // SAFETY: the caller promises it.
        let touches = unsafe { items(touches, n_touches) }?;
        // SAFETY: the caller promises it.
        let ShagreenVoice { texture, voice } = unsafe { exclusive(voice) }.ok_or(ShagreenStatus::Pointer)?;
        let texture = texture.view();
        voice.process(&texture, touches, samples);
        if !friction_n.is_null() {
            // SAFETY: the caller promises it.
            *unsafe { exclusive(friction_n) }.ok_or(ShagreenStatus::Pointer)? = voice.friction_n(&texture);
        }
        if voice.is_tripped() { Err(ShagreenStatus::Silenced) } else { Ok(()) }
    });
    if status != ShagreenStatus::Ok {
        // SAFETY: the caller promises it, and the body above has ended.
        let samples = unsafe { items_mut(samples, n_samples) };
        samples.unwrap_or_default().fill(0.0);
    }
    status
}

/// Starts the tap transient of the texture with the next sample, for a tip that lands at `impact_mps` in m/s; NaN if that is
/// not known. A texture without a tap transient stays silent.
///
/// # Safety
/// `voice` comes from `shagreen_voice_create` and is not freed. No other function uses it at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_tap(voice: *mut ShagreenVoice, impact_mps: f32) -> ShagreenStatus {
    status_of(|| {
        // SAFETY: the caller promises it.
        let voice = unsafe { exclusive(voice) }.ok_or(ShagreenStatus::Pointer)?;
        voice.voice.tap(Some(impact_mps));
        Ok(())
    })
}

/// Returns a voice to the state in which it was made, with the same noise. It takes about as long as to make one.
///
/// # Safety
/// `voice` comes from `shagreen_voice_create` and is not freed. No other function uses it at the same time.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_reset(voice: *mut ShagreenVoice) -> ShagreenStatus {
    status_of(|| {
        // SAFETY: the caller promises it.
        let voice = unsafe { exclusive(voice) }.ok_or(ShagreenStatus::Pointer)?;
        voice.voice.reset();
        Ok(())
    })
}

/// Delay in s from a touch to the middle of its ramp in the samples, beside the time until its block; NaN for a null pointer.
///
/// # Safety
/// `voice` is null, or comes from `shagreen_voice_create` and is not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn shagreen_voice_latency_secs(voice: *const ShagreenVoice) -> f32 {
    guarded(f32::NAN, || {
        // SAFETY: the caller promises it.
        let voice = unsafe { shared(voice) };
        voice.map_or(f32::NAN, |voice| voice.voice.latency_secs())
    })
}
