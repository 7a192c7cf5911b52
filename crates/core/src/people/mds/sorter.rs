//! Sorting of distances together with their pairs, again and again in nearly the same order.
//!
//! A descent moves the points little, so a run of tied pairs is nearly in order from the step before: late in a descent,
//! insertion mends it. Otherwise distances are first dealt into buckets of equal width, about as many as there are
//! distances, in one pass. Both keep the order of equal distances, and both are linear in practice.

/// Number of distances below which a comparison sort is as fast.
const FEW: usize = 64;

/// Number of distances for each fall up to which insertion alone is tried.
const FEW_FALLS: usize = 8;

/// Number of buckets for each distance: with more, fewer distances are out of order in their bucket.
const BUCKETS_EACH: usize = 2;

/// Maximum number of distances in a bucket; insertion would take too long with more.
const MOST_IN_BUCKET: u32 = 32;

/// Sorts distances and pairs; it keeps the memory that this takes.
#[derive(Clone, Default)]
pub(super) struct Sorter {
    /// Number of distances in each bucket, then the index of the next free place of each.
    places: Vec<u32>,
    buckets: Vec<u32>,
    values: Vec<f64>,
    pairs: Vec<[u16; 2]>,
}

impl Sorter {
    /// Sorts `values` and applies the same permutation to `pairs`. Equal values keep their order.
    pub(super) fn sort(&mut self, values: &mut [f64], pairs: &mut [[u16; 2]]) {
        let n_falls = values.windows(2).filter(|two| two[0] > two[1]).count();
        if n_falls == 0 || (n_falls <= values.len() / FEW_FALLS && insert(values, pairs, values.len())) {
            return;
        }
        if values.len() < FEW || !self.deal(values) {
            return by_comparison(values, pairs);
        }
        self.values.clear();
        self.values.extend_from_slice(values);
        self.pairs.clear();
        self.pairs.extend_from_slice(pairs);
        for ((bucket, value), pair) in self.buckets.iter().zip(&self.values).zip(&self.pairs) {
            let place = &mut self.places[*bucket as usize];
            values[*place as usize] = *value;
            pairs[*place as usize] = *pair;
            *place += 1;
        }
        insert(values, pairs, usize::MAX);
    }

    /// Computes the bucket of each value and the first place of each bucket; `false` if a bucket is too full.
    fn deal(&mut self, values: &[f64]) -> bool {
        let (lowest, highest) = range(values);
        let n_buckets = BUCKETS_EACH * values.len();
        let scale = n_buckets as f64 / (highest - lowest);
        if !scale.is_finite() {
            return false;
        }
        self.buckets.clear();
        // Conversion truncates, and the highest value gets a bucket of its own, so none lies outside.
        self.buckets.extend(values.iter().map(|value| ((value - lowest) * scale) as u32));
        self.places.clear();
        self.places.resize(n_buckets + 1, 0);
        for bucket in &self.buckets {
            self.places[*bucket as usize] += 1;
        }
        if self.places.iter().any(|n| *n > MOST_IN_BUCKET) {
            return false;
        }
        let mut first = 0;
        for place in &mut self.places {
            first += std::mem::replace(place, first);
        }
        true
    }
}

/// Lowest and highest value, in several lanes at once.
fn range(values: &[f64]) -> (f64, f64) {
    const LANES: usize = 4;
    let (mut lowest, mut highest) = ([f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]);
    let (fours, rest) = values.as_chunks::<LANES>();
    for four in fours {
        for lane in 0..LANES {
            lowest[lane] = if four[lane] < lowest[lane] { four[lane] } else { lowest[lane] };
            highest[lane] = if four[lane] > highest[lane] { four[lane] } else { highest[lane] };
        }
    }
    let low = lowest.iter().chain(rest).copied().fold(f64::INFINITY, f64::min);
    (low, highest.iter().chain(rest).copied().fold(f64::NEG_INFINITY, f64::max))
}

/// Insertion sort, for values that are nearly sorted; `false` if it would shift values more than `most` times, and it
/// ends midway.
fn insert(values: &mut [f64], pairs: &mut [[u16; 2]], mut most: usize) -> bool {
    for i in 1..values.len() {
        let value = values[i];
        if values[i - 1] <= value {
            continue;
        }
        let pair = pairs[i];
        let to = values[..i - 1].iter().rposition(|before| *before <= value).map_or(0, |before| before + 1);
        values.copy_within(to..i, to + 1);
        pairs.copy_within(to..i, to + 1);
        (values[to], pairs[to]) = (value, pair);
        if i - to > most {
            return false;
        }
        most -= i - to;
    }
    true
}

fn by_comparison(values: &mut [f64], pairs: &mut [[u16; 2]]) {
    let mut both: Vec<(f64, [u16; 2])> = values.iter().copied().zip(pairs.iter().copied()).collect();
    // A stable sort also benefits from the order that the previous step left.
    both.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    for ((value, pair), sorted) in values.iter_mut().zip(pairs).zip(both) {
        (*value, *pair) = sorted;
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::{prop, prop_assert_eq, proptest};

    use super::{Sorter, by_comparison};
    use crate::maths::rng::lcg_noise;

    fn check(sorter: &mut Sorter, values: &[f64]) {
        let pairs: Vec<[u16; 2]> = (0..values.len()).map(|i| [(i >> 8) as u16, i as u16]).collect();
        let (mut sorted, mut with) = (values.to_vec(), pairs.clone());
        sorter.sort(&mut sorted, &mut with);
        let (mut slowly, mut slow_with) = (values.to_vec(), pairs);
        by_comparison(&mut slowly, &mut slow_with);
        assert_eq!(sorted, slowly);
        assert_eq!(with, slow_with);
    }

    #[test]
    fn agrees_with_a_comparison_sort() {
        let mut sorter = Sorter::default();
        let noise: Vec<f64> = lcg_noise(5000, 3).iter().map(|v| v.abs()).collect();
        check(&mut sorter, &noise);
        // Nearly sorted, with many equal values.
        let steps: Vec<f64> =
            noise.iter().zip(0..).map(|(e, k)| f64::from(k / 7) + (2.0 * e).round()).collect();
        check(&mut sorter, &steps);
        // One far value leaves all others in one bucket, and infinity makes all buckets infinitely wide.
        for far in [1e9, f64::MAX, f64::INFINITY] {
            let mut values = noise.clone();
            values[17] = far;
            check(&mut sorter, &values);
        }
        check(&mut sorter, &[vec![1.0; 100], vec![0.0; 100]].concat());
    }

    proptest! {
        #[test]
        fn any_values_are_sorted(values in prop::collection::vec(0.0_f64..9.0, 0..300), scale in 0_i32..600) {
            let values: Vec<f64> = values.iter().map(|v| v * 2.0_f64.powi(-scale)).collect();
            let (mut sorted, mut pairs) = (values.clone(), vec![[0; 2]; values.len()]);
            Sorter::default().sort(&mut sorted, &mut pairs);
            let mut expected = values;
            expected.sort_by(f64::total_cmp);
            prop_assert_eq!(sorted, expected);
        }
    }
}
