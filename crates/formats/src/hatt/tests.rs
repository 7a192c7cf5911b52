//! These tests generate synthetic files in several spellings; they contain nothing from published files.

mod written;

use std::fmt::Write as _;

use proptest::prelude::{prop_assert, proptest};
use shagreen_core::dsp::lsf::ar_from_lsf;
use shagreen_core::maths::rng::Random;
use shagreen_core::texture::PublishedNode;
use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

use super::{HattError, HattTexture, read_hatt};
use crate::imported::Imported;

/// How a file spells lists of numbers.
#[derive(Clone, Copy, Debug)]
enum Spelling {
    Spaces,
    Lines,
    Commas,
    Values,
    Attributes,
    Repeated,
}

const SPELLINGS: [Spelling; 6] = [
    Spelling::Spaces,
    Spelling::Lines,
    Spelling::Commas,
    Spelling::Values,
    Spelling::Attributes,
    Spelling::Repeated,
];

impl Spelling {
    fn list(self, element: &str, numbers: &[String]) -> String {
        let joined = |between: &str| format!("<{element}>{}</{element}>\n", numbers.join(between));
        let each = |open: &str, close: &str| -> String {
            numbers.iter().flat_map(|number| [open, number, close, "\n"]).collect()
        };
        match self {
            Self::Spaces => joined(" "),
            Self::Lines => joined("\n  "),
            Self::Commas => joined(", "),
            Self::Values => format!("<{element}>\n{}</{element}>\n", each("<value>", "</value>")),
            Self::Attributes => format!("<{element}>{}</{element}>\n", each("<v value=\"", "\"/>")),
            Self::Repeated => each(&format!("<{element}>"), &format!("</{element}>")),
        }
    }
}

/// Random line spectral frequencies of a filter, kept apart from each other; `seed` selects them.
fn lsf(order: usize, seed: u64) -> Vec<f64> {
    let mut random = Random::new(seed);
    let step = std::f64::consts::PI / (order + 1) as f64;
    (1..=order).map(|k| (1e6 * step * (k as f64 + 0.7 * (random.uniform() - 0.5))).round() / 1e6).collect()
}

/// The nodes of a synthetic texture: a complete boundary and three models inside.
fn nodes(order: usize, ma_order: usize) -> Vec<PublishedNode> {
    let places = [
        (0.0, 0.0, 0.0),
        (200.0, 0.0, 0.0),
        (0.0, 3.0, 0.0),
        (200.0, 3.0, 0.05),
        (60.0, 1.0, 0.002),
        (120.0, 2.0, 0.01),
        (150.0, 0.5, 0.02),
    ];
    let node = |(index, (speed, force, variance)): (usize, (f64, f64, f64))| PublishedNode {
        speed: MetersPerSecond::from_mm_per_s(speed),
        force: Newtons(force),
        ar_lsf: lsf(order, index as u64),
        ma_lsf: lsf(ma_order, 100 + index as u64),
        variance,
        gain: 2.0 + index as f64,
    };
    places.into_iter().enumerate().map(node).collect()
}

/// Writes a file of these nodes in the format's layout.
fn file(nodes: &[PublishedNode], spelling: Spelling) -> String {
    let strings = |values: &[f64]| values.iter().map(f64::to_string).collect::<Vec<_>>();
    let speeds: Vec<f64> = nodes.iter().map(|n| n.speed.mm_per_s()).collect();
    let forces: Vec<f64> = nodes.iter().map(|n| n.force.0).collect();
    let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
    let mut text = format!(
        "<?xml version=\"1.0\"?>\n<modelSet texture=\"42\">\n<material>Made Up</material>\n\
         <AccelUnits>m/s^2</AccelUnits><SpeedUnits>mm/s</SpeedUnits><ForceUnits>N</ForceUnits>\n\
         <SampleRate>1000</SampleRate><mu>0.25</mu><htmlPicture>a.bmp</htmlPicture>\n\
         <numMod>{}</numMod><maxSpeed>{}</maxSpeed><maxForce>{}</maxForce>\n\
         <numARCoeff>{}</numARCoeff><numMACoeff>{}</numMACoeff>\n",
        nodes.len(),
        highest(&speeds),
        highest(&forces),
        nodes[0].ar_lsf.len(),
        nodes[0].ma_lsf.len(),
    );
    text += &spelling.list("speedList", &strings(&speeds));
    text += &spelling.list("forceList", &strings(&forces));
    for (index, node) in nodes.iter().enumerate() {
        let with_one = |lsf: &[f64]| strings(&[vec![1.0], ar_from_lsf(lsf)].concat());
        text += "<model>\n";
        writeln!(text, "<modNum>{}</modNum>", index + 1).unwrap();
        text += &spelling.list("ARcoeff", &with_one(&node.ar_lsf));
        text += &spelling.list("ARlsf", &strings(&node.ar_lsf));
        if !node.ma_lsf.is_empty() {
            text += &spelling.list("MAcoeff", &with_one(&node.ma_lsf));
            text += &spelling.list("MAlsf", &strings(&node.ma_lsf));
        }
        writeln!(text, "<var>{}</var><gain value=\"{}\"/>", node.variance, node.gain).unwrap();
        writeln!(text, "<speedMod>{}</speedMod>", node.speed.mm_per_s()).unwrap();
        writeln!(text, "<forceMod>{}</forceMod>\n</model>", node.force.0).unwrap();
    }
    text + "</modelSet>\n"
}

