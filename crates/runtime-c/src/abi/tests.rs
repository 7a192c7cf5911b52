use std::ffi::{CStr, c_char};
use std::ptr;

use shagreen_synth::contact::Contact;
use shagreen_synth::runtime_table::TableError;
use shagreen_synth::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};

use super::{
    SHAGREEN_ABI_VERSION, SHAGREEN_TEXTURE_ALONG, SHAGREEN_TEXTURE_FRICTION, SHAGREEN_TEXTURE_HEIGHT_MAP,
    SHAGREEN_TEXTURE_RELIEF, SHAGREEN_TEXTURE_RESTRICTED, SHAGREEN_TEXTURE_TAP, ShagreenInfo, ShagreenStatus,
    ShagreenTexture, ShagreenTouch, ShagreenVoice, guarded, shagreen_abi_version, shagreen_status_text,
    shagreen_texture_destroy, shagreen_texture_info, shagreen_texture_load, shagreen_texture_name,
    shagreen_texture_origin, shagreen_texture_terms, shagreen_voice_create, shagreen_voice_destroy,
    shagreen_voice_latency_secs, shagreen_voice_process, shagreen_voice_reset, shagreen_voice_size_bytes,
    shagreen_voice_tap,
};
use crate::texture::RuntimeTexture;

const TABLE: &[u8] = include_bytes!("../../../../vectors/p_runtime_table/layered.shgt");
const TOUCH: ShagreenTouch = ShagreenTouch { x_m: 0.01, y_m: 0.02, speed_mps: 0.5, force_n: 0.75 };

fn loaded(bytes: &[u8]) -> Result<*mut ShagreenTexture, ShagreenStatus> {
    let mut texture = ptr::dangling_mut();
    // SAFETY: bytes and texture are references.
    let status = unsafe { shagreen_texture_load(bytes.as_ptr(), bytes.len(), &raw mut texture) };
    assert_eq!(status == ShagreenStatus::Ok, !texture.is_null());
    if status == ShagreenStatus::Ok { Ok(texture) } else { Err(status) }
}

fn created(
    texture: *const ShagreenTexture,
    rate: f32,
    max: f32,
) -> Result<*mut ShagreenVoice, ShagreenStatus> {
    let mut voice = ptr::dangling_mut();
    // SAFETY: the texture is loaded or null, and voice is a reference.
    let status = unsafe { shagreen_voice_create(texture, rate, max, 3, &raw mut voice) };
    assert_eq!(status == ShagreenStatus::Ok, !voice.is_null());
    if status == ShagreenStatus::Ok { Ok(voice) } else { Err(status) }
}

fn processed(
    voice: *mut ShagreenVoice,
    touches: &[ShagreenTouch],
    samples: &mut [f32],
) -> (ShagreenStatus, f32) {
    let (n_touches, n_samples) = (touches.len(), samples.len());
    let mut friction_n = f32::NAN;
    // SAFETY: the voice is made or null; all others are references.
    let status = unsafe {
        shagreen_voice_process(
            voice,
            touches.as_ptr(),
            n_touches,
            samples.as_mut_ptr(),
            n_samples,
            &raw mut friction_n,
        )
    };
    (status, friction_n)
}

fn text_of(text: *const c_char) -> String {
    // SAFETY: every text of the interface ends with a NUL and outlives this function.
    unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned()
}

#[test]
fn a_texture_says_what_its_table_says() {
    let texture = loaded(TABLE).unwrap();
    let mut info = ShagreenInfo::default();
    // SAFETY: the texture is loaded, and info is a reference.
    assert_eq!(unsafe { shagreen_texture_info(texture, &raw mut info) }, ShagreenStatus::Ok);
    assert_eq!((info.rate_hz, info.speed_max_mps, info.force_max_n), (1000.0, 1.0, 1.0));
    assert_eq!((info.n_nodes, info.n_triangles), (4, 2));
    let all = SHAGREEN_TEXTURE_TAP
        | SHAGREEN_TEXTURE_ALONG
        | SHAGREEN_TEXTURE_RELIEF
        | SHAGREEN_TEXTURE_HEIGHT_MAP
        | SHAGREEN_TEXTURE_FRICTION
        | SHAGREEN_TEXTURE_RESTRICTED;
    assert_eq!(info.flags, all);
    assert_eq!(info.memory_bytes, RuntimeTexture::load(TABLE).unwrap().memory_bytes() as u64);
    // SAFETY: the texture is loaded.
    let name = unsafe { shagreen_texture_name(texture) };
    // SAFETY: the texture is loaded.
    let terms = unsafe { shagreen_texture_terms(texture) };
    // SAFETY: the texture is loaded.
    let origin = unsafe { shagreen_texture_origin(texture) };
    assert_eq!([name, terms, origin].map(text_of), ["Square °", "CC0-1.0", "Made up."]);
    // SAFETY: the texture is loaded and not used afterwards.
    unsafe { shagreen_texture_destroy(texture) };
}

