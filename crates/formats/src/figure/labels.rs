//! Placement of point labels without overlap.

/// Height of a label in pixels.
const HEIGHT: f64 = 12.0;
/// Approximate width of a character in pixels.
const CHARACTER: f64 = 5.6;
/// Distance of a label from its point, in pixels.
const GAP: f64 = 6.0;

/// A rectangle in pixels, from its upper left to its lower right corner.
#[derive(Clone, Copy)]
struct Frame {
    left: f64,
    top: f64,
    right: f64,
    bottom: f64,
}

impl Frame {
    fn overlap(self, other: Self) -> f64 {
        let width = self.right.min(other.right) - self.left.max(other.left);
        let height = self.bottom.min(other.bottom) - self.top.max(other.top);
        width.max(0.0) * height.max(0.0)
    }
}

/// Returns the offset in pixels from each labeled point to the upper left corner of its label, in an image of this
/// `size`. Each label takes the side with the least overlap. `points` are the dots to keep free.
pub(super) fn offsets(
    labels: &[(&str, (f64, f64))],
    points: &[(f64, f64)],
    size: (f64, f64),
) -> Vec<(i32, i32)> {
    let mut placed: Vec<Frame> = Vec::new();
    let dots: Vec<Frame> = points
        .iter()
        .map(|(x, y)| Frame { left: x - 4.0, top: y - 4.0, right: x + 4.0, bottom: y + 4.0 })
        .collect();
    labels
        .iter()
        .map(|(label, (x, y))| {
            let width = CHARACTER * label.chars().count() as f64;
            let sides = [
                (GAP, -0.5 * HEIGHT),
                (-GAP - width, -0.5 * HEIGHT),
                (-0.5 * width, -GAP - HEIGHT),
                (-0.5 * width, GAP),
                (GAP, -GAP - HEIGHT),
                (-GAP - width, GAP),
            ];
            let frame = |(dx, dy): (f64, f64)| Frame {
                left: x + dx,
                top: y + dy,
                right: x + dx + width,
                bottom: y + dy + HEIGHT,
            };
            let cost = |side: &(f64, f64)| {
                let f = frame(*side);
                let covered: f64 = placed.iter().chain(&dots).map(|other| f.overlap(*other)).sum();
                let outside = (-f.left).max(0.0)
                    + (f.right - size.0).max(0.0)
                    + (-f.top).max(0.0)
                    + (f.bottom - size.1).max(0.0);
                covered + HEIGHT * outside
            };
            let best = sides.into_iter().min_by(|a, b| cost(a).total_cmp(&cost(b))).unwrap_or((GAP, 0.0));
            placed.push(frame(best));
            (best.0.round() as i32, best.1.round() as i32)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::offsets;

    #[test]
    fn a_label_stands_to_the_right_unless_something_is_there() {
        let at = offsets(&[("cork", (50.0, 50.0))], &[(50.0, 50.0)], (200.0, 100.0));
        assert_eq!(at, [(6, -6)]);
        let beside = offsets(&[("cork", (50.0, 50.0))], &[(50.0, 50.0), (62.0, 50.0)], (200.0, 100.0));
        assert!(beside[0].0 < 0, "{beside:?}");
        let edge = offsets(&[("cork", (190.0, 50.0))], &[(190.0, 50.0)], (200.0, 100.0));
        assert!(edge[0].0 < 0, "{edge:?}");
    }

    #[test]
    fn labels_of_near_points_do_not_lie_on_each_other() {
        let points = [(50.0, 50.0), (54.0, 52.0), (52.0, 47.0)];
        let labels = [("cork", points[0]), ("felt", points[1]), ("glass", points[2])];
        let at = offsets(&labels, &points, (200.0, 100.0));
        let places: Vec<(f64, f64)> =
            points.iter().zip(&at).map(|(p, o)| (p.0 + f64::from(o.0), p.1 + f64::from(o.1))).collect();
        for i in 0..3 {
            for j in 0..i {
                let (dx, dy) = ((places[i].0 - places[j].0).abs(), (places[i].1 - places[j].1).abs());
                assert!(dx > 20.0 || dy > 9.0, "{places:?}");
            }
        }
    }
}
