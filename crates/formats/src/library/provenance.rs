//! Whether what a texture was made from may be passed on.

/// Whether a texture may be passed on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Provenance {
    /// As its licence says.
    #[default]
    Free,
    /// Made from data that may not be passed on, as the published models of the Penn Haptic Texture Toolkit: for the
    /// person who imported it alone.
    Restricted,
}

impl Provenance {
    /// The warning before textures leave this machine, in a file or a package, from the names of those that are
    /// restricted. `None` where none is.
    pub fn warning(restricted: &[&str]) -> Option<String> {
        const NAMED: usize = 5;
        let shown = restricted[..restricted.len().min(NAMED)].join(", ");
        let more = match restricted.len().saturating_sub(NAMED) {
            0 => String::new(),
            n => format!(" and {n} more"),
        };
        let (are, them) = if restricted.len() == 1 { ("is", "it") } else { ("are", "them") };
        (!restricted.is_empty()).then(|| {
            format!(
                "{shown}{more} {are} made from restricted data, for non-profit research and not to be passed on: leave {them} out of what you share"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Provenance;

    #[test]
    fn the_warning_names_what_is_restricted() {
        let check = |names: &[&str], expected: &str| {
            let warning = Provenance::warning(names).unwrap();
            assert!(warning.starts_with(expected), "{warning}");
        };
        assert_eq!(Provenance::warning(&[]), None);
        check(&["Cork"], "Cork is made");
        check(&["a", "b"], "a, b are made");
        check(&["a", "b", "c", "d", "e", "f", "g"], "a, b, c, d, e and 2 more are made");
    }
}
