//! Picture of the audible texture on the stroke pad, turned as the texture is felt.

use egui::epaint::tessellator::path::rounded_rectangle;
use egui::epaint::{RectShape, RoundedRect, Vertex};
use egui::{Color32, Mesh, Painter, Pos2, Rect, TextureId, pos2};
use shagreen_core::units::Radians;

use super::surface::on_pad_m;
use crate::look::theme::RADIUS;

/// Picture of the audible texture, which repeats without a seam.
#[derive(Clone, Copy, Debug)]
pub struct PadPicture {
    /// The picture on the graphics card.
    pub texture: TextureId,
    /// Width and height in mm.
    pub size_mm: [f64; 2],
    /// Whether the texture is felt where the picture shows it: the lower left corner of the picture then lies in the middle
    /// of the pad, where the tip is at zero.
    pub is_felt: bool,
    /// Angle of the picture's x axis on the pad, counterclockwise: that of the texture.
    pub turn: Radians,
}

impl PadPicture {
    /// Fills the pad with the picture.
    pub(crate) fn show(&self, painter: &Painter, area: Rect) {
        if self.turn.0 == 0.0 {
            let uv = Rect::from_min_max(self.uv(area, area.min), self.uv(area, area.max));
            let shape = RectShape::filled(area, f32::from(RADIUS), Color32::WHITE);
            painter.add(shape.with_texture(self.texture, uv));
            return;
        }
        let mut outline = Vec::new();
        rounded_rectangle(&mut outline, RoundedRect::new(area, f32::from(RADIUS)));
        let mut mesh = Mesh::with_texture(self.texture);
        let vertex = |pos: &Pos2| Vertex { pos: *pos, uv: self.uv(area, *pos), color: Color32::WHITE };
        mesh.vertices = outline.iter().map(vertex).collect();
        // The outline is convex, so that triangles from one of its points fill it.
        for next in 2..mesh.vertices.len() as u32 {
            mesh.add_triangle(0, next - 1, next);
        }
        painter.add(mesh);
    }

    /// Coordinates in the picture at a point of the window, in widths to the right and heights down.
    fn uv(&self, area: Rect, pos: Pos2) -> Pos2 {
        let [right, down] = place_in_picture(on_pad_m(area, pos), self.size_mm, self.turn);
        let uv = pos2(right as f32, down as f32);
        if self.is_felt {
            return uv;
        }
        // The upper left corner of an upright picture lies in that of the pad.
        let [left, up] = place_in_picture(on_pad_m(area, area.min), self.size_mm, Radians(0.0));
        uv - pos2(left as f32, up as f32).to_vec2()
    }
}

