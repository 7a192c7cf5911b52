//! Whether the desktop asks programs for reduced motion.
//!
//! Only desktops on Linux that keep this setting in a text file are read: KDE, and GTK programs without a settings
//! service. GNOME, Windows and macOS keep it where only their own libraries find it.

use std::path::Path;

use shagreen_formats::bounded_file::{self, FileKind};

/// Files below the folder of settings, with the key that turns animations off by 0 or "false".
const FILES: [(&str, &str); 3] = [
    ("gtk-4.0/settings.ini", "gtk-enable-animations"),
    ("gtk-3.0/settings.ini", "gtk-enable-animations"),
    ("kdeglobals", "AnimationDurationFactor"),
];

/// Returns whether a desktop with this folder of settings turns animations off.
pub(crate) fn reduces_motion(folder: &Path) -> bool {
    FILES.iter().any(|(file, key)| {
        // Without the file, the desktop has its usual animations.
        let text = bounded_file::read(&folder.join(file), FileKind::Small).unwrap_or_default();
        turns_off(&String::from_utf8_lossy(&text), key)
    })
}

fn turns_off(text: &str, key: &str) -> bool {
    let mut values = text.lines().filter_map(|line| line.split_once('='));
    let value = values.rfind(|(name, _)| name.trim() == key).map(|(_, value)| value.trim());
    value.is_some_and(|value| value.eq_ignore_ascii_case("false") || value.parse::<f64>() == Ok(0.0))
}

#[cfg(test)]
mod tests {
    use super::reduces_motion;

    #[test]
    fn the_desktop_is_asked_for_reduced_motion() {
        let folder = tempfile::tempdir().unwrap();
        assert!(!reduces_motion(folder.path()));
        std::fs::create_dir(folder.path().join("gtk-3.0")).unwrap();
        for (file, text, is_reduced) in [
            ("gtk-3.0/settings.ini", "[Settings]\ngtk-enable-animations=0\n", true),
            ("gtk-3.0/settings.ini", "[Settings]\ngtk-enable-animations = false\n", true),
            ("gtk-3.0/settings.ini", "[Settings]\ngtk-enable-animations=1\n", false),
            ("kdeglobals", "[KDE]\nAnimationDurationFactor=0\n", true),
            ("kdeglobals", "[KDE]\nAnimationDurationFactor=0.5\n", false),
        ] {
            std::fs::write(folder.path().join(file), text).unwrap();
            assert_eq!(reduces_motion(folder.path()), is_reduced, "{file}: {text}");
        }
    }
}
