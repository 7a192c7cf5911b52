//! Results of a leave-one-out evaluation: a JSON report for scripts and figures for people.

use serde_json::{Map, Value, json};
use shagreen_core::space::LabelSource;
use shagreen_core::space::fidelity::{FORCES_N, N_CHANNELS, SPEEDS_MM_PER_S, center};
use shagreen_core::space::leave_one_out::{LeaveOneOut, LeftOut, Method, Outcome, SignalCheck, Summary};
use shagreen_core::words::counted;

use crate::figure::{Chart, Figure, Mark, Point, Scale, Series, Table, Tone};
use crate::library::Library;

/// Value of the `format` field of a report.
pub const FORMAT: &str = "shagreen-evaluation-report";
/// Label beside every figure: the errors are measured on signals, not in listening or touch experiments.
pub const MEASURED: &str = "measured on signals";

/// Version of the report.
const VERSION: &str = "1.2";

/// Identifier of a method in files and figures.
pub fn method_id(method: &Method) -> &'static str {
    match method {
        Method::Nearest => "nearest",
        Method::Blended(blending) => blending.mode.id(),
    }
}

/// Describes the basis of the figures: signals, and the label sources of the positions.
pub fn evaluation_source(library: &Library) -> String {
    let sources: Vec<&str> = library.label_sources().into_iter().map(LabelSource::label).collect();
    format!("{MEASURED}, positions from {}", sources.join(" and "))
}

/// Limit of the result: whether positions of the library follow from the vibration of the textures, so that the position
/// of a left-out texture contains part of its answer. `None` if all positions come from ratings and sorts.
pub fn position_caveat(library: &Library) -> Option<&'static str> {
    let sources = library.label_sources();
    if sources.contains(&LabelSource::PhysicalLabels) {
        Some(
            "Physical labels are computed from the textures themselves (in the starter library, roughness from the vibration level), so the position of a left-out texture contains part of its answer. The shape error excludes the overall level.",
        )
    } else if sources.contains(&LabelSource::Estimated) {
        Some(
            "Estimated positions can be predicted from the vibration of the textures themselves, so the position of a left-out texture can contain part of its answer. The shape error excludes the overall level.",
        )
    } else {
        None
    }
}

/// Returns the complete report as one JSON object. `library` must be the evaluated library.
pub fn evaluation_report(library: &Library, measured: &LeaveOneOut) -> Value {
    let summaries = measured.methods.iter().map(|s| (method_id(&s.method).to_owned(), summary(s)));
    let mut modes: Map<String, Value> = summaries.collect();
    let nearest = modes.remove(method_id(&Method::Nearest));
    let id = |texture: &usize| library.textures[*texture].id.as_str();
    json!({
        "format": FORMAT,
        "version": VERSION,
        "measured": MEASURED,
        "position_caveat": position_caveat(library),
        "label_sources": library.label_sources().into_iter().map(LabelSource::id).collect::<Vec<_>>(),
        "n": measured.textures.len(),
        "modes": modes,
        "nearest": nearest,
        "best": best(measured).map(|summary| method_id(&summary.method)),
        "reach_db": measured.reach_db,
        "compared_at": {
            "speeds_mm_per_s": SPEEDS_MM_PER_S,
            "forces_n": FORCES_N,
            "channels_hz": (0..N_CHANNELS).map(|channel| center(channel).0).collect::<Vec<_>>(),
        },
        "textures": measured.textures.iter().map(|left| texture(library, measured, left)).collect::<Vec<_>>(),
        "on_hull": measured.on_hull.iter().map(id).collect::<Vec<_>>(),
    })
}

/// Returns the method with the lowest mean error.
pub fn best(measured: &LeaveOneOut) -> Option<&Summary> {
    measured.methods.iter().min_by(|a, b| a.error_db_mean.total_cmp(&b.error_db_mean))
}

fn summary(summary: &Summary) -> Value {
    json!({
        "n": summary.n,
        "error_db_mean": summary.error_db_mean,
        "error_db_median": summary.error_db_median,
        "level_error_db_mean": summary.level_error_db_mean,
        "shape_error_db_mean": summary.shape_error_db_mean,
        "rank1": summary.rank1,
        "top5": summary.top5,
        "nrs_mean": summary.nrs_mean,
        "signals": summary.signals.as_ref().map(signals),
    })
}

fn signals(check: &SignalCheck) -> Value {
    json!({
        "n": check.n,
        "seconds": check.seconds,
        "error_db_mean": check.error_db_mean,
        "model_error_db_mean": check.model_error_db_mean,
        "mean_difference_db": check.mean_difference_db,
        "largest_difference_db": check.largest_difference_db,
        "from_model_db": check.from_model_db,
        "chance_db": check.chance_db,
    })
}

