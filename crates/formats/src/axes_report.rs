//! Report of an evaluation of axes: a JSON object for scripts, and its sentences for people.

use serde_json::{Value, json};
use shagreen_core::space::MOST_AXES;
use shagreen_core::space::axis_evaluation::{AxisEvaluation, AxisStep};
use shagreen_core::space::signal_axes::SignalAxis;

use crate::evaluation_report::{MEASURED, position_caveat};
use crate::library::{Library, TextureEntry};

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-axes-report";
/// Limit of a result with axes that are computed from the vibration.
const SIGNAL_AXES_NOTE: &str = "An axis that is computed from the vibration contains a part of the answer: its error says how well a texture can be authored with this axis, not how well ratings predict it.";
/// Result if no axis lowers the error by more than chance explains.
pub const NOTHING_HELPS: &str = "No further axis lowers the error by more than chance: what it states says nothing about the vibration that the first axes do not say already.";
/// Results if no further axis was evaluated: there is none besides the first ones, too few textures have the others, or the space
/// has the largest number of axes already.
const NONE_GIVEN: &str = "No further axis was evaluated: none is given besides the first axes.";
const NONE_KNOWN: &str = "No further axis was evaluated: too few textures have a value on the others.";
const NO_ROOM: &str = "No further axis was evaluated: a space has at most six axes.";

/// Version of the report.
const VERSION: &str = "1.0";

/// Returns the limit of a result if one of its axes is computed from the vibration: it has the name of a feature of the
/// vibration, and no attribute of a texture has this name. `axes` are the names of the axes. The textures of `library` have
/// their own positions, or positions on these axes.
pub fn signal_axes_note<'a, I: IntoIterator<Item = &'a str>>(
    library: &Library,
    axes: I,
) -> Option<&'static str> {
    let has = |texture: &TextureEntry, name: &str| {
        texture.attributes.as_ref().is_some_and(|attributes| attributes.get(name).is_some())
    };
    let is_attribute = |name: &str| library.textures.iter().any(|texture| has(texture, name));
    let mut axes = axes.into_iter();
    axes.any(|name| SignalAxis::from_name(name).is_some() && !is_attribute(name)).then_some(SIGNAL_AXES_NOTE)
}

/// Returns whether an axis beyond the first ones lowers the error by more than chance explains.
pub fn helps(found: &AxisEvaluation) -> bool {
    found.steps.iter().any(|step| step.helps() == Some(true))
}

/// Returns what to conclude if no axis beyond the first ones helps, or if none was evaluated; `None` if one helps.
pub fn nothing_helps(found: &AxisEvaluation) -> Option<&'static str> {
    if found.steps.iter().any(|step| step.gain_db.is_some()) {
        return (!helps(found)).then_some(NOTHING_HELPS);
    }
    let has_room = found.steps.iter().all(|step| step.n_axes < MOST_AXES);
    Some(match (has_room, found.left_out.is_empty()) {
        (false, _) => NO_ROOM,
        (true, false) => NONE_KNOWN,
        (true, true) => NONE_GIVEN,
    })
}

/// Returns the complete report as one JSON object. `library` is the evaluated library, and `names` are those of the candidates, to
/// which the indices of the evaluation refer.
pub fn axes_report(library: &Library, names: &[String], found: &AxisEvaluation) -> Value {
    let id = |texture: &usize| library.textures[*texture].id.as_str();
    let left_out: Vec<&String> = found.left_out.iter().map(|axis| &names[*axis]).collect();
    let of_axes = signal_axes_note(library, names.iter().map(String::as_str));
    let notes = [of_axes, position_caveat(library), nothing_helps(found)];
    json!({
        "format": FORMAT,
        "version": VERSION,
        "measured": MEASURED,
        "library": library.name,
        "validation": "nested: axes are chosen without the tenth of the textures that is predicted",
        "n": found.textures.len(),
        "textures": found.textures.iter().map(id).collect::<Vec<_>>(),
        "left_out": left_out,
        "steps": found.steps.iter().map(|of| step(names, of)).collect::<Vec<_>>(),
        "notes": notes.into_iter().flatten().collect::<Vec<_>>(),
    })
}

fn step(names: &[String], step: &AxisStep) -> Value {
    json!({
        "n_axes": step.n_axes,
        "axis": names[step.added],
        "agreement": step.agreement,
        "error_db": step.error_db_mean,
        "rank1": step.rank1,
        "nearest_db": step.nearest_db_mean,
        "nearest_rank1": step.nearest_rank1,
        "gain_db": step.gain_db.map(|[gain, _]| gain),
        "gain_standard_error_db": step.gain_db.map(|[_, error]| error),
        "helps": step.helps(),
    })
}

