//! Spectral difference of two textures, as the leave-one-out evaluation measures it.

use shagreen_core::space::fidelity::{
    COMPARED_RATE, Channels, Profile, error_db, level_error_db, shape_error_db,
};
use shagreen_core::texture::blend::Mode;
use shagreen_core::units::Hertz;
use shagreen_formats::library::TextureEntry;

use crate::authoring::plane_at;
use crate::report::Reporter;

/// Difference of two textures at nine speeds and forces, in 40 frequency channels from 20 to 480 Hz.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TextureDifference {
    /// Root-mean-square difference of the channel levels, in dB.
    pub error_db: f64,
    /// Mean absolute difference of the total level, in dB.
    pub level_error_db: f64,
    /// What remains of the difference of the channel levels with one gain for all of them, in dB.
    pub shape_error_db: f64,
}

/// Returns the difference of two textures. Speeds and forces that a texture was not measured at are replaced by the nearest that
/// it was.
///
/// # Errors
/// A texture cannot be converted to the rate at which textures are compared.
pub fn texture_difference(
    a: &TextureEntry,
    b: &TextureEntry,
    reporter: &dyn Reporter,
) -> anyhow::Result<TextureDifference> {
    let channels = Channels::of_models();
    let profile = |texture: &TextureEntry| texture_profile(texture, &channels, reporter);
    let (a, b) = (profile(a)?, profile(b)?);
    Ok(TextureDifference {
        error_db: error_db(&a, &b),
        level_error_db: level_error_db(&a, &b),
        shape_error_db: shape_error_db(&a, &b),
    })
}

/// Returns the spectral profile of a texture.
///
/// # Errors
/// The texture cannot be converted to the rate at which textures are compared.
pub(crate) fn texture_profile(
    texture: &TextureEntry,
    channels: &Channels,
    reporter: &dyn Reporter,
) -> anyhow::Result<Profile> {
    let rate = Hertz(texture.model.rate().0.max(COMPARED_RATE.0));
    let plane = plane_at(texture, rate, reporter)?;
    Ok(channels.profile(&[(&plane, 1.0)], Mode::Shared))
}

#[cfg(test)]
mod tests {
    use super::texture_difference;
    use crate::export::shaped;
    use crate::report::Warnings;
    use shagreen_core::texture::shape::Shape;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_change_of_level_alone_has_no_shape_error() {
        let library = starter_library().unwrap();
        let cork = &library.textures[0];
        let quiet = shaped(cork, &Shape { level_db: -6.0, ..Shape::default() }).unwrap();
        let between = |other| texture_difference(cork, other, &Warnings::default()).unwrap();
        let same = between(cork);
        assert!(same.error_db < 1e-9 && same.level_error_db < 1e-9);
        let softer = between(&quiet);
        // Channels at the lower limit of the density do not change.
        assert!((softer.error_db - 6.0).abs() < 0.1 && softer.shape_error_db < 0.2, "{softer:?}");
        assert!((softer.level_error_db - 6.0).abs() < 1e-6, "{softer:?}");
        let other = between(&library.textures[1]);
        assert!(other.error_db > 0.5 && other.shape_error_db <= other.error_db, "{other:?}");
    }
}
