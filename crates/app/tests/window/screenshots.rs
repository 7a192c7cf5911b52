//! Screenshots of every view at all supported sizes and scales in both themes, for people to look at.
//!
//! `SHAGREEN_SCREENSHOTS=DIR cargo test --workspace --test window screenshots` writes them; without the variable the test
//! takes one view, to show that it still works. `SHAGREEN_SCREENSHOT_SIZES=2560x1440-1.5,2560x1440-2` limits the sizes, so
//! that several processes can share them.

use std::path::{Path, PathBuf};

use egui_kittest::Harness;
use shagreen_app::command::Command;
use shagreen_studio::project::new_project;

use crate::images::raster::Raster;
use crate::support::{self, Author, begin, wait, wait_for_field, window};
use crate::views::{SIZES, carry_out, each_view, points};

fn opened(pixels: [f32; 2], scale: f32) -> Author {
    let builder = Harness::builder().with_size(points(pixels, scale));
    let builder = builder.with_pixels_per_point(scale).renderer(Raster::default());
    let mut harness = support::opened(builder, begin(new_project()));
    wait(&mut harness, "the output opens", |h| window(h).session().status().is_some());
    wait_for_field(&mut harness);
    harness
}

/// Writes what the window shows.
fn shoot(harness: &mut Author, folder: &Path, view: &str) {
    wait(harness, "the surface of the pad is made", |h| !window(h).pictures().is_busy());
    harness.run_steps(4);
    let name: String = view.chars().map(|c| if c.is_alphanumeric() { c } else { '-' }).collect();
    harness.render().unwrap().save(folder.join(format!("{name}.png"))).unwrap();
}

#[test]
fn screenshots_of_all_views() {
    let Some(folder) = std::env::var_os("SHAGREEN_SCREENSHOTS").map(PathBuf::from) else {
        let folder = tempfile::tempdir().unwrap();
        let mut harness = opened(SIZES[0].0, SIZES[0].1);
        shoot(&mut harness, folder.path(), "Author");
        assert_eq!(image::image_dimensions(folder.path().join("Author.png")).unwrap(), (960, 600));
        return;
    };
    let wanted = std::env::var("SHAGREEN_SCREENSHOT_SIZES").unwrap_or_default();
    for (size, scale) in SIZES {
        let name = format!("{}x{}-{scale}", size[0], size[1]);
        if !wanted.is_empty() && !wanted.split(',').any(|wanted| wanted == name) {
            continue;
        }
        for is_light in [false, true] {
            let theme = if is_light { "light" } else { "dark" };
            let folder = folder.join(format!("{name}-{theme}"));
            std::fs::create_dir_all(&folder).unwrap();
            let mut harness = opened(size, scale);
            if is_light {
                carry_out(&mut harness, Command::ToggleTheme);
            }
            let files = tempfile::tempdir().unwrap();
            each_view(&mut harness, files.path(), &mut |harness, view, _| shoot(harness, &folder, view));
        }
    }
}
