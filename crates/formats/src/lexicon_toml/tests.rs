use super::{built_in_lexicon, read_lexicon};
use crate::starter::starter_library;
use shagreen_core::surfaces::prompt::{PromptInterpretation, interpret};
use shagreen_core::surfaces::touch_words::{Hints, Lexicon, Meaning};

#[test]
fn the_words_of_the_program_are_sound() {
    let lexicon = built_in_lexicon().unwrap();
    let library = starter_library().unwrap();
    let mut n_surfaces = 0;
    for (word, _) in lexicon.words() {
        if let Some((_, Meaning::Surface { like, hints, .. })) = lexicon.get(word) {
            n_surfaces += 1;
            assert!(
                library.textures.iter().any(|texture| texture.id == *like),
                "{word} refers to the missing texture {like}"
            );
            assert!(hints.iter().all(Option::is_some), "{word} has no estimate of some attribute");
        }
    }
    assert!(n_surfaces > 500, "{n_surfaces}");
}

#[test]
fn names_of_the_starter_library_lead_to_their_places() {
    let lexicon = built_in_lexicon().unwrap();
    let library = starter_library().unwrap();
    for texture in &library.textures {
        let understood = interpret(&texture.name, lexicon);
        let at = texture.at().unwrap();
        let [rough, hard, ..] = understood.attributes;
        assert!((rough.mean - at.x()).abs() < 2.0 * rough.deviation, "{}: {rough:?}", texture.name);
        assert!((hard.mean - at.y()).abs() < 2.0 * hard.deviation, "{}: {hard:?}", texture.name);
        assert!(understood.unknown.is_empty(), "{}: {:?}", texture.name, understood.unknown);
    }
}

#[test]
fn files_that_make_no_sense_are_refused() {
    const FRAME: &str = "negations = []\nfillers = []\nsurface = []\nquality = []\npattern = []\ncolor = []\nshade = []\nsize = []\ndegree = []";
    assert!(read_lexicon(FRAME).is_ok());
    let with = |from: &str, to: &str| read_lexicon(&FRAME.replace(from, to)).unwrap_err().to_string();
    for (from, to, expected) in [
        ("fillers = []", "fillers = [\"a\", \"a\"]", "\"a\" is listed twice"),
        (
            "quality = []",
            "quality = [{ words = [\"rough\"], rough-smooth = [140, 8] }]",
            "a mean of \"rough\" is 140",
        ),
        ("quality = []", "quality = [{ words = [\"rough\"] }]", "no estimate of any attribute"),
        ("size = []", "size = [{ words = [\"tiny\"], factor = 0 }]", "factor of \"tiny\" is 0"),
        ("size = []", "size = [{ words = [\"tiny\"], factor = 1, of = 2 }]", "unknown field"),
        (
            "degree = []",
            "degree = []\nclasses = { wool = \"yarn\" }",
            "\"wool\" stands for \"yarn\", which is not a word of a surface",
        ),
        ("degree = []", "degree = []\ndepictions = [\"close up\"]", "\"close up\" must be"),
    ] {
        let error = with(from, to);
        assert!(error.contains(expected), "{error}");
    }
}

/// Sentences around a material. Their other words say nothing of touch, because they are about people, places and questions,
/// or about a picture and its light: "soft" is the light, "rough" the sketch, "old" the picture. A sentence with an
/// adjective of the surface, or with a second surface, must move the estimate, so it cannot be among them.
const SENTENCES: [&str; 10] = [
    "a photo of {}",
    "something like {}",
    "{} that my grandmother had",
    "soft light on {}",
    "a rough sketch of {}",
    "I found an old picture of {}",
    "what does {} feel like?",
    "I would like to touch {}, please",
    "it looks as if it were made of {}",
    "my father bought {} in a store last winter",
];

/// Words of surfaces, with their estimates.
fn material_words(lexicon: &Lexicon) -> impl Iterator<Item = (&str, &Hints)> {
    lexicon.words().filter_map(move |(word, _)| match lexicon.get(word) {
        Some((_, Meaning::Surface { hints, .. })) => Some((word, hints)),
        _ => None,
    })
}

