//! Low-pass of heights by the contact patch of a ball tip.

/// Gain for waves of angular wave number k in a contact patch of radius a, from the product `ka`:
/// `3 (sin ka − ka cos ka) / (ka)³`.
///
/// It is the mean of a wave over a disk, weighted with the Hertz pressure `√(1 − r²/a²)` (K. L. Johnson, "Contact
/// Mechanics", 1985, equation 3.39). The disk is round, so that the gain does not depend on the direction of the wave.
pub fn patch_gain(ka: f64) -> f64 {
    // Below this, the closed form suffers cancellation, and the first term of the series is accurate.
    if ka < 1e-2 {
        return 1.0 - ka * ka / 10.0;
    }
    3.0 * (ka.sin() - ka * ka.cos()) / ka.powi(3)
}

#[cfg(test)]
mod tests {
    use super::patch_gain;

    /// Slow oracle: the gain is the mean of cos(kx) over the hemispherical pressure of a disk.
    #[test]
    fn the_gain_is_the_integral_over_the_pressure() {
        for ka in [0.005, 0.02, 0.5, 2.0, 7.0] {
            let n = 20_000;
            // Integrating the pressure √(1 − r²) across the patch gives weight π/2 (1 − x²) along x.
            let integral: f64 = (0..n)
                .map(|i| {
                    let x = (f64::from(i) + 0.5) / f64::from(n);
                    1.5 * (1.0 - x * x) * (ka * x).cos() / f64::from(n)
                })
                .sum();
            assert!((patch_gain(ka) - integral).abs() < 1e-8, "ka {ka}");
        }
    }
}
