//! Shape of an authored texture.

use shagreen_core::texture::shape::ShapeControl;

pub const HEADING: &str = "Shape";
pub const HELP: &str = "Changes the interpolated texture as a whole. At the neutral values the texture is exactly the interpolated one.";
pub const RESET_ALL: &str = "Reset shape";
pub const RESET_ALL_HELP: &str = "Makes all seven controls neutral";

/// Heading with the number of controls that are not neutral.
pub fn heading(n_changed: usize) -> String {
    if n_changed == 0 { HEADING.to_owned() } else { format!("{HEADING} ({n_changed} changed)") }
}

pub fn name(control: ShapeControl) -> &'static str {
    match control {
        ShapeControl::Level => "Level",
        ShapeControl::Grain => "Grain size",
        ShapeControl::Brightness => "Brightness",
        ShapeControl::Softness => "Tap softness",
        ShapeControl::Friction => "Friction",
        ShapeControl::Relief => "Relief depth",
        ShapeControl::Direction => "Direction",
    }
}

pub fn help(control: ShapeControl) -> &'static str {
    match control {
        ShapeControl::Level => {
            "Level of the vibration while the tip moves, in dB relative to the interpolated texture. The tap transient keeps its level."
        }
        ShapeControl::Grain => {
            "Spatial scale of the surface, relative to the interpolated texture: above 1 is coarser. At the same speed, all frequencies are divided by this factor."
        }
        ShapeControl::Brightness => {
            "Slope of the spectrum around 100 Hz, in dB an octave: above 0, high frequencies are stronger. The level stays the same."
        }
        ShapeControl::Softness => {
            "Factor by which the tap transient is slower and weaker: above 1 is softer. No effect on a texture without a tap transient."
        }
        ShapeControl::Friction => {
            "Factor of the friction coefficient. No effect on a texture without a friction coefficient."
        }
        ShapeControl::Relief => {
            "Factor of the height of the relief. No effect on a texture without a relief."
        }
        ShapeControl::Direction => {
            "Rotation of the texture on the pad, counterclockwise, in degrees. No effect on a texture that is equal in all directions."
        }
    }
}

/// Why a control has nothing to act on; empty for those that always have something.
pub fn nothing(control: ShapeControl) -> &'static str {
    match control {
        ShapeControl::Level | ShapeControl::Grain | ShapeControl::Brightness => "",
        ShapeControl::Softness => "This texture has no tap transient.",
        ShapeControl::Friction => "This texture has no friction coefficient.",
        ShapeControl::Relief => "This texture has no relief.",
        ShapeControl::Direction => "This texture is equal in all directions.",
    }
}

/// Accessible name of the slider.
pub fn slider(control: ShapeControl) -> String {
    format!("{HEADING}: {}", name(control).to_lowercase())
}

/// Accessible name of the button that makes a control neutral.
pub fn reset(control: ShapeControl) -> String {
    format!("Reset {}", name(control).to_lowercase())
}

/// Text before the number.
pub fn prefix(control: ShapeControl) -> &'static str {
    if control.unit().is_empty() { "\u{d7}" } else { "" }
}

/// Text after the number.
pub fn suffix(control: ShapeControl) -> &'static str {
    match control {
        ShapeControl::Level => " dB",
        ShapeControl::Brightness => " dB/oct",
        ShapeControl::Direction => "\u{b0}",
        ShapeControl::Grain | ShapeControl::Softness | ShapeControl::Friction | ShapeControl::Relief => "",
    }
}

/// Notice that a typed number is out of range.
pub fn limited(control: ShapeControl) -> String {
    let limits = control.limits();
    let [low, high] = [limits.start(), limits.end()]
        .map(|limit| format!("{}{}{}", prefix(control), number(control, *limit), suffix(control)));
    format!("{}: {low} to {high}", name(control))
}

/// The number, with as many decimals as a hand can set.
pub fn number(control: ShapeControl, value: f64) -> String {
    match control {
        ShapeControl::Level | ShapeControl::Brightness => format!("{value:.1}"),
        ShapeControl::Direction => format!("{value:.0}"),
        ShapeControl::Grain | ShapeControl::Softness | ShapeControl::Friction | ShapeControl::Relief => {
            format!("{value:.2}")
        }
    }
}
