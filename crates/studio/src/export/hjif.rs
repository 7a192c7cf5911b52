//! Haptic files of MPEG.

use std::time::{SystemTime, UNIX_EPOCH};

use shagreen_formats::hjif::{check_hjif, hjif_of_texture, iso_date, lost_in_hjif, write_hjif};
use shagreen_formats::library::TextureEntry;

use super::signal_format::FilePart;
use super::{ExportContext, ExportFormat};

pub(super) struct Hjif;

impl ExportFormat for Hjif {
    fn id(&self) -> &'static str {
        "hjif"
    }

    fn name(&self) -> &'static str {
        "MPEG haptics (HJIF)"
    }

    fn ending(&self) -> &'static str {
        "hjif"
    }

    fn help(&self) -> &'static str {
        "Bands of vibration, friction and stiffness, for players of ISO/IEC 23090-31"
    }

    fn lost(&self, texture: &TextureEntry) -> Vec<String> {
        lost_in_hjif(texture)
    }

    fn describes_actuator(&self) -> bool {
        true
    }

    fn bytes(&self, texture: &TextureEntry, created_by: &str) -> anyhow::Result<Vec<u8>> {
        bytes(texture, &ExportContext::new(created_by))
    }

    fn files(
        &self,
        texture: &TextureEntry,
        _: &str,
        context: &ExportContext<'_>,
    ) -> anyhow::Result<Vec<FilePart>> {
        Ok(vec![FilePart { suffix: "", bytes: bytes(texture, context)? }])
    }

    fn is_like(&self, bytes: &[u8]) -> bool {
        check_hjif(bytes).is_ok()
    }
}

fn bytes(texture: &TextureEntry, context: &ExportContext<'_>) -> anyhow::Result<Vec<u8>> {
    // A clock before 1970 is wrong in any case.
    let unix_secs = SystemTime::now().duration_since(UNIX_EPOCH).map_or(0, |time| time.as_secs());
    let date = iso_date(unix_secs);
    let file = hjif_of_texture(texture, context.actuator, (context.created_by, &date))?;
    Ok(write_hjif(&file))
}

#[cfg(test)]
mod tests {
    use super::super::{ExportContext, ExportFormat as _};
    use super::Hjif;
    use shagreen_formats::actuator_toml::built_in_actuators;
    use shagreen_formats::hjif::read_hjif;
    use shagreen_formats::starter::starter_library;

    #[test]
    fn the_actuator_of_the_context_is_the_reference_device() {
        let library = starter_library().unwrap();
        let actuator = built_in_actuators().unwrap().swap_remove(0);
        let context = ExportContext { actuator: Some(&actuator), ..ExportContext::new("test") };
        let files = Hjif.files(&library.textures[0], "a", &context).unwrap();
        let file = read_hjif(&files[0].bytes).unwrap();
        assert_eq!(file.perceptions[0].reference_devices[0].name, actuator.name);
        assert!(file.description.contains("Written by test"), "{}", file.description);
        let without = read_hjif(&Hjif.bytes(&library.textures[0], "test").unwrap()).unwrap();
        assert!(without.perceptions[0].reference_devices.is_empty());
        assert!(without.date.len() == 10 && without.date.as_str() > "2025", "{}", without.date);
    }
}
