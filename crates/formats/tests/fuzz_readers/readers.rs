//! The readers, each with small valid files as seeds. To add a reader, add an entry to [`READERS`].

use shagreen_formats::hatt::{read_hatt, write_hatt};
use shagreen_formats::library::{read_library, write_library};
use shagreen_formats::materials_toml::read_materials;
use shagreen_formats::picture::{Picture, PictureFormat, Rgb, check, decode, encode_jpeg};
use shagreen_formats::starter::starter_library;
use shagreen_formats::stroke_csv::read_stroke_csv;
use shagreen_formats::svc::{PenFlavor, PenMapping, pen_samples, read_svc};
use shagreen_formats::wav::SidecarV1;

use crate::documents::{
    actuator_seeds, copied_texture_seeds, hid_seeds, project_seeds, read_a_copied_texture, read_a_hid_text,
    read_a_project, read_an_actuator, read_some_settings, settings_seeds,
};
use crate::judgments::{
    photo_table_seeds, places_seeds, ratings_seeds, read_a_sorting, read_some_photos, read_some_places,
    read_some_ratings, read_some_recordings, recordings_seeds, sorting_seeds, table_bombs as judgment_bombs,
};
use crate::mutate::repair_png;
use crate::photos::{photo_bombs, photo_seeds, read_a_photo};
use crate::recordings::{
    map_seeds, read_a_map, read_a_table, read_a_wav, read_a_wav_sidecar, sidecar_seeds as wav_sidecar_seeds,
    table_bombs, table_seeds, wav_bombs, wav_seeds,
};

use crate::signals::{
    profile_seeds, read_a_profile, read_a_stream, repair_stream, stream_bombs, stream_seeds,
};
use crate::studies::{log_seeds, plan_seeds, read_a_log, read_a_plan};

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

pub(crate) const READERS: &[Reader] = &[
    Reader { name: "library", seeds: library_seeds, repair: None, bombs: json_bombs, read: read_a_library },
    Reader { name: "hatt", seeds: hatt_seeds, repair: None, bombs: xml_bombs, read: read_a_hatt },
    Reader {
        name: "svc",
        seeds: svc_seeds,
        repair: None,
        bombs: no_bombs,
        read: |bytes| {
            read_an_svc(bytes);
            Ok(())
        },
    },
    Reader {
        name: "stroke_csv",
        seeds: csv_seeds,
        repair: None,
        bombs: csv_bombs,
        read: |bytes| {
            read_a_stroke(bytes);
            Ok(())
        },
    },
    Reader {
        name: "sidecar",
        seeds: sidecar_seeds,
        repair: None,
        bombs: json_bombs,
        read: |bytes| {
            read_a_sidecar(bytes);
            Ok(())
        },
    },
    Reader {
        name: "materials",
        seeds: materials_seeds,
        repair: None,
        bombs: toml_bombs,
        read: |bytes| {
            read_some_materials(bytes);
            Ok(())
        },
    },
    Reader { name: "jpeg", seeds: jpeg_seeds, repair: None, bombs: jpeg_bombs, read: read_a_jpeg },
    Reader { name: "png", seeds: png_seeds, repair: Some(repair_png), bombs: png_bombs, read: read_a_png },
    Reader { name: "photo", seeds: photo_seeds, repair: None, bombs: photo_bombs, read: read_a_photo },
    Reader {
        name: "recording_table",
        seeds: table_seeds,
        repair: None,
        bombs: table_bombs,
        read: read_a_table,
    },
    Reader {
        name: "sorting",
        seeds: sorting_seeds,
        repair: None,
        bombs: judgment_bombs,
        read: read_a_sorting,
    },
    Reader {
        name: "ratings",
        seeds: ratings_seeds,
        repair: None,
        bombs: judgment_bombs,
        read: read_some_ratings,
    },
    Reader {
        name: "places",
        seeds: places_seeds,
        repair: None,
        bombs: judgment_bombs,
        read: read_some_places,
    },
    Reader {
        name: "photo_table",
        seeds: photo_table_seeds,
        repair: None,
        bombs: judgment_bombs,
        read: read_some_photos,
    },
    Reader {
        name: "recordings",
        seeds: recordings_seeds,
        repair: None,
        bombs: judgment_bombs,
        read: read_some_recordings,
    },
    Reader { name: "recording_wav", seeds: wav_seeds, repair: None, bombs: wav_bombs, read: read_a_wav },
    Reader {
        name: "recording_sidecar",
        seeds: wav_sidecar_seeds,
        repair: None,
        bombs: json_bombs,
        read: read_a_wav_sidecar,
    },
    Reader { name: "map", seeds: map_seeds, repair: None, bombs: toml_bombs, read: read_a_map },
    Reader {
        name: "codec_stream",
        seeds: stream_seeds,
        repair: Some(repair_stream),
        bombs: stream_bombs,
        read: read_a_stream,
    },
    Reader { name: "project", seeds: project_seeds, repair: None, bombs: json_bombs, read: read_a_project },
    Reader {
        name: "copied_texture",
        seeds: copied_texture_seeds,
        repair: None,
        bombs: json_bombs,
        read: read_a_copied_texture,
    },
    Reader {
        name: "settings",
        seeds: settings_seeds,
        repair: None,
        bombs: json_bombs,
        read: read_some_settings,
    },
    Reader {
        name: "actuator",
        seeds: actuator_seeds,
        repair: None,
        bombs: toml_bombs,
        read: read_an_actuator,
    },
    Reader {
        name: "hid_text",
        seeds: hid_seeds,
        repair: None,
        bombs: csv_bombs,
        read: |bytes| {
            read_a_hid_text(bytes);
            Ok(())
        },
    },
    Reader { name: "profile", seeds: profile_seeds, repair: None, bombs: csv_bombs, read: read_a_profile },
    Reader { name: "study_plan", seeds: plan_seeds, repair: None, bombs: toml_bombs, read: read_a_plan },
    Reader { name: "study_log", seeds: log_seeds, repair: None, bombs: json_bombs, read: read_a_log },
];

