//! Further sliders in the inspector: their room, their words, and the range of the textures.

use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;
use shagreen_app::strings::{self, axes as words};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::starter::simulated_library;

use super::{THIRD, placed, sliced, third, use_axes};
use crate::support::{author_on, says, wait, wait_for_field};

#[test]
fn three_further_sliders_leave_the_mode_and_the_contributions_visible() {
    let mut harness = author_on(simulated_library().unwrap(), [1280.0, 720.0]);
    wait_for_field(&mut harness);
    use_axes(&mut harness, &ATTRIBUTES);
    harness.run_steps(4);
    let stage_top = harness.get_by_label(strings::HAND_START).rect().top();
    let bottom = |rect: egui::Rect| rect.bottom();
    let mode = bottom(harness.get_by_role_and_label(Role::ComboBox, strings::BLEND_MODE).rect());
    let beyond = bottom(harness.get_by_role_and_label(Role::CheckBox, strings::BEYOND).rect());
    let contributions = bottom(harness.get_by_label(strings::PARENTS).rect());
    assert!(mode < beyond && beyond < contributions, "{mode}, {beyond}, {contributions}");
    assert!(contributions < stage_top, "{contributions} of {stage_top}");
    // Each further axis has its name above its slider, as wide as before.
    for (name, slider) in [("flat-bumpy", "Flat to bumpy"), ("sticky-slippery", "Sticky to slippery")] {
        let name = harness.get_by_label(name).rect();
        let slider = harness.get_by_role_and_label(Role::Slider, slider).rect();
        assert!(name.bottom() <= slider.top() + 1.0 && slider.width() > 150.0, "{name:?} over {slider:?}");
    }
}

#[test]
fn the_button_of_the_axes_has_a_name_and_sliders_state_the_range_of_the_textures() {
    let mut harness = sliced();
    let button = harness.get_by_label(words::BUTTON).rect();
    assert!(button.width() > 30.0, "it has a word: {button:?}");
    assert!(says(&harness, &words::ends("centroid", &["dull", "bright"].map(str::to_owned)).expect("ends")));
    let values: Vec<f64> = placed(&harness).iter().map(|(_, at)| third(*at)).collect();
    let low = values.iter().copied().fold(100.0, f64::min);
    let high = values.iter().copied().fold(0.0, f64::max);
    let slider = harness.get_by_role_and_label(Role::Slider, THIRD).rect();
    harness.hover_at(slider.center());
    wait(&mut harness, "the tooltip is shown", |h| says(h, &words::range([low, high])));
}