/// Bit by bit, and also after the texture was freed.
#[test]
fn a_voice_plays_what_the_renderer_plays() {
    let texture = loaded(TABLE).unwrap();
    let voice = created(texture, 48_000.0, 200.0).unwrap();
    // SAFETY: the texture is loaded and not used afterwards.
    unsafe { shagreen_texture_destroy(texture) };
    let owned = RuntimeTexture::load(TABLE).unwrap();
    let settings = VoiceSettings { sample_rate_hz: 48_000.0, max_mps2: 200.0, seed: 3 };
    let mut expected_of = RuntimeVoice::new(&owned.view(), owned.tap(), settings).unwrap();
    // SAFETY: the voice is made.
    assert_eq!(unsafe { shagreen_voice_latency_secs(voice) }, expected_of.latency_secs());
    let (mut samples, mut expected) = ([f32::NAN; 300], [f32::NAN; 300]);
    let mut highest = 0.0_f32;
    for i in 0..100_u16 {
        if i == 3 {
            // SAFETY: the voice is made.
            assert_eq!(unsafe { shagreen_voice_tap(voice, 0.2) }, ShagreenStatus::Ok);
            expected_of.tap(Some(0.2));
        }
        if i == 50 {
            // SAFETY: the voice is made.
            assert_eq!(unsafe { shagreen_voice_reset(voice) }, ShagreenStatus::Ok);
            expected_of.reset();
        }
        let x_m = 1e-3 * f64::from(i);
        let touches = [ShagreenTouch { x_m, ..TOUCH }, ShagreenTouch { x_m: x_m + 5e-4, ..TOUCH }];
        assert_eq!(processed(voice, &touches, &mut samples), (ShagreenStatus::Ok, 0.4 * 0.75));
        let touches = touches.map(|ShagreenTouch { x_m, y_m, speed_mps, force_n }| Touch {
            x_m,
            y_m,
            contact: Contact { speed_mps, force_n },
        });
        expected_of.process(&owned.view(), &touches, &mut expected);
        assert_eq!(samples.map(f32::to_bits), expected.map(f32::to_bits), "block {i}");
        highest = samples.iter().fold(highest, |highest, x| highest.max(x.abs()));
    }
    assert!(highest > 0.1, "{highest}");
    // SAFETY: the voice is made and not used afterwards.
    unsafe { shagreen_voice_destroy(voice) };
}

#[test]
fn what_is_wrong_has_its_status() {
    let mut damaged = TABLE.to_vec();
    damaged[40] ^= 1;
    let mut newer = TABLE.to_vec();
    newer[4] = 9;
    for (bytes, expected) in [
        (&b"my notes"[..], ShagreenStatus::Foreign),
        (&b""[..], ShagreenStatus::Foreign),
        (&newer[..], ShagreenStatus::Version),
        (&TABLE[..99], ShagreenStatus::Incomplete),
        (&damaged[..], ShagreenStatus::Damaged),
    ] {
        assert_eq!(loaded(bytes), Err(expected));
    }
    assert_eq!(ShagreenStatus::from(TableError::Text), ShagreenStatus::Invalid);
    let texture = loaded(TABLE).unwrap();
    assert_eq!(created(texture, 999.0, 1.0), Err(ShagreenStatus::Rate));
    assert_eq!(created(texture, f32::NAN, 1.0), Err(ShagreenStatus::Rate));
    assert_eq!(created(texture, 48_000.0, 0.0), Err(ShagreenStatus::Limit));
    assert_eq!(created(ptr::null(), 48_000.0, 1.0), Err(ShagreenStatus::Pointer));
    // SAFETY: the texture is loaded and not used afterwards.
    unsafe { shagreen_texture_destroy(texture) };
}

