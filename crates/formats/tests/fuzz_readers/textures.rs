//! Texture models: libraries, models in the XML of HaTT, and materials.

use shagreen_core::texture::TextureModel;
use shagreen_formats::hatt::{read_hatt, write_hatt};
use shagreen_formats::library::{Provenance, read_library, write_library};
use shagreen_formats::materials_toml::read_materials;
use shagreen_formats::starter::starter_library;

pub(crate) fn library_seeds() -> Vec<Vec<u8>> {
    vec![
        include_bytes!("../golden/library-1.0.json").to_vec(),
        include_bytes!("../golden/library-1.1.json").to_vec(),
        include_bytes!("../golden/library-1.7.json").to_vec(),
        include_bytes!("../golden/library-1.8.json").to_vec(),
        include_bytes!("../golden/library-1.9.json").to_vec(),
    ]
}

pub(crate) fn read_a_library(bytes: &[u8]) -> Result<(), String> {
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
pub(crate) fn hatt_seeds() -> Vec<Vec<u8>> {
    let mut texture = starter_library().unwrap().textures.swap_remove(0);
    let nodes = texture.model.nodes()[..2].to_vec();
    texture.model = TextureModel::new(texture.model.rate(), nodes, Some(0.4)).unwrap();
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

pub(crate) fn xml_bombs() -> Vec<Vec<u8>> {
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

pub(crate) fn read_a_hatt(bytes: &[u8]) -> Result<(), String> {
    let Ok(imported) = read_hatt(bytes) else { return Ok(()) };
    let mut entry = imported.value.into_entry("fuzz");
    entry.provenance = Provenance::Free;
    let written = write_hatt(&entry, "fuzz").map_err(|error| error.to_string())?;
    read_hatt(&written).map(|_| ()).map_err(|error| format!("the written texture cannot be read: {error}"))
}

pub(crate) fn materials_seeds() -> Vec<Vec<u8>> {
    let text = include_str!("../../../../assets/starter/materials.toml");
    // The header and the first two materials.
    let end = text.match_indices("[[material]]").nth(2).map_or(text.len(), |(at, _)| at);
    vec![text.as_bytes()[..end].to_vec()]
}

pub(crate) fn read_some_materials(bytes: &[u8]) {
    // An error is fine too.
    let _ = read_materials(bytes);
}
