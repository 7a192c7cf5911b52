//! Jumps of the level within a recording, such as a changed gain: neighboring segments are estimated together, so that nothing
//! else would show them.

use crate::recording::fit::pieces::Piece;

/// Largest difference in dB between the levels before and after a moment that is no jump. So much can have other reasons:
/// - The standard error of a level from [`LEAST_SECS`] of signal is about 0.6 dB, so that two of them differ by up to 2.6 dB,
///   three standard errors.
/// - The exponents of speed and force differ by about a quarter within a real texture, which makes up to 0.9 dB each over the
///   factor [`LIKE`].
///
/// A gain that is changed by a factor of two makes 6 dB.
const JUMP_DB: f64 = 5.0;

/// Time before and after a moment in which levels are averaged, in seconds: a few back-and-forth strokes, which have the same
/// speeds on both sides.
const SIDE_SECS: f64 = 4.0;
/// Least duration of the segments on each side, in seconds.
const LEAST_SECS: f64 = 1.0;
/// Largest ratio of the mean speeds of both sides, and of their mean forces, at which they are compared.
const LIKE: f64 = 1.5;

/// A jump of the level at like speed and force.
#[derive(Clone, Copy, Debug, PartialEq)]
struct LevelJump {
    /// Index of the recording.
    recording: usize,
    /// Start of the first segment after the jump, in seconds.
    at_secs: f64,
    /// Level after the jump relative to that before it, at the same speed and force, in dB.
    difference_db: f64,
    /// Geometric mean of the speeds of both sides, in m/s.
    speed_mps: f64,
    /// Geometric mean of the forces of both sides, in N.
    force_n: f64,
}

/// Returns the largest jump of the level above [`JUMP_DB`] between neighboring segments, in the order of their recordings and
/// times. `exponents` are those of speed and force in the power law of the levels, by which levels are compared at the same
/// speed and force.
fn largest_jump(pieces: &[Piece], exponents: [f64; 2]) -> Option<LevelJump> {
    let jumps = (1..pieces.len()).filter_map(|index| jump_at(pieces, index, exponents));
    let jump = jumps.max_by(|a, b| a.difference_db.abs().total_cmp(&b.difference_db.abs()))?;
    (jump.difference_db.abs() > JUMP_DB).then_some(jump)
}

/// Sentence about the largest jump, if there is one.
pub(super) fn note(pieces: &[Piece], exponents: [f64; 2], n_recordings: usize) -> Option<String> {
    let jump = largest_jump(pieces, exponents)?;
    let LevelJump { recording, at_secs, difference_db, speed_mps, force_n } = jump;
    let of = if n_recordings > 1 { format!(" of recording {}", recording + 1) } else { String::new() };
    let direction = if difference_db > 0.0 { "rises" } else { "falls" };
    Some(format!(
        "The level {direction} by {:.1} dB near {at_secs:.1} s{of}, at about the same speed ({:.0} mm/s) and force ({force_n:.1} N); \
         both parts were fitted together. Check the gain of the sensor and the surface, and import the parts as separate files \
         if they differ.",
        difference_db.abs(),
        1e3 * speed_mps
    ))
}

/// Means of the logarithms of speed, force and level over segments, weighted by their durations.
struct Side([f64; 3]);

impl Side {
    /// `None` if the segments are shorter than [`LEAST_SECS`] together.
    fn of(pieces: &mut dyn Iterator<Item = &Piece>) -> Option<Self> {
        let (mut sums, mut seconds) = ([0.0; 3], 0.0);
        for piece in pieces {
            let logs = [piece.speed_mps.ln(), piece.force_n.ln(), 0.5 * piece.mean_square.ln()];
            for (sum, log) in sums.iter_mut().zip(logs) {
                *sum += piece.seconds * log;
            }
            seconds += piece.seconds;
        }
        (seconds >= LEAST_SECS).then(|| Self(sums.map(|sum| sum / seconds)))
    }
}