/// Place in a repeating picture, in widths to the right and in heights down from its lower left corner, where a texture is felt
/// at a position on the pad in m (to the right and up from the middle). The texture's x axis lies at `turn` on the pad.
///
/// The renderer reads a height map at the same place: its position in the texture's axes is that on the pad, rotated by `-turn`
/// (`shagreen_synth::relief::Passage::turned`), and its first row, at y = 0, is the lowest row of the picture.
fn place_in_picture([x_m, y_m]: [f64; 2], [width_mm, height_mm]: [f64; 2], turn: Radians) -> [f64; 2] {
    let (sin, cos) = turn.0.sin_cos();
    let (across_m, up_m) = (cos * x_m + sin * y_m, cos * y_m - sin * x_m);
    [1e3 * across_m / width_mm, -1e3 * up_m / height_mm]
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use egui::{Rect, TextureId, pos2, vec2};
    use shagreen_core::texture::height_map::{HeightMap, HeightMapOptions};
    use shagreen_core::texture::plane::{Plane, Prepared};
    use shagreen_core::texture::{GrainNode, TextureModel};
    use shagreen_core::units::{Hertz, MetersPerSecond, Newtons, Radians};
    use shagreen_device::synth::contact::Place;
    use shagreen_device::synth::relief::Passage;

    use super::{PadPicture, place_in_picture};

    const SIDE_MM: f64 = 20.0;
    const TURNS_RAD: [f64; 7] = [0.0, 0.5, -0.5, 1.7, -2.0, 3.1, std::f64::consts::FRAC_PI_2];

    /// A texture at an angle on the pad, with a round bump 5 mm to the right and 3.75 mm up in its picture.
    fn bump(turn_rad: f64) -> Prepared {
        let step_mm = SIDE_MM / 16.0;
        let height_m = |i: usize| {
            let (x_mm, y_mm) = (step_mm * (i % 16) as f64, step_mm * (i / 16) as f64);
            5e-5 * (-0.5 * ((x_mm - 5.0).powi(2) + (y_mm - 3.75).powi(2)) / 1.5_f64.powi(2)).exp()
        };
        let heights_m = (0..256).map(height_m).collect();
        let map = HeightMap::new(heights_m, 1e-3 * SIDE_MM, HeightMapOptions::HARD_PLASTIC).unwrap();
        let (speed, force) = (MetersPerSecond(0.1), Newtons(1.0));
        let node = GrainNode { speed, force, lsf: vec![1.0, 2.0], level_mps2: 1.0 };
        let model = TextureModel::new(Hertz(1000.0), vec![node], None).unwrap();
        Plane::new(&model.with_height_map(Some(Arc::new(map))).with_turn_rad(turn_rad)).prepare()
    }

    /// Position in the texture's axes at which the renderer reads its height map, in m.
    fn rendered_at(texture: &Prepared, [x_m, y_m]: [f64; 2]) -> [f64; 2] {
        let on_pad = Passage::default().on(Place { x_m, y_m, n_jumps: 0 }, 1.0);
        let passage = texture.view().passage(&on_pad);
        [passage.x_m.1, passage.y_m.1]
    }

    /// Positions on a pad of 60 mm by 40 mm, in m.
    fn positions() -> impl Iterator<Item = [f64; 2]> {
        (0..=80).flat_map(|j| (0..=120).map(move |i| [5e-4 * f64::from(i - 60), 5e-4 * f64::from(j - 40)]))
    }

    #[test]
    fn the_pad_shows_the_place_that_the_renderer_reads() {
        for turn_rad in TURNS_RAD {
            let texture = bump(turn_rad);
            for position_m in positions() {
                let [x_m, y_m] = rendered_at(&texture, position_m);
                let [right, down] = place_in_picture(position_m, [SIDE_MM, SIDE_MM], Radians(turn_rad));
                // The renderer keeps rotations in `f32`.
                let apart_m = (1e-3 * SIDE_MM * right - x_m).hypot(1e-3 * SIDE_MM * down + y_m);
                assert!(apart_m < 2e-8, "{apart_m} m at {position_m:?}, {turn_rad} rad");
            }
        }
    }

    /// Wherever the renderer finds the top of the bump, the pad shows the bump of the picture: from its top, whose first row is
    /// the highest one, 16.25 mm down.
    #[test]
    fn a_bump_is_felt_where_the_pad_shows_it() {
        for turn_rad in TURNS_RAD {
            let texture = bump(turn_rad);
            let view = texture.view();
            let map = view.height_map().unwrap();
            let felt =
                |position_m: &[f64; 2]| map.mean_acceleration_mps2(rendered_at(&texture, *position_m), 1e-6);
            let top_m = positions().min_by(|a, b| felt(a).total_cmp(&felt(b))).unwrap();
            let [right, down] = place_in_picture(top_m, [SIDE_MM, SIDE_MM], Radians(turn_rad));
            let apart_mm =
                (SIDE_MM * right.rem_euclid(1.0) - 5.0).hypot(SIDE_MM * down.rem_euclid(1.0) - 16.25);
            // Positions are 0.5 mm apart.
            assert!(apart_mm < 0.4, "{apart_mm} mm at {turn_rad} rad");
        }
    }

    #[test]
    fn a_picture_that_is_not_felt_in_place_begins_in_the_upper_left_corner() {
        let area = Rect::from_min_size(pos2(10.0, 30.0), vec2(300.0, 120.0));
        let picture = |is_felt| PadPicture {
            texture: TextureId::default(),
            size_mm: [50.0, 20.0],
            is_felt,
            turn: Radians(0.0),
        };
        let is_near = |a: egui::Pos2, b: egui::Pos2| (a - b).length() < 1e-5;
        // The pad is 100 mm by 40 mm large.
        assert!(is_near(picture(false).uv(area, area.min), pos2(0.0, 0.0)));
        assert!(is_near(picture(false).uv(area, area.max), pos2(2.0, 2.0)));
        assert!(is_near(picture(true).uv(area, area.center()), pos2(0.0, 0.0)));
        assert!(is_near(picture(true).uv(area, area.min), pos2(-1.0, -1.0)));
        // Half a turn shows the opposite side.
        let turned = PadPicture { turn: Radians(std::f64::consts::PI), ..picture(true) };
        assert!(is_near(turned.uv(area, area.min), pos2(1.0, 1.0)));
    }
}
