//! Sources of the positions on each axis, from the report of a space.

use serde_json::Value;
use shagreen_core::space::LabelSource;

/// Source of the positions on each axis, as one text: "rough-smooth: human ratings; hard-soft: predicted from vibration
/// features, by a model trained on human ratings". `None` if the report does not state that features predicted the
/// positions on any axis.
pub fn axis_sources(report: &Value) -> Option<String> {
    let judgments = judgments(report)?.label();
    let axes = predicted_axes(report)?;
    let source = |axis: &Value| {
        let name = axis.get("name").and_then(Value::as_str)?;
        Some(if is_predicted(axis) {
            format!("{name}: predicted from vibration features, by a model trained on {judgments}")
        } else {
            format!("{name}: {judgments}")
        })
    };
    let all: Vec<String> = axes.iter().filter_map(source).collect();
    Some(all.join("; "))
}

/// Whether the report states that positions were predicted by a model trained on ratings by people.
pub fn is_predicted_from_ratings(report: &Value) -> bool {
    judgments(report) == Some(LabelSource::HumanRatings) && predicted_axes(report).is_some()
}

/// All axes of the report, if features predicted the positions on any of them.
fn predicted_axes(report: &Value) -> Option<&Vec<Value>> {
    let axes = report.get("axes")?.as_array()?;
    axes.iter().any(is_predicted).then_some(axes)
}

fn judgments(report: &Value) -> Option<LabelSource> {
    LabelSource::from_id(report.get("label_source")?.as_str()?)
}

fn is_predicted(axis: &Value) -> bool {
    axis.get("placed_by").and_then(Value::as_str) == Some("predicted")
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use super::{axis_sources, is_predicted_from_ratings};

    fn report(label_source: &str, placed_by: [&str; 2]) -> Value {
        json!({
            "label_source": label_source,
            "axes": [
                {"name": "rough-smooth", "placed_by": placed_by[0]},
                {"name": "hard-soft", "placed_by": placed_by[1]},
            ],
        })
    }

    #[test]
    fn each_axis_has_its_own_source() {
        let mixed = report("human", ["felt", "predicted"]);
        assert_eq!(
            axis_sources(&mixed).as_deref(),
            Some(
                "rough-smooth: human ratings; hard-soft: predicted from vibration features, by a model trained on human ratings"
            )
        );
        assert!(is_predicted_from_ratings(&mixed));
        assert_eq!(axis_sources(&report("human", ["felt", "felt"])), None);
        let simulated = report("simulated", ["predicted", "predicted"]);
        assert!(axis_sources(&simulated).is_some_and(|text| text.contains("trained on simulated raters")));
        assert!(!is_predicted_from_ratings(&simulated));
        for other in [
            json!(null),
            json!({}),
            json!({"label_source": "human", "axes": 3}),
            report("x", ["predicted"; 2]),
        ] {
            assert_eq!(axis_sources(&other), None, "{other}");
        }
    }
}
