//! Reading of a table into memory of the caller.

use super::fields::Fields;
use super::head::{Arrays, Head, HeightMapHead, Lengths, ReliefHead};
use super::sections::{Kind, Sections};
use super::{About, TableError, is_storable, is_valid};
use crate::height_map::HeightMap;
use crate::limits::{MAX_MA_ORDER, MAX_ORDER};
use crate::relief::Relief;
use crate::stick_slip::Friction;
use crate::tap::Tap;
use crate::texture::{Excitation, MAX_NODES, Node, Texture, TextureError, Triangle};

/// Bytes of a triangle.
const TRIANGLE_BYTES: usize = 60;
/// Flag of a texture that must not be redistributed.
pub(super) const RESTRICTED: u32 = 1;

/// Memory for the arrays of a texture, at least as long as [`Table::lengths`].
#[derive(Debug)]
pub struct Memory<'m> {
    /// For the nodes across and along the lay.
    pub nodes: &'m mut [Node],
    /// For the triangles across and along the lay.
    pub triangles: &'m mut [Triangle],
    /// For the excitations of a published model.
    pub excitations: &'m mut [Excitation],
    /// For the samples of relief and height map.
    pub samples: &'m mut [f32],
}

/// A table whose frame, checksum and lengths are valid. [`Table::load`] checks the numbers.
#[derive(Clone, Copy, Debug)]
pub struct Table<'b> {
    sections: Sections<'b>,
    head: Head,
    tap: Option<Tap>,
    about: About<'b>,
}

impl<'b> Table<'b> {
    /// A table in these bytes, which are borrowed. Cost: one pass over the bytes.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn open(bytes: &'b [u8]) -> Result<Self, TableError> {
        let sections = Sections::of(bytes)?;
        let (head, flags) = head(&sections)?;
        let tap = match sections.get(Kind::Tap) {
            Some(bytes) => Some(tap(bytes).ok_or(TableError::Section)?),
            None => None,
        };
        if tap.is_some_and(|tap| !is_valid(tap)) {
            return Err(TableError::Tap);
        }
        let text = |kind: Kind| {
            let text = core::str::from_utf8(sections.get(kind).unwrap_or_default()).ok();
            text.filter(|text| is_storable(text)).ok_or(TableError::Text)
        };
        let about = About {
            name: text(Kind::Name)?,
            terms: text(Kind::Terms)?,
            origin: text(Kind::Origin)?,
            created_by: text(Kind::CreatedBy)?,
            is_restricted: flags & RESTRICTED != 0,
        };
        Ok(Self { sections, head, tap, about })
    }

    /// Words about the texture.
    pub fn about(&self) -> About<'b> {
        self.about
    }

    /// Tap transient at [`crate::tap::REFERENCE_IMPACT_MPS`], if the texture has one.
    pub fn tap(&self) -> Option<Tap> {
        self.tap
    }

    /// Numbers of the texture, for an owner of its arrays.
    pub fn head(&self) -> Head {
        self.head
    }

    /// Lengths of the arrays of the texture.
    pub fn lengths(&self) -> Lengths {
        self.head.lengths()
    }

    /// Copies the arrays of the texture into memory, and checks them.
    ///
    /// # Errors
    /// The memory is too short, or the numbers are invalid. The content of the memory is then unspecified.
    pub fn load<'m>(&self, memory: Memory<'m>) -> Result<Texture<'m>, TableError> {
        let Lengths { n_nodes, n_triangles, n_excitations, n_samples } = self.lengths();
        let Memory { nodes, triangles, excitations, samples } = memory;
        let (Some(nodes), Some(triangles), Some(excitations), Some(samples)) = (
            nodes.get_mut(..n_nodes),
            triangles.get_mut(..n_triangles),
            excitations.get_mut(..n_excitations),
            samples.get_mut(..n_samples),
        ) else {
            return Err(TableError::Memory);
        };
        self.fill(nodes, triangles, excitations, samples).ok_or(TableError::Section)?;
        let arrays = Arrays { nodes, triangles, excitations, samples };
        let parts = self.head.parts(arrays);
        if let Some(relief) = parts.relief {
            Relief::new(relief.step_m(), relief.force_n(), relief.n(), relief.octaves())
                .map_err(TableError::Relief)?;
        }
        if let Some(map) = parts.height_map {
            HeightMap::new(map.side_m(), map.force_n(), map.speed_exponent(), map.n(), map.octaves())
                .map_err(TableError::HeightMap)?;
        }
        Texture::new(parts).map_err(TableError::Texture)
    }

    /// Copies the arrays; `None` if a section is cut off.
    fn fill(
        &self,
        nodes: &mut [Node],
        triangles: &mut [Triangle],
        excitations: &mut [Excitation],
        samples: &mut [f32],
    ) -> Option<()> {
        let fields = |kind: Kind| Fields(self.sections.get(kind).unwrap_or_default());
        let (across, along) = nodes.split_at_mut_checked(self.head.across[0])?;
        for (part, kind) in [(across, Kind::Nodes), (along, Kind::NodesAlong)] {
            let mut fields = fields(kind);
            for node in part {
                *node = Node { level_mps2: fields.f32()?, lsf: fields.lsf(self.head.order)? };
            }
        }
        let (across, along) = triangles.split_at_mut_checked(self.head.across[1])?;
        for (part, kind) in [(across, Kind::Triangles), (along, Kind::TrianglesAlong)] {
            let mut fields = fields(kind);
            for triangle in part {
                *triangle = Triangle {
                    nodes: fields.indices()?,
                    neighbors: fields.indices()?,
                    weights: fields.floats()?,
                    ln_gain: fields.floats()?,
                };
            }
        }
        let mut of_nodes = fields(Kind::Excitations);
        for excitation in excitations {
            *excitation = Excitation {
                variance: of_nodes.f32()?,
                gain: of_nodes.f32()?,
                ma_lsf: of_nodes.lsf(self.head.ma_order)?,
            };
        }
        let (mut relief, mut map) = (fields(Kind::Relief), fields(Kind::HeightMap));
        let n_relief = self.head.relief.map_or(0, |relief| relief.n_samples);
        if n_relief > 0 {
            relief_head(&mut relief)?;
        }
        if n_relief < samples.len() {
            height_map_head(&mut map)?;
        }
        let (of_relief, of_map) = samples.split_at_mut_checked(n_relief)?;
        for (part, mut fields) in [(of_relief, relief), (of_map, map)] {
            for sample in part {
                *sample = fields.f32()?;
            }
        }
        Some(())
    }
}

