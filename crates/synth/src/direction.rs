//! Direction in which the tip moves over the pad, for textures that feel different along and across their lay.
//!
//! A stroke and its reversal feel alike, so the direction is an axis. It is described and averaged by the double-angle
//! vector (cos 2θ, sin 2θ) (K. V. Mardia and P. E. Jupp, "Directional Statistics", 2000, on axial data).

use crate::relief::Passage;

/// Time constant of the mean, in s: an axis that turns by a full turn in 2 s is followed with a lag of atan(π / 10) / 2,
/// which is 9°.
const MEAN_SECS: f32 = 0.05;
/// Length constant of the mean, in m. It is the shorter one above 40 mm/s, where position noise is small beside the
/// displacement of a tick.
const MEAN_M: f32 = 0.002;
/// Shortest displacement that has a direction, in m. Position noise of a tip at rest stays below it; a tip at 20 mm/s
/// moves farther in a tick of 5 ms.
const LEAST_M: f64 = 8e-5;
/// Longest time that counts for a displacement, in s. Noise that exceeds [`LEAST_M`] after a rest therefore turns the
/// direction only in part.
const MOST_SECS: f32 = 0.01;
/// Length of the mean double-angle vector below which the axis is uncertain. A tip that turns by 90° at a corner passes
/// through such vectors, and the mixture then passes through the middle instead of jumping.
const CERTAIN: f32 = 0.5;

/// Axis of a stroke on the pad.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Direction {
    /// Double-angle vector of at most unit length, shorter for an uncertain axis; `None` without motion so far.
    double: Option<(f32, f32)>,
}

impl Direction {
    /// No motion so far: every texture is stroked across its lay.
    pub const UNKNOWN: Self = Self { double: None };

    /// Stroke at an angle on the pad, in rad, counterclockwise from the pad's x axis. An angle that is not finite gives
    /// [`Direction::UNKNOWN`].
    pub fn at_angle(angle_rad: f32) -> Self {
        let double = (libm::cosf(2.0 * angle_rad), libm::sinf(2.0 * angle_rad));
        Self { double: angle_rad.is_finite().then_some(double) }
    }

    /// Share of the power that comes from the grain along the lay, 0..1, for a texture whose x axis lies at `turn_rad` on
    /// the pad: `sin²` of the angle between the stroke and that axis.
    pub fn share_along(self, turn_rad: f32) -> f32 {
        let Some((cos, sin)) = self.double else { return 0.0 };
        let cos_between = cos * libm::cosf(2.0 * turn_rad) + sin * libm::sinf(2.0 * turn_rad);
        (0.5 * (1.0 - cos_between)).clamp(0.0, 1.0)
    }
}

/// Running mean of the direction of a tip.
#[derive(Clone, Debug, Default)]
pub(crate) struct DirectionMean {
    /// Mean double-angle vector since the tip landed or jumped; `None` before its first displacement.
    mean: Option<(f32, f32)>,
    /// Position in m from which the next displacement counts, and the time since the tip was there, in s.
    from_m: (f64, f64),
    secs: f32,
    direction: Direction,
}

impl DirectionMean {
    /// Returns the direction after a tick of `tick_secs`. It stays while the tip rests, and after a contact onset or a
    /// jump until the first displacement, which replaces it.
    pub(crate) fn follow(&mut self, passage: &Passage, tick_secs: f32) -> Direction {
        if passage.is_elsewhere {
            self.mean = None;
            (self.from_m, self.secs) = ((passage.x_m.0, passage.y_m.0), 0.0);
        }
        self.secs += tick_secs;
        let (x_m, y_m) = (passage.x_m.1 - self.from_m.0, passage.y_m.1 - self.from_m.1);
        let square = x_m * x_m + y_m * y_m;
        if square > LEAST_M * LEAST_M {
            let double = ((x_m * x_m - y_m * y_m) / square, 2.0 * x_m * y_m / square);
            let (cos, sin) = self.next_mean((double.0 as f32, double.1 as f32), libm::sqrt(square) as f32);
            let certain = libm::sqrtf(cos * cos + sin * sin).max(CERTAIN);
            self.mean = Some((cos, sin));
            self.direction = Direction { double: Some((cos / certain, sin / certain)) };
            (self.from_m, self.secs) = ((passage.x_m.1, passage.y_m.1), 0.0);
        }
        self.direction
    }

    fn next_mean(&self, (cos, sin): (f32, f32), length_m: f32) -> (f32, f32) {
        let Some(mean) = self.mean else { return (cos, sin) };
        let ways = (self.secs.min(MOST_SECS) / MEAN_SECS).max(length_m / MEAN_M);
        let weight = 1.0 - libm::expf(-ways);
        (mean.0 + weight * (cos - mean.0), mean.1 + weight * (sin - mean.1))
    }
}

#[cfg(test)]
mod tests;
