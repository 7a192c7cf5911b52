//! The colors of maps.

/// The color of a map at a share of its range, 0..1, as red, green and blue: from dark blue by gray to yellow, which readers
/// of any color vision tell apart, and which gets lighter all the way (after cividis, J. Nuñez, C. Anderton and R. Renslow
/// 2018).
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
