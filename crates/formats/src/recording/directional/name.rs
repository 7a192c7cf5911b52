//! What the name of a file states about a stroke.

use std::path::Path;

use shagreen_core::texture::{FORCES_N, SPEEDS_MPS};
use shagreen_core::units::{MetersPerSecond, Newtons};

/// Quantity in a file of a stroke.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Quantity {
    /// Acceleration of the tip.
    Acceleration,
    /// Normal force.
    Force,
    /// Position of the tip on the surface.
    Position,
}

/// Stroke as the name of its files states it: `{texture}_{direction}_{speed in mm/s}_{force in mN}_{repeat}`.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokeName {
    /// Texture; may contain underscores.
    pub texture: String,
    /// Direction of the stroke as it is written: an angle in degrees, a word or a number.
    pub direction: String,
    /// Tip speed.
    pub speed: MetersPerSecond,
    /// Normal force.
    pub force: Newtons,
    /// Number of the repeat.
    pub repeat: u32,
}

impl Quantity {
    /// Name in messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Acceleration => "acceleration",
            Self::Force => "force",
            Self::Position => "position",
        }
    }

    fn of_word(word: &str) -> Option<Self> {
        match word.to_ascii_lowercase().as_str() {
            "acc" | "accel" | "acceleration" | "accelerations" | "accelerometer" => Some(Self::Acceleration),
            "force" | "forces" | "load" => Some(Self::Force),
            "pos" | "position" | "positions" => Some(Self::Position),
            _ => None,
        }
    }

    /// Quantity that a folder name contains as a word.
    fn of_folder(name: &str) -> Option<Self> {
        name.split(|c: char| !c.is_alphanumeric()).find_map(Self::of_word)
    }
}

impl StrokeName {
    /// Parses the name without quantity and ending. Speed and force may end in their units, as in `20mms` and `200mN`.
    fn parse(stem: &str) -> Option<Self> {
        const SPEED_UNITS: [(&str, f64); 4] = [("", 1e-3), ("mm", 1e-3), ("mms", 1e-3), ("mmps", 1e-3)];
        const FORCE_UNITS: [(&str, f64); 3] = [("", 1e-3), ("mn", 1e-3), ("n", 1.0)];
        let mut words = stem.rsplitn(5, '_');
        let (repeat, force, speed) = (words.next()?, words.next()?, words.next()?);
        let (direction, texture) = (words.next()?, words.next()?);
        let speed_mps = number(speed, &SPEED_UNITS).filter(|value| SPEEDS_MPS.contains(value))?;
        let force_n = number(force, &FORCE_UNITS).filter(|value| FORCES_N.contains(value))?;
        let repeat = repeat.trim_start_matches(|c: char| c.is_ascii_alphabetic()).parse().ok()?;
        (!direction.is_empty() && !texture.is_empty()).then(|| Self {
            texture: texture.to_owned(),
            direction: direction.to_owned(),
            speed: MetersPerSecond(speed_mps),
            force: Newtons(force_n),
            repeat,
        })
    }
}

/// Stroke and quantity of a file, from its name and the folders that contain it, the innermost first. `path` begins with
/// the name of the outermost folder. `None` if the name is not that of a stroke or the quantity is not stated.
pub(super) fn stroke_of(path: &Path) -> Option<(StrokeName, Quantity)> {
    let stem = path.file_stem()?.to_str()?;
    let (stem, stated) = without_quantity(stem);
    let by_folder = || {
        path.ancestors()
            .skip(1)
            .filter_map(|folder| folder.file_name()?.to_str())
            .find_map(Quantity::of_folder)
    };
    Some((StrokeName::parse(stem)?, stated.or_else(by_folder)?))
}

/// Separates a quantity from the end or the beginning of a name.
fn without_quantity(stem: &str) -> (&str, Option<Quantity>) {
    let marks = ['_', '-', '.', ' '];
    if let Some((rest, word)) = stem.rsplit_once(marks)
        && let Some(quantity) = Quantity::of_word(word)
    {
        return (rest, Some(quantity));
    }
    if let Some((word, rest)) = stem.split_once(marks)
        && let Some(quantity) = Quantity::of_word(word)
    {
        return (rest, Some(quantity));
    }
    (stem, None)
}

/// Value of a number with one of these units, in the SI unit.
fn number(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let text = text.to_ascii_lowercase();
    let end = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (digits, unit) = text.split_at(end);
    let (_, si) = units.iter().find(|(name, _)| *name == unit)?;
    digits.parse::<f64>().ok().map(|value| value * si)
}

#[cfg(test)]
mod tests {
    use super::{Quantity, StrokeName, stroke_of};
    use std::path::Path;

    fn of(path: &str) -> Option<(StrokeName, Quantity)> {
        stroke_of(Path::new(path))
    }

    #[test]
    fn a_name_states_its_stroke_and_the_folder_or_a_word_its_quantity() {
        for (path, quantity) in [
            ("data/acceleration/cork_tile_45_20_200_3.csv", Quantity::Acceleration),
            ("data/Force data/cork_tile_45_20_200_3.csv", Quantity::Force),
            ("position/cork/cork_tile_45_20_200_3.csv", Quantity::Position),
            ("data/cork_tile_45_20_200_3_acc.csv", Quantity::Acceleration),
            ("data/force-cork_tile_45_20mms_200mN_r3.txt", Quantity::Force),
            // The name of the file is nearer than its folder.
            ("force/cork_tile_45_20_0.2N_03.pos.csv", Quantity::Position),
            ("force/acc/cork_tile_45_20_200_3.csv", Quantity::Acceleration),
        ] {
            let (name, found) = of(path).unwrap();
            assert_eq!(
                (found, name.texture.as_str(), name.direction.as_str()),
                (quantity, "cork_tile", "45")
            );
            assert!((name.speed.0 - 0.02).abs() < 1e-12 && (name.force.0 - 0.2).abs() < 1e-12, "{path}");
            assert_eq!(name.repeat, 3);
        }
    }

    #[test]
    fn other_names_are_not_strokes() {
        for path in [
            "acc/cork_45_20_200.csv",
            "acc/_45_20_200_1.csv",
            "acc/cork_45_-20_200_1.csv",
            "acc/cork_45_0_200_1.csv",
            "acc/cork_45_20_200_one.csv",
            "acc/cork_45_20_inf_1.csv",
            "acc/cork_45_20V_200_1.csv",
            "data/cork_45_20_200_1.csv",
            "acc/notes.csv",
            "",
        ] {
            assert_eq!(of(path), None, "{path}");
        }
    }
}
