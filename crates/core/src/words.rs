//! Counts and lists of names for messages.

/// Number of names that a message lists before it counts the rest.
const N_NAMED: usize = 3;

/// Count followed by `noun`, in the plural unless the count is one: `1 texture`, `2 textures`.
pub fn counted(n: usize, noun: &str) -> String {
    if n == 1 { format!("1 {noun}") } else { format!("{n} {noun}s") }
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
    use super::{counted, listed};

    #[test]
    fn one_and_many() {
        assert_eq!([0, 1, 2].map(|n| counted(n, "texture")), ["0 textures", "1 texture", "2 textures"]);
        assert_eq!(listed(&["a"; 3]), "a, a, a");
        assert_eq!(listed(&["a"; 5]), "a, a, a and 2 more");
        assert_eq!(listed::<&str>(&[]), "");
    }
}
