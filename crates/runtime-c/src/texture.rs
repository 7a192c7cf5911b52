//! A texture that owns the data of a runtime table.

use std::ffi::{CStr, CString};

use shagreen_synth::runtime_table::{About, Arrays, Head, Lengths, Memory, Table, TableError};
use shagreen_synth::tap::Tap;
use shagreen_synth::texture::{Excitation, MAX_MA_ORDER, MAX_ORDER, NO_NEIGHBOR, Node, Texture, Triangle};

/// A texture of a runtime table. Voices in any number of threads can share it.
#[derive(Clone, Debug)]
pub struct RuntimeTexture {
    head: Head,
    nodes: Box<[Node]>,
    triangles: Box<[Triangle]>,
    excitations: Box<[Excitation]>,
    samples: Box<[f32]>,
    tap: Option<Tap>,
    name: CString,
    terms: CString,
    origin: CString,
    is_restricted: bool,
}

impl RuntimeTexture {
    /// A copy of the texture in the bytes of a table.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn load(bytes: &[u8]) -> Result<Self, TableError> {
        let table = Table::open(bytes)?;
        let Lengths { n_nodes, n_triangles, n_excitations, n_samples } = table.lengths();
        let lsf = [0.0; MAX_ORDER];
        let triangle =
            Triangle { nodes: [0; 3], neighbors: [NO_NEIGHBOR; 3], weights: [0.0; 6], ln_gain: [0.0; 6] };
        let mut nodes = vec![Node { level_mps2: 0.0, lsf }; n_nodes];
        let mut triangles = vec![triangle; n_triangles];
        let silent = Excitation { variance: 0.0, gain: 0.0, ma_lsf: [0.0; MAX_MA_ORDER] };
        let mut excitations = vec![silent; n_excitations];
        let mut samples = vec![0.0; n_samples];
        table.load(Memory {
            nodes: &mut nodes,
            triangles: &mut triangles,
            excitations: &mut excitations,
            samples: &mut samples,
        })?;
        let About { name, terms, origin, is_restricted, .. } = table.about();
        // A table has no text with a NUL.
        let text = |text: &str| CString::new(text).unwrap_or_default();
        Ok(Self {
            head: table.head(),
            nodes: nodes.into(),
            triangles: triangles.into(),
            excitations: excitations.into(),
            samples: samples.into(),
            tap: table.tap(),
            name: text(name),
            terms: text(terms),
            origin: text(origin),
            is_restricted,
        })
    }

    /// View of the texture for a voice. It costs nothing.
    pub fn view(&self) -> Texture<'_> {
        let Self { nodes, triangles, excitations, samples, .. } = self;
        self.head.view(Arrays { nodes, triangles, excitations, samples })
    }

    /// Tap transient, if the texture has one.
    pub fn tap(&self) -> Option<Tap> {
        self.tap
    }

    /// Name of the texture, in UTF-8.
    pub fn name(&self) -> &CStr {
        &self.name
    }

    /// Terms of use, in UTF-8; empty if they are not known.
    pub fn terms(&self) -> &CStr {
        &self.terms
    }

    /// Where the texture comes from, in UTF-8; empty if that is not known.
    pub fn origin(&self) -> &CStr {
        &self.origin
    }

    /// Whether the texture must not be redistributed.
    pub fn is_restricted(&self) -> bool {
        self.is_restricted
    }

    /// Memory that the texture takes, in bytes.
    pub fn memory_bytes(&self) -> usize {
        let texts = [&self.name, &self.terms, &self.origin];
        let texts_bytes: usize = texts.iter().map(|text| text.as_bytes_with_nul().len()).sum();
        size_of::<Self>() + self.head.lengths().bytes() + texts_bytes
    }
}
