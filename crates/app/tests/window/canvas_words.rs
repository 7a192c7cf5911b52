//! Names of textures and words of the axes on the canvas: no line strikes them through, and no texture covers them.

use egui::accesskit::Role;
use egui::{Pos2, Rect, Shape};
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings;

use crate::frame::{painted, rows};
use crate::support::{Author, author, wait_for_field, window};

/// Largest area of a backing, relative to that of the letters on it.
const LARGEST_BACKING: f32 = 6.0;

/// Whether a line crosses the letters, or a picture lies on them.
fn covers(shape: &Shape, letters: Rect) -> bool {
    let lines: Vec<[Pos2; 2]> = match shape {
        Shape::LineSegment { points, .. } => vec![*points],
        Shape::Path(path) => path.points.windows(2).map(|ends| [ends[0], ends[1]]).collect(),
        Shape::Rect(rect) if rect.brush.is_some() => return rect.rect.intersects(letters),
        _ => Vec::new(),
    };
    let is_on = |[from, to]: &[Pos2; 2], share: f32| letters.contains(from.lerp(*to, share));
    lines.iter().any(|line| (0..=200_u8).any(|step| is_on(line, f32::from(step) / 200.0)))
}

/// Whether a shape is a backing of the letters.
fn is_backing(shape: &Shape, letters: Rect) -> bool {
    let Shape::Rect(rect) = shape else { return false };
    let is_opaque = rect.brush.is_none() && rect.fill.a() > 200;
    is_opaque && rect.rect.contains(letters.center()) && rect.rect.area() < LARGEST_BACKING * letters.area()
}

/// Words on the canvas, and those without a backing or below a line or picture.
fn words_and_faults(harness: &Author) -> (Vec<String>, Vec<String>) {
    let session = window(harness).session();
    let mut known: Vec<&str> = session.textures().iter().map(|texture| texture.name.as_str()).collect();
    known.extend(session.poles().iter().flatten().map(String::as_str));
    let canvas = harness.get_by_role_and_label(Role::Canvas, strings::CANVAS).rect();
    let shapes = painted(harness);
    let (mut words, mut faults) = (Vec::new(), Vec::new());
    for (order, shape) in shapes.iter().enumerate() {
        let Shape::Text(text) = shape.shape else { continue };
        if !canvas.contains(text.pos) || !known.contains(&text.galley.text()) {
            continue;
        }
        words.push(text.galley.text().to_owned());
        for letters in rows(text) {
            let backing = shapes[..order].iter().rposition(|below| is_backing(below.shape, letters));
            let is_covered = |from: usize| shapes[from..].iter().any(|above| covers(above.shape, letters));
            if backing.is_none_or(is_covered) {
                faults.push(text.galley.text().to_owned());
            }
        }
    }
    (words, faults)
}

#[test]
fn every_word_lies_above_the_lines() {
    let mut harness = author();
    wait_for_field(&mut harness);
    harness.run_steps(3);
    let (words, faults) = words_and_faults(&harness);
    assert!(words.len() > 15, "{words:?}");
    assert_eq!(faults, Vec::<String>::new());
}
