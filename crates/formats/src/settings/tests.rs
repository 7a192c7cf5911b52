use super::{
    KeptPrompt, MAX_RECENT, RigSettings, Settings, SettingsError, merged, read_settings, write_settings,
};
use crate::photo_networks::{ImageNetwork, PhotoNetworks};
use crate::rig_settings::{ActuatorSettings, PressureSettings, ProfileSettings};
use std::path::Path;

/// Reads settings with a valid device setup.
fn read(bytes: &[u8]) -> Settings {
    let (settings, error) = read_settings(bytes);
    assert!(error.is_none(), "{error:?}");
    settings
}

#[test]
fn settings_come_back_and_what_is_none_is_told() {
    let mut settings = Settings { is_light: Some(true), ..Settings::default() };
    settings.note_project(Path::new("/a.shagreen"));
    (settings.scale, settings.template) = (Some(1.5), Some("/b.shagreen".into()));
    settings.learned_hints = vec!["drag-point".to_owned()];
    settings.reduces_motion = Some(false);
    settings.quality_model = Some("/lab.json".into());
    settings.panels.stage = Some(300.5);
    settings.studies.pixels_per_mm = Some(3.78);
    settings.studies.masking_output = Some("pulse:headphones".to_owned());
    settings.studies.choose_log_folder(Path::new("/a.toml"), Path::new("/logs"));
    let network = ImageNetwork::Resnet50("/r.safetensors".into());
    settings.photo_networks = Some(PhotoNetworks { network, heads: Some("/h.safetensors".into()) });
    #[cfg(unix)]
    {
        use std::os::unix::ffi::OsStrExt as _;
        settings.note_project(Path::new(std::ffi::OsStr::from_bytes(b"/a/\xff.shagreen")));
        let folder = Path::new(std::ffi::OsStr::from_bytes(b"/\xff-logs"));
        settings.studies.choose_log_folder(Path::new("/b.toml"), folder);
    }
    for seed in [1, 2, 1] {
        settings.note_prompt(KeptPrompt { prompt: "rough".to_owned(), seed, by_diffusion: false });
    }
    settings.note_prompt(KeptPrompt { prompt: "rough".to_owned(), seed: 1, by_diffusion: true });
    assert_eq!(settings.prompts.iter().map(|kept| kept.seed).collect::<Vec<_>>(), [1, 1, 2]);
    let before = br#"{"prompts": [{"prompt": "rough", "seed": 2}]}"#;
    assert_eq!(read(before).prompts, settings.prompts[2..], "an older file, without generators");
    settings.unknown.insert("later".to_owned(), 3.into());
    assert_eq!(read(&write_settings(&settings)), settings);
    assert_eq!(read(b"{}"), Settings::default());
    for nothing in [&b""[..], b"{{", b"[]", b"null"] {
        let (settings, error) = read_settings(nothing);
        assert!(settings == Settings::default() && matches!(error, Some(SettingsError::Format(_))));
    }
}

#[test]
fn a_library_is_permitted_for_its_project_only() {
    let mut settings = Settings::default();
    for library in ["/other/b.json", "/other/a.json", "/other/b.json"] {
        settings.permit_library(Path::new("/woods/a.shagreen"), Path::new(library));
    }
    let permitted = ["/other/b.json", "/other/a.json"].map(Path::new);
    assert_eq!(settings.libraries_of(Path::new("/woods/a.shagreen")), permitted);
    assert!(settings.libraries_of(Path::new("/woods/b.shagreen")).is_empty());
    let written = write_settings(&settings);
    assert_eq!(read(&written).libraries, settings.libraries);
    let damaged = br#"{"libraries": [{"project": "/a"}, 3, {"project": "/a", "library": "/b"}]}"#;
    assert_eq!(read(damaged).libraries_of(Path::new("/a")), [Path::new("/b")]);
}

