//! Counts, rounded numbers and lists of names for messages.

/// Number of names that a message lists before it counts the rest.
const N_NAMED: usize = 3;

/// Count followed by `noun`, in the plural unless the count is one: `1 texture`, `2 textures`.
pub fn counted(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
}

/// Number of 0 or more with two significant digits, and at most two decimals: `0.90`, `4.0`, `26`, `15000`. For values
/// whose source is not more exact, such as multiples of a detection threshold.
pub fn two_digits(value: f64) -> String {
    if value < 0.995 {
        return format!("{value:.2}");
    }
    if value < 9.95 {
        return format!("{value:.1}");
    }
    if value < 99.5 || !value.is_finite() {
        return format!("{value:.0}");
    }
    let step = 10.0_f64.powi(value.log10().floor() as i32 - 1);
    format!("{:.0}", (value / step).round() * step)
}

/// First three names, followed by the number of remaining names.
pub(crate) fn listed<S: AsRef<str>>(names: &[S]) -> String {
    let named: Vec<&str> = names.iter().take(N_NAMED).map(AsRef::as_ref).collect();
    match names.len().saturating_sub(N_NAMED) {
        0 => named.join(", "),
        n => format!("{} and {n} more", named.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::{counted, listed, two_digits};

    #[test]
    fn two_digits_are_kept() {
        for (value, text) in [
            (0.0, "0.00"),
            (0.904, "0.90"),
            (0.996, "1.0"),
            (4.04, "4.0"),
            (9.96, "10"),
            (25.8, "26"),
            (99.6, "100"),
            (15_283.7, "15000"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(two_digits(value), text, "{value}");
        }
    }

    #[test]
    fn one_and_many() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "texture")), ["0 textures", "1 texture", "2 textures"]);
        assert_eq!(listed(&["a"; 3]), "a, a, a");
        assert_eq!(listed(&["a"; 5]), "a, a, a and 2 more");
        assert_eq!(listed::<&str>(&[]), "");
    }
}