/// Difference of the levels before and after the start of a segment, if the sides are long enough and alike.
fn jump_at(pieces: &[Piece], index: usize, [of_speed, of_force]: [f64; 2]) -> Option<LevelJump> {
    let Piece { recording, start_secs: at_secs, .. } = pieces[index];
    let is_before = |piece: &&Piece| {
        piece.recording == recording && piece.start_secs + piece.seconds >= at_secs - SIDE_SECS
    };
    let is_after = |piece: &&Piece| piece.recording == recording && piece.start_secs <= at_secs + SIDE_SECS;
    let Side(before) = Side::of(&mut pieces[..index].iter().rev().take_while(is_before))?;
    let Side(after) = Side::of(&mut pieces[index..].iter().take_while(is_after))?;
    let [speed, force, level] = [0, 1, 2].map(|i| after[i] - before[i]);
    if speed.abs().max(force.abs()) > LIKE.ln() {
        return None;
    }
    let difference = level - of_speed * speed - of_force * force;
    Some(LevelJump {
        recording,
        at_secs,
        difference_db: 20.0 * std::f64::consts::LOG10_E * difference,
        speed_mps: (0.5 * (before[0] + after[0])).exp(),
        force_n: (0.5 * (before[1] + after[1])).exp(),
    })
}

#[cfg(test)]
mod tests {
    use super::{LevelJump, Piece, jump_at, largest_jump, note};

    /// Exponents of all levels here.
    const EXPONENTS: [f64; 2] = [0.9, 0.3];

    /// Segments of half a second, one after the other, with these speeds in m/s and gains, at 1 N.
    fn pieces(speeds_and_gains: impl IntoIterator<Item = (f64, f64)>) -> Vec<Piece> {
        let piece = |(index, (speed_mps, gain)): (usize, (f64, f64))| {
            let level_mps2 = gain * speed_mps.powf(EXPONENTS[0]);
            Piece {
                recording: 0,
                start_secs: 0.5 * index as f64,
                seconds: 0.5,
                speed_mps,
                force_n: 1.0,
                signal: Vec::new(),
                speeds_mps: Vec::new(),
                mean_square: level_mps2.powi(2),
            }
        };
        speeds_and_gains.into_iter().enumerate().map(piece).collect()
    }

    /// The gain changes after ten segments; the speed alternates as in strokes.
    fn switched(gain: f64) -> Vec<Piece> {
        pieces(
            (0..20)
                .map(|index| (if index % 2 == 0 { 0.08 } else { 0.12 }, if index < 10 { 1.0 } else { gain })),
        )
    }

    #[test]
    fn a_changed_gain_is_found_where_it_changes() {
        for gain in [2.0, 0.5, 30.0] {
            let jump = largest_jump(&switched(gain), EXPONENTS).unwrap();
            let LevelJump { recording, at_secs, difference_db, force_n, .. } = jump;
            assert_eq!((recording, at_secs), (0, 5.0));
            assert!((difference_db - 20.0 * f64::log10(gain)).abs() < 1e-9, "{difference_db} for {gain}");
            assert!((force_n - 1.0).abs() < 1e-12 && (0.08..0.12).contains(&jump.speed_mps));
        }
        let said = note(&switched(2.0), EXPONENTS, 2).unwrap();
        assert!(said.contains("rises by 6.0 dB near 5.0 s of recording 1"), "{said}");
        let said = note(&switched(0.5), EXPONENTS, 1).unwrap();
        assert!(said.contains("falls by 6.0 dB near 5.0 s, at"), "{said}");
    }

    #[test]
    fn what_else_changes_the_level_is_no_jump() {
        assert_eq!(largest_jump(&switched(1.0), EXPONENTS), None);
        // 4.6 dB can be the surface.
        assert_eq!(largest_jump(&switched(1.7), EXPONENTS), None);
        // Another speed, by the power law.
        let faster = pieces((0..20).map(|index| (if index < 10 { 0.1 } else { 0.149 }, 1.0)));
        assert_eq!(largest_jump(&faster, EXPONENTS), None);
        // A speed at which nothing is known about the level before.
        let much_faster = pieces((0..20).map(|index| if index < 10 { (0.1, 1.0) } else { (0.2, 9.0) }));
        assert_eq!(jump_at(&much_faster, 10, EXPONENTS), None);
        // The law of these levels alone.
        assert_eq!(largest_jump(&much_faster, [EXPONENTS[0] + 9.0_f64.log2(), EXPONENTS[1]]), None);
        // One segment, such as a knock.
        let knock = pieces((0..20).map(|index| (0.1, if index == 10 { 10.0 } else { 1.0 })));
        assert_eq!(largest_jump(&knock, EXPONENTS), None);
        // Too little signal, and other recordings.
        assert_eq!(largest_jump(&switched(9.0)[9..11], EXPONENTS), None);
        let mut two = switched(9.0);
        for piece in &mut two[10..] {
            piece.recording = 1;
            piece.start_secs -= 5.0;
        }
        assert_eq!(largest_jump(&two, EXPONENTS), None);
        assert_eq!(largest_jump(&[], EXPONENTS), None);
    }
}
