//! Texture synthesis by image quilting: a large picture of a surface from a small one, without visible tiles.
//!
//! After A. Efros and W. Freeman, "Image quilting for texture synthesis and transfer" (SIGGRAPH 2001): blocks of the
//! sample overlap, each is chosen among random ones to fit its neighbors, and the overlap is cut where both agree most.
//! Unlike there, the result also fits its own opposite edges, so that it can be repeated.

use crate::maths::rng::Random;

/// Blocks that are tried for each place.
const N_TRIED: usize = 32;
/// Side of a block as a fraction of the shorter side of the sample, and the smallest side in pixels.
const BLOCK_SHARE: f64 = 0.45;
const MIN_BLOCK: usize = 8;

/// A picture of linear or encoded colors, row by row from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct Pixels {
    /// Width in pixels.
    pub width: usize,
    /// Red, green and blue of each pixel, 0 to 255.
    pub colors: Vec<[f32; 3]>,
}

impl Pixels {
    /// Height in pixels.
    pub fn height(&self) -> usize {
        self.colors.len().checked_div(self.width).unwrap_or(0)
    }

    /// Color at a place, beyond the edges that of the opposite side.
    pub fn at(&self, x: usize, y: usize) -> [f32; 3] {
        self.colors[y % self.height() * self.width + x % self.width]
    }
}

/// Makes a picture of about `size` pixels (width, height) that looks like `sample` and fits its own opposite edges. The
/// same seed gives the same picture. `None` if the sample is smaller than two blocks.
///
/// Cost: at most 30 differences of colors for each pixel.
pub fn quilted(sample: &Pixels, size: [usize; 2], seed: u64) -> Option<Pixels> {
    let shorter = sample.width.min(sample.height());
    let block = ((BLOCK_SHARE * shorter as f64) as usize).max(MIN_BLOCK);
    if shorter < 2 * MIN_BLOCK {
        return None;
    }
    let overlap = (block / 3).max(2);
    let step = block - overlap;
    let counts = size.map(|side| (side / step).max(2));
    let (width, height) = (counts[0] * step, counts[1] * step);
    let mut quilt = Quilt {
        made: Pixels { width, colors: vec![[0.0; 3]; width * height] },
        is_made: vec![false; width * height],
        block,
        overlap,
    };
    let mut random = Random::new(seed);
    for row in 0..counts[1] {
        for column in 0..counts[0] {
            let place = [column * step, row * step];
            let (mut best, mut least) = ([0, 0], f32::INFINITY);
            for _ in 0..N_TRIED {
                let from =
                    [random.below(sample.width - block + 1), random.below(sample.height() - block + 1)];
                let misfit = quilt.misfit(sample, from, place, least);
                if misfit < least {
                    (best, least) = (from, misfit);
                }
            }
            quilt.put(sample, best, place);
        }
    }
    Some(quilt.made)
}

/// A picture that is being made.
struct Quilt {
    made: Pixels,
    is_made: Vec<bool>,
    block: usize,
    overlap: usize,
}

impl Quilt {
    fn index(&self, [x, y]: [usize; 2]) -> usize {
        y % self.made.height() * self.made.width + x % self.made.width
    }

    /// Squared difference between a pixel of the block and what is there; `None` where nothing is.
    fn difference(
        &self,
        sample: &Pixels,
        from: [usize; 2],
        place: [usize; 2],
        at: [usize; 2],
    ) -> Option<f32> {
        let index = self.index([place[0] + at[0], place[1] + at[1]]);
        let there = self.is_made[index].then(|| self.made.colors[index])?;
        let new = sample.at(from[0] + at[0], from[1] + at[1]);
        Some((0..3).map(|c| (new[c] - there[c]) * (new[c] - there[c])).sum())
    }

    /// Sum of the squared differences where the block overlaps what is there, or a part of it that exceeds `limit`.
    fn misfit(&self, sample: &Pixels, from: [usize; 2], place: [usize; 2], limit: f32) -> f32 {
        let far = self.block - self.overlap;
        let mut sum = 0.0;
        // Every other pixel in both directions is enough to compare.
        for y in (0..self.block).step_by(2) {
            let is_edge_row = y < self.overlap || y >= far;
            for x in (0..self.block).step_by(2) {
                if is_edge_row || x < self.overlap || x >= far {
                    sum += self.difference(sample, from, place, [x, y]).unwrap_or(0.0);
                }
            }
            if sum > limit {
                return sum;
            }
        }
        sum
    }

    /// Puts a block in place; where it overlaps, both are cut along the path of least difference.
    fn put(&mut self, sample: &Pixels, from: [usize; 2], place: [usize; 2]) {
        let (block, overlap) = (self.block, self.overlap);
        let mut is_new = vec![true; block * block];
        for axis in 0..2 {
            for is_far in [false, true] {
                // Pixel at a distance from the edge, along the edge.
                let at = |depth: usize, along: usize| {
                    let across = if is_far { block - 1 - depth } else { depth };
                    if axis == 0 { [across, along] } else { [along, across] }
                };
                let has_neighbor = self.difference(sample, from, place, at(0, block / 2)).is_some();
                if !has_neighbor {
                    continue;
                }
                let cost = |depth: usize, along: usize| {
                    self.difference(sample, from, place, at(depth, along)).unwrap_or(0.0)
                };
                for (along, cut) in cheapest_cut(overlap, block, cost).into_iter().enumerate() {
                    for depth in 0..cut {
                        let [x, y] = at(depth, along);
                        is_new[y * block + x] = false;
                    }
                }
            }
        }
        for y in 0..block {
            for x in 0..block {
                let index = self.index([place[0] + x, place[1] + y]);
                if is_new[y * block + x] || !self.is_made[index] {
                    self.made.colors[index] = sample.at(from[0] + x, from[1] + y);
                    self.is_made[index] = true;
                }
            }
        }
    }
}

