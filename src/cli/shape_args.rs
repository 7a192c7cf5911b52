//! The option `--shape`.

use shagreen_core::texture::shape::Shape;

/// Shape of the texture.
#[derive(clap::Args)]
pub(crate) struct ShapeArgs {
    /// Shape of the texture: values of its controls, separated by commas, as in level=-3,grain=1.2. Controls that are not
    /// named are neutral. level: change of the level, -24 to 12 dB. grain: spatial scale of the surface, 0.25 (fine) to 4
    /// (coarse) times. brightness: slope of the spectrum, -6 to 6 dB/octave. softness: the tap transient is slower and
    /// weaker by this factor, 0.25 to 4. friction: factor of the friction coefficient, 0 to 3. relief: factor of the
    /// height of reliefs, 0 to 4. direction: rotation, -180 to 180 degrees counterclockwise. An authored texture has its
    /// own shape, which this option replaces.
    #[arg(long, value_name = "SHAPE")]
    shape: Option<Shape>,
}

impl ShapeArgs {
    /// Returns the shape that was given, or else `own`.
    pub(crate) fn or(&self, own: Shape) -> Shape {
        self.shape.unwrap_or(own)
    }
}
