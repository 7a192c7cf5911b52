//! Choice among the octaves of a multiresolution pyramid by the tip's displacement.

/// The octave to play for a tip displacement per model sample: the first one whose band ends at or below half the
/// sample rate, if every octave contains only components with at least four samples per period; `step_m` is the distance
/// between two samples of octave 0.
///
/// Above each whole octave, the next octave is faded in within a quarter of an octave. Components at the edge of the band
/// thus fade out smoothly, and aliasing is possible only within that quarter octave.
pub(crate) fn octave_for(way_m: f64, step_m: f32) -> f32 {
    let ways = libm::fabs(way_m) as f32 / (2.0 * step_m);
    if ways <= 1.0 {
        return 0.0;
    }
    let octave = libm::log2f(ways);
    let lower = libm::floorf(octave);
    lower + (4.0 * (octave - lower)).min(1.0)
}

/// Returns the lower one of the two octaves around a fractional one, of octaves 0 to `last`, and the share of the upper
/// one.
pub(crate) fn lower_and_share(octave: f32, last: u32) -> (u32, f32) {
    let octave = octave.clamp(0.0, last as f32);
    let lower = octave as u32;
    (lower, octave - lower as f32)
}

#[cfg(test)]
mod tests {
    use super::{lower_and_share, octave_for};

    #[test]
    fn the_band_of_an_octave_ends_at_half_the_sample_rate() {
        // Four samples of 1 mm per period: a displacement of 2 mm is half a period.
        for (way_m, octave) in [(0.0, 0.0), (0.002, 0.0), (-0.0019, 0.0), (0.004, 1.0), (-0.016, 3.0)] {
            assert!((octave_for(way_m, 1e-3) - octave).abs() < 1e-5, "{way_m}");
        }
        // An eighth of an octave above a whole one, half of the next octave is faded in.
        assert!((octave_for(0.004 * libm::pow(2.0, 0.125), 1e-3) - 1.5).abs() < 1e-4);
        assert!((octave_for(0.0079, 1e-3) - 2.0).abs() < 1e-6);
    }

    #[test]
    fn octaves_out_of_range_are_limited() {
        assert_eq!(lower_and_share(-1.0, 5), (0, 0.0));
        assert_eq!(lower_and_share(2.25, 5), (2, 0.25));
        assert_eq!(lower_and_share(f32::INFINITY, 5), (5, 0.0));
    }
}
