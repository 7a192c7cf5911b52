//! An authored texture as text, for the clipboard: copied from one project and pasted into another.
//!
//! ```json
//! {
//!  "shagreen": "authored texture",
//!  "version": 1,
//!  "library": "Starter library",
//!  "axes": [["rough", "smooth"], ["hard", "soft"]],
//!  "pinned": {"oak": "Oak"},
//!  "texture": {"key": 1, "name": "Oak copy", "rough_smooth": 41.5, "hard_soft": 70.0, "blend": {…}}
//! }
//! ```
//!
//! `texture` is an authored texture in the project format. `library` and `axes` name the space in which its position was
//! chosen, with the words at both ends of each axis, and `pinned` names its pinned textures, so that another project can say what it lacks. `textures`, if there are any,
//! are those of the pinned textures that were added to its project, in the format of a library: no other library has them.
//!
//! `axes` has one entry for each coordinate of the texture. Version 2 adds `axis_names`, the names of these axes in the
//! project, such as `["rough-smooth", "attribute:flat-bumpy", "centroid"]`: an attribute has the words of a position of the same
//! name. A text has version 2 if it has another number of axes than two, or an axis that is named as an attribute.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::layout;
use crate::library::TextureEntry;
use crate::library::read::texture as texture_entry;
use crate::library::v1::TextureV1;
use crate::library::write::texture as texture_wire;
use crate::own_json::check_density;
use crate::parser_words::plain;
use crate::project::read::authored_texture;
use crate::project::v1::AuthoredV1;
use crate::project::write::authored;
use crate::project::{AuthoredTexture, ProjectError, plain_axis_name};
use crate::text_limits::{self, MAX_ID, MAX_NAME, MAX_NOTES};

/// Value of the `shagreen` field.
const KIND: &str = "authored texture";
/// Version of a texture on two axes that are known by their words.
const VERSION: u32 = 1;
/// Version with the names of the axes.
const VERSION_AXIS_NAMES: u32 = 2;
/// Maximum length of the text, in bytes; it may contain a picture.
const MAX_BYTES: usize = 16 << 20;
/// Nesting depth up to which values get their own lines.
const OPEN_DEPTH: usize = 1;

/// A copied authored texture, with the names of what it refers to.
#[derive(Clone, Debug, PartialEq)]
pub struct CopiedTexture {
    /// The texture. Its key has no meaning outside its project.
    pub texture: AuthoredTexture,
    /// Name of the library of its project.
    pub library: String,
    /// Words at both ends of each axis, the x axis first, then the y axis; one entry for each coordinate of the texture.
    pub axes: Vec<[String; 2]>,
    /// Names of these axes in its project. Empty if the text has only the words: then there are two, and none is named as an
    /// attribute.
    pub axis_names: Vec<String>,
    /// Names of its pinned textures, by identifier.
    pub pinned: BTreeMap<String, String>,
    /// The pinned textures that were added to its project.
    pub textures: Vec<TextureEntry>,
}

/// Why a text is not a copied authored texture.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CopiedTextureError {
    /// Text of another kind.
    #[error("the clipboard contains no authored texture; copy one in Shagreen first")]
    Foreign,
    /// Another version of the format.
    #[error(
        "the authored texture on the clipboard has version {found}, but this program reads the versions {VERSION} and {VERSION_AXIS_NAMES}; copy it with this version of Shagreen"
    )]
    Version {
        /// Value of the `version` field.
        found: String,
    },
    /// The text is longer than any authored texture.
    #[error(
        "the text on the clipboard has {n_bytes} bytes, but at most {MAX_BYTES} are possible; copy a texture with a smaller picture"
    )]
    TooLarge {
        /// Length of the text.
        n_bytes: usize,
    },
    /// The text is incomplete, or a field is missing or of the wrong type.
    #[error("the authored texture on the clipboard is damaged ({reason}); copy it again")]
    Damaged {
        /// The parser's message, with line and column.
        reason: String,
    },
    /// A value is out of range.
    #[error("the authored texture on the clipboard is invalid: {source}")]
    Invalid {
        /// What is wrong.
        source: ProjectError,
    },
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct CopiedV1 {
    shagreen: String,
    version: u32,
    library: String,
    axes: Vec<[String; 2]>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    axis_names: Vec<String>,
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pinned: BTreeMap<String, String>,
    texture: AuthoredV1,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    textures: Vec<TextureV1>,
}

