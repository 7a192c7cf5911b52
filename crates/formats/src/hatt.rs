//! Texture models in the XML of the Penn Haptic Texture Toolkit (HaTT): `Models_<Name>.xml`.
//!
//! A file is a `modelSet` of ARMA models over speed and force: line spectral frequencies of both filters, the variance of
//! the excitation, a gain, and the boundary models that close the plane (H. Culbertson, J. Lopez Delgado and K.
//! Kuchenbecker, "One hundred data-driven haptic texture models and open-source methods for rendering on 3D objects",
//! 2014). The line spectral frequencies are what the published renderer uses, so they are what is read; triangles are
//! made anew.
//!
//! Lists of numbers are understood parted by white space, commas or semicolons, as repeated elements, with one inner
//! element a number, or as attributes.
//!
//! # Terms
//!
//! The published models are for research and may not be passed on. A file is taken for one of them, and its texture is
//! [`Provenance::Restricted`], unless it has an element `createdBy`, which [`write_hatt`] writes into files made of a
//! person's own models, and published files do not have.

mod boundary;
mod file;
mod read;
mod write;
mod xml;

use shagreen_core::texture::{TextureModel, TextureModelError};

use crate::library::{Provenance, TextureEntry};

pub use crate::hatt::read::read_hatt;
pub use crate::hatt::write::{HattWriteError, lost_in_hatt, write_hatt};

/// The element by which a file says that it is not one of the published ones.
const CREATED_BY: &str = "createdBy";

/// Highest order of a filter that is looked at.
const MAX_ORDER: usize = shagreen_core::texture::MAX_ORDER;

/// A texture as a file of the toolkit has it.
#[derive(Clone, Debug, PartialEq)]
pub struct HattTexture {
    /// Name of the material; empty where the file has none.
    pub name: String,
    /// Number of the texture among the published ones.
    pub index: Option<u32>,
    /// Whether it may be passed on.
    pub provenance: Provenance,
    /// The program that wrote the file, where it says so.
    pub created_by: Option<String>,
    /// What it does to a tip: published nodes with their boundary, friction.
    pub model: TextureModel,
}

impl HattTexture {
    /// The texture as an entry of a library, under this identifier, with where it comes from.
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

/// Terms of the published models, in a sentence.
const RESTRICTED_TERMS: &str = "Penn Haptic Texture Toolkit: non-profit research; not to be passed on without written approval of its authors";

/// Why bytes are no texture of the toolkit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HattError {
    /// Not XML, cut off, or more than is read.
    #[error("the file cannot be read as XML: {reason}; get a complete copy")]
    Xml {
        /// What is wrong, with line and column where there are any.
        reason: String,
    },
    /// XML of another kind.
    #[error("this is no HaTT texture: the file is a \"{found}\", not a \"modelSet\"; choose another file")]
    Format {
        /// Name of the root.
        found: String,
    },
    /// An element is missing.
    #[error("{element} is missing in what begins in line {line}; get a complete copy")]
    Missing {
        /// The element.
        element: &'static str,
        /// Line of what should have it.
        line: u32,
    },
    /// A quantity has another unit.
    #[error("{element} is {found}, this program reads {expected}; convert the numbers and the unit")]
    Unit {
        /// The element.
        element: &'static str,
        /// The unit in the file.
        found: String,
        /// The unit that is read.
        expected: &'static str,
    },
    /// A word is not a finite number.
    #[error("\"{found}\" in {element} in line {line} is not a finite number; correct it")]
    Number {
        /// The element.
        element: String,
        /// Its line.
        line: u32,
        /// What stands there.
        found: String,
    },
    /// An element has more numbers than make sense.
    #[error("{element} in line {line} has {found} numbers, not {expected}; correct it")]
    Count {
        /// The element.
        element: String,
        /// Its line.
        line: u32,
        /// The numbers found.
        found: usize,
        /// The numbers expected.
        expected: usize,
    },
    /// A filter has no line spectral frequencies, and its coefficients have none.
    #[error(
        "{element} (order {order}) of the model in line {line} has no line spectral frequencies: the filter is not stable, or its order is above {max}; make the model anew",
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
    /// The numbers are no texture.
    #[error("the texture cannot be used: {0}; {hint}", hint = hint(.0))]
    Model(#[from] TextureModelError),
}

/// What to do about numbers that are no texture.
fn hint(error: &TextureModelError) -> &'static str {
    match error {
        TextureModelError::Rate { .. } => "correct SampleRate",
        TextureModelError::Friction { .. } => "correct mu",
        _ => "correct it; nodes count from zero in the order of the file",
    }
}

#[cfg(test)]
mod tests;