#[test]
fn a_plan_has_the_folder_that_was_chosen_last_for_it() {
    let mut studies = Settings::default().studies;
    for (plan, folder) in [("/a.toml", "/one"), ("/b.toml", "/two"), ("/a.toml", "/three")] {
        studies.choose_log_folder(Path::new(plan), Path::new(folder));
    }
    let folder_of = |plan: &str| studies.log_folder_of(Path::new(plan));
    assert_eq!(folder_of("/a.toml"), Some(Path::new("/three")));
    assert_eq!(folder_of("/b.toml"), Some(Path::new("/two")));
    assert_eq!((folder_of("/c.toml"), studies.log_folders.len()), (None, 2));
    let damaged = br#"{"studies": {"log_folders": [{"plan": 3, "folder": "/one"}]}}"#;
    assert!(read(damaged).studies.log_folders.is_empty());
}

/// An unreadable setting affects no other, least of all the device setup.
#[test]
fn each_setting_is_read_on_its_own() {
    let rig = RigSettings { output: Some("null".to_owned()), ..RigSettings::default() };
    for wrong in [
        r#""recent": 3"#,
        r#""is_light": "yes""#,
        r#""has_seen_tour": 1"#,
        r#""scale": "large""#,
        r#""template": 7"#,
        r#""photo_networks": {"network": "resnet-50"}"#,
        r#""studies": {"pixels_per_mm": 1e9}"#,
        r#""studies": 3"#,
        r#""quality_model": 3"#,
    ] {
        let bytes = format!(r#"{{"rig": {{"output": "null"}}, "later": 3, {wrong}}}"#);
        let mut expected = Settings { rig: Some(rig.clone()), ..Settings::default() };
        expected.unknown.insert("later".to_owned(), 3.into());
        assert_eq!(read(bytes.as_bytes()), expected, "{wrong}");
    }
    assert_eq!(read(br#"{"rig": null}"#), Settings::default());
    for wrong in ["3", r#"{"channel": -1}"#, r#"{"actuator": {"of_later": "x"}}"#] {
        let bytes = format!(r#"{{"is_light": true, "rig": {wrong}}}"#);
        let (settings, error) = read_settings(bytes.as_bytes());
        assert_eq!(settings, Settings { is_light: Some(true), ..Settings::default() });
        assert!(matches!(error, Some(SettingsError::Rig(_))), "{wrong}");
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
        assert_eq!(read(&write_settings(&settings)), settings);
    }
    let before = read(b"{\"recent\": [], \"has_seen_tour\": true}");
    assert_eq!((before.rig, before.has_seen_tour), (None, true));
}

#[test]
fn settings_of_two_windows_are_merged_by_key() {
    let path = |name: &str| Path::new(name).to_owned();
    let mut base = Settings { recent: vec![path("/a"), path("/b")], ..Settings::default() };
    base.unknown.insert("later".to_owned(), 1.into());
    let (mut ours, mut theirs) = (base.clone(), base.clone());
    ours.note_project(Path::new("/ours"));
    ours.is_light = Some(true);
    ours.reduces_motion = Some(true);
    ours.learned_hints = vec!["a".to_owned()];
    let none = PhotoNetworks { network: ImageNetwork::Statistics, heads: None };
    ours.photo_networks = Some(none.clone());
    ours.studies.pixels_per_mm = Some(4.0);
    ours.quality_model = Some(path("/lab.json"));
    theirs.studies.masking_output = Some("theirs".to_owned());
    theirs.learned_hints = vec!["b".to_owned()];
    theirs.note_project(Path::new("/theirs"));
    (theirs.scale, theirs.has_seen_tour) = (Some(1.5), true);
    theirs.unknown.insert("later".to_owned(), 2.into());
    let both = merged(&base, &ours, theirs.clone());
    assert_eq!(both.recent, ["/ours", "/a", "/b", "/theirs"].map(path));
    assert_eq!((both.is_light, both.scale, both.has_seen_tour), (Some(true), Some(1.5), true));
    assert_eq!(both.unknown, theirs.unknown);
    assert_eq!((both.reduces_motion, both.photo_networks), (Some(true), Some(none)));
    assert_eq!(both.learned_hints, ["a", "b"]);
    assert_eq!(both.studies.pixels_per_mm, Some(4.0));
    assert_eq!(both.quality_model, Some(path("/lab.json")));
    assert_eq!(both.studies.masking_output.as_deref(), Some("theirs"));
    assert_eq!(merged(&base, &base, theirs.clone()), theirs);
    assert_eq!(merged(&base, &ours, base.clone()), ours);
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
