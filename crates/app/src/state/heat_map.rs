//! A quantity over the whole space, drawn as colors behind the canvas. A worker computes it, coarse resolution first.

mod region;

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, channel};

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authoring, Blending};
use shagreen_core::space::heat_map::{HeatMapper, Quantity};
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Contact;

use crate::state::heat_map::region::{continued, outline};

/// Cells along each side, from coarse to fine.
const SIDES: [usize; 3] = [8, 24, 48];

/// Input of a heat map. Equal inputs have equal maps.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    /// Displayed quantity.
    pub quantity: Quantity,
    /// Interpolation options.
    pub blending: Blending,
    /// Tip speed and normal force.
    pub contact: Contact,
    /// Coordinates on the axes that the map does not show; those on its own axes are zero.
    pub slice: SpacePoint,
    /// Number that changes whenever textures or positions change.
    pub generation: u64,
}

/// Heat map at one resolution.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    /// Cells along each side.
    pub side: usize,
    /// Values at the cell centers, row by row from the low end of the y axis, each row from the low end of the x axis.
    /// `None` where there is no value.
    pub values: Vec<Option<f64>>,
    /// Values with those outside the outline continued from its edge, in the same order. Colors are interpolated between
    /// cells, so that cells outside determine colors inside.
    pub continued: Vec<Option<f64>>,
    /// Outline of the region with values, as a polygon; `None` if the whole space has values, or if the map is a slice of a space
    /// with more axes.
    pub outline: Option<Arc<[SpacePoint]>>,
}

impl Grid {
    /// Lowest and highest value, or `None` without values.
    pub fn range(&self) -> Option<(f64, f64)> {
        let values = || self.values.iter().flatten().copied();
        Some((values().min_by(f64::total_cmp)?, values().max_by(f64::total_cmp)?))
    }
}

/// Latest heat map, and the worker that refines it.
#[derive(Default)]
pub(crate) struct HeatMap {
    wanted: Option<Wanted>,
    job: Option<Job>,
    grid: Option<Grid>,
    picture: Option<TextureHandle>,
    is_new: bool,
}

struct Job {
    grids: Receiver<Grid>,
    is_cancelled: Arc<AtomicBool>,
}

impl Drop for Job {
    fn drop(&mut self) {
        self.is_cancelled.store(true, Ordering::Relaxed);
    }
}

impl HeatMap {
    /// Requests a map, or none. `textures` returns the input of the worker and is called only if the request has
    /// changed.
    pub(crate) fn follow(
        &mut self,
        wanted: Option<Wanted>,
        textures: impl FnOnce() -> (Authoring, Vec<Arc<Plane>>),
        ctx: &Context,
    ) {
        if let Some(job) = &self.job {
            while let Ok(grid) = job.grids.try_recv() {
                (self.grid, self.is_new) = (Some(grid), true);
            }
        }
        if wanted == self.wanted {
            return;
        }
        let is_same_quantity =
            wanted.as_ref().map(|w| w.quantity) == self.wanted.as_ref().map(|w| w.quantity);
        if !is_same_quantity {
            // Another quantity has another unit, so the old map is discarded.
            (self.grid, self.picture) = (None, None);
        }
        self.wanted.clone_from(&wanted);
        self.job = wanted.map(|wanted| {
            let (authoring, planes) = textures();
            begin(wanted, authoring, planes, ctx.clone())
        });
    }

    /// Latest map, as far as it is computed.
    pub(crate) fn grid(&self) -> Option<&Grid> {
        self.grid.as_ref()
    }

    /// Map as a picture of the whole space, in the colors that `color_of` returns for 0 to 1.
    pub(crate) fn picture(
        &mut self,
        ctx: &Context,
        color_of: impl Fn(f32) -> Color32,
    ) -> Option<&TextureHandle> {
        let grid = self.grid.as_ref()?;
        if std::mem::take(&mut self.is_new) || self.picture.is_none() {
            let image = image(grid, color_of);
            match &mut self.picture {
                Some(picture) => picture.set(image, TextureOptions::LINEAR),
                none => *none = Some(ctx.load_texture("heat map", image, TextureOptions::LINEAR)),
            }
        }
        self.picture.as_ref()
    }
}

fn begin(wanted: Wanted, authoring: Authoring, planes: Vec<Arc<Plane>>, ctx: Context) -> Job {
    let (sender, grids) = channel();
    let is_cancelled = Arc::new(AtomicBool::new(false));
    let job = Job { grids, is_cancelled: Arc::clone(&is_cancelled) };
    std::thread::spawn(move || {
        let planes: Vec<&Plane> = planes.iter().map(|plane| &**plane).collect();
        let mapper = HeatMapper::new(&authoring, &planes, &wanted.blending, wanted.contact, wanted.quantity);
        // The distance from the textures is defined everywhere, and so is every quantity in a slice, whose outline is not known.
        let is_plane = authoring.space().n_axes() == 2;
        let has_outline = is_plane && wanted.quantity != Quantity::Distance;
        let outline: Option<Arc<[SpacePoint]>> =
            has_outline.then(|| Arc::from(outline(&authoring, &wanted.blending)));
        for side in SIDES {
            let middle_of = |cell: usize| wanted.slice.on_canvas_at(middle_of(cell, side));
            let mut values = Vec::with_capacity(side * side);
            for cell in 0..side * side {
                if is_cancelled.load(Ordering::Relaxed) {
                    return;
                }
                values.push(mapper.at(middle_of(cell)));
            }
            let is_inside = |cell: usize| {
                authoring.space().locate(middle_of(cell)).is_some_and(|location| !location.clamped)
            };
            let continued = if is_plane { continued(&values, side, is_inside) } else { values.clone() };
            if sender.send(Grid { side, values, continued, outline: outline.clone() }).is_err() {
                return;
            }
            ctx.request_repaint();
        }
    });
    job
}

fn middle_of(cell: usize, side: usize) -> SpacePoint {
    let along = |i: usize| 100.0 * (i as f64 + 0.5) / side as f64;
    SpacePoint::plane(along(cell % side), along(cell / side))
}

/// Picture of the map, to be clipped to the outline; its first row is the high end of the y axis.
fn image(grid: &Grid, color_of: impl Fn(f32) -> Color32) -> ColorImage {
    let (low, high) = grid.range().unwrap_or_default();
    let share = |value: f64| if high > low { ((value - low) / (high - low)) as f32 } else { 0.5 };
    let rows = grid.continued.chunks(grid.side).rev();
    let pixels =
        rows.flatten().map(|value| value.map_or(Color32::TRANSPARENT, |value| color_of(share(value))));
    ColorImage::new([grid.side, grid.side], pixels.collect())
}

#[cfg(test)]
mod tests {
    use super::{Grid, image, middle_of};
    use egui::Color32;

    #[test]
    fn a_map_is_a_picture_with_its_high_axis_up() {
        let values = vec![Some(1.0), None, Some(3.0), Some(2.0)];
        let grid = Grid { side: 2, continued: values.clone(), values, outline: None };
        assert_eq!(grid.range(), Some((1.0, 3.0)));
        let gray = |share: f32| Color32::from_gray((100.0 * share) as u8);
        let image = image(&grid, gray);
        let expected =
            [Color32::from_gray(100), Color32::from_gray(50), Color32::from_gray(0), Color32::TRANSPARENT];
        assert_eq!(image.pixels, expected);
        let middle = middle_of(2, 2);
        assert_eq!((middle.x(), middle.y()), (25.0, 75.0));
        let nothing = Grid { side: 1, values: vec![None], continued: vec![None], outline: None };
        assert_eq!(nothing.range(), None);
    }
}
