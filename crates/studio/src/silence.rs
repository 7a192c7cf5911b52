//! Silent signals, and why they are silent.

use shagreen_formats::wav::TraceV1;

/// Highest acceleration in m/s² of a signal that counts as silent: far below what anybody feels, and above rounding.
const SILENT_MPS2: f32 = 1e-6;

/// Whether a signal in m/s² is silent.
pub fn is_silent(samples: &[f32]) -> bool {
    !samples.iter().any(|sample| sample.abs() > SILENT_MPS2)
}

/// Returns a warning that a signal in m/s² is silent, with the reason in the motion of the tip; `None` if it is not.
pub fn silence_warning(samples: &[f32], trace: &TraceV1) -> Option<String> {
    if !is_silent(samples) {
        return None;
    }
    let touches = trace.force_n.iter().any(|force_n| *force_n > 0.0);
    let moves = trace.speed_mm_per_s.iter().any(|speed| *speed > 0.0);
    let reason = match (touches, moves) {
        (false, _) => "the force is 0, so that the tip never touches; choose a force above 0",
        (true, false) => "the speed is 0, so that the tip never moves; choose a speed above 0",
        (true, true) => "the motion is too slow or too light for this texture; choose a faster or firmer one",
    };
    Some(format!("the signal is silent: {reason}"))
}

#[cfg(test)]
mod tests {
    use super::silence_warning;
    use crate::trace::steady_trace;
    use shagreen_core::units::Contact;

    #[test]
    fn a_silent_signal_says_why() {
        for (speed, force, words) in
            [(100.0, 0.0, "the force is 0"), (0.0, 1.0, "the speed is 0"), (5.0, 1.0, "too slow")]
        {
            let trace = steady_trace(Contact::from_mm_per_s_and_n(speed, force), 1.0);
            let said = silence_warning(&[0.0, 1e-7], &trace).unwrap();
            assert!(said.contains("silent") && said.contains(words), "{said}");
            assert_eq!(silence_warning(&[0.0, -1e-3], &trace), None);
        }
    }
}
