//! Properties of a texture that a signal of one stroke lacks, whatever its format.

use shagreen_core::texture::tap::Tap;
use shagreen_core::units::Hertz;
use shagreen_device::synth::tap::HIGHEST_SHARE;
use shagreen_formats::library::{Library, TextureEntry};

use crate::sound::Sound;

/// Signal whose losses are listed.
#[derive(Clone, Copy, Debug)]
pub struct Rendered<'a> {
    /// The texture; `None` if signals are mixed instead, so that there is no single texture.
    pub texture: Option<&'a TextureEntry>,
    /// Tap transient of the texture, if it has one.
    pub tap: Option<Tap>,
    /// Sample rate of the signal.
    pub rate: Hertz,
    /// Whether the tip follows a recorded stroke, in which contacts begin.
    pub follows_stroke: bool,
}

impl<'a> Rendered<'a> {
    /// Describes a signal of a sound. `library` has the textures of the sound.
    pub fn of_sound(library: &'a Library, sound: &Sound, rate: Hertz, follows_stroke: bool) -> Self {
        Self { texture: sound.named_entry(library), tap: sound.tap, rate, follows_stroke }
    }
}

/// Returns what the signal lacks of the tap transient of its texture. Nobody can tell this from a signal, whereas all else
/// in [`lost_of_stroke`] is true of every signal of one stroke.
pub fn lost_of_tap(rendered: Rendered<'_>) -> Option<String> {
    let Rendered { tap, rate, follows_stroke, .. } = rendered;
    let (frequency_hz, highest_hz) = (tap?.frequency.0, HIGHEST_SHARE * rate.0);
    if !follows_stroke {
        return Some("the tap transient: no contact begins in a steady motion".to_owned());
    }
    (frequency_hz > highest_hz).then(|| {
        format!(
            "the frequency of the tap transient: {frequency_hz:.0} Hz is above what this sample rate can hold, so the transient has {highest_hz:.0} Hz; choose a higher rate"
        )
    })
}

/// Lists the properties of a texture that a signal of one stroke cannot store, even as samples with a sidecar. Pictures are
/// not among them, because nobody expects one in a signal.
pub fn lost_of_stroke(rendered: Rendered<'_>) -> Vec<String> {
    let mut lost = vec!["all tip speeds and normal forces except those of this stroke".to_owned()];
    lost.extend(lost_of_tap(rendered));
    let texture = rendered.texture;
    let model = texture.map(|texture| &texture.model);
    if model.is_some_and(|model| model.along().is_some() || model.height_map().is_some()) {
        lost.push("all stroke directions except those of this stroke".to_owned());
    }
    if model.is_some_and(|model| model.friction().is_some()) {
        lost.push("the friction coefficient".to_owned());
    }
    if model.is_some_and(|model| model.stick_slip().is_some()) {
        lost.push("static friction and Stribeck speed, except for the vibration that they cause".to_owned());
    }
    lost
}

#[cfg(test)]
mod tests {
    use super::{Rendered, Tap, lost_of_stroke, lost_of_tap};
    use shagreen_core::texture::stick_slip::StickSlip;
    use shagreen_core::units::{Hertz, MetersPerSecond};
    use shagreen_formats::library::TextureEntry;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_signal_loses_all_but_one_stroke() {
        let library = starter_library().unwrap();
        let texture = &library.textures[0];
        let lost = |texture, tap, follows_stroke, hz| {
            lost_of_stroke(Rendered { texture, tap, rate: Hertz(hz), follows_stroke }).join("; ")
        };
        let tap = Some(Tap { frequency: Hertz(180.0), decay_per_sec: 90.0, amplitude_mps2: 6.0 });
        assert!(lost(None, None, false, 1000.0).starts_with("all tip speeds and normal forces"));
        assert!(lost(None, tap, false, 1000.0).contains("no contact begins"));
        assert!(!lost(None, tap, true, 1000.0).contains("tap transient"), "a recorded stroke has contacts");
        assert!(lost(None, tap, true, 300.0).contains("so the transient has 120 Hz"));
        let of_texture = lost(Some(texture), None, false, 1000.0);
        assert_eq!(of_texture.contains("friction"), texture.model.friction().is_some());
        // Every signal lacks the other speeds and forces; only the tap is worth a note.
        let rendered =
            Rendered { texture: Some(texture), tap: None, rate: Hertz(1000.0), follows_stroke: true };
        assert_eq!(lost_of_tap(rendered), None);
        assert!(lost_of_tap(Rendered { tap, follows_stroke: false, ..rendered }).is_some());
    }

    #[test]
    fn a_signal_of_a_directional_texture_loses_the_other_directions() {
        let mut texture = starter_library().unwrap().textures.swap_remove(0);
        let lost = |texture: &TextureEntry| {
            let texture = Some(texture);
            lost_of_stroke(Rendered { texture, tap: None, rate: Hertz(1000.0), follows_stroke: true })
                .join("; ")
        };
        let stick_slip = StickSlip { static_ratio: 1.5, stribeck_speed: MetersPerSecond(0.02) };
        texture.model = texture.model.with_along(None).unwrap().with_height_map(None).with_stick_slip(None);
        assert!(!lost(&texture).contains("directions") && !lost(&texture).contains("Stribeck"));
        let along = texture.model.nodes().to_vec();
        texture.model = texture.model.with_along(Some(along)).unwrap().with_stick_slip(Some(stick_slip));
        assert!(lost(&texture).contains("directions") && lost(&texture).contains("Stribeck"));
    }
}
