//! Software rasterizer for the triangles of egui.
//!
//! Its images are the same on every machine, unlike those of graphics drivers. No maintained library supports this
//! version of egui.

use std::collections::HashMap;

use egui::epaint::{ImageData, Mesh, Primitive, Vertex};
use egui::{Color32, Context, FullOutput, Rect, TextureId, TextureWrapMode, TexturesDelta};
use egui_kittest::TestRenderer;
use image::{Rgba, RgbaImage};

#[derive(Default)]
pub(crate) struct Raster {
    textures: HashMap<TextureId, Texture>,
}

struct Texture {
    size: [usize; 2],
    pixels: Vec<Color32>,
    wrap: TextureWrapMode,
}

impl Texture {
    /// Bilinearly interpolated color at texture coordinates, of which 0 to 1 is the whole texture.
    fn at(&self, u: f32, v: f32) -> [f32; 4] {
        let axis = |share: f32, n: usize| {
            let x = share * n as f32 - 0.5;
            (self.wrapped(x.floor() as isize, n), self.wrapped(x.floor() as isize + 1, n), x - x.floor())
        };
        let ((left, right, across), (top, bottom, down)) = (axis(u, self.size[0]), axis(v, self.size[1]));
        let pixel = |x: usize, y: usize| self.pixels[y * self.size[0] + x].to_array().map(f32::from);
        let mix =
            |a: [f32; 4], b: [f32; 4], share: f32| std::array::from_fn(|i| a[i] + share * (b[i] - a[i]));
        let upper = mix(pixel(left, top), pixel(right, top), across);
        let lower = mix(pixel(left, bottom), pixel(right, bottom), across);
        mix(upper, lower, down)
    }

    /// The pixel that is shown at an index outside a row of `n` pixels, too.
    fn wrapped(&self, index: isize, n: usize) -> usize {
        let n = n.cast_signed();
        let index = match self.wrap {
            TextureWrapMode::ClampToEdge => index.clamp(0, n - 1),
            TextureWrapMode::Repeat => index.rem_euclid(n),
            TextureWrapMode::MirroredRepeat => {
                let index = index.rem_euclid(2 * n);
                index.min(2 * n - 1 - index)
            }
        };
        index.cast_unsigned()
    }
}

impl TestRenderer for Raster {
    fn handle_delta(&mut self, delta: &mut TexturesDelta) {
        for (id, changes) in delta.set.drain() {
            for change in changes {
                let ImageData::Color(image) = change.image;
                match change.pos {
                    None => {
                        let texture = Texture {
                            size: image.size,
                            pixels: image.pixels.clone(),
                            wrap: change.options.wrap_mode,
                        };
                        self.textures.insert(id, texture);
                    }
                    Some([left, top]) => {
                        let texture = self.textures.get_mut(&id).expect("a texture that was set");
                        for (y, row) in image.pixels.chunks(image.size[0]).enumerate() {
                            let begin = (top + y) * texture.size[0] + left;
                            texture.pixels[begin..begin + row.len()].copy_from_slice(row);
                        }
                    }
                }
            }
        }
        for id in delta.free.drain() {
            self.textures.remove(&id);
        }
    }

    fn render(&mut self, ctx: &Context, output: &FullOutput) -> Result<RgbaImage, String> {
        let scale = output.pixels_per_point;
        let size = ctx.content_rect().size() * scale;
        let mut image = RgbaImage::from_pixel(size.x as u32, size.y as u32, Rgba([0, 0, 0, 255]));
        for clipped in ctx.tessellate(output.shapes.clone(), scale) {
            if let Primitive::Mesh(mesh) = clipped.primitive {
                let texture = self.textures.get(&mesh.texture_id).ok_or("a texture that nobody set")?;
                fill_mesh(&mut image, &mesh, texture, clipped.clip_rect * scale, scale);
            }
        }
        Ok(image)
    }
}

fn fill_mesh(image: &mut RgbaImage, mesh: &Mesh, texture: &Texture, clip: Rect, scale: f32) {
    for corners in mesh.indices.as_chunks::<3>().0 {
        let corners = corners.map(|index| mesh.vertices[index as usize]);
        fill_triangle(image, corners, texture, clip, scale);
    }
}

