//! Description of an exported signal in words, for formats without fields for it.

use crate::clip_scale::ClipScale;
use crate::wav::{ParentV1, SidecarV1};

/// Largest number of textures whose terms of use are listed.
const MOST_LISTED: usize = 8;

/// Returns what a file with a signal contains: texture, motion, scale, program and terms of use.
pub fn signal_description(sidecar: &SidecarV1, scale: ClipScale) -> String {
    let [low, high] = scale.band;
    let sentences = [
        format!("{}, {}, {:.2} s.", texture(sidecar), motion(sidecar), sidecar.seconds),
        format!("Amplitude 1 is {:.4} m/s²; frequency 0 to 1 is {low} to {high}.", scale.full_scale_mps2),
        format!("Made by {}.", sidecar.created_by),
        terms(&sidecar.parents),
    ];
    sentences.join(" ").trim_end().to_owned()
}

/// Name of the texture, and its library.
fn texture(sidecar: &SidecarV1) -> String {
    let named = sidecar.name.as_deref().or(sidecar.texture.as_deref());
    let name = named.map_or_else(
        || match &sidecar.at {
            Some(at) => {
                let coordinates = at.iter().map(|x| format!("{x:.1}")).collect::<Vec<_>>().join(", ");
                format!("Texture at ({coordinates})")
            }
            None => "Texture".to_owned(),
        },
        |name| format!("Texture \"{name}\""),
    );
    if sidecar.library.is_empty() { name } else { format!("{name} of the library \"{}\"", sidecar.library) }
}

fn motion(sidecar: &SidecarV1) -> String {
    match (&sidecar.stroke, sidecar.trace.steady()) {
        (Some(stroke), _) => format!("along the stroke {stroke}"),
        (None, Some((speed_mm_per_s, force_n))) => format!("at {speed_mm_per_s} mm/s and {force_n} N"),
        (None, None) => "along a stroke".to_owned(),
    }
}

/// Terms of use of the textures that contribute.
fn terms(parents: &[ParentV1]) -> String {
    let mut listed: Vec<String> = Vec::new();
    for ParentV1 { id, licence, .. } in parents {
        let text = format!("{id}: {licence}");
        if !licence.is_empty() && !listed.contains(&text) {
            listed.push(text);
        }
    }
    let n_more = listed.len().saturating_sub(MOST_LISTED);
    listed.truncate(MOST_LISTED);
    if n_more > 0 {
        listed.push(format!("{n_more} more"));
    }
    if listed.is_empty() { String::new() } else { format!("Terms of use: {}.", listed.join("; ")) }
}

#[cfg(test)]
mod tests {
    use super::signal_description;
    use crate::clip_scale::ClipScale;
    use crate::wav::{ParentV1, SidecarV1, TraceV1};

    #[test]
    fn a_description_says_what_numbers_mean() {
        let steady = TraceV1 {
            time_s: vec![0.0, 2.0],
            speed_mm_per_s: vec![100.0; 2],
            force_n: vec![1.0; 2],
            ..TraceV1::default()
        };
        let parent = |id: &str| ParentV1 { id: id.to_owned(), weight: 1.0, licence: "CC0-1.0".to_owned() };
        let mut sidecar = SidecarV1 {
            texture: Some("cork".to_owned()),
            library: "Starter".to_owned(),
            parents: vec![parent("cork")],
            trace: steady,
            ..SidecarV1::new(1000, 2.0, 1, "shagreen 1")
        };
        let text = |sidecar: &SidecarV1| signal_description(sidecar, ClipScale::new(1.25, None));
        assert_eq!(
            text(&sidecar),
            "Texture \"cork\" of the library \"Starter\", at 100 mm/s and 1 N, 2.00 s. Amplitude 1 is 1.2500 m/s²; \
             frequency 0 to 1 is 60 Hz to 300 Hz. Made by shagreen 1. Terms of use: cork: CC0-1.0."
        );
        sidecar.texture = None;
        sidecar.at = Some(vec![30.0, 70.25]);
        sidecar.stroke = Some("my.csv".to_owned());
        sidecar.parents = (0..12).map(|i| parent(&format!("t{i}"))).collect();
        let text = text(&sidecar);
        for words in ["Texture at (30.0, 70.2", "along the stroke my.csv", "t7: CC0-1.0; 4 more"] {
            assert!(text.contains(words), "{words}: {text}");
        }
    }
}
