//! Words about the map behind the canvas.

use shagreen_core::heat_map::Quantity;

/// Accessible name of the choice.
pub const MAP: &str = "Map behind the space";
/// The map is being worked out.
pub const WAITING: &str = "working out…";

/// The name of a map; `None` shows none.
pub fn name(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "No map",
        Some(Quantity::Level) => "Level",
        Some(Quantity::Centroid) => "Spectral centroid",
        Some(Quantity::Roughness) => "Predicted place",
        Some(Quantity::Distance) => "Thin places",
    }
}

/// What a map shows.
pub fn help(quantity: Option<Quantity>) -> &'static str {
    match quantity {
        None => "Colors behind the space show what is authored where",
        Some(Quantity::Level) => {
            "How strong the texture of each point is at the speed and force of the hand, by its model"
        }
        Some(Quantity::Centroid) => {
            "Where the middle of the spectrum lies between 20 and 500 Hz at the speed and force of the hand, by the model"
        }
        Some(Quantity::Roughness) => {
            "The place along the first axis (0 is its left end, in this space the rough one) that level and centroid alone predict: where it differs from the axis, vibration \
             does not tell the whole. A prediction from signals, no rating"
        }
        Some(Quantity::Distance) => {
            "How far the nearest real texture is: far from all, what is authored is a guess"
        }
    }
}

/// A value with its unit.
pub fn value(quantity: Quantity, value: f64) -> String {
    match quantity {
        // Rounded first, so that nothing reads "-0 dB".
        Quantity::Level => format!("{:.0} dB", value.round() + 0.0),
        Quantity::Centroid => format!("{value:.0} Hz"),
        Quantity::Roughness => format!("{:.0} of 100", value.round() + 0.0),
        Quantity::Distance => format!("{:.0} points", value.round() + 0.0),
    }
}

/// The scale, as a screen reader says it.
pub fn scale(title: &str, low: &str, high: &str) -> String {
    format!("{title}, from {low} to {high}")
}