/// Fills the pixels whose centers are in a triangle. A pixel on an edge belongs to one of the two triangles that share
/// it.
fn fill_triangle(image: &mut RgbaImage, mut corners: [Vertex; 3], texture: &Texture, clip: Rect, scale: f32) {
    let mut at = corners.map(|corner| corner.pos * scale);
    let mut area = (at[1] - at[0]).rot90().dot(at[2] - at[0]);
    if area == 0.0 {
        return;
    }
    if area < 0.0 {
        corners.swap(1, 2);
        at.swap(1, 2);
        area = -area;
    }
    let bounds = Rect::from_points(&at).intersect(clip).intersect(Rect::from_min_max(
        egui::Pos2::ZERO,
        egui::pos2(image.width() as f32, image.height() as f32),
    ));
    if !bounds.is_positive() {
        return;
    }
    let owns_edge = |from: egui::Pos2, to: egui::Pos2| {
        let edge = to - from;
        edge.y < 0.0 || (edge.y == 0.0 && edge.x > 0.0)
    };
    for y in (bounds.top() - 0.5).ceil() as u32..=(bounds.bottom() - 0.5).ceil() as u32 {
        for x in (bounds.left() - 0.5).ceil() as u32..=(bounds.right() - 0.5).ceil() as u32 {
            let middle = egui::pos2(x as f32 + 0.5, y as f32 + 0.5);
            if x >= image.width() || y >= image.height() || !clip.contains(middle) {
                continue;
            }
            let weights: [f32; 3] = std::array::from_fn(|i| {
                let (from, to) = (at[(i + 1) % 3], at[(i + 2) % 3]);
                (to - from).rot90().dot(middle - from)
            });
            let is_inside = (0..3).all(|i| {
                weights[i] > 0.0 || (weights[i] == 0.0 && owns_edge(at[(i + 1) % 3], at[(i + 2) % 3]))
            });
            if is_inside {
                let weights = weights.map(|weight| weight / area);
                blend(image.get_pixel_mut(x, y), shade(&corners, weights, texture));
            }
        }
    }
}

/// Premultiplied color of a point in a triangle, 0..255.
fn shade(corners: &[Vertex; 3], weights: [f32; 3], texture: &Texture) -> [f32; 4] {
    let sum = |value: &dyn Fn(&Vertex) -> f32| {
        corners.iter().zip(weights).map(|(corner, weight)| weight * value(corner)).sum::<f32>()
    };
    let pixel = texture.at(sum(&|corner| corner.uv.x), sum(&|corner| corner.uv.y));
    std::array::from_fn(|i| pixel[i] * sum(&|corner| f32::from(corner.color.to_array()[i])) / 255.0)
}

fn blend(pixel: &mut Rgba<u8>, color: [f32; 4]) {
    let left = 1.0 - color[3] / 255.0;
    for (below, above) in pixel.0.iter_mut().zip(color) {
        *below = (above + left * f32::from(*below)).round().clamp(0.0, 255.0) as u8;
    }
}

#[cfg(test)]
mod tests {
    use super::{Raster, RgbaImage};
    use egui::{Color32, Rect, pos2, vec2};
    use egui_kittest::Harness;

    fn picture(color: Color32) -> RgbaImage {
        let mut harness =
            Harness::builder().with_size(vec2(40.0, 30.0)).renderer(Raster::default()).build_ui(move |ui| {
                let painter = ui.ctx().layer_painter(egui::LayerId::debug());
                painter.rect_filled(Rect::EVERYTHING, 0.0, Color32::BLACK);
                painter.rect_filled(Rect::from_min_max(pos2(10.0, 5.0), pos2(30.0, 20.0)), 0.0, color);
            });
        harness.run_steps(2);
        harness.render().unwrap()
    }

    /// Every pixel of a rectangle is filled exactly once, including those on its diagonal, and no other pixel is
    /// filled.
    #[test]
    fn a_rectangle_is_filled_once() {
        for (color, seen) in [(Color32::WHITE, 255), (Color32::from_white_alpha(128), 128)] {
            for (x, y, pixel) in picture(color).enumerate_pixels() {
                let is_inside = (10..30).contains(&x) && (5..20).contains(&y);
                let is_edge = [9, 10, 29, 30].contains(&x) || [4, 5, 19, 20].contains(&y);
                let value = i32::from(pixel.0[0]);
                // egui smooths edges.
                assert!(
                    is_edge || (value - if is_inside { seen } else { 0 }).abs() <= 2,
                    "{x}, {y}: {value}"
                );
            }
        }
    }
}
