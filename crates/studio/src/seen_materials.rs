//! What a picture seems to show: likely materials with their lexicon entries, and doubts with what to do about them.

use shagreen_core::surfaces::picture_doubts::PictureDoubt;
use shagreen_core::surfaces::touch_words::{Hints, Lexicon};
use shagreen_learn::picture_predictor::LikelyMaterial;

/// Largest number of materials that are named.
const MOST_NAMED: usize = 3;

/// A material that a picture is likely to show.
#[derive(Clone, Debug, PartialEq)]
pub struct SeenMaterial {
    /// Name of its class.
    pub name: String,
    /// Probability, 0 to 1.
    pub probability: f64,
    /// Lexicon entry of the class, if there is one.
    pub entry: Option<MaterialEntry>,
}

/// Lexicon entry of a class of materials. Its values are estimates of the authors; nobody rated a word.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialEntry {
    /// Name of the entry.
    pub name: String,
    /// Estimates of the attributes, 0 to 100.
    pub hints: Hints,
}

impl SeenMaterial {
    /// Returns the name with the probability in percent.
    pub fn label(&self) -> String {
        format!("{} {:.0} %", self.name, 100.0 * self.probability)
    }
}

/// Returns the materials that are named, the most likely first, with their lexicon entries.
pub fn seen_materials(likely: &[LikelyMaterial], lexicon: &Lexicon) -> Vec<SeenMaterial> {
    let seen = |LikelyMaterial { name, probability }: &LikelyMaterial| {
        let entry = lexicon.material(name);
        let entry = entry.map(|(name, hints)| MaterialEntry { name: name.to_owned(), hints: *hints });
        SeenMaterial { name: name.clone(), probability: *probability, entry }
    };
    likely.iter().take(MOST_NAMED).map(seen).collect()
}

/// Returns the names of the materials with their probabilities; `None` without materials.
pub fn looks_like(materials: &[SeenMaterial]) -> Option<String> {
    let labels: Vec<String> = materials.iter().map(SeenMaterial::label).collect();
    (!labels.is_empty()).then(|| format!("looks like {}", labels.join(", ")))
}

/// Returns a doubt about a picture, and what to do.
pub fn doubt_with_advice(doubt: PictureDoubt) -> String {
    let advice = match doubt {
        PictureDoubt::NoDetail => "light the surface from the side, or move the camera closer",
        PictureDoubt::Blurred => "use a sharp picture",
        PictureDoubt::UnlikeTraining => "use a picture that shows only the surface, from above",
        PictureDoubt::NoClearMaterial => "also describe the material in words, or correct the position",
    };
    format!("{}; {advice}", doubt.words())
}

#[cfg(test)]
mod tests {
    use super::{doubt_with_advice, looks_like, seen_materials};
    use shagreen_core::surfaces::picture_doubts::PictureDoubt;
    use shagreen_formats::lexicon_toml::built_in_lexicon;
    use shagreen_learn::picture_predictor::LikelyMaterial;

    fn likely(of: &[(&str, f64)]) -> Vec<LikelyMaterial> {
        let material = |(name, probability): &(&str, f64)| LikelyMaterial {
            name: (*name).to_owned(),
            probability: *probability,
        };
        of.iter().map(material).collect()
    }

    #[test]
    fn the_likely_materials_are_named_with_their_lexicon_entries() {
        let lexicon = built_in_lexicon().unwrap();
        let likely = likely(&[("fabric", 0.62), ("plush", 0.21), ("plasma", 0.08), ("carpet", 0.05)]);
        let seen = seen_materials(&likely, lexicon);
        assert_eq!(looks_like(&seen).unwrap(), "looks like fabric 62 %, plush 21 %, plasma 8 %");
        let entries: Vec<Option<&str>> =
            seen.iter().map(|of| of.entry.as_ref().map(|entry| entry.name.as_str())).collect();
        assert_eq!(entries, [Some("fabric"), Some("teddy bear"), None]);
        let fabric = seen[0].entry.as_ref().unwrap();
        assert_eq!(Some(&fabric.hints), lexicon.material("fabric").map(|(_, hints)| hints));
        assert_eq!(looks_like(&seen_materials(&[], lexicon)), None);
    }

    #[test]
    fn each_doubt_says_what_to_do() {
        for doubt in [
            PictureDoubt::NoDetail,
            PictureDoubt::Blurred,
            PictureDoubt::UnlikeTraining,
            PictureDoubt::NoClearMaterial,
        ] {
            let said = doubt_with_advice(doubt);
            assert!(said.starts_with(doubt.words()) && said.len() > doubt.words().len() + 10, "{said}");
        }
    }
}
