//! Draws the icons and the splash picture of the packages.
//!
//! `cargo run --release -p shagreen-app --example draw_icons -- FOLDER` writes `shagreen-SIDE.png` for the usual sides, and
//! `splash.png`.
#![allow(clippy::print_stdout, reason = "an example prints its results")]

use std::path::PathBuf;

use egui::IconData;
use image::RgbaImage;
use shagreen_app::look::icon::{icon, splash};

/// Sides of the icons in pixels, as desktops look for them.
const SIDES: [usize; 7] = [16, 24, 32, 48, 64, 128, 256];
/// Width and height of the splash picture in pixels.
const SPLASH: [usize; 2] = [1280, 640];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let folder = std::env::args_os().nth(1).map(PathBuf::from).ok_or("name the folder for the pictures")?;
    std::fs::create_dir_all(&folder)?;
    let write = |name: String, drawn: IconData| -> Result<(), Box<dyn std::error::Error>> {
        let picture =
            RgbaImage::from_raw(drawn.width, drawn.height, drawn.rgba).ok_or("a picture is incomplete")?;
        let path = folder.join(name);
        picture.save(&path)?;
        println!("{}", path.display());
        Ok(())
    };
    for side in SIDES {
        write(format!("shagreen-{side}.png"), icon(side))?;
    }
    write("splash.png".to_owned(), splash(SPLASH[0], SPLASH[1]))
}
