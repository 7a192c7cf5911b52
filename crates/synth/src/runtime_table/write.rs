//! Writing of a table into bytes of the caller.

use super::read::RESTRICTED;
use super::sections::{CHECKSUM, Kind};
use super::{About, Content, MAGIC, TableError, VERSION, is_storable, is_valid};
use crate::height_map::HeightMap;
use crate::relief::Relief;
use crate::stick_slip::Friction;
use crate::tap::Tap;
use crate::texture::{Node, Parts, Texture, Triangle};

/// Place of the table's length.
const LENGTH_AT: usize = 8;

/// Writes a table, and returns its length in bytes. `out` holds a table only if it is at least that long: an empty slice
/// gives the length alone.
///
/// # Errors
/// The texture, its tap transient or a text cannot be stored, or the table would be longer than 4 GiB.
pub fn write(content: &Content<'_>, out: &mut [u8]) -> Result<usize, TableError> {
    let Content { parts, tap, about } = content;
    Texture::new(*parts).map_err(TableError::Texture)?;
    let About { name, terms, origin, created_by, is_restricted } = *about;
    if ![name, terms, origin, created_by].iter().all(|text| is_storable(text)) {
        return Err(TableError::Text);
    }
    if tap.is_some_and(|tap| !is_valid(tap)) {
        return Err(TableError::Tap);
    }
    let mut output = Output { out, n: 0 };
    output.put(&MAGIC);
    for number in VERSION {
        output.put(&number.to_le_bytes());
    }
    output.put(&0_u32.to_le_bytes());
    numbers(&mut output, parts, if is_restricted { RESTRICTED } else { 0 });
    plane(&mut output, [Kind::Nodes, Kind::Triangles], (parts.nodes, parts.triangles), parts.order);
    if !parts.excitations.is_empty() {
        output.section(Kind::Excitations, |output| {
            for excitation in parts.excitations {
                output.floats(&[excitation.variance, excitation.gain]);
                output.floats(&excitation.ma_lsf[..parts.ma_order]);
            }
        });
    }
    if let Some(along) = parts.along {
        let kinds = [Kind::NodesAlong, Kind::TrianglesAlong];
        plane(&mut output, kinds, (along.nodes, along.triangles), parts.order);
    }
    layers(&mut output, parts, *tap);
    let texts =
        [(Kind::Name, name), (Kind::Terms, terms), (Kind::Origin, origin), (Kind::CreatedBy, created_by)];
    for (kind, text) in texts.into_iter().filter(|(_, text)| !text.is_empty()) {
        output.section(kind, |output| output.put(text.as_bytes()));
    }
    output.finish()
}

/// Writes the numbers of the texture that are no arrays.
fn numbers(output: &mut Output<'_>, parts: &Parts<'_>, flags: u32) {
    output.section(Kind::Head, |output| {
        output.floats(&[parts.rate_hz, parts.speed_max_mps, parts.force_max_n, parts.turn_rad]);
        // Both are at most 64.
        for order in [parts.order, parts.ma_order] {
            output.put(&(order as u16).to_le_bytes());
        }
        output.put(&flags.to_le_bytes());
    });
}

/// Writes the nodes and the triangles of one plane.
fn plane(
    output: &mut Output<'_>,
    [of_nodes, of_triangles]: [Kind; 2],
    (nodes, triangles): (&[Node], &[Triangle]),
    order: usize,
) {
    output.section(of_nodes, |output| {
        for node in nodes {
            output.floats(&[node.level_mps2]);
            output.floats(&node.lsf[..order]);
        }
    });
    output.section(of_triangles, |output| {
        for triangle in triangles {
            let indices = triangle.nodes.iter().chain(&triangle.neighbors);
            indices.for_each(|index| output.put(&index.to_le_bytes()));
            output.floats(&triangle.weights);
            output.floats(&triangle.ln_gain);
        }
    });
}

/// Writes relief, height map, friction and tap transient, as far as the texture has them.
fn layers(output: &mut Output<'_>, parts: &Parts<'_>, tap: Option<Tap>) {
    if let Some(relief) = &parts.relief {
        output.section(Kind::Relief, |output| relief_section(output, relief));
    }
    if let Some(map) = &parts.height_map {
        output.section(Kind::HeightMap, |output| height_map_section(output, map));
    }
    if let Some(Friction { kinetic, static_ratio, stribeck_speed_mps }) = parts.friction {
        output.section(Kind::Friction, |output| output.floats(&[kinetic, static_ratio, stribeck_speed_mps]));
    }
    if let Some(Tap { frequency_hz, decay_per_sec, amplitude_mps2 }) = tap {
        output.section(Kind::Tap, |output| output.floats(&[frequency_hz, decay_per_sec, amplitude_mps2]));
    }
}

fn relief_section(output: &mut Output<'_>, relief: &Relief<'_>) {
    output.floats(&[relief.step_m(), relief.force_n()]);
    output.put(&(relief.n() as u32).to_le_bytes());
    output.floats(relief.octaves());
}

fn height_map_section(output: &mut Output<'_>, map: &HeightMap<'_>) {
    output.put(&map.side_m().to_le_bytes());
    output.floats(&[map.force_n(), map.speed_exponent()]);
    output.put(&(map.n() as u32).to_le_bytes());
    output.floats(map.octaves());
}

/// Bytes of a table, and how many there are so far; those that do not fit are only counted.
struct Output<'o> {
    out: &'o mut [u8],
    n: usize,
}

impl Output<'_> {
    fn put(&mut self, bytes: &[u8]) {
        self.put_at(self.n, bytes);
        self.n += bytes.len();
    }

    fn put_at(&mut self, at: usize, bytes: &[u8]) {
        if let Some(place) = self.out.get_mut(at..at + bytes.len()) {
            place.copy_from_slice(bytes);
        }
    }

    fn floats(&mut self, values: &[f32]) {
        for value in values {
            self.put(&value.to_le_bytes());
        }
    }

    /// Writes a section with its letters and its length.
    fn section(&mut self, kind: Kind, content: impl FnOnce(&mut Self)) {
        self.put(&kind.letters());
        let length_at = self.n;
        self.put(&0_u32.to_le_bytes());
        let begin = self.n;
        content(self);
        // A longer section makes the table too long, which `finish` refuses.
        self.put_at(length_at, &((self.n - begin) as u32).to_le_bytes());
    }

    /// Writes the length of the table and its checksum.
    fn finish(mut self) -> Result<usize, TableError> {
        let length = u32::try_from(self.n + size_of::<u32>()).map_err(|_| TableError::Length)?;
        self.put_at(LENGTH_AT, &length.to_le_bytes());
        let checksum = self.out.get(..self.n).map_or(0, |bytes| CHECKSUM.checksum(bytes));
        self.put(&checksum.to_le_bytes());
        Ok(self.n)
    }
}
