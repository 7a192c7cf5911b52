//! The slice that the canvas shows while a path with other further coordinates plays.

use shagreen_app::command::Command;
use shagreen_app::strings;

use super::{THIRD, click_at, dot, free_place, placed, set, sliced, third};
use crate::support::{Author, click, window};
use crate::views::carry_out;

/// Width of each texture on the canvas.
fn widths(harness: &Author) -> Vec<f32> {
    placed(harness).iter().map(|(name, _)| dot(harness, name).1).collect()
}

/// The map is that of the texture, too: it takes longer than a frame.
#[test]
fn textures_stay_on_the_slice_of_the_texture() {
    let mut harness = sliced();
    set(&mut harness, THIRD, 95.0);
    carry_out(&mut harness, Command::TogglePathTool);
    let free = free_place(&harness);
    click_at(&mut harness, free);
    click(&mut harness, &strings::play_texture("Brick"));
    carry_out(&mut harness, Command::TogglePathTool);
    let high = widths(&harness);
    set(&mut harness, THIRD, 5.0);
    let low = widths(&harness);
    assert_ne!(low, high, "the control");
    carry_out(&mut harness, Command::PlayPath(true));
    let played = window(&harness).session().path_point().expect("the path plays");
    assert_eq!((third(played), widths(&harness)), (95.0, low));
}
