//! How several lines of a figure that are compared are drawn.

use super::{Mark, Tone};

/// Tones of compared lines, in order.
const TONES: [Tone; 8] = [
    Tone::Main,
    Tone::Second,
    Tone::Third,
    Tone::Fourth,
    Tone::Fifth,
    Tone::Sixth,
    Tone::Seventh,
    Tone::Eighth,
];
/// Number of lines after which the style changes: more colors than these cannot be told apart with every color vision.
const N_OF_STYLE: usize = 4;

/// Returns the mark and the tone of a line, by its index from zero among lines that are compared. The first sixteen differ.
pub fn compared_line(index: usize) -> (Mark, Tone) {
    // In the second round, each tone has the style that it did not have in the first one.
    let is_dashed = (index / N_OF_STYLE + index / TONES.len()) % 2 == 1;
    let mark = if is_dashed { Mark::DashedLine } else { Mark::Line };
    (mark, TONES[index % TONES.len()])
}

#[cfg(test)]
mod tests {
    use super::{Mark, Tone, compared_line};

    #[test]
    fn sixteen_lines_differ_and_neighbors_of_one_style_are_four() {
        let all: Vec<(Mark, Tone)> = (0..16).map(compared_line).collect();
        for (index, look) in all.iter().enumerate() {
            assert!(!all[..index].contains(look), "{index}");
        }
        assert!(all[..4].iter().all(|(mark, _)| *mark == Mark::Line));
        assert!(all[4..8].iter().all(|(mark, _)| *mark == Mark::DashedLine));
        assert_eq!((compared_line(0), compared_line(16)), ((Mark::Line, Tone::Main), compared_line(0)));
    }
}
