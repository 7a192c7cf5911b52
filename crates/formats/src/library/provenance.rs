//! Redistribution status of a texture.

/// Whether a texture may be redistributed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Provenance {
    /// Redistribution follows its license.
    #[default]
    Free,
    /// Made from data that must not be redistributed, such as the published models of the Penn Haptic Texture Toolkit;
    /// only for the person who imported it.
    Restricted,
}

impl Provenance {
    /// Returns a warning to show before textures are saved or exported, from the names of the restricted ones; `None`
    /// if none is restricted.
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
                "{shown}{more} {are} made from restricted data, for non-profit research only, which must not be redistributed; remove {them} from files that you share"
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
