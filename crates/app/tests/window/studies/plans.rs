//! Small plans, one for each design.

/// Begin of a plan, with five textures of the starter library and a coded version of the first one.
const HEAD: &str = r#"format = "shagreen-study"
version = "1.0"
name = "Test"
consent = "You can stop at any time."
seed = 5

[[stimulus]]
id = "a"
texture = "cork"

[[stimulus]]
id = "b"
texture = "felt"

[[stimulus]]
id = "c"
texture = "brick"

[[stimulus]]
id = "d"
texture = "glass"

[[stimulus]]
id = "e"
texture = "denim"

[[stimulus]]
id = "a-low"
texture = "cork"
variant = "coded"
kbps = 1.75

"#;

/// Distance in mm that the tip must move over each stimulus.
pub(crate) const TOUCH_MM: f64 = 2.0;

/// Names of the textures, which participants must not see.
pub(crate) const HIDDEN: [&str; 5] = ["cork", "felt", "brick", "glass", "denim"];

pub(crate) const SORTING: &str = r#"[[part]]
id = "sort"
title = "Sort the textures"
instructions = "Stroke the textures."
design = "sorting"
stimuli = ["a", "b", "c", "d", "e"]
groups = [3]
"#;

pub(crate) const RELEVANCE: &str = r#"[[part]]
id = "relevance"
design = "relevance"
stimuli = ["a", "b"]
adjectives = ["rough", "smooth", "soft"]
"#;

pub(crate) const RATING: &str = r#"[[part]]
id = "rating"
title = "Rate the texture"
design = "rating"
stimuli = ["a", "b"]
scales = ["rough-smooth", "hard-soft"]
slider_mm = 127
practice = 1
"#;

pub(crate) const DISSIMILARITY: &str = r#"[[part]]
id = "difference"
design = "dissimilarity"
pairs = [["a", "b"]]
reference = ["c", "d"]
break_every = 2
"#;

pub(crate) const SAME_DIFFERENT: &str = r#"[[part]]
id = "same"
design = "same-different"
pairs = [["a", "a-low"]]
stimulus_s = 0.1
gap_s = 0.05
pause_s = 0.05
"#;

pub(crate) const STAIRCASE: &str = r#"[[part]]
id = "gaps"
title = "Where are the gaps?"
design = "staircase"
varied = "gap"
start = 2.0
lowest = 0.05
highest = 6.0
down = 2
factors = [4, 2]
reversals = 4
averaged = 2
max_trials = 20
feedback_reversals = 0
lead_s = 0.02
stimulus_s = 0.1
practice = 1
max_plays = 1
"#;

pub(crate) const SIMILARITY: &str = r#"[[part]]
id = "similarity"
design = "similarity"
pairs = [["a", "b"]]
points = 5
low = "very similar"
high = "very different"
repeats = 2
"#;

pub(crate) const LIKERT: &str = r#"[[part]]
id = "questions"
design = "likert"
conditions = [
    { id = "txt-t", shown = "nothing" },
    { id = "txt-ti", shown = "picture" },
    { id = "txt-tis", shown = "picture-and-sliders" },
]
statements = [
    { id = "realism", text = "The texture feels real." },
    { id = "match", text = "The texture matches my words." },
]
own_prompts = 1
points = 7
low = "strongly disagree"
high = "strongly agree"
"#;

pub(crate) const ABX: &str = r#"[[part]]
id = "abx"
design = "abx"
pairs = [["a", "b"]]
repeats = 2
max_plays = 5
"#;

pub(crate) const MUSHRA: &str = r#"[[part]]
id = "quality"
design = "mushra"
pages = [{ reference = "a", tested = ["b"], anchors = ["c"] }]
"#;

pub(crate) const ANCHORS: &str = r#"[[part]]
id = "place"
design = "anchors"
stimuli = ["a"]
low_anchor = "b"
high_anchor = "c"
"#;

/// Plans whose first trials look different.
pub(crate) const RUN: [(&str, &str); 9] = [
    ("adjectives", RELEVANCE),
    ("rating", RATING),
    ("difference", DISSIMILARITY),
    ("succession", SAME_DIFFERENT),
    ("similarity", SIMILARITY),
    ("text", LIKERT),
    ("third", ABX),
    ("page", MUSHRA),
    ("anchors", ANCHORS),
];

/// Text of a plan with these parts. A short movement over each stimulus suffices, because it takes real time.
pub(crate) fn plan_text(parts: &str) -> String {
    if parts.contains("require_touch") {
        return format!("{HEAD}{parts}");
    }
    let parts = parts.replace("design = \"", &format!("touch_mm = {TOUCH_MM}\ndesign = \""));
    format!("{HEAD}{parts}")
}