fn texture(library: &Library, measured: &LeaveOneOut, left: &LeftOut) -> Value {
    let by_method = |value: &dyn Fn(&Outcome) -> Value| -> Map<String, Value> {
        let methods = measured.methods.iter().map(|summary| method_id(&summary.method).to_owned());
        methods.zip(left.outcomes.iter().map(value)).collect()
    };
    json!({
        "id": library.textures[left.texture].id,
        "at": left.at.coordinates(),
        "nearest": library.textures[left.nearest].id,
        "within_measured": left.is_within_measured,
        "error_db": by_method(&|outcome| json!(outcome.error_db)),
        "level_error_db": by_method(&|outcome| json!(outcome.level_error_db)),
        "shape_error_db": by_method(&|outcome| json!(outcome.shape_error_db)),
        "rank": by_method(&|outcome| json!(outcome.rank)),
        "nrs": by_method(&|outcome| json!(outcome.nrs)),
        "signal_error_db": by_method(&|outcome| json!(outcome.signal_error_db)),
    })
}

/// Short name of the figure of one method, used as a file name. [`TABLE`] names the table of all methods.
pub fn figure_name(method: &Method) -> String {
    format!("error-{}", method_id(method))
}

/// Name of the table that compares the methods.
pub const TABLE: &str = "methods";

/// Returns a table of the methods, and for each method a map of the space with the error at every evaluated position.
pub fn evaluation_figures(library: &Library, measured: &LeaveOneOut) -> Vec<(String, Figure)> {
    let mut figures = vec![(TABLE.to_owned(), methods(measured))];
    let maps = measured.methods.iter().enumerate();
    figures
        .extend(maps.map(|(index, summary)| (figure_name(&summary.method), map(library, measured, index))));
    let source = evaluation_source(library);
    for (_, figure) in &mut figures {
        figure.set_source(&source);
    }
    figures
}

fn methods(measured: &LeaveOneOut) -> Figure {
    let columns = [
        "error, mean, dB",
        "error, median, dB",
        "level error, dB",
        "shape error, dB",
        "original nearest, share",
        "original in five nearest, share",
        "NRS",
    ];
    let row = |summary: &Summary| {
        let values = [
            summary.error_db_mean,
            summary.error_db_median,
            summary.level_error_db_mean,
            summary.shape_error_db_mean,
            summary.rank1,
            summary.top5,
        ];
        let values = values.into_iter().map(Some).chain([summary.nrs_mean]).collect();
        (method_id(&summary.method).to_owned(), values)
    };
    Figure::Table(Table {
        title: format!("Leave-one-out errors of {}", counted(measured.textures.len(), "texture")),
        columns: columns.map(str::to_owned).to_vec(),
        rows: measured.methods.iter().map(row).collect(),
        decimals: 2,
        n_counts: 0,
        source: String::new(),
    })
}

/// The map of one method: the error at every evaluated position on the first two axes, colored by whether a copy of the nearest texture has a
/// larger error.
fn map(library: &Library, measured: &LeaveOneOut, method: usize) -> Figure {
    let summary = &measured.methods[method];
    let nearest = measured.methods.iter().position(|summary| summary.method == Method::Nearest);
    let is_better =
        |left: &LeftOut| nearest.is_none_or(|n| left.outcomes[method].error_db <= left.outcomes[n].error_db);
    let dots = |is_wanted: &dyn Fn(&LeftOut) -> bool| -> Vec<Point> {
        let wanted = measured.textures.iter().filter(|left| is_wanted(left));
        let point = |left: &LeftOut| {
            let label = format!("{:.1}", left.outcomes[method].error_db);
            Point::named(left.at.x(), left.at.y(), label)
        };
        wanted.map(point).collect()
    };
    let on_hull = measured.on_hull.iter().filter_map(|texture| library.textures[*texture].at());
    let series = |name: &str, tone: Tone, points: Vec<Point>| Series {
        name: name.to_owned(),
        mark: Mark::Dots,
        tone,
        points,
    };
    let mut all = vec![
        series(
            "on the convex hull, not evaluated",
            Tone::Faint,
            on_hull.map(|at| Point::new(at.x(), at.y())).collect(),
        ),
        series(
            "larger error than a copy of the nearest texture",
            Tone::Second,
            dots(&|left| !is_better(left)),
        ),
        series(
            if summary.method == Method::Nearest {
                "left-out texture"
            } else {
                "no larger error than a copy of the nearest texture"
            },
            Tone::Main,
            dots(&is_better),
        ),
    ];
    all.retain(|series| !series.points.is_empty());
    // A map shows the first two axes; a position on one axis lies in the middle of the other.
    let axes = library.axis_names();
    let label = |axis: usize| axes.get(axis).map_or_else(String::new, |name| format!("{name}, 0 to 100"));
    Figure::Chart(Chart {
        title: format!("Error of {} in dB, mean {:.2}", method_id(&summary.method), summary.error_db_mean),
        x_label: label(0),
        y_label: label(1),
        is_isotropic: true,
        x_scale: Scale::Linear,
        shown: None,
        series: all,
        source: String::new(),
    })
}

#[cfg(test)]
mod tests {
    use shagreen_core::space::leave_one_out::{LeaveOneOut, LeftOut, Method, Outcome, Summary};
    use shagreen_core::space::{LabelSource, SpacePoint};
    use shagreen_core::texture::blend::Mode;