/// Reads the numbers of a texture, and its flags.
fn head(sections: &Sections<'_>) -> Result<(Head, u32), TableError> {
    let mut fields = Fields(sections.get(Kind::Head).ok_or(TableError::Section)?);
    let mut numbers = || {
        let [rate_hz, speed_max_mps, force_max_n, turn_rad] = fields.floats()?;
        let (order, ma_order) = (usize::from(fields.u16()?), usize::from(fields.u16()?));
        Some(([rate_hz, speed_max_mps, force_max_n, turn_rad], [order, ma_order], fields.u32()?))
    };
    let (numbers, [order, ma_order], flags) = numbers().ok_or(TableError::Section)?;
    // The lengths of records follow from the orders.
    if order == 0 || order > MAX_ORDER || ma_order > MAX_MA_ORDER {
        return Err(TableError::Texture(TextureError::Order));
    }
    let count = |kind: Kind, record_bytes: usize| match sections.get(kind) {
        Some(bytes) if bytes.len().is_multiple_of(record_bytes) => Some(bytes.len() / record_bytes),
        _ => None,
    };
    let node_bytes = 4 * (1 + order);
    let plane =
        |nodes: Kind, triangles: Kind| Some([count(nodes, node_bytes)?, count(triangles, TRIANGLE_BYTES)?]);
    let is_there = |kind: Kind| sections.get(kind).is_some();
    let across = plane(Kind::Nodes, Kind::Triangles).ok_or(TableError::Section)?;
    let along = if is_there(Kind::NodesAlong) || is_there(Kind::TrianglesAlong) {
        Some(plane(Kind::NodesAlong, Kind::TrianglesAlong).ok_or(TableError::Section)?)
    } else {
        None
    };
    let n_excitations = if is_there(Kind::Excitations) {
        count(Kind::Excitations, 4 * (2 + ma_order)).ok_or(TableError::Section)?
    } else {
        0
    };
    // A node takes up to thirty times as much memory as bytes, so that a long table could demand more than there is.
    if across[0].max(along.map_or(0, |[n_nodes, _]| n_nodes)) > MAX_NODES {
        return Err(TableError::Texture(TextureError::Triangle));
    }
    if n_excitations > 0 && n_excitations != across[0] {
        return Err(TableError::Texture(TextureError::Excitation));
    }
    let fields = |kind: Kind| sections.get(kind).map(Fields);
    let relief = present(fields(Kind::Relief), relief_head)?.filter(ReliefHead::fits);
    let height_map = present(fields(Kind::HeightMap), height_map_head)?.filter(HeightMapHead::fits);
    if relief.is_some() != is_there(Kind::Relief) || height_map.is_some() != is_there(Kind::HeightMap) {
        return Err(TableError::Section);
    }
    let friction = present(fields(Kind::Friction), |fields| {
        let [kinetic, static_ratio, stribeck_speed_mps] = fields.floats()?;
        Some(Friction { kinetic, static_ratio, stribeck_speed_mps })
    })?;
    let [rate_hz, speed_max_mps, force_max_n, turn_rad] = numbers;
    let head = Head {
        rate_hz,
        speed_max_mps,
        force_max_n,
        turn_rad,
        order,
        ma_order,
        across,
        along,
        n_excitations,
        relief,
        height_map,
        friction,
    };
    Ok((head, flags))
}

/// Reads a section, if the table has it.
fn present<'b, T>(
    fields: Option<Fields<'b>>,
    read: impl FnOnce(&mut Fields<'b>) -> Option<T>,
) -> Result<Option<T>, TableError> {
    match fields {
        Some(mut fields) => read(&mut fields).map(Some).ok_or(TableError::Section),
        None => Ok(None),
    }
}

fn relief_head(fields: &mut Fields<'_>) -> Option<ReliefHead> {
    let [step_m, force_n] = fields.floats()?;
    let n = usize::try_from(fields.u32()?).ok()?;
    Some(ReliefHead { step_m, force_n, n, n_samples: whole_floats(fields)? })
}

fn height_map_head(fields: &mut Fields<'_>) -> Option<HeightMapHead> {
    let side_m = fields.f64()?;
    let [force_n, speed_exponent] = fields.floats()?;
    let n = usize::try_from(fields.u32()?).ok()?;
    Some(HeightMapHead { side_m, force_n, speed_exponent, n, n_samples: whole_floats(fields)? })
}

/// Number of floats in the rest of a section; `None` if a part of one is left.
fn whole_floats(fields: &Fields<'_>) -> Option<usize> {
    fields.0.len().is_multiple_of(4).then_some(fields.0.len() / 4)
}

fn tap(bytes: &[u8]) -> Option<Tap> {
    let [frequency_hz, decay_per_sec, amplitude_mps2] = Fields(bytes).floats()?;
    Some(Tap { frequency_hz, decay_per_sec, amplitude_mps2 })
}