/// The fields that identify the text.
#[derive(Deserialize)]
struct Mark {
    #[serde(default)]
    shagreen: Value,
    #[serde(default)]
    version: Value,
}

/// Serializes a copied texture as JSON; without its added textures if the text would be too long to be read again.
pub fn write_copied_texture(copied: &CopiedTexture) -> String {
    let text = written(copied, &copied.textures);
    if text.len() > MAX_BYTES { written(copied, &[]) } else { text }
}

fn written(copied: &CopiedTexture, textures: &[TextureEntry]) -> String {
    let has_names = needs_names(copied);
    let mut texture = copied.texture.clone();
    // It may have other coordinates if the library of its project has changed.
    texture.fit(copied.axes.len());
    let wire = CopiedV1 {
        shagreen: KIND.to_owned(),
        version: if has_names { VERSION_AXIS_NAMES } else { VERSION },
        library: copied.library.clone(),
        axes: copied.axes.clone(),
        axis_names: if has_names { copied.axis_names.clone() } else { Vec::new() },
        pinned: copied.pinned.clone(),
        texture: authored(&texture),
        textures: textures.iter().map(texture_wire).collect(),
    };
    // JSON is UTF-8, so nothing is lost.
    String::from_utf8_lossy(&layout::to_bytes(&wire, OPEN_DEPTH)).into_owned()
}

/// Whether the words do not say which the axes are, or older programs do not know so many.
fn needs_names(copied: &CopiedTexture) -> bool {
    copied.axes.len() != 2 || copied.axis_names.iter().any(|name| plain_axis_name(name) != name)
}

/// Reads a copied texture; every value is checked.
///
/// # Errors
/// See [`CopiedTextureError`]; any text that Shagreen did not write is [`CopiedTextureError::Foreign`].
pub fn read_copied_texture(text: &str) -> Result<CopiedTexture, CopiedTextureError> {
    // Every copied texture begins with a brace and states its kind. Other text is not parsed.
    if !text.trim_start().starts_with('{') || !text.contains(KIND) {
        return Err(CopiedTextureError::Foreign);
    }
    if text.len() > MAX_BYTES {
        return Err(CopiedTextureError::TooLarge { n_bytes: text.len() });
    }
    check_density(text.as_bytes()).map_err(|reason| CopiedTextureError::Damaged { reason })?;
    let damaged =
        |error: serde_json::Error| CopiedTextureError::Damaged { reason: plain(&error.to_string()) };
    let mark: Mark = serde_json::from_str(text).map_err(damaged)?;
    if mark.shagreen != KIND {
        return Err(CopiedTextureError::Foreign);
    }
    if mark.version != VERSION && mark.version != VERSION_AXIS_NAMES {
        let found = mark.version.to_string().chars().take(20).collect();
        return Err(CopiedTextureError::Version { found });
    }
    checked(serde_json::from_str(text).map_err(damaged)?)
        .map_err(|source| CopiedTextureError::Invalid { source })
}

