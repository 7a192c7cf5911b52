//! Color map behind the canvas.

use shagreen_core::space::heat_map::Quantity;

pub const MAP: &str = "Map behind the space";
pub const WAITING: &str = "computing…";

/// Name of a map; `None` is no map.
pub fn name(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "No map",
        Some(Quantity::Level) => "Level",
        Some(Quantity::Centroid) => "Spectral centroid",
        Some(Quantity::Roughness) => "Predicted x",
        Some(Quantity::Distance) => "Texture distance",
    }
}

pub fn help(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "Colors a quantity of the interpolated texture at every point of the space",
        Some(Quantity::Level) => {
            "Level of the texture at each point, from its model, in dB re 1 m/s², at the speed and force of the stroke"
        }
        Some(Quantity::Centroid) => {
            "Spectral centroid of the model between 20 and 500 Hz, at the speed and force of the stroke"
        }
        Some(Quantity::Roughness) => {
            "Position along the x axis (0 is its left end, the rough end in this space) predicted from level and spectral centroid \
             alone. Where it differs from the actual position, vibration does not determine it alone. A prediction from signals, not a rating"
        }
        Some(Quantity::Distance) => {
            "Distance to the nearest measured texture, in points of the axes (0 to 100). Far from all textures, the interpolated one is a guess"
        }
    }
}

pub fn value(quantity: Quantity, value: f64) -> String {
    match quantity {
        // Rounded first, so that nothing reads "-0 dB".
        Quantity::Level => format!("{:.0} dB", value.round() + 0.0),
        Quantity::Centroid => format!("{value:.0} Hz"),
        Quantity::Roughness => format!("{:.0} of 100", value.round() + 0.0),
        Quantity::Distance => format!("{:.0} points", value.round() + 0.0),
    }
}

/// Color scale for a screen reader.
pub fn scale(title: &str, low: &str, high: &str) -> String {
    format!("{title}, from {low} to {high}")
}
