//! Shape of a texture: seven controls that change it as a whole, as the controls of a synthesizer change a sound.
//!
//! Each control has a neutral value, at which it changes no bit of the texture, and changes only what its name says:
//!
//! | control | effect |
//! |---|---|
//! | level | levels of the grain, of the relief and of the height map times `10^(dB/20)` |
//! | grain size | spatial scale of the surface times `g`: at the same speed, every frequency is divided by `g` |
//! | brightness | slope of the spectrum, in dB an octave around 100 Hz, at the same level |
//! | softness | frequency, decay and amplitude of the tap transient divided by `s` |
//! | friction | friction coefficient times a factor |
//! | relief | height of the relief and of the height map times a factor |
//! | direction | rotation on the pad, counterclockwise |
//!
//! The level is that of the vibration while the tip moves. The tap transient has its own control, because a hand feels
//! hardness in the tap and loudness in the stroke. Stick-slip follows from the friction coefficient, not from the level.

mod layers;
mod spectra;
#[cfg(test)]
mod tests;
mod text;

use std::ops::RangeInclusive;

use crate::texture::shape::layers::{shaped_height_map, shaped_relief};
use crate::texture::shape::spectra::{NodeShaper, shaped_grain};
use crate::texture::tap::Tap;
use crate::texture::{TextureModel, TextureModelError};
use crate::units::Hertz;

/// Changes of a texture as a whole. The default is neutral.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shape {
    /// Change of the level of the vibration while the tip moves, in dB.
    pub level_db: f64,
    /// Factor of the spatial scale of the surface: above 1 is coarser.
    pub grain: f64,
    /// Change of the slope of the spectrum, in dB an octave: above 0 is brighter.
    pub brightness_db_per_octave: f64,
    /// Factor by which the tap transient is slower and weaker: above 1 is softer.
    pub softness: f64,
    /// Factor of the friction coefficient.
    pub friction: f64,
    /// Factor of the height of the relief and of the height map.
    pub relief: f64,
    /// Rotation on the pad in degrees, counterclockwise.
    pub direction_deg: f64,
}

/// Control of a shape.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShapeControl {
    /// [`Shape::level_db`].
    Level,
    /// [`Shape::grain`].
    Grain,
    /// [`Shape::brightness_db_per_octave`].
    Brightness,
    /// [`Shape::softness`].
    Softness,
    /// [`Shape::friction`].
    Friction,
    /// [`Shape::relief`].
    Relief,
    /// [`Shape::direction_deg`].
    Direction,
}

/// Why values or a text are not a shape.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// A value is out of range or not a number.
    #[error(
        "{} of the shape is {value}; it must be from {} to {}{}",
        .control.id(),
        .control.limits().start(),
        .control.limits().end(),
        .control.unit_after_number()
    )]
    Value {
        /// Control with this value.
        control: ShapeControl,
        /// The value.
        value: f64,
    },
    /// A part of a text is not of the form `control=value`.
    #[error("\"{part}\" is not of the form control=value; write a shape as in level=-3,grain=1.2")]
    Part {
        /// The part between two commas.
        part: String,
    },
    /// A text names a control that does not exist.
    #[error("a shape has no \"{name}\"; {meant}")]
    Name {
        /// The name in the text.
        name: String,
        /// Question with similar names, or a list of all names.
        meant: String,
    },
    /// A text names a control twice.
    #[error("a shape has {} only once; remove one of the two values", .control.id())]
    Twice {
        /// The control.
        control: ShapeControl,
    },
    /// A value in a text is not a number.
    #[error(
        "{} of the shape is \"{value}\", which is not a number; write one from {} to {}{}",
        .control.id(),
        .control.limits().start(),
        .control.limits().end(),
        .control.unit_after_number()
    )]
    NotANumber {
        /// The control.
        control: ShapeControl,
        /// The text of the value.
        value: String,
    },
}

impl Default for Shape {
    fn default() -> Self {
        Self {
            level_db: 0.0,
            grain: 1.0,
            brightness_db_per_octave: 0.0,
            softness: 1.0,
            friction: 1.0,
            relief: 1.0,
            direction_deg: 0.0,
        }
    }
}

impl ShapeControl {
    /// All controls, in the order of the user interface.
    pub const ALL: [Self; 7] = [
        Self::Level,
        Self::Grain,
        Self::Brightness,
        Self::Softness,
        Self::Friction,
        Self::Relief,
        Self::Direction,
    ];

    /// Identifier in scripts.
    pub fn id(self) -> &'static str {
        match self {
            Self::Level => "level",
            Self::Grain => "grain",
            Self::Brightness => "brightness",
            Self::Softness => "softness",
            Self::Friction => "friction",
            Self::Relief => "relief",
            Self::Direction => "direction",
        }
    }

    /// Unit of the values; empty for a factor.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Level => "dB",
            Self::Brightness => "dB/octave",
            Self::Direction => "°",
            Self::Grain | Self::Softness | Self::Friction | Self::Relief => "",
        }
    }

    /// Lowest and highest valid value.
    pub fn limits(self) -> RangeInclusive<f64> {
        match self {
            Self::Level => -24.0..=12.0,
            Self::Grain | Self::Softness => 0.25..=4.0,
            Self::Brightness => -6.0..=6.0,
            Self::Friction => 0.0..=3.0,
            Self::Relief => 0.0..=4.0,
            Self::Direction => -180.0..=180.0,
        }
    }

    /// Value that changes nothing.
    pub fn neutral(self) -> f64 {
        Shape::default().get(self)
    }

    /// The unit as it follows a number.
    fn unit_after_number(self) -> String {
        match self.unit() {
            "" | "°" => self.unit().to_owned(),
            unit => format!(" {unit}"),
        }
    }
}