fn checked(wire: CopiedV1) -> Result<CopiedTexture, ProjectError> {
    let texture = &wire.texture;
    text_limits::check("the name of the library", &wire.library, MAX_NAME)?;
    text_limits::check("the name of an authored texture", &texture.name, MAX_NAME)?;
    text_limits::check("the notes of an authored texture", &texture.notes, MAX_NOTES)?;
    for tag in &texture.tags {
        text_limits::check("a tag of an authored texture", tag, MAX_NAME)?;
    }
    for word in wire.axes.iter().flatten().chain(&wire.axis_names) {
        text_limits::check("the name of an axis", word, MAX_NAME)?;
    }
    for id in wire.pinned.keys().chain(&texture.blend.locked) {
        text_limits::check("the identifier of a pinned texture", id, MAX_ID)?;
    }
    for name in wire.pinned.values() {
        text_limits::check("the name of a pinned texture", name, MAX_NAME)?;
    }
    let entry = |wire| texture_entry(wire).map_err(|source| ProjectError::Library { path: None, source });
    let texture = authored_texture(wire.texture)?;
    let n = texture.at.n_axes();
    let n_named = if wire.axis_names.is_empty() { n } else { wire.axis_names.len() };
    if let Some(n_axes) = [wire.axes.len(), n_named].into_iter().find(|n_axes| *n_axes != n) {
        return Err(ProjectError::AxisCount { name: texture.name, n, n_axes });
    }
    let mut copied = CopiedTexture {
        textures: wire.textures.into_iter().map(entry).collect::<Result<_, _>>()?,
        texture,
        library: wire.library,
        axes: wire.axes,
        axis_names: wire.axis_names,
        pinned: wire.pinned,
    };
    if !needs_names(&copied) {
        copied.axis_names.clear();
    }
    Ok(copied)
}

#[cfg(test)]
mod tests {
    use std::collections::{BTreeMap, BTreeSet};

    use serde_json::{Value, json};
    use shagreen_core::space::SpacePoint;
    use shagreen_core::texture::blend::Mode;
    use shagreen_core::texture::shape::Shape;

    use super::{CopiedTexture, CopiedTextureError, MAX_BYTES, read_copied_texture, write_copied_texture};
    use crate::project::{AuthoredTexture, BlendChoice};
    use crate::starter::starter_library;

    fn copied() -> CopiedTexture {
        let locked = BTreeSet::from(["oak".to_owned()]);
        CopiedTexture {
            texture: AuthoredTexture {
                color: 3,
                notes: "line one\n\"line two\"".to_owned(),
                tags: vec!["wood".to_owned()],
                at: SpacePoint::plane(100.0 / 3.0, 0.1),
                blend: BlendChoice { mode: Mode::Field, locked, ..BlendChoice::default() },
                shape: Shape { grain: 1.3, softness: 0.5, ..Shape::default() },
                ..AuthoredTexture::new(7, "Eiche, geölt")
            },
            library: "Starter library".to_owned(),
            axes: [["rough", "smooth"], ["hard", "soft"]].map(|ends| ends.map(str::to_owned)).to_vec(),
            axis_names: Vec::new(),
            pinned: BTreeMap::from([("oak".to_owned(), "Oak".to_owned())]),
            textures: Vec::new(),
        }
    }

    /// Reads the text of [`copied`] after a change.
    fn changed(change: impl FnOnce(&mut Value)) -> Result<CopiedTexture, CopiedTextureError> {
        let mut value: Value = serde_json::from_str(&write_copied_texture(&copied())).unwrap();
        change(&mut value);
        read_copied_texture(&value.to_string())
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = write_copied_texture(&copied());
        assert!(text.starts_with("{\n \"shagreen\": \"authored texture\",\n \"version\": 1,"), "{text}");
        assert_eq!(read_copied_texture(&text).unwrap(), copied());
        assert_eq!(changed(|_| {}).unwrap(), copied(), "whatever the layout");
    }

    #[test]
    fn textures_on_any_number_of_axes_are_read_again() {
        let ends = |axis: usize| [format!("low {axis}"), format!("high {axis}")];
        for n_axes in [1, 3, 6] {
            let mut copied = copied();
            copied.texture.at = copied.texture.at.on(n_axes).with(n_axes - 1, 12.5);
            copied.axes = (0..n_axes).map(ends).collect();
            copied.axis_names = (0..n_axes).map(|axis| format!("dimension {axis}")).collect();
            let text = write_copied_texture(&copied);
            assert!(text.contains("\"version\": 2"), "older programs say so: {text}");
            assert_eq!(read_copied_texture(&text).unwrap(), copied);
        }
        let changed_library = CopiedTexture {
            texture: AuthoredTexture { at: copied().texture.at.on(4), ..copied().texture },
            ..copied()
        };
        assert_eq!(read_copied_texture(&write_copied_texture(&changed_library)).unwrap(), copied());
        for (field, axes) in [("axes", json!([["rough", "smooth"]])), ("axis_names", json!(["rough-smooth"]))]
        {
            let fewer = changed(|value| value[field] = axes).unwrap_err().to_string();
            assert!(
                fewer.contains("\"Eiche, geölt\" has 2 coordinates, but the number of axes is 1"),
                "{fewer}"
            );
        }
    }