fn no_bombs() -> Vec<Vec<u8>> {
    Vec::new()
}

fn library_seeds() -> Vec<Vec<u8>> {
    vec![
        include_bytes!("../golden/library-1.0.json").to_vec(),
        include_bytes!("../golden/library-1.1.json").to_vec(),
        include_bytes!("../golden/library-1.7.json").to_vec(),
        include_bytes!("../golden/library-1.8.json").to_vec(),
    ]
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

fn read_a_library(bytes: &[u8]) -> Result<(), String> {
    let Ok(imported) = read_library(bytes) else { return Ok(()) };
    let written = write_library(&imported.value);
    let again =
        read_library(&written).map_err(|error| format!("the written library cannot be read: {error}"))?;
    if write_library(&again.value) == written {
        Ok(())
    } else {
        Err("writing the library twice gives different bytes".into())
    }
}

/// A file of two measured models as this program writes it, and one as other programs may write it.
fn hatt_seeds() -> Vec<Vec<u8>> {
    let mut texture = starter_library().unwrap().textures.swap_remove(0);
    let nodes = texture.model.nodes()[..2].to_vec();
    texture.model =
        shagreen_core::texture::TextureModel::new(texture.model.rate(), nodes, Some(0.4)).unwrap();
    let other = "<modelSet texture=\"7\"><material>Made up</material><AccelUnits>m/s^2</AccelUnits>\
        <SpeedUnits>mm/s</SpeedUnits><ForceUnits>N</ForceUnits><SampleRate>1000</SampleRate><mu>0.3</mu>\
        <numMod>1</numMod><maxSpeed>90</maxSpeed><maxForce>2</maxForce>\
        <speedList><value>50</value></speedList><forceList><value>1</value></forceList>\
        <numARCoeff>2</numARCoeff><numMACoeff>0</numMACoeff><model><modNum>1</modNum>\
        <ARcoeff><value>1</value><value>-0.9</value><value>0.5</value></ARcoeff>\
        <ARlsf><value>0.723</value><value>1.372</value></ARlsf><var>0.01</var><gain>2</gain>\
        <speedMod>50</speedMod><forceMod>1</forceMod></model></modelSet>";
    vec![write_hatt(&texture, "shagreen").unwrap(), other.as_bytes().to_vec()]
}

fn xml_bombs() -> Vec<Vec<u8>> {
    let entities =
        "<!DOCTYPE a [<!ENTITY b \"bbbbbbbb\"><!ENTITY c \"&b;&b;&b;&b;\">]><modelSet>&c;</modelSet>";
    let attributes: String =
        (0..100_000).flat_map(|i| [" a".to_owned(), i.to_string(), "=\"\"".to_owned()]).collect();
    vec![
        entities.as_bytes().to_vec(),
        "<a>".repeat(1 << 19).into_bytes(),
        format!("<modelSet>{}</modelSet>", "<a/>".repeat(1 << 20)).into_bytes(),
        format!("<modelSet{attributes}/>").into_bytes(),
        format!("<modelSet>{}</modelSet>", "<a a=\"\" b=\"\" c=\"\"/>".repeat(1 << 17)).into_bytes(),
        format!("<modelSet><SampleRate>1</SampleRate>{}</modelSet>", "<model/>".repeat(100_000)).into_bytes(),
        format!("<modelSet><speedList>{}</speedList></modelSet>", "1 ".repeat(1 << 20)).into_bytes(),
    ]
}

fn read_a_hatt(bytes: &[u8]) -> Result<(), String> {
    let Ok(imported) = read_hatt(bytes) else { return Ok(()) };
    let mut entry = imported.value.into_entry("fuzz");
    entry.provenance = shagreen_formats::library::Provenance::Free;
    let written = write_hatt(&entry, "fuzz").map_err(|error| error.to_string())?;
    read_hatt(&written).map(|_| ()).map_err(|error| format!("the written texture cannot be read: {error}"))
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

fn materials_seeds() -> Vec<Vec<u8>> {
    let text = include_str!("../../../../assets/starter/materials.toml");
    // The header and the first two materials.
    let end = text.match_indices("[[material]]").nth(2).map_or(text.len(), |(at, _)| at);
    vec![text.as_bytes()[..end].to_vec()]
}

fn toml_bombs() -> Vec<Vec<u8>> {
    vec![
        format!("a = {}", "[".repeat(1 << 18)).into_bytes(),
        format!("{}a = 1", "a.".repeat(1 << 16)).into_bytes(),
        "[[material]]\n".repeat(1 << 14).into_bytes(),
        format!("a = [{}]", "0,".repeat(1 << 17)).into_bytes(),
    ]
}

fn read_some_materials(bytes: &[u8]) {
    // An error is fine too.
    let _ = read_materials(bytes);
}

fn rgb(width: u32, height: u32) -> Rgb {
    let pixels = (0..3 * width * height).map(|i| (i * i / 7 % 256) as u8).collect();
    Rgb { width, height, pixels }
}

fn jpeg_seeds() -> Vec<Vec<u8>> {
    vec![encode_jpeg(&rgb(16, 16), 20.0).unwrap().bytes, encode_jpeg(&rgb(40, 24), 20.0).unwrap().bytes]
}

/// Two headers that state the largest possible pictures, baseline and progressive.
fn jpeg_bombs() -> Vec<Vec<u8>> {
    let large = |change: fn(&mut [u8])| {
        let mut bytes = encode_jpeg(&rgb(16, 16), 20.0).unwrap().bytes;
        let frame = bytes.windows(2).position(|pair| pair == [0xFF, 0xC0]).unwrap();
        bytes[frame + 5..frame + 9].copy_from_slice(&[0x10, 0, 0x10, 0]);
        change(&mut bytes[frame..]);
        bytes
    };
    vec![large(|_| {}), large(|frame| frame[1] = 0xC2)]
}

/// The size in the header, so that the reader does not stop at a size mismatch.
fn jpeg_size(bytes: &[u8]) -> Option<(u32, u32)> {
    let frame = bytes.windows(2).position(|pair| pair[0] == 0xFF && (0xC0..=0xC2).contains(&pair[1]))?;
    let side = |at: usize| Some(u32::from(u16::from_be_bytes([*bytes.get(at)?, *bytes.get(at + 1)?])));
    Some((side(frame + 7)?, side(frame + 5)?))
}

fn read_a_jpeg(bytes: &[u8]) -> Result<(), String> {
    let (width, height) = jpeg_size(bytes).unwrap_or((1, 1));
    read_a_picture(bytes, width, height, PictureFormat::Jpeg)
}

fn png(image: &image::DynamicImage) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bytes.into_inner()
}

fn png_seeds() -> Vec<Vec<u8>> {
    vec![
        png(&image::DynamicImage::new_rgb8(12, 7)),
        png(&image::DynamicImage::new_rgba16(5, 9)),
        png(&image::DynamicImage::new_luma8(9, 5)),
    ]
}

/// Empty pictures of the largest size: some kB that decode to hundreds of MB.
fn png_bombs() -> Vec<Vec<u8>> {
    vec![png(&image::DynamicImage::new_luma8(4096, 4096)), png(&image::DynamicImage::new_rgba16(4096, 4096))]
}

fn read_a_png(bytes: &[u8]) -> Result<(), String> {
    let side = |at: usize| {
        bytes.get(at..at + 4).and_then(|b| <[u8; 4]>::try_from(b).ok()).map_or(1, u32::from_be_bytes)
    };
    read_a_picture(bytes, side(16), side(20), PictureFormat::Png)
}

fn read_a_picture(bytes: &[u8], width: u32, height: u32, format: PictureFormat) -> Result<(), String> {
    let picture = Picture { width, height, millimeters: 20.0, format, bytes: bytes.to_vec() };
    let head_is_sound = check(&picture).is_ok();
    match decode(&picture) {
        Ok(_) if !head_is_sound => Err("a picture with a damaged header was decoded".into()),
        _ => Ok(()),
    }
}