impl Shape {
    /// Value of a control.
    pub fn get(&self, control: ShapeControl) -> f64 {
        match control {
            ShapeControl::Level => self.level_db,
            ShapeControl::Grain => self.grain,
            ShapeControl::Brightness => self.brightness_db_per_octave,
            ShapeControl::Softness => self.softness,
            ShapeControl::Friction => self.friction,
            ShapeControl::Relief => self.relief,
            ShapeControl::Direction => self.direction_deg,
        }
    }

    /// Returns the shape with another value of a control, limited to its range. A value that is not a number changes
    /// nothing.
    #[must_use]
    pub fn with(mut self, control: ShapeControl, value: f64) -> Self {
        if value.is_nan() {
            return self;
        }
        let limits = control.limits();
        let value = value.clamp(*limits.start(), *limits.end());
        match control {
            ShapeControl::Level => self.level_db = value,
            ShapeControl::Grain => self.grain = value,
            ShapeControl::Brightness => self.brightness_db_per_octave = value,
            ShapeControl::Softness => self.softness = value,
            ShapeControl::Friction => self.friction = value,
            ShapeControl::Relief => self.relief = value,
            ShapeControl::Direction => self.direction_deg = value,
        }
        self
    }

    /// Returns the shape if every value is in its range.
    ///
    /// # Errors
    /// [`ShapeError::Value`] for the first one that is not.
    pub fn checked(self) -> Result<Self, ShapeError> {
        let is_bad = |control: &ShapeControl| !control.limits().contains(&self.get(*control));
        match ShapeControl::ALL.into_iter().find(is_bad) {
            Some(control) => Err(ShapeError::Value { control, value: self.get(control) }),
            None => Ok(self),
        }
    }

    /// Controls that are not neutral.
    pub fn changed(&self) -> impl Iterator<Item = ShapeControl> {
        let shape = *self;
        ShapeControl::ALL.into_iter().filter(move |control| shape.get(*control) != control.neutral())
    }

    /// Whether the shape changes nothing.
    pub fn is_neutral(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the texture in this shape; for a neutral shape, the same texture. Values out of range are limited to it.
    ///
    /// First the grain: its spectra are scaled by the grain size, then tilted by the brightness, and fitted again by
    /// predictors of order 32 (or of the texture's own order, if that is higher), if one of the two is not neutral; then
    /// its level is changed. Grain size keeps the level, except for the power that a finer grain moves above half of the model rate.
    /// The other layers follow. Relief and height map are stretched by the grain size at the same acceleration, and
    /// their heights are scaled by depth and level.
    ///
    /// With a grain size or a brightness, the cost is that of a conversion to another rate.
    ///
    /// # Errors
    /// See [`TextureModelError`]. A valid texture has no error: peaks too narrow for the renderer are widened.
    pub fn apply(&self, model: &TextureModel) -> Result<TextureModel, TextureModelError> {
        let shape = self.limited();
        if shape.is_neutral() {
            return Ok(model.clone());
        }
        let mut shaped = match NodeShaper::new(model, &shape) {
            Some(shaper) => shaped_grain(model, &shaper)?,
            None => model.clone(),
        };
        let (stretch, scale) = (shape.grain, shape.level_factor() * shape.relief);
        if stretch != 1.0 || scale != 1.0 {
            let relief = model.relief().and_then(|relief| shaped_relief(relief, stretch, scale));
            let height_map = model.height_map().and_then(|map| shaped_height_map(map, stretch, scale));
            shaped = shaped.with_relief(relief).with_height_map(height_map);
        }
        if shape.friction != 1.0 {
            shaped = shaped.with_friction(model.friction().map(|friction| shape.friction * friction))?;
        }
        if shape.direction_deg != 0.0 {
            shaped = shaped.with_turn_rad(model.turn_rad() + shape.direction_deg.to_radians());
        }
        Ok(shaped.with_tap(shape.tap(model.tap())))
    }

    /// Returns a tap transient in this shape, within the valid ranges of tap transients.
    ///
    /// Frequency, decay rate and amplitude are all divided by the softness `s`: the tip takes `s` times as long to
    /// stop, and the integral of the acceleration, which is proportional to the momentum of the impact, stays the same.
    #[must_use]
    pub fn tap(&self, tap: Option<Tap>) -> Option<Tap> {
        let softness = self.limited().softness;
        if softness == 1.0 {
            return tap;
        }
        let softer = |tap: Tap| Tap {
            frequency: Hertz(tap.frequency.0 / softness),
            decay_per_sec: tap.decay_per_sec / softness,
            amplitude_mps2: tap.amplitude_mps2 / softness,
        };
        tap.map(|tap| softer(tap).bounded())
    }

    /// Factor of the level.
    fn level_factor(&self) -> f64 {
        10_f64.powf(0.05 * self.level_db)
    }

    /// The shape with every value limited to its range; a value that is not a number becomes neutral.
    fn limited(&self) -> Self {
        ShapeControl::ALL
            .into_iter()
            .fold(Self::default(), |shape, control| shape.with(control, self.get(control)))
    }
}
