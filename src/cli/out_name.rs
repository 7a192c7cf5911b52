//! Names of files to write.

use std::path::Path;

use anyhow::bail;

use crate::cli::output::Usage;

/// Refuses `-`, which is standard output in other programs, and would become a file of this name.
pub(crate) fn refuse_dash(out: &Path) -> anyhow::Result<()> {
    if out == Path::new("-") {
        bail!(Usage(
            "--out is \"-\", but nothing is written to standard output; give a file name, or ./- for a file of this name"
                .to_owned()
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::refuse_dash;
    use std::path::Path;

    #[test]
    fn a_dash_alone_is_no_name() {
        assert!(refuse_dash(Path::new("-")).unwrap_err().to_string().contains("standard output"));
        // Paths are compared by their parts, of which "./" is one only at the begin.
        for name in ["./-", "-.wav", "a/-", ""] {
            assert!(refuse_dash(Path::new(name)).is_ok(), "{name}");
        }
    }
}
