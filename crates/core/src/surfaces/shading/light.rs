//! Lamp, room and camera of a picture; colors are linear light, 0 to 1 and above.

use crate::surfaces::material::Material;

/// Linear red, green and blue.
pub(super) type Rgb = [f64; 3];

/// A direction: x to the right, y down the picture, z toward the camera.
pub(super) type Direction = [f64; 3];

/// Unit direction toward the lamp at the upper left.
const LAMP: Direction = [-0.507, -0.541, 0.671];

/// Ambient fraction of the diffuse light on a flat surface.
const AMBIENT: f64 = 0.38;

/// Reflectance of a smooth dielectric at normal incidence.
const DIELECTRIC_REFLECTANCE: f64 = 0.045;

/// Change of the view direction's x and y components from one edge of a picture to the other.
const PERSPECTIVE: f64 = 0.55;

/// Returns the light that a point reflects toward the camera.
///
/// `place` is the position in the picture, 0 to 1. `open`, 0 to 1, is the visible fraction of the room.
pub(super) fn reflect(
    material: &Material,
    albedo: Rgb,
    normal: Direction,
    place: [f64; 2],
    open: f64,
) -> Rgb {
    let diffuse = (dot(normal, LAMP) / LAMP[2]).max(0.0);
    let matte = (AMBIENT * open + (1.0 - AMBIENT) * diffuse * (0.4 + 0.6 * open)) * (1.0 - material.metallic);

    let view = unit([PERSPECTIVE * (0.5 - place[0]), PERSPECTIVE * (0.5 - place[1]), 1.0]);
    let facing = dot(normal, view).clamp(0.0, 1.0);
    let mirrored = [0, 1, 2].map(|c| 2.0 * facing * normal[c] - view[c]);
    let fresnel = DIELECTRIC_REFLECTANCE + (1.0 - DIELECTRIC_REFLECTANCE) * (1.0 - facing).powi(5);
    let sheen = open * room(mirrored, material.gloss);

    let clear = material.gloss.sqrt() * fresnel * (1.0 - material.metallic);
    albedo.map(|albedo| albedo * matte + clear * sheen * 3.2 + material.metallic * albedo * sheen)
}

/// Brightness of the room in a direction; lower gloss blurs it more.
fn room(direction: Direction, gloss: f64) -> f64 {
    let blur = 0.03 + 0.75 * (1.0 - gloss).powi(2);
    let [x, y, z] = direction;
    // Dark below, brighter toward the top of the picture.
    let walls = 0.25 + 0.65 * smoothstep(-0.25 - blur, 0.25 + blur, -y - 0.25 * x);
    // A window of two by two panes at the upper left, in perspective.
    let [s, t] = [x / z.max(0.05) + 0.15, y / z.max(0.05) + 0.15];
    let pane = |t: f64| band(t, 0.085, 0.5 * blur) * (1.0 - band(t, 0.006, 0.3 * blur));
    walls + window_strength(gloss) * pane(s) * pane(t)
}

/// Brightness of the window: blur spreads its light, so it is dimmer at low gloss.
fn window_strength(gloss: f64) -> f64 {
    0.8 + 3.2 * gloss.powi(4)
}

/// Returns 1 within `half_width` of 0, falling to 0 over `blur`.
fn band(t: f64, half_width: f64, blur: f64) -> f64 {
    1.0 - smoothstep(half_width - 0.5 * blur, half_width + 0.5 * blur + 1e-6, t.abs())
}

/// Returns 0 below `low`, 1 above `high`, and a smooth transition between.
pub(super) fn smoothstep(low: f64, high: f64, value: f64) -> f64 {
    let t = ((value - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Returns the color at fraction `t` of the way from `a` to `b`.
pub(super) fn lerp(a: Rgb, b: Rgb, t: f64) -> Rgb {
    [0, 1, 2].map(|c| a[c] + t * (b[c] - a[c]))
}

/// Returns the direction scaled to length 1.
pub(super) fn unit(direction: Direction) -> Direction {
    let length = dot(direction, direction).sqrt();
    direction.map(|component| component / length)
}

fn dot(a: Direction, b: Direction) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Returns the linear light of an sRGB color (IEC 61966-2-1).
pub(super) fn linear(srgb: [u8; 3]) -> Rgb {
    srgb.map(|byte| {
        let value = f64::from(byte) / 255.0;
        if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
    })
}

/// Returns the sRGB byte of a linear light; highlights roll off instead of clipping.
pub(super) fn srgb_byte(linear: f64) -> u8 {
    const KNEE: f64 = 0.8;
    let over = (linear - KNEE).max(0.0);
    let value = linear.clamp(0.0, KNEE) + (1.0 - KNEE) * (1.0 - (-over / (1.0 - KNEE)).exp());
    let encoded = if value <= 0.003_130_8 { 12.92 * value } else { 1.055 * value.powf(1.0 / 2.4) - 0.055 };
    (255.0 * encoded).round().clamp(0.0, 255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::{linear, room, srgb_byte, unit};

    #[test]
    fn srgb_round_trips_below_the_highlights() {
        for byte in 0..=230_u8 {
            // The roll-off starts at a linear value of 0.8, which is byte 231.
            assert_eq!(srgb_byte(linear([byte; 3])[0]), byte);
        }
        assert_eq!((srgb_byte(-1.0), srgb_byte(1e9)), (0, 255));
    }

    #[test]
    fn highlights_keep_their_order() {
        let bytes: Vec<u8> = (0..40).map(|i| srgb_byte(0.7 + 0.02 * f64::from(i))).collect();
        assert!(bytes.is_sorted() && bytes[0] < bytes[20]);
    }

    #[test]
    fn a_glossier_mirror_shows_a_brighter_window() {
        let brightest = |gloss: f64| {
            (0..100)
                .flat_map(|i| (0..100).map(move |j| [i, j].map(|k| 0.012 * (f64::from(k) - 50.0))))
                .map(|[x, y]| room(unit([x, y, 1.0]), gloss))
                .fold(0.0, f64::max)
        };
        assert!(brightest(1.0) > brightest(0.5) && brightest(0.5) > brightest(0.0));
    }
}
