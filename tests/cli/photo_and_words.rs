//! Photos and words together: which of them counts, and what is said about a photo.

use serde_json::Value;

use crate::learn::{FIVE, attribute, generated, prompt};
use crate::support::Bench;

#[test]
fn a_photo_and_words_are_weighted_by_their_standard_deviations() {
    let bench = Bench::new();
    generated(&bench, "coarse brick", "--out brick --size 256");
    let (words, photo) =
        (prompt(&bench, "velvet"), bench.json("predict attributes --photo brick/picture.png"));
    let both = bench.json("predict attributes --photo brick/picture.png --prompt velvet");
    let differ = both["words_and_picture_differ"].as_array().unwrap();
    for name in ["rough-smooth", "hard-soft"] {
        let ((said, of_words), (seen, of_photo)) = (attribute(&words, name), attribute(&photo, name));
        let (value, sd) = attribute(&both, name);
        let [p, q] = [of_words, of_photo].map(|sd| 1.0 / (sd * sd));
        assert!((value - (p * said + q * seen) / (p + q)).abs() < 1e-6, "{name}: {value}");
        let apart = (said - seen).abs() / of_words.hypot(of_photo);
        assert!((sd - (apart.max(1.0) / (p + q).sqrt()).min(28.9)).abs() < 1e-6, "{name}: {sd}");
        assert_eq!(differ.contains(&name.into()), apart > 2.0, "{name}");
    }
    for name in &FIVE[2..] {
        assert_eq!(attribute(&both, name), attribute(&words, name), "{name}");
    }
    assert_eq!((&both["by_words"], &both["by_picture"]), (&words["attributes"], &photo["attributes"]));
    assert_eq!((&both["words"], &both["is_about_touch"]), (&words["words"], &true.into()));
    let text = bench.run("predict attributes --photo brick/picture.png --prompt velvet").stdout;
    for part in ["understood: velvet", "photo: predicted by", "no person rated"] {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn a_doubtful_photo_says_so_and_what_to_do() {
    let bench = Bench::new();
    image::RgbImage::from_pixel(64, 64, image::Rgb([128; 3])).save(bench.path("card.png")).unwrap();
    let said = bench.json("predict attributes --photo card.png");
    let doubts: Vec<&str> = said["doubts"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
    assert!(doubts.iter().any(|doubt| doubt.contains("almost no detail; light the surface")), "{doubts:?}");
    assert!(said["materials"].is_array(), "{said}");
    let warned = bench.run("predict attributes --photo card.png").stderr;
    assert!(warned.contains("warning: the picture shows almost no detail") && warned.contains("card.png"));
}

/// A procedural picture is computed from the words: it may look like anything.
#[test]
fn the_words_of_a_prompt_lead_where_they_made_the_picture() {
    let bench = Bench::new();
    for text in ["velvet", "aluminum foil", "rough and smooth", "the meaning of life"] {
        let said = generated(&bench, text, "--out made --size 64 --interpolated");
        assert_eq!(said["picture_is_independent"], false);
        for (axis, name) in ["rough-smooth", "hard-soft"].into_iter().enumerate() {
            assert_eq!(said["together"][name], said["by_words"][name], "{text}");
            assert_eq!(said["at"][axis], said["by_words"][name]["value"], "{text}");
        }
        let alone = prompt(&bench, text);
        let (value, sd) = attribute(&alone, "hard-soft");
        assert_eq!(said["together"]["hard-soft"], serde_json::json!({"value": value, "sd": sd}), "{text}");
    }
}
