//! What a picture seems to show, as JSON.

use serde_json::{Value, json};
use shagreen_core::surfaces::picture_doubts::PictureDoubt;
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_studio::seen_materials::{MaterialEntry, SeenMaterial, doubt_with_advice};

/// Returns the likely materials: name and probability, and the name and the estimates of the lexicon entry.
pub(crate) fn materials_json(materials: &[SeenMaterial]) -> Value {
    let material = |of: &SeenMaterial| {
        json!({
            "name": of.name,
            "probability": of.probability,
            "lexicon_entry": of.entry.as_ref().map(|entry| &entry.name),
            "lexicon_attributes": of.entry.as_ref().map(attributes_json),
        })
    };
    materials.iter().map(material).collect()
}

fn attributes_json(entry: &MaterialEntry) -> Value {
    let of_names = ATTRIBUTES.into_iter().zip(entry.hints);
    let attributes = of_names.filter_map(|(name, hint)| Some((name.to_owned(), hint?)));
    let values = attributes.map(|(name, of)| (name, json!({"value": of.mean, "sd": of.deviation})));
    values.collect::<serde_json::Map<String, Value>>().into()
}

/// Returns the doubts about a picture, with what to do.
pub(crate) fn doubts_json(doubts: &[PictureDoubt]) -> Value {
    doubts.iter().map(|doubt| doubt_with_advice(*doubt)).collect()
}

#[cfg(test)]
mod tests {
    use super::{doubts_json, materials_json};
    use shagreen_core::maths::gaussian_process::Estimate;
    use shagreen_core::surfaces::picture_doubts::PictureDoubt;
    use shagreen_studio::seen_materials::{MaterialEntry, SeenMaterial};

    #[test]
    fn materials_have_their_lexicon_entries() {
        let hints = [Some(Estimate { mean: 29.0, deviation: 11.0 }), None, None, None, None];
        let entry = MaterialEntry { name: "carpet".to_owned(), hints };
        let of = |name: &str, entry| SeenMaterial { name: name.to_owned(), probability: 0.5, entry };
        let json = materials_json(&[of("carpet", Some(entry)), of("plasma", None)]);
        assert_eq!((&json[0]["name"], &json[0]["probability"]), (&"carpet".into(), &0.5.into()));
        assert_eq!(json[0]["lexicon_entry"], "carpet");
        let attributes = json[0]["lexicon_attributes"].as_object().unwrap();
        assert_eq!((attributes.len(), &attributes["rough-smooth"]["sd"]), (1, &11.0.into()));
        assert!(json[1]["lexicon_entry"].is_null() && json[1]["lexicon_attributes"].is_null());
        assert!(doubts_json(&[PictureDoubt::Blurred])[0].as_str().unwrap().contains("blurred"));
        assert!(doubts_json(&[]).as_array().unwrap().is_empty());
    }
}
