//! WAV: the signal of one stroke, rendered by `shagreen render` and by the export sheet.

use shagreen_formats::library::TextureEntry;

use super::FormatInfo;

/// The WAV format, whose files need a stroke besides the texture.
pub const WAV: FormatInfo = FormatInfo {
    id: "wav",
    name: "WAV signal",
    ending: "wav",
    help: "Acceleration along one stroke, for audio editors, game engines and analysis",
};

/// Signal whose losses are listed.
#[derive(Clone, Copy, Debug)]
pub struct Rendered<'a> {
    /// The texture; `None` if signals are mixed instead, so that there is no single texture.
    pub texture: Option<&'a TextureEntry>,
    /// Whether the texture has a tap transient.
    pub has_tap: bool,
    /// Whether the tip follows a recorded stroke, in which contacts begin.
    pub follows_stroke: bool,
}

/// Lists the properties of a texture that the WAV file of a stroke and its sidecar cannot store.
pub fn lost_in_wav(rendered: Rendered<'_>) -> Vec<String> {
    let Rendered { texture, has_tap, follows_stroke } = rendered;
    let mut lost = vec!["all tip speeds and normal forces except those of this stroke".to_owned()];
    if has_tap && !follows_stroke {
        lost.push("the tap transient: no contact begins in a steady motion".to_owned());
    }
    if texture.is_some_and(|texture| texture.model.friction().is_some()) {
        lost.push("the friction coefficient".to_owned());
    }
    if texture.is_some_and(|texture| texture.picture.is_some()) {
        lost.push("the picture".to_owned());
    }
    lost
}

#[cfg(test)]
mod tests {
    use super::{Rendered, lost_in_wav};
    use shagreen_formats::starter::starter_library;

    #[test]
    fn a_signal_loses_all_but_one_stroke() {
        let library = starter_library().unwrap();
        let texture = library.textures.iter().find(|texture| texture.picture.is_some()).unwrap();
        let lost = |texture, has_tap, follows_stroke| {
            lost_in_wav(Rendered { texture, has_tap, follows_stroke }).join("; ")
        };
        assert!(lost(None, false, false).starts_with("all tip speeds and normal forces"));
        assert!(lost(None, true, false).contains("tap transient"));
        assert!(!lost(None, true, true).contains("tap transient"), "a recorded stroke has contacts");
        let of_texture = lost(Some(texture), false, false);
        assert!(of_texture.contains("the picture"));
        assert_eq!(of_texture.contains("friction"), texture.model.friction().is_some());
    }
}
