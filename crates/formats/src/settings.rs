//! What the program remembers of a person and a machine, whatever project is open: one JSON file.

use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

use crate::layout;
use crate::rig_settings::RigSettings;

/// All of it stands open.
const OPEN_DEPTH: usize = 2;

/// Projects that are remembered.
pub const MAX_RECENT: usize = 12;

/// What is remembered.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Projects that were open, newest first.
    #[serde(default)]
    pub recent: Vec<PathBuf>,
    /// Whether the light theme was chosen, or the dark one; `None` follows the system.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub is_light: Option<bool>,
    /// Whether the first steps were shown, or skipped.
    #[serde(default)]
    pub has_seen_tour: bool,
    /// How much larger everything is drawn than usual; `None` is as usual.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f32>,
    /// The project that new ones begin like.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub template: Option<PathBuf>,
    /// The output, the actuator and the pen; `None` where nobody has chosen any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rig: Option<RigSettings>,
    /// What another version remembers.
    #[serde(flatten)]
    pub unknown: Map<String, Value>,
}

impl Settings {
    /// A project was opened or saved.
    pub fn note_project(&mut self, path: &Path) {
        // Told from every folder alike.
        let path = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        self.recent.retain(|other| *other != path);
        self.recent.insert(0, path);
        self.recent.truncate(MAX_RECENT);
    }
}

/// Settings from the bytes of a file; those that cannot be read are as nobody had chosen any.
pub fn read_settings(bytes: &[u8]) -> Settings {
    serde_json::from_slice(bytes).unwrap_or_default()
}

/// The file of settings.
pub fn write_settings(settings: &Settings) -> Vec<u8> {
    layout::to_bytes(settings, OPEN_DEPTH)
}

#[cfg(test)]
mod tests {
    use super::{MAX_RECENT, RigSettings, Settings, read_settings, write_settings};
    use crate::rig_settings::{ActuatorSettings, PressureSettings, ProfileSettings};
    use std::path::Path;

    #[test]
    fn settings_come_back_and_what_is_no_settings_is_left() {
        let mut settings = Settings { is_light: Some(true), ..Settings::default() };
        settings.note_project(Path::new("/a.shagreen"));
        (settings.scale, settings.template) = (Some(1.5), Some("/b.shagreen".into()));
        settings.unknown.insert("later".to_owned(), 3.into());
        assert_eq!(read_settings(&write_settings(&settings)), settings);
        for nothing in [&b""[..], b"{{", b"[]", b"{\"recent\": 3}"] {
            assert_eq!(read_settings(nothing), Settings::default());
        }
    }

    #[test]
    fn the_rig_comes_back_and_is_nothing_where_nobody_chose_any() {
        let full = |profile, load_g| {
            let mut rig = RigSettings {
                output: Some("pulse:alsa_output.usb-1".to_owned()),
                buffer_frames: Some(128),
                channel: Some(3),
                actuator: Some(ActuatorSettings { profile, load_g }),
                equalizes: Some(false),
                full_scale_volts: Some(2.75),
                full_scale_mps2: Some(0.1 + 0.2),
                pen: Some("hid:056a:0061".to_owned()),
                pressure: Some(PressureSettings { activation_n: 0.03, full_n: 4.0, bend: -1.5 }),
                pen_size_mm: Some([216.0, 135.5]),
                ..RigSettings::default()
            };
            rig.unknown.insert("later".to_owned(), "kept".into());
            rig
        };
        for rig in [
            RigSettings::default(),
            full(ProfileSettings::BuiltIn("mm1c".to_owned()), None),
            full(ProfileSettings::Own("format = \"x\"\n".to_owned()), Some(40.0)),
        ] {
            let settings = Settings { rig: Some(rig), ..Settings::default() };
            assert_eq!(read_settings(&write_settings(&settings)), settings);
        }
        let before = read_settings(b"{\"recent\": [], \"has_seen_tour\": true}");
        assert_eq!((before.rig, before.has_seen_tour), (None, true));
    }

    #[test]
    fn the_newest_project_stands_first_and_once() {
        let mut settings = Settings::default();
        for i in 0..20 {
            settings.note_project(Path::new(&format!("/{i}.shagreen")));
        }
        settings.note_project(Path::new("/15.shagreen"));
        assert_eq!(settings.recent.len(), MAX_RECENT);
        assert_eq!(settings.recent[..2], [Path::new("/15.shagreen"), Path::new("/19.shagreen")]);
    }
}
