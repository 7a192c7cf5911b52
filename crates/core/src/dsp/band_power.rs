//! Power of a spectral density in frequency bands, exact also where resonances are narrow.
//!
//! The peaks of an AR spectrum lie between line spectral frequencies, and are about as wide as the distance between them.
//! Every interval between these frequencies and the edges of the bands is therefore halved toward both of its ends, and each
//! part is integrated by the Gauss-Legendre rule of five nodes.

use crate::units::Hertz;

/// Halvings toward an end of an interval. The last part is 1e-8 of half the interval: about the least distance of line
/// spectral frequencies.
const N_HALVINGS: u32 = 26;

/// Power in one band.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BandPower {
    /// Integral of the density, in its unit times Hz: (m/s²)² for a density in (m/s²)²/Hz.
    pub power: f64,
    /// Mean frequency, weighted by the density; the center of the band if it has no power.
    pub mean: Hertz,
}

/// Returns the power in each band between neighboring `edges`, which ascend.
///
/// `density` returns one value for each frequency. Its narrow peaks and dips must lie near `breaks`, such as the line spectral
/// frequencies of an AR process; the order of `breaks` does not matter.
pub fn band_powers(
    density: impl Fn(&[Hertz]) -> Vec<f64>,
    edges: &[Hertz],
    breaks: &[Hertz],
) -> Vec<BandPower> {
    edges.windows(2).map(|edges| band_power(&density, edges[0].0, edges[1].0, breaks)).collect()
}

fn band_power(
    density: &impl Fn(&[Hertz]) -> Vec<f64>,
    low_hz: f64,
    high_hz: f64,
    breaks: &[Hertz],
) -> BandPower {
    let inside = breaks.iter().map(|at| at.0).filter(|hz| *hz > low_hz && *hz < high_hz);
    let mut ends: Vec<f64> = [low_hz, high_hz].into_iter().chain(inside).collect();
    ends.sort_by(f64::total_cmp);
    let (mut nodes, mut weights) = (Vec::new(), Vec::new());
    for interval in ends.windows(2) {
        let middle_hz = 0.5 * (interval[0] + interval[1]);
        for end_hz in [interval[0], interval[1]] {
            halve_toward(end_hz, middle_hz, &mut nodes, &mut weights);
        }
    }
    let parts = density(&nodes).into_iter().zip(weights).map(|(density, weight)| weight * density);
    let (power, moment) = parts
        .zip(&nodes)
        .fold((0.0, 0.0), |(power, moment), (part, at)| (power + part, moment + part * at.0));
    // Rounding may move the mean of a very narrow band beyond its edges.
    let mean_hz =
        if power > 0.0 { (moment / power).clamp(low_hz, high_hz) } else { 0.5 * (low_hz + high_hz) };
    BandPower { power, mean: Hertz(mean_hz) }
}

/// Adds the nodes and weights of the parts between the middle of an interval and one of its ends.
fn halve_toward(end_hz: f64, middle_hz: f64, nodes: &mut Vec<Hertz>, weights: &mut Vec<f64>) {
    let mut outer = 1.0;
    for halving in 0..=N_HALVINGS {
        let inner = if halving < N_HALVINGS { 0.5 * outer } else { 0.0 };
        let center_hz = end_hz + 0.5 * (inner + outer) * (middle_hz - end_hz);
        let half_hz = 0.5 * (outer - inner) * (middle_hz - end_hz);
        for (node, weight) in gauss_legendre() {
            nodes.push(Hertz(center_hz + node * half_hz));
            weights.push(weight * half_hz.abs());
        }
        outer = inner;
    }
}

/// Nodes and weights of the Gauss-Legendre rule of five nodes on -1 to 1, in closed form.
fn gauss_legendre() -> [(f64, f64); 5] {
    let root = (10.0_f64 / 7.0).sqrt();
    let [near, far] = [5.0 - 2.0 * root, 5.0 + 2.0 * root].map(|square| square.sqrt() / 3.0);
    let part = 13.0 * 70.0_f64.sqrt();
    let [of_near, of_far] = [322.0 + part, 322.0 - part].map(|sum| sum / 900.0);
    [(-far, of_far), (-near, of_near), (0.0, 128.0 / 225.0), (near, of_near), (far, of_far)]
}

#[cfg(test)]
mod tests {
    use super::{BandPower, band_powers, gauss_legendre};
    use crate::dsp::ar::{power_gain, psd};
    use crate::dsp::lsf::ar_from_lsf;
    use crate::units::Hertz;
    use proptest::prelude::{prop, prop_assert, proptest};
    use std::f64::consts::{PI, TAU};

