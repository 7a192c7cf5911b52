//! Counts, rounded numbers, lists of names, and similar names for messages.

/// Number of names that a message lists before it counts the rest.
const N_NAMED: usize = 3;
/// Largest number of suggestions for an unknown name.
const MOST_SUGGESTED: usize = 3;
/// Longest name for which similar ones are searched, in bytes: the search takes time in proportion to it.
const LONGEST_SOUGHT: usize = 100;

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

/// Returns up to three of these names that are similar to `wanted`, the most similar first.
pub fn near<'a>(names: impl IntoIterator<Item = &'a str>, wanted: &str) -> Vec<&'a str> {
    if wanted.len() > LONGEST_SOUGHT {
        return Vec::new();
    }
    let wanted = wanted.to_lowercase();
    let similar = |name: &'a str| {
        let distance = strsim::levenshtein(&wanted, &name.to_lowercase());
        let is_part = wanted.len() > 2 && name.contains(&wanted);
        let is_near = distance <= 1 + wanted.chars().count() / 3;
        (is_part || is_near).then_some((if is_part { 0 } else { distance }, name))
    };
    let mut near: Vec<(usize, &str)> = names.into_iter().filter_map(similar).collect();
    near.sort_unstable();
    near.into_iter().take(MOST_SUGGESTED).map(|(_, name)| name).collect()
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
    use super::{counted, listed, near, two_digits};

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
    fn near_names_are_offered_nearest_first() {
        assert_eq!(near(["rough-smooth", "hard-soft"], "Rough-Smoth"), ["rough-smooth"]);
        assert_eq!(near(["flat-rubber", "cork", "corks"], "cork"), ["cork", "corks"]);
        assert_eq!(near(["flat-rubber"], "rubber"), ["flat-rubber"], "a part of a name");
        assert_eq!(near(["a", "b", "c", "d"], "e"), ["a", "b", "c"]);
        assert!(near(["cork"], "zzzzzzzz").is_empty() && near(["cork"], &"cork".repeat(50)).is_empty());
    }

    #[test]
    fn one_and_many() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "texture")), ["0 textures", "1 texture", "2 textures"]);
        assert_eq!(listed(&["a"; 3]), "a, a, a");
        assert_eq!(listed(&["a"; 5]), "a, a, a and 2 more");
        assert_eq!(listed::<&str>(&[]), "");
    }
}