#[cfg(test)]
mod tests {
    use super::{
        MOST_AXES, NO_ROOM, NONE_GIVEN, NONE_KNOWN, NOTHING_HELPS, SIGNAL_AXES_NOTE, axes_report, helps,
        nothing_helps, signal_axes_note,
    };
    use crate::library::{Attribute, Attributes};
    use crate::starter::{simulated_library, starter_library};
    use serde_json::json;
    use shagreen_core::space::LabelSource;
    use shagreen_core::space::axis_evaluation::{AxisEvaluation, AxisStep};

    fn evaluation(gain_db: f64) -> AxisEvaluation {
        let step = |n_axes: usize, gain_db| AxisStep {
            n_axes,
            added: n_axes,
            agreement: 0.75,
            error_db_mean: 2.5,
            rank1: 0.5,
            nearest_db_mean: 3.0,
            nearest_rank1: 0.25,
            gain_db,
        };
        let steps = vec![step(1, None), step(2, Some([gain_db, 0.25]))];
        AxisEvaluation { textures: vec![0, 2], left_out: vec![0], steps }
    }

    #[test]
    fn a_report_names_axes_and_textures() {
        let library = simulated_library().unwrap();
        let names = ["warm-cold", "hard-soft", "centroid"].map(str::to_owned);
        let report = axes_report(&library, &names, &evaluation(1.0));
        assert_eq!((&report["n"], &report["left_out"]), (&json!(2), &json!(["warm-cold"])));
        assert_eq!(report["textures"], json!([library.textures[0].id, library.textures[2].id]));
        let expected = json!({
            "n_axes": 2, "axis": "centroid", "agreement": 0.75, "error_db": 2.5, "rank1": 0.5, "nearest_db": 3.0,
            "nearest_rank1": 0.25, "gain_db": 1.0, "gain_standard_error_db": 0.25, "helps": true,
        });
        assert_eq!(report["steps"][1], expected);
        assert_eq!(
            (&report["steps"][0]["axis"], &report["steps"][0]["gain_db"]),
            (&json!("hard-soft"), &json!(null))
        );
        assert_eq!(report["notes"], json!([SIGNAL_AXES_NOTE]));
    }

    #[test]
    fn only_axes_that_are_computed_from_the_vibration_have_a_note() {
        let mut library = simulated_library().unwrap();
        let rated = ["rough-smooth", "hard-soft", "sticky-slippery"].map(str::to_owned);
        assert_eq!(axes_report(&library, &rated, &evaluation(1.0))["notes"], json!([]));
        assert_eq!(signal_axes_note(&library, ["hard-soft", "tap frequency"]), Some(SIGNAL_AXES_NOTE));
        assert_eq!(signal_axes_note(&library, ["attribute:centroid"]), None);
        // People rated an attribute of this name.
        let values = vec![Attribute { name: "centroid".to_owned(), value: 20.0 }];
        library.textures[3].attributes = Some(Attributes { source: LabelSource::HumanRatings, values });
        assert_eq!(signal_axes_note(&library, ["hard-soft", "centroid"]), None);
    }

    #[test]
    fn a_report_says_where_nothing_helps_and_where_positions_contain_the_answer() {
        assert!(helps(&evaluation(0.6)) && !helps(&evaluation(0.5)));
        let library = starter_library().unwrap();
        let names = ["warm-cold", "hard-soft", "centroid"].map(str::to_owned);
        let report = axes_report(&library, &names, &evaluation(0.5));
        let notes = report["notes"].as_array().unwrap();
        assert!(notes.len() == 3 && notes[1].as_str().unwrap().contains("Physical labels"), "{notes:?}");
        assert_eq!(notes[2], NOTHING_HELPS);
    }

    /// An axis that was not evaluated does not fail to help.
    #[test]
    fn an_evaluation_without_further_axes_says_why() {
        assert_eq!(
            [nothing_helps(&evaluation(0.6)), nothing_helps(&evaluation(0.5))],
            [None, Some(NOTHING_HELPS)]
        );
        let mut first = evaluation(1.0);
        first.steps.truncate(1);
        assert_eq!(nothing_helps(&first), Some(NONE_KNOWN));
        first.left_out.clear();
        assert_eq!(nothing_helps(&first), Some(NONE_GIVEN));
        first.steps[0].n_axes = MOST_AXES;
        assert_eq!(nothing_helps(&first), Some(NO_ROOM));
    }
}