    /// The words of an attribute are those of a position of the same name.
    #[test]
    fn two_axes_are_named_only_where_their_words_are_ambiguous() {
        let with =
            |names: [&str; 2]| CopiedTexture { axis_names: names.map(str::to_owned).to_vec(), ..copied() };
        let attribute = with(["attribute:rough-smooth", "hard-soft"]);
        let text = write_copied_texture(&attribute);
        assert!(text.contains("\"version\": 2"), "{text}");
        assert_eq!(read_copied_texture(&text).unwrap(), attribute);
        let text = write_copied_texture(&with(["rough-smooth", "hard-soft"]));
        assert_eq!(text, write_copied_texture(&copied()), "as older programs read it");
    }

    #[test]
    fn added_textures_travel_unless_the_text_would_be_too_long() {
        let starter = starter_library().unwrap();
        let with = |n: usize| CopiedTexture {
            textures: starter.textures.iter().cycle().take(n).cloned().collect(),
            ..copied()
        };
        assert_eq!(read_copied_texture(&write_copied_texture(&with(2))).unwrap(), with(2));
        let one = write_copied_texture(&with(1)).len();
        let many = with(3 * MAX_BYTES / one);
        assert_eq!(read_copied_texture(&write_copied_texture(&many)).unwrap(), copied());
        let mut value: Value = serde_json::from_str(&write_copied_texture(&with(1))).unwrap();
        value["textures"][0]["space"]["rough_smooth"] = json!(101.0);
        let error = read_copied_texture(&value.to_string()).unwrap_err();
        assert!(matches!(error, CopiedTextureError::Invalid { .. }), "{error}");
    }

    #[test]
    fn other_text_is_foreign() {
        let long = "{".repeat(MAX_BYTES + 1);
        for text in ["", "Oak", "authored texture", "{}", "[1, 2]", r#"{"shagreen": "other"}"#, &long] {
            let error = read_copied_texture(text).unwrap_err();
            assert!(matches!(error, CopiedTextureError::Foreign), "{error}");
        }
        let named = changed(|value| value["shagreen"] = json!("a project")).unwrap_err();
        assert!(matches!(named, CopiedTextureError::Foreign), "{named}");
        let noted = r#"{"format": "shagreen-project", "notes": "an authored texture"}"#;
        let error = read_copied_texture(noted).unwrap_err();
        assert!(matches!(error, CopiedTextureError::Foreign), "{error}");
    }

    #[test]
    fn damage_is_refused() {
        let text = write_copied_texture(&copied());
        let half = text.chars().take(text.len() / 2).collect();
        for (text, part) in [
            (half, "damaged"),
            (format!("{text}{}", " ".repeat(MAX_BYTES)), "bytes"),
            (text.replace("\"version\": 1", "\"version\": 3"), "version 3"),
            (text.replace("\"version\": 1", "\"more\": 1"), "version null"),
            (text.replace("\"library\"", "\"librarie\""), "librarie"),
        ] {
            let error = read_copied_texture(&text).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
        for (change, part) in [
            (json!({"rough_smooth": 101.0}), "position"),
            (json!({"color": 8}), "color"),
            (json!({"shape": {"relief": -1}}), "relief of the shape is -1"),
            (json!({"name": "a".repeat(5000)}), "characters"),
            (json!({"tags": ["a".repeat(5000)]}), "characters"),
        ] {
            let outcome = changed(|value| {
                for (field, new) in change.as_object().unwrap() {
                    value["texture"][field] = new.clone();
                }
            });
            let error = outcome.unwrap_err();
            let is_invalid = matches!(error, CopiedTextureError::Invalid { .. });
            assert!(is_invalid && error.to_string().contains(part), "{error}");
        }
    }
}
