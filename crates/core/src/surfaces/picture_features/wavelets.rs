//! Haar wavelet energies of a picture, by scale and direction (A. Haar 1910; S. Mallat 1989).

/// Number of levels: details of 2, 4, … 32 pixels.
pub(super) const N_LEVELS: usize = 5;

/// Returns the mean squared detail of each level, finest first: horizontal, vertical and diagonal change.
pub(super) fn haar_energies(gray: &[f64], side: usize) -> [[f64; 3]; N_LEVELS] {
    let (mut image, mut side) = (gray.to_vec(), side);
    std::array::from_fn(|_| {
        let half = side / 2;
        let mut energies = [0.0; 3];
        let mut next = Vec::with_capacity(half * half);
        for y in 0..half {
            for x in 0..half {
                let at = |dx: usize, dy: usize| image[(2 * y + dy) * side + 2 * x + dx];
                let [a, b, c, d] = [at(0, 0), at(1, 0), at(0, 1), at(1, 1)];
                // Orthonormal, except for the means, which stay gray levels.
                let details = [a - b + c - d, a + b - c - d, a - b - c + d].map(|detail| 0.5 * detail);
                for (energy, detail) in energies.iter_mut().zip(details) {
                    *energy += detail * detail;
                }
                next.push(0.25 * (a + b + c + d));
            }
        }
        (image, side) = (next, half);
        energies.map(|energy| energy / (half * half).max(1) as f64)
    })
}
