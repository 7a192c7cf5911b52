//! Paths in a bundle: such that every system can have the file, in the folder that the user has chosen.

/// Longest path, in bytes.
const MAX_BYTES: usize = 400;
/// Names of devices on Windows, with any ending.
const DEVICES: [&str; 4] = ["con", "prn", "aux", "nul"];

/// Checks a path of a bundle.
///
/// # Errors
/// What is wrong, as the end of a sentence about the path.
pub(super) fn check_path(path: &str) -> Result<(), &'static str> {
    if path.len() > MAX_BYTES {
        return Err("is too long");
    }
    if path.chars().any(|c| c.is_control() || matches!(c, '\\' | ':' | '*' | '?' | '"' | '<' | '>' | '|')) {
        return Err("has a character that not every system permits");
    }
    for part in path.split('/') {
        if part.is_empty() {
            return Err("begins or ends with a slash, or has two in a row");
        }
        if part == "." || part == ".." {
            return Err("leads out of its folder");
        }
        if part.ends_with(['.', ' ']) {
            return Err("has a name that ends with a point or a space");
        }
        if is_device(part) {
            return Err("has the name of a device");
        }
    }
    Ok(())
}

fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().trim_end().to_lowercase();
    let is_port = |port: &str| {
        let number = stem.strip_prefix(port);
        number.is_some_and(|number| matches!(number.as_bytes(), [b'0'..=b'9']))
    };
    DEVICES.contains(&&*stem) || is_port("com") || is_port("lpt")
}

#[cfg(test)]
mod tests {
    use super::check_path;

    #[test]
    fn paths_that_lead_elsewhere_are_refused() {
        for path in [
            "",
            "/etc/passwd",
            "../up.json",
            "a/../../up.json",
            "a/./b",
            "a//b",
            "a/",
            "C:/windows",
            "c:windows",
            "a\\..\\b",
            "\\\\server\\share",
            "a/b:stream",
            "a\0b",
            "a\nb",
            "nul",
            "a/Con.txt",
            "com1.wav",
            "a./b",
            "a ",
            "a?",
            &"a".repeat(401),
        ] {
            assert!(check_path(path).is_err(), "{path:?}");
        }
        for path in ["project.shagreen", "exports/run 1/Ä.wav", "a..b", ".a", "console.txt", "com10", "lpt"]
        {
            assert_eq!(check_path(path), Ok(()), "{path}");
        }
    }
}
