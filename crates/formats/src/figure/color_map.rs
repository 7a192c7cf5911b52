//! The color map of [`crate::figure::Map`].

/// Returns the sRGB color of a value, given as a fraction of the range, 0..1. The map runs from dark blue through gray
/// to yellow with increasing lightness, so readers with color vision deficiency can read it (after cividis, J. Nuñez,
/// C. Anderton and R. Renslow 2018).
pub fn map_color(share: f32) -> [u8; 3] {
    const STOPS: [[f32; 3]; 5] = [
        [0.0, 34.0, 78.0],
        [62.0, 76.0, 107.0],
        [124.0, 123.0, 120.0],
        [187.0, 173.0, 108.0],
        [254.0, 232.0, 56.0],
    ];
    let at = share.clamp(0.0, 1.0) * (STOPS.len() - 1) as f32;
    let first = (at as usize).min(STOPS.len() - 2);
    let part = at - first as f32;
    let channel = |i: usize| (STOPS[first][i] + part * (STOPS[first + 1][i] - STOPS[first][i])).round() as u8;
    [channel(0), channel(1), channel(2)]
}
