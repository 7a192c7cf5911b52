//! A texture on a microcontroller: a runtime table in flash, its arrays and a voice in fixed memory, no heap.
//!
//! `scripts/check-no-std` builds this crate. It fails if the renderer links `std` or `alloc`.
#![no_std]
#![forbid(unsafe_code)]

#[cfg(feature = "with-alloc")]
extern crate alloc;
#[cfg(feature = "with-std")]
extern crate std;

use core::panic::PanicInfo;

use shagreen_synth::contact::Contact;
use shagreen_synth::runtime_table::{Memory, Table};
use shagreen_synth::runtime_voice::{RuntimeVoice, Touch, VoiceSettings};
use shagreen_synth::texture::{MAX_ORDER, NO_NEIGHBOR, Node, Triangle};

/// A made-up texture with every layer.
static TABLE: &[u8] = include_bytes!("../../../../vectors/p_runtime_table/layered.shgt");

const NODE: Node = Node { level_mps2: 0.0, lsf: [0.0; MAX_ORDER] };
const TRIANGLE: Triangle =
    Triangle { nodes: [0; 3], neighbors: [NO_NEIGHBOR; 3], weights: [0.0; 6], ln_gain: [0.0; 6] };

/// Returns the highest of the first samples of a stroke, or -1 if the table cannot be played.
pub extern "C" fn highest_mps2() -> f32 {
    let Ok(table) = Table::open(TABLE) else { return -1.0 };
    let (mut nodes, mut triangles, mut samples) = ([NODE; 8], [TRIANGLE; 4], [0.0; 52]);
    let memory =
        Memory { nodes: &mut nodes, triangles: &mut triangles, excitations: &mut [], samples: &mut samples };
    let Ok(texture) = table.load(memory) else { return -1.0 };
    let settings = VoiceSettings { sample_rate_hz: 8000.0, max_mps2: 50.0, seed: 1 };
    let Ok(mut voice) = RuntimeVoice::new(&texture, table.tap(), settings) else { return -1.0 };
    voice.tap(None);
    let mut out = [0.0; 64];
    let touch = Touch { x_m: 0.0, y_m: 0.0, contact: Contact { speed_mps: 0.1, force_n: 1.0 } };
    let mut highest_mps2 = 0.0_f32;
    for _ in 0..100 {
        voice.process(&texture, &[touch], &mut out);
        highest_mps2 = out.iter().fold(highest_mps2, |highest, sample| highest.max(sample.abs()));
    }
    highest_mps2
}

#[panic_handler]
fn panic(_: &PanicInfo<'_>) -> ! {
    loop {}
}
