//! Reading and checking `.hjif` files.

use crate::first_faults::FirstFaults;
use crate::foreign_file::Found;
use crate::foreign_json::{ObjectFault, read_object};
use crate::hjif::check::check;
use crate::hjif::faults::Faults;
use crate::hjif::rule::Fault;
use crate::hjif::tree::Hjif;

/// Why bytes are no `.hjif` file.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HjifError {
    /// The file is not JSON.
    #[error("{}", .found.instead_of("an MPEG haptic file (.hjif)", "hjif"))]
    Foreign {
        /// What the file is.
        found: Found,
    },
    /// Not JSON, or a field is missing or has a value that the format does not know.
    #[error("cannot read the MPEG haptic file: {reason}; correct the file")]
    Damaged {
        /// The parser's message with its line and column.
        reason: String,
    },
    /// The file breaks rules of the format.
    #[error("the MPEG haptic file breaks {} of the format: {first}; `shagreen check` lists all", rules(*.n))]
    Rules {
        /// First broken rule with its place.
        first: Fault,
        /// Number of places at which a rule is broken.
        n: usize,
    },
}

impl From<ObjectFault> for HjifError {
    fn from(fault: ObjectFault) -> Self {
        match fault {
            ObjectFault::Foreign(found) => Self::Foreign { found },
            ObjectFault::Damaged(reason) => Self::Damaged { reason },
        }
    }
}

/// A file that can be read, and the rules that it breaks.
#[derive(Clone, Debug, PartialEq)]
pub struct Checked {
    /// The file.
    pub file: Hjif,
    /// Broken rules in the order of the file, at most a hundred of them.
    pub faults: Vec<Fault>,
    /// Number of places at which a rule is broken.
    pub n_faults: usize,
}

/// Reads a file that follows all rules of the format.
///
/// # Errors
/// See [`HjifError`].
pub fn read_hjif(bytes: &[u8]) -> Result<Hjif, HjifError> {
    let Checked { file, faults, n_faults } = check_hjif(bytes)?;
    match faults.into_iter().next() {
        Some(first) => Err(HjifError::Rules { first, n: n_faults }),
        None => Ok(file),
    }
}

/// Reads a file and lists the rules of the format that it breaks.
///
/// # Errors
/// [`HjifError::Foreign`] and [`HjifError::Damaged`]: the tree of the file cannot be read.
pub fn check_hjif(bytes: &[u8]) -> Result<Checked, HjifError> {
    let file: Hjif = read_object(bytes)?;
    let Faults(FirstFaults { first: faults, n: n_faults }) = check(&file);
    Ok(Checked { file, faults, n_faults })
}

fn rules(n: usize) -> String {
    if n == 1 { "a rule".to_owned() } else { format!("rules at {n} places") }
}
