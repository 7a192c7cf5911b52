//! Relief playback through the whole engine.

use shagreen_synth::renderer::Mix;

use super::{CONFIG, HAND, new, peak, play};
use crate::controls::Input;
use crate::hand::{Hand, Path};
use crate::texture::tests::wavy;

/// A stroke at 64 mm/s over waves of 0.64 mm gives 100 Hz for every block size. There is no click at a change or
/// reversal of the stroke, and a lifted tip is silent.
#[test]
fn a_relief_is_played_by_place() {
    let run = |block: usize| {
        let (mut handle, mut engine) = new(CONFIG).unwrap();
        let id = handle.load(wavy()).unwrap();
        handle.set_mix(Mix::solo(id)).unwrap();
        let mut out = Vec::new();
        let hand = Hand { speed_mps: 0.064, force_n: 1.0, ..HAND };
        for input in [Input::Hand(hand), Input::Lifted, Input::Hand(Hand { path: Path::Circle, ..hand })] {
            handle.set_input(input);
            out.extend(play(&mut engine, 96_000, block));
        }
        out
    };
    let whole = run(960);
    assert!(run(257) == whole);
    let steady = &whole[4800..33_600];
    let part = |of: fn(f64) -> f64| -> f64 {
        let turn = |i: usize| std::f64::consts::TAU * 100.0 * i as f64 / 48e3;
        steady.iter().enumerate().map(|(i, x)| of(turn(i)) * f64::from(*x)).sum::<f64>() / steady.len() as f64
    };
    let power = steady.iter().map(|x| f64::from(*x).powi(2)).sum::<f64>() / steady.len() as f64;
    let tone = 2.0 * (part(f64::sin).powi(2) + part(f64::cos).powi(2));
    assert!(power > 1e-4 && tone > 0.95 * power, "{tone} of {power} is at 100 Hz");
    assert!(
        peak(&whole[110_000..192_000]) < 1e-6,
        "peak of {} with a lifted tip",
        peak(&whole[110_000..192_000])
    );
    let steepest = |x: &[f32]| x.windows(2).map(|pair| (pair[1] - pair[0]).abs()).fold(0.0, f32::max);
    assert!(steepest(&whole) < 2.0 * steepest(steady), "{} of {}", steepest(&whole), steepest(steady));
}
