//! Authored points at one position, side by side.

use egui::{Pos2, Vec2};

/// Distance below which two points hide each other, in points of the window.
const SAME_PLACE: f32 = 5.0;
/// Distance of a point that is moved aside from its position, in points of the window.
const ASIDE: f32 = 19.0;
/// Number of points around one position.
const IN_A_RING: usize = 6;
/// Number of rings. Further points hide each other: the farther a point is drawn from its position, the more it misleads.
const MOST_RINGS: usize = 2;

/// Positions at which the authored points are drawn: the first point at a position there, later ones around it. They do not
/// depend on the selection, so that a point that is selected by a click stays under the pointer.
pub(super) fn fanned(places: &[Pos2]) -> Vec<Pos2> {
    let n_before = |index: usize, place: Pos2| {
        places.iter().take(index).filter(|at| at.distance(place) < SAME_PLACE).count()
    };
    places.iter().enumerate().map(|(index, place)| *place + aside(n_before(index, *place))).collect()
}

/// Offset of the point number `n` at a position; the first one stays.
fn aside(n: usize) -> Vec2 {
    let Some(n) = n.checked_sub(1) else { return Vec2::ZERO };
    let angle = std::f32::consts::TAU * ((n % IN_A_RING) as f32 / IN_A_RING as f32 - 0.125);
    ASIDE * (1 + n / IN_A_RING).min(MOST_RINGS) as f32 * Vec2::angled(angle)
}

#[cfg(test)]
mod tests {
    use super::{ASIDE, SAME_PLACE, fanned};
    use egui::pos2;

    #[test]
    fn every_point_of_a_stack_is_seen_in_a_place_of_its_own() {
        let mut places = vec![pos2(100.0, 50.0); 9];
        places.push(pos2(300.0, 50.0));
        let all = fanned(&places);
        assert_eq!((all[0], all[9]), (places[0], places[9]), "the first one, and one that is alone");
        for (i, a) in all.iter().enumerate() {
            assert!(all[i + 1..].iter().all(|b| a.distance(*b) > 2.0 * SAME_PLACE), "{all:?}");
        }
        let many = fanned(&[places[0]; 40]);
        let farthest = many.iter().map(|at| at.distance(places[0])).fold(0.0, f32::max);
        assert!(farthest <= 2.01 * ASIDE, "{farthest}");
        // A point that is added or dragged away moves none before it.
        assert_eq!(fanned(&places[..4]), all[..4]);
        places[8] = pos2(200.0, 50.0);
        assert_eq!(fanned(&places)[..8], all[..8]);
    }
}