fn read(text: &str) -> Imported<HattTexture> {
    read_hatt(text.as_bytes()).unwrap()
}

#[test]
fn every_spelling_gives_the_same_texture() {
    for (order, ma_order) in [(20, 18), (14, 12), (19, 17), (6, 0), (5, 2), (1, 0)] {
        let nodes = nodes(order, ma_order);
        for spelling in SPELLINGS {
            let imported = read(&file(&nodes, spelling));
            assert_eq!(imported.warnings, [""; 0], "{spelling:?}");
            let texture = imported.value;
            assert_eq!((texture.name.as_str(), texture.index), ("Made Up", Some(42)));
            assert_eq!(texture.model.friction(), Some(0.25));
            assert_eq!(texture.model.rate(), Hertz(1000.0));
            assert_eq!(texture.model.published_nodes(), nodes, "{spelling:?}");
        }
    }
}

#[test]
fn coefficients_stand_in_for_missing_frequencies() {
    let nodes = nodes(8, 6);
    let mut text = file(&nodes, Spelling::Spaces);
    for name in ["ARlsf", "MAlsf"] {
        text = text.lines().filter(|line| !line.contains(name)).collect::<Vec<_>>().join("\n");
    }
    let texture = read(&text).value;
    for (read, made) in texture.model.published_nodes().iter().zip(&nodes) {
        let pairs = read.ar_lsf.iter().zip(&made.ar_lsf).chain(read.ma_lsf.iter().zip(&made.ma_lsf));
        // The coefficients have all digits, so the roots are exact up to rounding.
        assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-9));
    }
    let unstable = text.replacen("<ARcoeff>1", "<ARcoeff>1 9", 1);
    assert!(matches!(read_hatt(unstable.as_bytes()), Err(HattError::Unstable { order: 9, .. })));
}

/// Reads the usual file after a change; one warning must contain `expected`.
#[track_caller]
fn check_warning(change: impl Fn(String) -> String, expected: &str) {
    let imported = read(&change(file(&nodes(6, 4), Spelling::Spaces)));
    assert!(imported.warnings.iter().any(|w| w.contains(expected)), "{expected:?}: {:?}", imported.warnings);
}

/// A file that gives speeds in m/s but states mm/s.
fn in_meters_per_second(_: String) -> String {
    let mut slow = nodes(6, 4);
    for node in &mut slow {
        node.speed.0 *= 1e-3;
    }
    file(&slow, Spelling::Spaces)
}

#[test]
fn what_is_odd_is_said_and_used() {
    let replace = |from: &'static str, to: &'static str| move |text: String| text.replacen(from, to, 1);
    check_warning(replace("<AccelUnits>m/s^2</AccelUnits>", ""), "AccelUnits is missing");
    check_warning(replace("<mu>0.25</mu>", ""), "mu is missing");
    check_warning(replace("<numMod>7", "<numMod>9"), "numMod states 9, but the file holds 7");
    check_warning(replace("<numARCoeff>6", "<numARCoeff>7"), "numARCoeff states 7");
    check_warning(replace("<numMACoeff>4", "<numMACoeff>6"), "numMACoeff states 6");
    check_warning(
        replace("<speedList>0 200", "<speedList>0 190"),
        "speedList differs from 1 models by up to 10.000",
    );
    check_warning(replace("<forceList>0 ", "<forceList>"), "forceList states 6, but the file holds 7");
    check_warning(replace("<modNum>2", "<modNum>3"), "same modNum");
    check_warning(replace("<ARcoeff>1 ", "<ARcoeff>1 0.5 "), "coefficients of 1 filters differ");
    check_warning(replace("<maxSpeed>200", "<maxSpeed>150"), "maxSpeed states 150");
    check_warning(replace("<maxSpeed>200", "<maxSpeed>240"), "boundary models are added");
    check_warning(replace("<material>Made Up</material>", ""), "no material name");
    check_warning(in_meters_per_second, "the highest speed is 0.200 mm/s");
    check_warning(replace("<mu>", "<tri>1 2 9</tri><mu>"), "1 triangles refer to missing models");
    check_warning(replace("<mu>", "<tri>1 2 3</tri><mu>"), "cover 50.0 %");
    check_warning(replace("<mu>", "<tri>1 2 3</tri><tri>2 3 4</tri><tri>2</tri><mu>"), "fewer than three");
    let whole = replace("<mu>", "<numTri>2</numTri><tri>1 2 3</tri><tri>2 3 4</tri><mu>");
    assert_eq!(read(&whole(file(&nodes(6, 4), Spelling::Spaces))).warnings, [""; 0]);
}