    const RATE: Hertz = Hertz(1000.0);

    fn hertz<const N: usize>(values: [f64; N]) -> [Hertz; N] {
        values.map(Hertz)
    }

    /// Power in each band of an AR process with unit excitation variance.
    fn of_ar(ar: &[f64], edges: &[Hertz], breaks: &[Hertz]) -> Vec<BandPower> {
        band_powers(|at| psd(ar, 1.0, RATE, at), edges, breaks)
    }

    /// Closed form: the rule integrates polynomials up to the ninth degree exactly.
    #[test]
    fn the_rule_is_exact_for_polynomials() {
        for degree in 0..10 {
            let sum: f64 = gauss_legendre().iter().map(|(x, weight)| weight * x.powi(degree)).sum();
            let exact = if degree % 2 == 0 { 2.0 / f64::from(degree + 1) } else { 0.0 };
            assert!((sum - exact).abs() < 1e-15, "{degree}: {sum}");
        }
    }

    /// Closed form: white noise has a power in proportion to the width of a band, and its center as the mean.
    #[test]
    fn white_noise_fills_bands_evenly() {
        let bands = band_powers(|at| vec![0.25; at.len()], &hertz([0.0, 50.0, 200.0, 200.0]), &[Hertz(60.0)]);
        let expected = [(12.5, 25.0), (37.5, 125.0), (0.0, 200.0)];
        assert_eq!(bands.len(), expected.len());
        for (band, (power, mean_hz)) in bands.iter().zip(expected) {
            assert!((band.power - power).abs() < 1e-12 && (band.mean.0 - mean_hz).abs() < 1e-9, "{band:?}");
        }
        let silent = band_powers(|at| vec![0.0; at.len()], &hertz([10.0, 30.0]), &[]);
        assert_eq!(silent, [BandPower { power: 0.0, mean: Hertz(20.0) }]);
        assert!(band_powers(|at| vec![1.0; at.len()], &hertz([10.0]), &[]).is_empty());
    }

    /// Closed form: `y[t] = a y[t-1] + e[t]` has the power `2/π / (1 - a²) atan((1+a)/(1-a) tan(πf/rate))` below f.
    #[test]
    fn a_first_order_process_in_closed_form() {
        for a in [0.5_f64, -0.8, 0.99, 0.999_9] {
            let below = |hz: f64| {
                let tangent = (PI * hz / RATE.0).tan();
                2.0 / PI / (1.0 - a * a) * ((1.0 + a) / (1.0 - a) * tangent).atan()
            };
            let edges = hertz([0.0, 3.0, 50.0, 250.0, 499.0]);
            // The peak is at 0 Hz or at half of the rate, where bands or the process end.
            for (band, edges) in
                of_ar(&[-a], &edges, &[Hertz(RATE.0 * a.acos() / TAU)]).iter().zip(edges.windows(2))
            {
                let exact = below(edges[1].0) - below(edges[0].0);
                assert!((band.power / exact - 1.0).abs() < 1e-6, "{a}: {} for {exact}", band.power);
                assert!((edges[0].0..=edges[1].0).contains(&band.mean.0));
            }
        }
    }

    proptest! {
        /// All bands together have the power of the process, however narrow its resonances.
        #[test]
        fn the_bands_share_the_power_of_the_process(
            gaps in prop::collection::vec(-3.0_f64..0.0, 2..20),
        ) {
            let gaps: Vec<f64> = gaps.iter().map(|exponent| 10_f64.powf(*exponent)).collect();
            let total: f64 = gaps.iter().sum();
            let lsf: Vec<f64> = (1..gaps.len()).map(|i| PI * gaps[..i].iter().sum::<f64>() / total).collect();
            let ar = ar_from_lsf(&lsf);
            let breaks: Vec<Hertz> = lsf.iter().map(|radians| Hertz(RATE.0 * radians / TAU)).collect();
            let bands = of_ar(&ar, &hertz([0.0, 50.0, 80.0, 125.0, 200.0, 315.0, 500.0]), &breaks);
            let sum: f64 = bands.iter().map(|band| band.power).sum();
            let gain = power_gain(&ar);
            // With a larger gain, the rounding of the coefficients exceeds the tolerance in both numbers.
            if gain < 1e8 {
                prop_assert!((sum / gain - 1.0).abs() < 1e-6, "{} for {}", sum, gain);
            }
        }
    }
}
