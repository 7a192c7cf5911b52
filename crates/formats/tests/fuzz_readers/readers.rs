//! The readers, each with small valid files as seeds. To add a reader, add an entry to [`READERS`].

use shagreen_formats::stroke_csv::read_stroke_csv;
use shagreen_formats::svc::{PenFlavor, PenMapping, pen_samples, read_svc};
use shagreen_formats::wav::SidecarV1;

use crate::batches::{
    bundle_bombs, bundle_seeds, manifest_seeds, part_seeds, read_a_bundle, read_a_manifest, read_a_part,
    read_a_record, record_seeds,
};
use crate::clips::{clip_seeds, pattern_seeds, read_a_clip, read_a_pattern};
use crate::documents::{
    actuator_seeds, copied_texture_seeds, hid_seeds, project_seeds, quality_model_seeds,
    read_a_copied_texture, read_a_hid_text, read_a_project, read_a_quality_model, read_an_actuator,
    read_some_settings, settings_seeds,
};
use crate::experiences::{hjif_seeds, read_a_scene, read_an_hjif, scene_seeds};
use crate::imports::{read_a_signal, signal_seeds};
use crate::judgments::{
    photo_table_seeds, places_seeds, rated_pairs_seeds, ratings_seeds, read_a_sorting, read_some_photos,
    read_some_places, read_some_rated_pairs, read_some_ratings, read_some_recordings, recordings_seeds,
    sorting_seeds, table_bombs as judgment_bombs,
};
use crate::mutate::repair_png;
use crate::photos::{photo_bombs, photo_seeds, read_a_photo};
use crate::pictures::{jpeg_bombs, jpeg_seeds, png_bombs, png_seeds, read_a_jpeg, read_a_png};
use crate::recordings::{
    map_seeds, read_a_map, read_a_table, read_a_wav, read_a_wav_sidecar, sidecar_seeds as wav_sidecar_seeds,
    table_bombs, table_seeds, wav_bombs, wav_seeds,
};
use crate::signals::{
    profile_seeds, read_a_profile, read_a_stream, repair_stream, stream_bombs, stream_seeds,
};
use crate::studies::{log_seeds, plan_seeds, read_a_log, read_a_plan};
use crate::textures::{
    hatt_seeds, library_seeds, materials_seeds, read_a_hatt, read_a_library, read_some_materials, xml_bombs,
};

/// A reader, and the source of its inputs.
#[derive(Clone, Copy)]
pub(crate) struct Reader {
    pub(crate) name: &'static str,
    /// Valid files, a few kB each.
    pub(crate) seeds: fn() -> Vec<Vec<u8>>,
    /// Recomputes checksums, so that the reader accepts mutated data.
    pub(crate) repair: Option<fn(&mut [u8])>,
    /// Small files that request much memory or time.
    pub(crate) bombs: fn() -> Vec<Vec<u8>>,
    /// Reads the input. An error of the reader is fine; a violated property of its result is returned as an error.
    pub(crate) read: fn(&[u8]) -> Result<(), String>,
}

/// A reader whose inputs need no repair.
const fn reader(
    name: &'static str,
    seeds: fn() -> Vec<Vec<u8>>,
    bombs: fn() -> Vec<Vec<u8>>,
    read: fn(&[u8]) -> Result<(), String>,
) -> Reader {
    Reader { name, seeds, repair: None, bombs, read }
}

pub(crate) const READERS: &[Reader] = &[
    reader("library", library_seeds, json_bombs, read_a_library),
    reader("hatt", hatt_seeds, xml_bombs, read_a_hatt),
    reader("svc", svc_seeds, no_bombs, |bytes| {
        read_an_svc(bytes);
        Ok(())
    }),
    reader("stroke_csv", csv_seeds, csv_bombs, |bytes| {
        read_a_stroke(bytes);
        Ok(())
    }),
    reader("sidecar", sidecar_seeds, json_bombs, |bytes| {
        read_a_sidecar(bytes);
        Ok(())
    }),
    reader("materials", materials_seeds, toml_bombs, |bytes| {
        read_some_materials(bytes);
        Ok(())
    }),
    reader("jpeg", jpeg_seeds, jpeg_bombs, read_a_jpeg),
    Reader { repair: Some(repair_png), ..reader("png", png_seeds, png_bombs, read_a_png) },
    reader("photo", photo_seeds, photo_bombs, read_a_photo),
    reader("recording_table", table_seeds, table_bombs, read_a_table),
    reader("sorting", sorting_seeds, judgment_bombs, read_a_sorting),
    reader("ratings", ratings_seeds, judgment_bombs, read_some_ratings),
    reader("places", places_seeds, judgment_bombs, read_some_places),
    reader("photo_table", photo_table_seeds, judgment_bombs, read_some_photos),
    reader("recordings", recordings_seeds, judgment_bombs, read_some_recordings),
    reader("recording_wav", wav_seeds, wav_bombs, read_a_wav),
    reader("recording_sidecar", wav_sidecar_seeds, json_bombs, read_a_wav_sidecar),
    reader("map", map_seeds, toml_bombs, read_a_map),
    Reader {
        repair: Some(repair_stream),
        ..reader("codec_stream", stream_seeds, stream_bombs, read_a_stream)
    },
    reader("project", project_seeds, json_bombs, read_a_project),
    reader("copied_texture", copied_texture_seeds, json_bombs, read_a_copied_texture),
    reader("settings", settings_seeds, json_bombs, read_some_settings),
    reader("actuator", actuator_seeds, toml_bombs, read_an_actuator),
    reader("hid_text", hid_seeds, csv_bombs, |bytes| {
        read_a_hid_text(bytes);
        Ok(())
    }),
    reader("profile", profile_seeds, csv_bombs, read_a_profile),
    reader("rated_pairs", rated_pairs_seeds, judgment_bombs, read_some_rated_pairs),
    reader("quality_model", quality_model_seeds, json_bombs, read_a_quality_model),
    reader("study_plan", plan_seeds, toml_bombs, read_a_plan),
    reader("study_log", log_seeds, json_bombs, read_a_log),
    reader("haptic_clip", clip_seeds, json_bombs, read_a_clip),
    reader("ahap", pattern_seeds, json_bombs, read_a_pattern),
    reader("clip_signal", signal_seeds, json_bombs, read_a_signal),
    reader("batch", manifest_seeds, toml_bombs, read_a_manifest),
    reader("batch_record", record_seeds, json_bombs, read_a_record),
    reader("evaluation_part", part_seeds, json_bombs, read_a_part),
    reader("bundle", bundle_seeds, bundle_bombs, read_a_bundle),
    reader("hjif", hjif_seeds, json_bombs, read_an_hjif),
    reader("gltf", scene_seeds, json_bombs, read_a_scene),
];