#[test]
fn null_and_impossible_lengths_are_refused_and_silent() {
    let mut samples = [7.0; 4];
    assert_eq!(processed(ptr::null_mut(), &[TOUCH], &mut samples).0, ShagreenStatus::Pointer);
    assert_eq!(samples, [0.0; 4]);
    let texture = loaded(TABLE).unwrap();
    let voice = created(texture, 48_000.0, 1.0).unwrap();
    for (n_touches, expected) in [(1, ShagreenStatus::Pointer), (usize::MAX, ShagreenStatus::Pointer)] {
        samples = [7.0; 4];
        let start = samples.as_mut_ptr();
        // SAFETY: null touches are refused; voice and samples are valid.
        let status =
            unsafe { shagreen_voice_process(voice, ptr::null(), n_touches, start, 4, ptr::null_mut()) };
        assert_eq!((status, samples), (expected, [0.0; 4]));
    }
    // SAFETY: the number of samples is refused.
    let status = unsafe {
        shagreen_voice_process(voice, ptr::null(), 0, samples.as_mut_ptr(), usize::MAX, ptr::null_mut())
    };
    assert_eq!(status, ShagreenStatus::TooLong);
    // No samples and no touches need no memory.
    // SAFETY: the voice is made.
    let status =
        unsafe { shagreen_voice_process(voice, ptr::null(), 0, ptr::null_mut(), 0, ptr::null_mut()) };
    assert_eq!(status, ShagreenStatus::Ok);
    // SAFETY: null is refused.
    assert_eq!(unsafe { shagreen_voice_tap(ptr::null_mut(), 0.1) }, ShagreenStatus::Pointer);
    // SAFETY: null is refused.
    assert_eq!(unsafe { shagreen_voice_reset(ptr::null_mut()) }, ShagreenStatus::Pointer);
    // SAFETY: null is refused.
    assert!(unsafe { shagreen_voice_latency_secs(ptr::null()) }.is_nan());
    // SAFETY: null is refused.
    assert!(unsafe { shagreen_texture_name(ptr::null()) }.is_null());
    // SAFETY: null is refused.
    assert_eq!(unsafe { shagreen_texture_info(texture, ptr::null_mut()) }, ShagreenStatus::Pointer);
    // SAFETY: null is refused.
    let status = unsafe { shagreen_texture_load(TABLE.as_ptr(), TABLE.len(), ptr::null_mut()) };
    assert_eq!(status, ShagreenStatus::Pointer);
    // SAFETY: null is ignored.
    unsafe { shagreen_texture_destroy(ptr::null_mut()) };
    // SAFETY: null is ignored.
    unsafe { shagreen_voice_destroy(ptr::null_mut()) };
    // SAFETY: the voice is made and not used afterwards.
    unsafe { shagreen_voice_destroy(voice) };
    // SAFETY: the texture is loaded and not used afterwards.
    unsafe { shagreen_texture_destroy(texture) };
}

#[test]
fn a_panic_ends_at_the_interface() {
    assert_eq!(guarded(ShagreenStatus::Internal, || panic!("a planted fault")), ShagreenStatus::Internal);
    assert_eq!(guarded(1, || 2), 2);
}

#[test]
fn every_status_says_what_to_do() {
    for (number, status) in ShagreenStatus::ALL.into_iter().enumerate() {
        assert_eq!(status as usize, number);
        let text = text_of(shagreen_status_text(status as i32));
        assert!(status == ShagreenStatus::Ok || text.contains("; "), "{text}");
    }
    for unknown in [-1, 12, i32::MAX] {
        assert_eq!(text_of(shagreen_status_text(unknown)), "an unknown status");
    }
    assert_eq!(shagreen_abi_version(), SHAGREEN_ABI_VERSION);
    assert!((10_000..21_000).contains(&shagreen_voice_size_bytes()));
}

#[test]
fn structs_have_no_padding() {
    assert_eq!(size_of::<ShagreenTouch>(), 2 * size_of::<f64>() + 2 * size_of::<f32>());
    assert_eq!(size_of::<ShagreenInfo>(), size_of::<u64>() + 6 * size_of::<u32>());
}
