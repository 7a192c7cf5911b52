//! Heat map behind the canvas.

use shagreen_core::space::authoring::Outside;
use shagreen_core::space::heat_map::Quantity;

pub const MAP: &str = "Map behind the space";
pub const WAITING: &str = "computing…";
pub const NO_VALUES: &str = "no values here";
pub const NO_VALUES_HELP: &str = "The textures are silent at this speed and force, or too few for this map.";
pub const OUTSIDE_HELP: &str = " Outside the hull, the map shows the texture that plays there: the one at the nearest point of the hull, or the extrapolated one.";

/// Name of a map; `None` is no map.
pub fn name(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "No map",
        Some(Quantity::Level) => "Level",
        Some(Quantity::Centroid) => "Spectral centroid",
        Some(Quantity::Roughness) => "Predicted x position",
        Some(Quantity::Distance) => "Texture distance",
    }
}

pub fn help(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "No colors behind the space",
        Some(Quantity::Level) => {
            "Level of the interpolated texture at each point, in dB re 1 m/s². Computed from the models, at the speed and force of the automatic stroke"
        }
        Some(Quantity::Centroid) => {
            "Spectral centroid of the interpolated texture at each point, from 20 to 500 Hz, in Hz. Computed from the models, at the speed and force of the automatic stroke"
        }
        Some(Quantity::Roughness) => {
            "x position predicted from level and spectral centroid alone (0 is the left end of the x axis, 100 the right end). \
             Where it differs from the actual x position, level and centroid do not explain that position. It is computed from the models, not rated by people"
        }
        Some(Quantity::Distance) => {
            "Distance in the space to the nearest texture, in axis points (each axis has 100). Far from all textures, the interpolated texture is uncertain"
        }
    }
}

/// Which values a map has outside the convex hull in a space with more axes than the canvas.
pub fn outside(outside: Outside) -> &'static str {
    match outside {
        Outside::Clamped => "Outside the hull: nearest point",
        Outside::Extrapolated => "Outside the hull: extrapolated",
    }
}

pub fn value(quantity: Quantity, value: f64) -> String {
    match quantity {
        // Rounded first, so that nothing reads "-0 dB".
        Quantity::Level => format!("{:.0} dB", value.round() + 0.0),
        Quantity::Centroid => format!("{value:.0} Hz"),
        Quantity::Roughness => format!("x = {:.0}", value.round() + 0.0),
        Quantity::Distance => format!("{:.0} points", value.round() + 0.0),
    }
}

/// Description of the color scale for a screen reader.
pub fn scale(title: &str, low: &str, high: &str) -> String {
    format!("{title}, from {low} to {high}")
}
