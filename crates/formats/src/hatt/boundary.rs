//! Boundary models for files that have none.

use shagreen_core::texture::boundary::{BoundaryModel, boundary};
use shagreen_core::texture::{MIN_NODE_DISTANCE, PublishedNode};
use shagreen_core::units::{Contact, MetersPerSecond, Newtons};

/// Returns whether there is a node at every corner of the rectangle from zero to `highest`.
pub(super) fn is_closed(nodes: &[PublishedNode], highest: Contact) -> bool {
    let corner = |speed_share: f64, force_share: f64| Contact {
        speed: MetersPerSecond(speed_share * highest.speed.0),
        force: Newtons(force_share * highest.force.0),
    };
    let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0)];
    corners.iter().all(|corner| is_near(nodes, *corner, highest, MIN_NODE_DISTANCE))
}

/// Adds the boundary models up to `highest` by the published rule, except where a node already exists.
pub(super) fn close(nodes: &mut Vec<PublishedNode>, highest: Contact) {
    let inside: Vec<PublishedNode> =
        nodes.iter().filter(|node| node.speed.0 > 0.0 && node.force.0 > 0.0).cloned().collect();
    let measured: Vec<Contact> =
        inside.iter().map(|node| Contact { speed: node.speed, force: node.force }).collect();
    for BoundaryModel { at, copy_of, silent } in boundary(&measured, highest) {
        // Twice the minimum node distance, so that an added node never conflicts with an existing one.
        if !is_near(nodes, at, highest, 2.0 * MIN_NODE_DISTANCE) {
            let copy = &inside[copy_of];
            let variance = if silent { 0.0 } else { copy.variance };
            nodes.push(PublishedNode { speed: at.speed, force: at.force, variance, ..copy.clone() });
        }
    }
}

fn is_near(nodes: &[PublishedNode], at: Contact, highest: Contact, share: f64) -> bool {
    nodes.iter().any(|node| {
        (node.speed.0 - at.speed.0).abs() < share * highest.speed.0
            && (node.force.0 - at.force.0).abs() < share * highest.force.0
    })
}
