//! Texture models in the XML of the Penn Haptic Texture Toolkit (HaTT): `Models_<Name>.xml`.
//!
//! A file is a `modelSet` of ARMA models over speed and force. Each model has the line spectral frequencies of both
//! filters, the variance of the excitation and a gain; boundary models extend the set to the edges of the speed-force
//! plane (H. Culbertson, J. Lopez Delgado and K. Kuchenbecker, "One hundred data-driven haptic texture models and
//! open-source methods for rendering on 3D objects", 2014). This reader uses the line spectral frequencies, as the
//! published renderer does, and computes the triangulation again.
//!
//! Lists of numbers may be separated by white space, commas or semicolons. They may also be repeated elements, hold one
//! inner element per number, or be attributes.
//!
//! # Terms of use
//!
//! The published models are for research and must not be redistributed. A file counts as one of them, and its texture
//! as [`Provenance::Restricted`], unless it has an element `createdBy`. Published files have no such element;
//! [`write_hatt`] adds it to files of a user's own models.

mod boundary;
mod file;
mod read;
mod write;
mod xml;

use shagreen_core::texture::{TextureModel, TextureModelError};

use crate::library::{Provenance, TextureEntry};

pub use crate::hatt::read::read_hatt;
pub use crate::hatt::write::{HattWriteError, lost_in_hatt, write_hatt};

/// The element that marks a file as not one of the published ones.
const CREATED_BY: &str = "createdBy";

/// Highest filter order that the reader accepts.
const MAX_ORDER: usize = shagreen_core::texture::MAX_ORDER;

/// A texture, as a HaTT file stores it.
#[derive(Clone, Debug, PartialEq)]
pub struct HattTexture {
    /// Name of the material; empty if the file has none.
    pub name: String,
    /// Number of the texture in the published set.
    pub index: Option<u32>,
    /// Whether it may be redistributed.
    pub provenance: Provenance,
    /// The program that wrote the file, if stated.
    pub created_by: Option<String>,
    /// The texture model: published nodes with their boundary, and friction.
    pub model: TextureModel,
}

impl HattTexture {
    /// Converts the texture to a library entry with this identifier; fills in license and origin.
    pub fn into_entry(self, id: impl Into<String>) -> TextureEntry {
        let origin = match (self.provenance, self.index, self.created_by) {
            (Provenance::Restricted, Some(index), _) => format!("HaTT texture {index}, restricted"),
            (Provenance::Restricted, None, _) => "HaTT, restricted".to_owned(),
            (Provenance::Free, _, Some(program)) => format!("A file in HaTT format by {program}"),
            (Provenance::Free, _, None) => String::new(),
        };
        let license = match self.provenance {
            Provenance::Restricted => RESTRICTED_TERMS.to_owned(),
            Provenance::Free => String::new(),
        };
        TextureEntry {
            license,
            origin,
            provenance: self.provenance,
            ..TextureEntry::new(id, self.name, self.model)
        }
    }
}

/// Terms of use of the published models.
pub(crate) const RESTRICTED_TERMS: &str = "Penn Haptic Texture Toolkit: non-profit research only; redistribution requires written approval of its authors";

/// Why bytes are not a HaTT texture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HattError {
    /// Not XML, truncated, or above the size limits.
    #[error("cannot read the file as XML: {reason}; correct the file or get a complete copy")]
    Xml {
        /// What is wrong, with line and column if known.
        reason: String,
    },
    /// XML of another format.
    #[error(
        "the file is not a HaTT texture: its root element is \"{found}\", not \"modelSet\"; choose another file"
    )]
    Format {
        /// Name of the root element.
        found: String,
    },
    /// A required element is missing.
    #[error(
        "{element} is missing in the element that begins in line {line}; get a complete copy of the file"
    )]
    Missing {
        /// Name of the missing element.
        element: &'static str,
        /// Line of the element that should contain it.
        line: u32,
    },
    /// A quantity has an unsupported unit.
    #[error("{element} is {found}, but this program reads {expected}; convert the numbers and the unit")]
    Unit {
        /// The element.
        element: &'static str,
        /// The unit in the file.
        found: String,
        /// The supported unit.
        expected: &'static str,
    },
    /// A word is not a finite number.
    #[error("\"{found}\" in {element} in line {line} is not a finite number; correct it")]
    Number {
        /// The element.
        element: String,
        /// Line of the element.
        line: u32,
        /// The word in the file.
        found: String,
    },
    /// An element has the wrong number of values.
    #[error("{element} in line {line} has {found} numbers, not {expected}; correct it")]
    Count {
        /// The element.
        element: String,
        /// Line of the element.
        line: u32,
        /// Number of values found.
        found: usize,
        /// Number of values expected.
        expected: usize,
    },
    /// A filter has no line spectral frequencies, and none follow from its coefficients.
    #[error(
        "{element} (order {order}) of the model in line {line} has no line spectral frequencies: the filter is unstable, or its order is above {max}; fit the model again",
        max = MAX_ORDER
    )]
    Unstable {
        /// The element with the coefficients.
        element: &'static str,
        /// Line of the model.
        line: u32,
        /// Order of the filter.
        order: usize,
    },
    /// The numbers do not form a valid texture model.
    #[error("the texture model is invalid: {0}; {hint}", hint = hint(.0))]
    Model(#[from] TextureModelError),
}

/// What the user should do about an invalid texture model.
fn hint(error: &TextureModelError) -> &'static str {
    match error {
        TextureModelError::Rate { .. } => "correct SampleRate",
        TextureModelError::Friction { .. } => "correct mu",
        _ => "correct it; nodes are numbered from zero in file order",
    }
}

#[cfg(test)]
mod tests;
