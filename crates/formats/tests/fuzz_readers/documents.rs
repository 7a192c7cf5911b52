//! Projects, settings, actuator profiles and texts with pen reports.

use std::io::ErrorKind;
use std::path::Path;

use shagreen_core::texture::shape::Shape;
use shagreen_formats::actuator_toml::{built_in_actuators, read_actuator, write_actuator};
use shagreen_formats::gallery::{GALLERY, GalleryProject};
use shagreen_formats::hid_text::read_hid_text;
use shagreen_formats::project::clipboard::{CopiedTexture, read_copied_texture, write_copied_texture};
use shagreen_formats::project::{AuthoredTexture, Project, read_project, write_project};
use shagreen_formats::quality_model::{
    ModelFit, built_in_quality_model, read_quality_model, write_quality_model,
};
use shagreen_formats::settings::{KeptPrompt, Settings, read_settings, write_settings};
use shagreen_formats::starter::starter_library;

/// Reads a project whose library file does not exist.
fn project_in(bytes: &[u8]) -> Option<Project> {
    let nothing = |_: &Path| Err(ErrorKind::NotFound.into());
    read_project(bytes, Path::new("/folder"), &nothing).ok().map(|read| read.value)
}

/// Projects of the gallery, with paths, pictures and snapshots.
pub(crate) fn project_seeds() -> Vec<Vec<u8>> {
    let bytes = |project: &GalleryProject| {
        let mut project = project.read().unwrap();
        project.snapshots = project.authored.clone();
        for texture in &mut project.authored {
            let shape = Shape { level_db: -3.0, grain: 1.5, direction_deg: 30.0, ..texture.shape };
            std::sync::Arc::make_mut(texture).shape = shape;
        }
        project.renamed.insert("cork".to_owned(), "Cork, sanded".to_owned());
        write_project(&project, Path::new("/folder"), "fuzz")
    };
    let further = include_bytes!("../../../../vectors/project/1.3.shagreen").to_vec();
    GALLERY.iter().take(3).map(bytes).chain([further]).collect()
}

pub(crate) fn read_a_project(bytes: &[u8]) -> Result<(), String> {
    let Some(project) = project_in(bytes) else { return Ok(()) };
    let used: Vec<u32> =
        project.authored.iter().chain(&project.snapshots).map(|texture| texture.key).collect();
    if used.contains(&project.free_key()) {
        return Err("the free key is in use".into());
    }
    let written = write_project(&project, Path::new("/folder"), "fuzz");
    let again = project_in(&written).ok_or("the written project cannot be read")?;
    // Numbers are rounded when they are written first.
    let twice = write_project(&again, Path::new("/folder"), "fuzz");
    if twice == written { Ok(()) } else { Err("writing the project twice gives different bytes".into()) }
}

/// The authored textures of a gallery project, as on the clipboard.
pub(crate) fn copied_texture_seeds() -> Vec<Vec<u8>> {
    let project = GALLERY[0].read().unwrap();
    let copied = |texture: &std::sync::Arc<AuthoredTexture>| CopiedTexture {
        texture: AuthoredTexture::clone(texture),
        library: "Starter library".to_owned(),
        axes: [["rough", "smooth"], ["hard", "soft"]].map(|ends| ends.map(str::to_owned)).to_vec(),
        axis_names: ["attribute:rough-smooth", "hard-soft"].map(str::to_owned).to_vec(),
        pinned: [("cork".to_owned(), "Cork".to_owned())].into(),
        textures: vec![starter_library().unwrap().textures.swap_remove(0)],
    };
    project.authored.iter().map(|texture| write_copied_texture(&copied(texture)).into_bytes()).collect()
}

pub(crate) fn read_a_copied_texture(bytes: &[u8]) -> Result<(), String> {
    let Ok(text) = std::str::from_utf8(bytes) else { return Ok(()) };
    let Ok(copied) = read_copied_texture(text) else { return Ok(()) };
    let written = write_copied_texture(&copied);
    let again = read_copied_texture(&written).map_err(|error| error.to_string())?;
    // Numbers are rounded when they are written first.
    let twice = write_copied_texture(&again);
    if twice == written { Ok(()) } else { Err("writing the texture twice gives different text".into()) }
}

pub(crate) fn settings_seeds() -> Vec<Vec<u8>> {
    let mut settings = Settings { is_light: Some(true), scale: Some(1.5), ..Settings::default() };
    settings.note_project(Path::new("/a/woods.shagreen"));
    settings.note_prompt(KeptPrompt { prompt: "rough bark".to_owned(), seed: 3, by_diffusion: false });
    let rig = br#"{"recent": ["/a"], "rig": {"output": "null", "buffer_frames": 128, "full_scale_volts": 2.5,
        "actuator": {"profile": {"built_in": "mm1c"}, "load_g": 40.0}}}"#;
    vec![write_settings(&settings), rig.to_vec()]
}

pub(crate) fn read_some_settings(bytes: &[u8]) -> Result<(), String> {
    let (settings, _) = read_settings(bytes);
    let written = write_settings(&settings);
    let (again, error) = read_settings(&written);
    match error {
        Some(error) => Err(format!("the written settings cannot be read: {error}")),
        None if write_settings(&again) == written => Ok(()),
        None => Err("writing the settings twice gives different bytes".into()),
    }
}

pub(crate) fn actuator_seeds() -> Vec<Vec<u8>> {
    built_in_actuators().unwrap().iter().map(write_actuator).collect()
}

pub(crate) fn read_an_actuator(bytes: &[u8]) -> Result<(), String> {
    let Ok(actuator) = read_actuator(bytes) else { return Ok(()) };
    match read_actuator(&write_actuator(&actuator)) {
        Ok(again) if again == actuator => Ok(()),
        Ok(_) => Err("the written profile is another one".into()),
        Err(error) => Err(format!("the written profile cannot be read: {error}")),
    }
}

pub(crate) fn quality_model_seeds() -> Vec<Vec<u8>> {
    let built_in = built_in_quality_model().unwrap();
    let mut fitted = built_in.clone();
    fitted.fit = Some(ModelFit {
        table_sha256: "ab".repeat(32),
        n_pairs: 25,
        n_textures: 5,
        r_squared: Some(0.9),
        nested_r_squared: None,
        is_simulated: true,
        tolerance: 0.2,
        standard_errors: vec![Some(0.25), None, Some(1.5), Some(0.125)],
    });
    [built_in, fitted].iter().map(write_quality_model).collect()
}

pub(crate) fn read_a_quality_model(bytes: &[u8]) -> Result<(), String> {
    let Ok(model) = read_quality_model(bytes) else { return Ok(()) };
    match read_quality_model(&write_quality_model(&model)) {
        Ok(again) if again == model => Ok(()),
        Ok(again) => Err(format!("{model:?} became {again:?}")),
        Err(error) => Err(format!("the written model cannot be read: {error}")),
    }
}

pub(crate) fn hid_seeds() -> Vec<Vec<u8>> {
    vec![
        b"R: 4 05 0d 09 02\nI: 3 056a 0061\nE: 000000.000000 4 02 e0 10 00\nE: 000000.008000 4 02 e1 11 00\n"
            .to_vec(),
        b"001:002:000:STREAM             1434567890.123456\n 02 E0 10 00 20 00 00 00\n\n".to_vec(),
    ]
}

pub(crate) fn read_a_hid_text(bytes: &[u8]) {
    // An error is fine too.
    let _ = read_hid_text(bytes);
}
