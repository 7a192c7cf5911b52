//! Texture as a runtime table, for programs that render it without the tool.

pub use shagreen_synth::runtime_table::{About, MAGIC as TABLE_MAGIC, TableError};
use shagreen_synth::runtime_table::{Content, Table, write};

use crate::texture::plane::Prepared;
use crate::texture::tap::Tap;

impl Prepared {
    /// Returns the bytes of a runtime table with this texture, its tap transient and words about it. A renderer plays the
    /// table as it plays this texture, bit by bit.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn to_table(&self, tap: Option<Tap>, about: About<'_>) -> Result<Vec<u8>, TableError> {
        let content = Content { parts: self.parts(), tap: tap.map(Into::into), about };
        let mut bytes = vec![0; write(&content, &mut [])?];
        write(&content, &mut bytes)?;
        Ok(bytes)
    }
}

/// Returns what a runtime table says about its texture in words; `None` if the bytes are no whole and undamaged table.
pub fn table_about(bytes: &[u8]) -> Option<About<'_>> {
    let table = Table::open(bytes).ok()?; // Other files have no such words.
    Some(table.about())
}

#[cfg(test)]
mod tests {
    use shagreen_synth::runtime_table::Table;

    use super::{About, TableError, table_about};
    use crate::texture::plane::Plane;
    use crate::texture::tap::Tap;
    use crate::texture::{GrainNode, TextureModel};
    use crate::units::{Hertz, MetersPerSecond, Newtons};

    #[test]
    fn a_table_has_the_texture_its_tap_and_its_name() {
        let node = GrainNode {
            speed: MetersPerSecond(0.1),
            force: Newtons(1.0),
            level_mps2: 2.0,
            lsf: vec![0.5, 1.5],
        };
        let model = TextureModel::new(Hertz(1000.0), vec![node], None).unwrap();
        let prepared = Plane::new(&model).prepare();
        let tap = Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 6.0 };
        let about = About { name: "Oak", is_restricted: true, ..About::default() };
        let bytes = prepared.to_table(Some(tap), about).unwrap();
        let table = Table::open(&bytes).unwrap();
        assert_eq!((table.about(), table.tap()), (about, Some(tap.into())));
        assert_eq!((table_about(&bytes), table_about(b"my notes")), (Some(about), None));
        let parts = prepared.parts();
        assert_eq!(table.lengths().n_nodes, parts.nodes.len());
        assert_eq!(table.lengths().n_triangles, parts.triangles.len());
        assert!(prepared.to_table(None, About::default()).unwrap().len() < bytes.len());
        let broken = About { terms: "a\0b", ..About::default() };
        assert_eq!(prepared.to_table(None, broken), Err(TableError::Text));
    }
}
