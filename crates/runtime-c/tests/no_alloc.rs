//! Tests that `shagreen_voice_process` and `shagreen_voice_tap` neither allocate nor free memory.
//!
//! The gate is the global allocator of this test program.

#![allow(clippy::unwrap_used, unsafe_code, reason = "tests; the functions take pointers")]

mod support;

use std::ptr;

use assert_no_alloc::{AllocDisabler, assert_no_alloc, reset_violation_count, violation_count};
use shagreen_runtime::abi::{
    ShagreenStatus, ShagreenTouch, shagreen_texture_destroy, shagreen_texture_load, shagreen_voice_create,
    shagreen_voice_destroy, shagreen_voice_process, shagreen_voice_tap,
};
use support::Exported;

#[global_allocator]
static GATE: AllocDisabler = AllocDisabler;

#[test]
fn the_gate_sees_an_allocation() {
    reset_violation_count();
    let boxed = assert_no_alloc(|| Box::new(7_u64));
    assert_eq!((violation_count(), *boxed), (1, 7));
}

#[test]
fn a_callback_allocates_nothing() {
    for exported in Exported::three() {
        let (mut texture, mut voice) = (ptr::null_mut(), ptr::null_mut());
        let table = &exported.table;
        // SAFETY: all pointers are those of references.
        let status = unsafe { shagreen_texture_load(table.as_ptr(), table.len(), &raw mut texture) };
        assert_eq!(status, ShagreenStatus::Ok);
        // SAFETY: the texture is loaded, and voice is a reference.
        let status = unsafe { shagreen_voice_create(texture, 48_000.0, 50.0, 1, &raw mut voice) };
        assert_eq!(status, ShagreenStatus::Ok);
        let mut samples = [f32::NAN; 256];
        let mut friction_n = f32::NAN;
        for i in 0..200_u16 {
            // Lifted for every tenth block, with a landing after it; invalid now and then.
            let speed_mps = if i % 37 == 36 { f32::NAN } else { 0.002 * f32::from(i) };
            let force_n = if i % 10 == 9 { 0.0 } else { 1.0 };
            let touch = ShagreenTouch { x_m: 1e-3 * f64::from(i), y_m: 0.0, speed_mps, force_n };
            samples.fill(f32::NAN);
            let start = samples.as_mut_ptr();
            reset_violation_count();
            let status = assert_no_alloc(|| {
                if i % 10 == 0 {
                    // SAFETY: the voice is made.
                    let _ = unsafe { shagreen_voice_tap(voice, 0.1) };
                }
                // SAFETY: the voice is made, and all others are references.
                unsafe { shagreen_voice_process(voice, &raw const touch, 1, start, 256, &raw mut friction_n) }
            });
            assert_eq!((violation_count(), status), (0, ShagreenStatus::Ok));
            assert!(samples.iter().all(|x| x.abs() <= 50.0) && friction_n >= 0.0);
        }
        // SAFETY: the voice is made and not used afterwards.
        unsafe { shagreen_voice_destroy(voice) };
        // SAFETY: the texture is loaded and not used afterwards.
        unsafe { shagreen_texture_destroy(texture) };
    }
}