    use super::{
        MEASURED, best, evaluation_figures, evaluation_report, figure_name, method_id, position_caveat,
    };
    use crate::figure::{figure_csv, figure_svg};
    use crate::starter::{simulated_library, starter_library};

    fn measured() -> LeaveOneOut {
        let summary = |method: Method, error_db: f64| Summary {
            method,
            n: 2,
            error_db_mean: error_db,
            error_db_median: error_db,
            level_error_db_mean: 1.0,
            shape_error_db_mean: 0.75 * error_db,
            rank1: 0.5,
            top5: 1.0,
            nrs_mean: None,
            signals: None,
        };
        let outcome = |error_db: f64| Outcome {
            error_db,
            level_error_db: 1.0,
            shape_error_db: 0.75 * error_db,
            rank: 2,
            nrs: None,
            signal_error_db: Some(2.5),
            signal_from_model_db: Some(0.5),
        };
        let left_out = |texture: usize, errors_db: [f64; 2]| LeftOut {
            texture,
            at: SpacePoint::new(10.0, 20.0 + texture as f64).unwrap(),
            nearest: texture + 1,
            is_within_measured: true,
            outcomes: errors_db.map(outcome).to_vec(),
        };
        LeaveOneOut {
            methods: vec![summary(Method::Nearest, 3.0), summary(Method::Blended(Mode::Field.into()), 2.0)],
            textures: vec![left_out(3, [3.0, 1.25]), left_out(4, [3.0, 4.75])],
            on_hull: vec![0, 1, 2],
            reach_db: 0.0,
        }
    }

    #[test]
    fn a_report_has_every_method_and_texture_and_says_what_it_is() {
        let library = starter_library().unwrap();
        let report = evaluation_report(&library, &measured());
        assert_eq!(
            (&report["measured"], &report["label_sources"][0]),
            (&MEASURED.into(), &"physical".into())
        );
        assert_eq!(report["version"], "1.2", "model error of the rendered textures");
        assert_eq!(report["modes"]["field"]["error_db_mean"], 2.0);
        assert_eq!(report["modes"]["field"]["shape_error_db_mean"], 1.5);
        assert!(report["position_caveat"].as_str().unwrap().contains("roughness from the vibration level"));
        assert_eq!((&report["nearest"]["rank1"], &report["best"]), (&0.5.into(), &"field".into()));
        assert!(report["modes"].get("nearest").is_none() && report["nearest"]["nrs_mean"].is_null());
        assert_eq!(report["textures"][1]["id"], library.textures[4].id.as_str());
        assert_eq!(report["textures"][1]["error_db"]["field"], 4.75);
        assert_eq!(report["textures"][1]["signal_error_db"]["nearest"], 2.5);
        assert_eq!(report["textures"][0]["nearest"], library.textures[4].id.as_str());
        assert_eq!(report["compared_at"]["channels_hz"].as_array().unwrap().len(), 40);
        assert_eq!(report["on_hull"].as_array().unwrap().len(), 3);
        assert_eq!(best(&measured()).map(|s| method_id(&s.method)), Some("field"));
    }

    #[test]
    fn positions_have_all_their_coordinates() {
        let mut measured = measured();
        measured.textures[0].at = SpacePoint::of(&[10.0, 23.0, 45.0]).unwrap();
        measured.textures[1].at = SpacePoint::of(&[10.0]).unwrap();
        let mut library = starter_library().unwrap();
        let report = evaluation_report(&library, &measured);
        assert_eq!(report["textures"][0]["at"], serde_json::json!([10.0, 23.0, 45.0]));
        assert_eq!(report["textures"][1]["at"], serde_json::json!([10.0]));
        // A map shows the first two axes, or one.
        library.axes = Some(vec!["rough-smooth".to_owned()]);
        let csv = String::from_utf8(figure_csv(&evaluation_figures(&library, &measured)[2].1)).unwrap();
        assert!(csv.contains(",10,50"), "{csv}");
    }

    #[test]
    fn positions_that_follow_from_the_vibration_are_named() {
        assert_eq!(position_caveat(&simulated_library().unwrap()), None);
        let mut library = simulated_library().unwrap();
        library.textures[0].place.as_mut().unwrap().source = LabelSource::Estimated;
        assert!(position_caveat(&library).unwrap().starts_with("Estimated positions"));
    }

    #[test]
    fn figures_show_where_the_error_is_and_that_nobody_felt_it() {
        let figures = evaluation_figures(&starter_library().unwrap(), &measured());
        let names: Vec<&str> = figures.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["methods", "error-nearest", &figure_name(&Method::Blended(Mode::Field.into()))]);
        for (_, figure) in &figures {
            assert!(figure.title().contains("measured on signals, positions from physical labels"));
            assert!(figure_svg(figure).contains(MEASURED));
        }
        let csv = String::from_utf8(figure_csv(&figures[2].1)).unwrap();
        assert!(csv.contains("no larger error than a copy of the nearest texture,1.2,10,23"), "{csv}");
        assert!(csv.contains("\nlarger error than a copy of the nearest texture,4.8,10,24"), "{csv}");
        // The three textures on the convex hull have no error.
        assert_eq!(csv.matches("on the convex hull").count(), 3);
    }
}