/// Whether each attribute lies within one standard deviation of the estimate of the lexicon.
fn lands(understood: &PromptInterpretation, hints: &Hints) -> bool {
    understood.attributes.iter().zip(hints).all(|(attribute, hint)| {
        hint.is_some_and(|hint| (attribute.mean - hint.mean).abs() <= hint.deviation)
    })
}

#[test]
fn each_material_lands_on_its_estimate_alone_and_in_ten_sentences() {
    let lexicon = built_in_lexicon().unwrap();
    let mut n_words = 0;
    for (word, hints) in material_words(lexicon) {
        n_words += 1;
        let alone = interpret(word, lexicon);
        assert!(lands(&alone, hints), "{word}: {:?}", alone.attributes);
        assert_eq!(alone.words.len(), 1, "{word}: {:?}", alone.words);
        for sentence in SENTENCES {
            let prompt = sentence.replace("{}", word);
            let understood = interpret(&prompt, lexicon);
            assert!(lands(&understood, hints), "{prompt}: {:?}", understood.words);
            // Stricter: the sentence adds nothing, neither to the means nor to the standard deviations.
            assert_eq!(understood.attributes, alone.attributes, "{prompt}: {:?}", understood.words);
        }
    }
    assert!(n_words > 900, "{n_words}");
}

/// Negative control: an adjective of the surface, or a second surface, moves the estimate.
#[test]
fn a_sentence_that_says_something_of_touch_moves_the_estimate() {
    let lexicon = built_in_lexicon().unwrap();
    let hints = |word: &str| lexicon.material(word).unwrap().1;
    for (prompt, word) in
        [("soft granite", "granite"), ("velvet on concrete", "velvet"), ("a rough mirror", "mirror")]
    {
        assert!(!lands(&interpret(prompt, lexicon), hints(word)), "{prompt}");
    }
}

/// Each of them is a letter or two away from a word of touch.
#[test]
fn ordinary_words_are_not_corrected_to_words_of_touch() {
    let lexicon = built_in_lexicon().unwrap();
    let words = "store strong stand screen chair print group handle father called turned increased watching bridge \
                 butterfly weather published function sleep state";
    for word in words.split_whitespace() {
        let understood = interpret(word, lexicon);
        assert!(!understood.is_about_touch(), "{word} is taken for {:?}", understood.words);
    }
    // Misspelled words are still corrected.
    for (wrong, right) in
        [("carpt", "carpet"), ("velvett", "velvet"), ("lether", "leather"), ("grnaite", "granite")]
    {
        assert_eq!(interpret(wrong, lexicon).attributes, interpret(right, lexicon).attributes, "{wrong}");
    }
}

/// Classes of labelled photos, by which the picture model names materials.
const PHOTO_CLASSES: &str = "asphalt, bamboo, bark, brick, canvas, cardboard, carpet, ceramic, chipboard, clay, concrete, \
     cork, fabric, fur, grass, gravel, knit, leather, leaves, marble, metal, moss, net, paper, pavement, plaster, plastic, \
     plush, quilt, roofing tile, rubber, snow, soil, sponge, stone, straw, tatami, terrazzo, tile, towel, wallpaper, wood, \
     wood chips";

#[test]
fn each_class_of_photos_has_a_lexicon_entry() {
    let lexicon = built_in_lexicon().unwrap();
    assert_eq!(PHOTO_CLASSES.split(", ").count(), 43);
    for class in PHOTO_CLASSES.split(", ") {
        let (name, hints) = lexicon.material(class).unwrap_or_else(|| panic!("{class} has no entry"));
        assert!(hints.iter().all(Option::is_some), "{class} ({name}) has no estimate of some attribute");
        // Data sets write a class in one word, too.
        assert_eq!(lexicon.material(&class.replace(' ', "-")), Some((name, hints)));
    }
    assert_eq!(lexicon.material("plush").unwrap().0, "teddy bear");
    assert_eq!(lexicon.material("glow"), None);
}