fn no_bombs() -> Vec<Vec<u8>> {
    Vec::new()
}

fn json_bombs() -> Vec<Vec<u8>> {
    let nested = |open: &str, n: usize| open.repeat(n).into_bytes();
    let inside =
        |inner: &str| format!("{{\"format\": \"shagreen-library\", \"version\": \"1.0\", \"x\": {inner}");
    vec![
        nested("[", 1 << 20),
        nested("{\"a\":", 1 << 18),
        inside(&"[".repeat(1 << 20)).into_bytes(),
        inside(&format!("[{}0]}}", "0,".repeat(1 << 20))).into_bytes(),
        inside(&format!("[{}0]}}", "[],".repeat(1 << 20))).into_bytes(),
    ]
}

fn svc_seeds() -> Vec<Vec<u8>> {
    vec![
        b"3\n100 200 10 1 1800 600 5000\n110 205 18 1 1800 600 5200\n120 210 26 0 1800 600 0\n".to_vec(),
        b"2\n1.5 2.5 0.01 1 180.5 60 0.5\n1.75 2.5 0.018 1 180.5 60 0.625\n".to_vec(),
    ]
}

fn read_an_svc(bytes: &[u8]) {
    if let Ok(imported) = read_svc(bytes) {
        let mapping = PenMapping::of(PenFlavor::Raw);
        // Whether the mapping accepts the numbers does not matter here.
        let _ = pen_samples(&imported.value, &mapping);
    }
}

fn csv_seeds() -> Vec<Vec<u8>> {
    vec![
        b"time [ms],speed [mm/s],force [N]\n0,100,0.5\n8,110,0.6\n16,\"120\",0.7\n".to_vec(),
        b"t;x;y;pressure;touching\n0,0;1,5;2,5;0,5;1\n0,008;1,75;2,5;0,625;0\n".to_vec(),
        b"0\t100\t0.5\n0.008\t110\t0.6\n".to_vec(),
    ]
}

fn csv_bombs() -> Vec<Vec<u8>> {
    vec![
        ",".repeat(1 << 20).into_bytes(),
        "0,1,2\n".repeat(1 << 17).into_bytes(),
        "\n".repeat(1 << 20).into_bytes(),
    ]
}

fn read_a_stroke(bytes: &[u8]) {
    // An error is fine too.
    let _ = read_stroke_csv(bytes);
}

fn sidecar_seeds() -> Vec<Vec<u8>> {
    let text = r#"{"format": "shagreen-signal", "version": "1.0", "units": "m/s^2", "full_scale": 1.0,
        "channels": ["acceleration"], "rate_hz": 1000, "seconds": 0.003, "texture": null, "at": [30.0, 70.0],
        "clamped": false, "blend": "shared", "parents": [{"id": "cork", "weight": 1.0, "licence": "CC0-1.0"}],
        "library": "Starter", "label_source": "physical", "seed": 5, "stroke": null,
        "trace": {"time_s": [0.0, 0.001], "speed_mm_per_s": [100.0, 110.0], "force_n": [1.0, 1.0]},
        "created_by": "shagreen"}"#;
    vec![text.as_bytes().to_vec()]
}

fn read_a_sidecar(bytes: &[u8]) {
    // An error is fine too.
    let _ = serde_json::from_slice::<SidecarV1>(bytes);
}

fn toml_bombs() -> Vec<Vec<u8>> {
    vec![
        format!("a = {}", "[".repeat(1 << 18)).into_bytes(),
        format!("{}a = 1", "a.".repeat(1 << 16)).into_bytes(),
        "[[material]]\n".repeat(1 << 14).into_bytes(),
        format!("a = [{}]", "0,".repeat(1 << 17)).into_bytes(),
    ]
}