/// For each place along an edge, the depth from which the new block begins, on the connected path of least cost.
fn cheapest_cut(depths: usize, length: usize, cost: impl Fn(usize, usize) -> f32) -> Vec<usize> {
    // sums[along][depth]: least cost of a path from the first place to this one.
    let mut sums = vec![vec![0.0_f32; depths]; length];
    for along in 0..length {
        for depth in 0..depths {
            let before = if along == 0 {
                0.0
            } else {
                let near = depth.saturating_sub(1)..=(depth + 1).min(depths - 1);
                sums[along - 1][near].iter().copied().fold(f32::INFINITY, f32::min)
            };
            sums[along][depth] = before + cost(depth, along);
        }
    }
    let least = |sums: &[f32], among: std::ops::RangeInclusive<usize>| {
        among.min_by(|a, b| sums[*a].total_cmp(&sums[*b])).unwrap_or(0)
    };
    let mut path: Vec<usize> = vec![0; length];
    for along in (0..length).rev() {
        let among = match path.get(along + 1) {
            None => 0..=depths - 1,
            Some(next) => next.saturating_sub(1)..=(next + 1).min(depths - 1),
        };
        path[along] = least(&sums[along], among);
    }
    path
}

#[cfg(test)]
mod tests {
    use super::{Pixels, cheapest_cut, quilted};
    use crate::maths::rng::Random;
    use proptest::prelude::{prop, prop_assert, proptest};

    /// A weave with noise: regular, but no two places alike.
    fn weave(side: usize) -> Pixels {
        let mut random = Random::new(3);
        let color = |x: usize, y: usize, noise: f64| {
            let wave = (0.7 * x as f64).sin() + (0.9 * y as f64).sin();
            [(128.0 + 50.0 * wave + 8.0 * noise) as f32; 3]
        };
        let colors = (0..side * side).map(|i| color(i % side, i / side, random.normal())).collect();
        Pixels { width: side, colors }
    }

    /// Mean absolute difference between neighbors across the columns at `x`.
    fn step_at(of: &Pixels, x: usize) -> f32 {
        let height = of.height();
        (0..height).map(|y| (of.at(x, y)[0] - of.at(x + 1, y)[0]).abs()).sum::<f32>() / height as f32
    }

    #[test]
    fn the_result_has_the_colors_of_the_sample_and_no_seam() {
        let sample = weave(72);
        let made = quilted(&sample, [300, 160], 1).unwrap();
        assert!(made.width > 250 && made.height() > 120, "{} x {}", made.width, made.height());
        assert!(made.colors.iter().all(|color| sample.colors.contains(color)), "no color is made up");
        // Neighbors differ as much as in the sample, also across the outer edge.
        let usual = (0..70).map(|x| step_at(&sample, x)).sum::<f32>() / 70.0;
        let worst = (0..made.width).map(|x| step_at(&made, x)).fold(0.0, f32::max);
        assert!(worst < 1.6 * usual, "{worst} for {usual}");
        assert!(step_at(&made, made.width - 1) < 1.5 * usual);
        // A tiled copy would repeat after 72 pixels.
        let repeated = (0..made.width).filter(|x| made.at(*x, 5) == made.at(x + 72, 5)).count();
        assert!(repeated < made.width / 4, "{repeated}");
        assert_eq!(quilted(&sample, [300, 160], 1), Some(made));
        assert_eq!(quilted(&weave(12), [100, 100], 1), None);
    }

    /// Without the search and the cut, the seams would show.
    #[test]
    fn blocks_put_side_by_side_would_be_found() {
        let sample = weave(72);
        let mut random = Random::new(9);
        let places: Vec<[usize; 2]> = (0..64).map(|_| [random.below(40), random.below(40)]).collect();
        let colors = (0..256 * 256).map(|i| {
            let (x, y) = (i % 256, i / 256);
            let [dx, dy] = places[y / 32 * 8 + x / 32];
            sample.at(dx + x % 32, dy + y % 32)
        });
        let tiled = Pixels { width: 256, colors: colors.collect() };
        let usual = (0..70).map(|x| step_at(&sample, x)).sum::<f32>() / 70.0;
        let worst = (0..255).map(|x| step_at(&tiled, x)).fold(0.0, f32::max);
        assert!(worst > 1.6 * usual, "{worst} for {usual}");
    }

    proptest! {
        /// The cut is connected and at least as cheap as any straight one.
        #[test]
        fn a_cut_is_connected_and_cheap(costs in prop::collection::vec(0.0_f32..10.0, 60)) {
            let cost = |depth: usize, along: usize| costs[along * 4 + depth];
            let path = cheapest_cut(4, 15, cost);
            prop_assert!(path.windows(2).all(|pair| pair[0].abs_diff(pair[1]) <= 1));
            let total: f32 = path.iter().enumerate().map(|(along, depth)| cost(*depth, along)).sum();
            for depth in 0..4 {
                let straight: f32 = (0..15).map(|along| cost(depth, along)).sum();
                prop_assert!(total <= straight + 1e-3);
            }
        }
    }
}