#[test]
fn latin_letters_are_names() {
    let text = file(&nodes(2, 0), Spelling::Spaces).replacen("Made Up", "Gr@n", 1);
    let bytes: Vec<u8> = text.bytes().map(|byte| if byte == b'@' { 0xFC } else { byte }).collect();
    let imported = read_hatt(&bytes).unwrap();
    assert_eq!(imported.value.name, "Grün");
    assert!(imported.warnings[0].contains("Latin-1"));
}

#[track_caller]
fn check_error(from: &str, to: &str, expected: &str) {
    let text = file(&nodes(6, 4), Spelling::Spaces);
    let changed = text.replacen(from, to, 1);
    assert_ne!(changed, text, "{from:?} is not in the file");
    let message = read_hatt(changed.as_bytes()).unwrap_err().to_string();
    assert!(message.contains(expected), "{expected:?} is not in {message:?}");
}

#[test]
fn what_cannot_be_used_is_refused_with_the_place() {
    check_error("<SpeedUnits>mm/s", "<SpeedUnits>m/s", "SpeedUnits is m/s, but this program reads mm/s");
    check_error("<AccelUnits>m/s^2", "<AccelUnits>g", "AccelUnits is g");
    check_error("<SampleRate>1000</SampleRate>", "", "SampleRate is missing");
    check_error("<SampleRate>1000", "<SampleRate>1 2", "SampleRate in line 5 has 2 numbers");
    check_error("<SampleRate>1000", "<SampleRate>nan", "\"nan\" in SampleRate in line 5");
    check_error("<SampleRate>1000", "<SampleRate>1e999", "not a finite number");
    check_error("<SampleRate>1000", "<SampleRate>44100", "44100");
    check_error("<SampleRate>1000", "<SampleRate>0", "200 and 4000 Hz, got 0; correct SampleRate");
    check_error(
        "<mu>0.25",
        "<mu>-5",
        "friction coefficient is -5; it must be finite and not negative; correct mu",
    );
    check_error("<var>0</var>", "<var>-1</var>", "variance");
    check_error("<var>0</var>", "", "var is missing");
    check_error("<gain value=\"2\"/>", "", "gain is missing");
    check_error("<ARlsf>", "<ARlsf>4 ", "node 0");
    check_error("<modelSet", "<!DOCTYPE a [<!ENTITY b \"c\">]><modelSet", "document type");
    check_error("</modelSet>", "", "XML");
    check_error("<?xml version=\"1.0\"?>\n<modelSet texture=\"42\">", "<other>", "XML");
    let message = read_hatt(b"<html/>").unwrap_err().to_string();
    assert!(message.contains("root element is \"html\", not \"modelSet\""), "{message}");
    let message = read_hatt(b"<modelSet><SampleRate>1</SampleRate></modelSet>").unwrap_err().to_string();
    assert!(message.contains("model is missing"), "{message}");
    assert!(read_hatt(b"\xFF\xFE<").unwrap_err().to_string().contains("UTF-16"));
}

#[test]
fn files_without_a_boundary_get_one() {
    let inside = &nodes(6, 4)[4..];
    let imported = read(&file(inside, Spelling::Values));
    assert!(imported.warnings[0].contains("boundary models are added"), "{:?}", imported.warnings);
    let all = imported.value.model.published_nodes();
    assert_eq!(&all[..3], inside);
    let at = |v: f64, f: f64| {
        let is_there =
            |n: &&PublishedNode| (n.speed.mm_per_s() - v).abs() < 1e-9 && (n.force.0 - f).abs() < 1e-9;
        all.iter().find(is_there)
    };
    // Silent models on the axes, and a copy of the nearest model, (150, 0.5), in the far corner.
    for (v, f) in [(0.0, 0.0), (40.0, 0.0), (120.0, 0.0), (150.0, 0.0), (0.0, 0.5), (0.0, 1.75), (0.0, 2.0)] {
        assert_eq!(at(v, f).unwrap().variance, 0.0, "{v} mm/s, {f} N");
    }
    let corner = at(150.0, 2.0).unwrap();
    assert_eq!((corner.variance, &corner.ar_lsf), (inside[2].variance, &inside[2].ar_lsf));
}

proptest! {
    #[test]
    fn cut_files_are_errors(cut in 1_usize..4000) {
        let text = file(&nodes(6, 4), Spelling::Values);
        prop_assert!(read_hatt(&text.as_bytes()[..text.len() - 1 - cut.min(text.len() - 2)]).is_err());
    }
}
