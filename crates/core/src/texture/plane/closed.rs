//! Measured nodes together with the boundary that closes the speed-force range around them.
//!
//! The published boundary ([`crate::texture::boundary`]) copies the measured node that is nearest in raw mm/s and N to
//! each place on the edges of highest speed and force. Speed then dominates: next to the edge of highest force, a node of
//! low force can be copied, and between two measured nodes the level is constant instead of linear. So the places are as
//! published, but the values are those of the nearest point of the convex hull of the measured nodes, linear between the
//! two nodes at the ends of its edge. A level that is linear in speed and force therefore stays linear up to the edges.

use crate::maths::triangulation::{Triangulation, Xy};
use crate::texture::GrainNode;
use crate::texture::boundary::{BoundaryModel, boundary};
use crate::texture::plane::values::Values;
use crate::units::Contact;

/// Distance from the edge of highest speed or force, relative to that speed or force, up to which a node counts as
/// measured on the edge. Nodes of recordings with the same nominal speed or force differ by a few percent; without a
/// tolerance, those that lie slightly inside the hull would be skipped.
const ON_EDGE: f64 = 0.05;

/// Measured nodes and the boundary around them. `places` are their speeds and forces, relative to `highest`.
pub(super) fn closed(nodes: &[GrainNode], places: &[Xy], highest: Contact) -> Vec<(Xy, Values)> {
    let measured: Vec<Values> = nodes.iter().map(|n| Values::measured(n.lsf.clone(), n.level_mps2)).collect();
    let contacts: Vec<Contact> = nodes.iter().map(|n| Contact { speed: n.speed, force: n.force }).collect();
    let models = boundary(&contacts, highest);
    // Grids that were measured up to the edges need no hull.
    let hull = if models.iter().all(|model| model.silent) { None } else { hull(places) };
    let added: Vec<(Xy, Values)> = models
        .into_iter()
        .map(|BoundaryModel { at, copy_of, silent }| {
            let place = [at.speed.0 / highest.speed.0, at.force.0 / highest.force.0];
            let values = match &hull {
                _ if silent => Values::measured(nodes[copy_of].lsf.clone(), 0.0),
                Some(hull) => on_hull(hull, &measured, place).unwrap_or_else(|| measured[copy_of].clone()),
                None => measured[copy_of].clone(),
            };
            (place, values)
        })
        .collect();
    places.iter().copied().zip(measured).chain(added).collect()
}

/// Triangles over the measured nodes, with those near the edges of highest speed and force moved onto them.
fn hull(places: &[Xy]) -> Option<Triangulation> {
    let moved = |share: f64| if share >= 1.0 - ON_EDGE { 1.0 } else { share };
    let places: Vec<Xy> = places.iter().map(|place| place.map(moved)).collect();
    // Relative coordinates are finite and at most 1, so that they can always be triangulated.
    Triangulation::in_order(&places).ok()
}

/// Values of the nearest point of the convex hull; `None` without nodes.
fn on_hull(hull: &Triangulation, measured: &[Values], place: Xy) -> Option<Values> {
    let (_, ends) = hull.nearest_on_outline(place)?;
    Some(Values::mean(&ends.map(|(node, weight)| (&measured[node], weight))))
}
