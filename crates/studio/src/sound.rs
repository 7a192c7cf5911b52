//! The signal to render or play: a texture of a library, or the texture authored at a point.

use anyhow::{Context as _, bail};
use serde_json::{Value, json};
use shagreen_core::space::SpacePoint;
use shagreen_core::space::authoring::{Authored, Authoring, Blending, Voice};
use shagreen_core::space::texture_path::TexturePath;
use shagreen_core::texture::TextureModel;
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::plane::Plane;
use shagreen_core::texture::rate::highest_rate;
use shagreen_core::texture::shape::Shape;
use shagreen_core::texture::tap::Tap;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, BlendChoice};
use shagreen_formats::wav::TraceV1;

use crate::authoring::{authoring, shaped_model, shaped_plane_at};
use crate::near_names::unknown_texture;
use crate::report::Reporter;

/// Largest number of contributing textures that are named in text.
const MOST_NAMED: usize = 3;

/// Signal to render or play: voices with weights, and properties of their mixture.
pub struct Sound {
    /// Contributing textures by their index in the library, with weights, largest first, at least one.
    pub parents: Vec<(usize, f64)>,
    /// Interpolation mode.
    pub mode: Mode,
    /// How the voices are mixed.
    pub mixing: Mode,
    /// Voices and their weights; for a path only the first texture.
    voices: Vec<(SoundVoice, f64)>,
    /// Shape of all voices, of the path and of the tap transient.
    pub shape: Shape,
    /// Path along a stroke, if the texture changes.
    pub path: Option<TexturePath>,
    /// Tap transient, if it is known.
    pub tap: Option<Tap>,
    /// Id of the texture, if one was named.
    pub texture: Option<String>,
    /// Authored point, if one was requested: that point, or the nearest one of the convex hull.
    pub at: Option<SpacePoint>,
    /// Whether the requested point lies outside the hull and another one was authored.
    pub clamped: bool,
    /// Whether the point lies outside the hull and was extrapolated.
    pub extrapolated: bool,
}

enum SoundVoice {
    /// A texture of the library, by its index, without the shape.
    Texture(usize),
    /// A texture interpolated for the point, with the shape.
    Interpolated(TextureModel),
}

impl Sound {
    /// Selects a texture of the library, in a shape.
    ///
    /// # Errors
    /// The library has no texture of this id; the message names similar ids. Or a texture of its path cannot be shaped.
    pub fn of_texture(library: &Library, id: &str, mode: Mode, shape: &Shape) -> anyhow::Result<Self> {
        let index = library.index_of(id).with_context(|| unknown_texture(library, id))?;
        let TextureEntry { path, model, .. } = &library.textures[index];
        Ok(Self {
            parents: vec![(index, 1.0)],
            mode,
            mixing: Mode::Shared,
            voices: vec![(SoundVoice::Texture(index), 1.0)],
            shape: *shape,
            path: path.as_ref().map(|path| path.clone().shaped(shape)).transpose()?,
            tap: shape.tap(model.tap()),
            texture: Some(id.to_owned()),
            at: None,
            clamped: false,
            extrapolated: false,
        })
    }

    /// Authors the texture at a point, in a shape.
    ///
    /// # Errors
    /// No texture of the library has a position, or the field has no texture at the point.
    pub fn of_point(
        library: &Library,
        point: SpacePoint,
        (blending, shape): (&Blending, &Shape),
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        Self::of_point_in(
            &authoring(library, blending.mode, reporter)?,
            library,
            point,
            (blending, shape),
            reporter,
        )
    }

    /// As [`Sound::of_point`], with the authoring space of the library for the mode ([`authoring`]), which several points share.
    ///
    /// # Errors
    /// As [`Sound::of_point`].
    pub fn of_point_in(
        authoring: &Authoring,
        library: &Library,
        point: SpacePoint,
        (blending, shape): (&Blending, &Shape),
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        let authored = authoring
            .author(point, blending)
            .context("no texture of the library has a position; use --texture, or assign positions first")?;
        warn_outside_hull(point, &authored, reporter);
        let authored = authored.shaped(shape).context("the texture at this point cannot have this shape")?;
        let voice = |(voice, weight): (Voice<'_>, f64)| match voice {
            Voice::Texture(index) => (SoundVoice::Texture(index), weight),
            Voice::Made(model) => (SoundVoice::Interpolated(model.clone()), weight),
        };
        let voices: Vec<(SoundVoice, f64)> = authored.voices().into_iter().map(voice).collect();
        if voices.is_empty() {
            bail!(
                "the interpolated field has no texture at {point}; choose another point, or --blend shared"
            );
        }
        Ok(Self {
            mode: authored.mode,
            mixing: authored.mixing(),
            voices,
            shape: *shape,
            path: None,
            tap: authored.tap(|index| library.textures[index].model.tap()),
            texture: None,
            at: Some(authored.location.at),
            clamped: authored.location.clamped,
            extrapolated: authored.is_extrapolated,
            parents: authored.parents,
        })
    }

    /// Authors an authored texture of a project, in a shape. `library` has the textures of the project, without the positions
    /// of those that take no part in it.
    ///
    /// # Errors
    /// As [`Sound::of_point`].
    pub fn of_authored(
        library: &Library,
        authored: &AuthoredTexture,
        shape: &Shape,
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        let (point, blending) = placed(library, authored, reporter);
        Self::of_point(library, point, (&blending, shape), reporter)
    }

    /// As [`Sound::of_authored`], with the authoring space of the library for the mode of the texture ([`authoring`]).
    ///
    /// # Errors
    /// As [`Sound::of_point`].
    pub fn of_authored_in(
        authoring: &Authoring,
        library: &Library,
        authored: &AuthoredTexture,
        shape: &Shape,
        reporter: &dyn Reporter,
    ) -> anyhow::Result<Self> {
        let (point, blending) = placed(library, authored, reporter);
        Self::of_point_in(authoring, library, point, (&blending, shape), reporter)
    }

    /// Returns the models of the voices in their shape, and their weights.
    ///
    /// # Errors
    /// A texture cannot have the shape; the message names it.
    pub fn voice_models(&self, library: &Library) -> anyhow::Result<Vec<(TextureModel, f64)>> {
        let model = |(voice, weight): &(SoundVoice, f64)| {
            let model = match voice {
                SoundVoice::Texture(index) => shaped_model(&library.textures[*index], &self.shape)?,
                SoundVoice::Interpolated(model) => model.clone(),
            };
            Ok((model, *weight))
        };
        self.voices.iter().map(model).collect()
    }

    /// Returns the speed-force planes of the voices at [`Sound::rate`], and their weights.
    ///
    /// # Errors
    /// A texture cannot be converted to that rate.
    pub fn planes(&self, library: &Library, reporter: &dyn Reporter) -> anyhow::Result<Vec<(Plane, f64)>> {
        let rate = self.rate(library)?;
        let plane = |(voice, weight): &(SoundVoice, f64)| {
            let plane = match voice {
                SoundVoice::Texture(index) => {
                    shaped_plane_at(&library.textures[*index], &self.shape, rate, reporter)?
                }
                SoundVoice::Interpolated(model) => Plane::new(model),
            };
            Ok((plane, *weight))
        };
        self.voices.iter().map(plane).collect()
    }

    /// Returns the models of the voices.
    fn models<'a>(&'a self, library: &'a Library) -> impl Iterator<Item = &'a TextureModel> {
        self.voices.iter().map(|(voice, _)| match voice {
            SoundVoice::Texture(index) => &library.textures[*index].model,
            SoundVoice::Interpolated(model) => model,
        })
    }

    /// Returns the highest rate of the voices, to which the others are converted.
    ///
    /// # Errors
    /// There is no voice.
    pub fn rate(&self, library: &Library) -> anyhow::Result<Hertz> {
        highest_rate(self.models(library)).context("there is nothing to render; choose another point")
    }

    /// Notes that a motion exceeds the speeds or forces at which the voices were measured, where they are clamped, or that
    /// most of it lies below them, where they fade.
    pub fn note_limits(&self, library: &Library, trace: &TraceV1, reporter: &dyn Reporter) {
        let highest_speeds = self.models(library).map(|m| m.speed_max().mm_per_s());
        let known_mm_per_s = highest_speeds.fold(f64::INFINITY, f64::min);
        let known_n = self.models(library).map(|m| m.force_max().0).fold(f64::INFINITY, f64::min);
        let highest = |values: &[f64]| values.iter().copied().fold(0.0, f64::max);
        if highest(&trace.speed_mm_per_s) > known_mm_per_s || highest(&trace.force_n) > known_n {
            reporter.note(&format!(
                "the texture was measured up to {known_mm_per_s:.0} mm/s and {known_n:.1} N; faster or harder strokes are \
                 rendered as at these values"
            ));
        }
        let [lowest_mm_per_s, lowest_n] = self.lowest(library);
        if is_mostly_below(trace, lowest_mm_per_s, lowest_n) {
            reporter.note(&format!(
                "the texture was measured from {lowest_mm_per_s:.0} mm/s and {lowest_n:.2} N; slower or lighter strokes are \
                 below the measured range and fade to silence"
            ));
        }
    }

    /// Returns the lowest speed in mm/s and the lowest force in N at which all voices were measured.
    fn lowest(&self, library: &Library) -> [f64; 2] {
        let of_model = |model: &TextureModel| {
            let measured = model.contacts().filter(|c| c.speed.0 > 0.0 && c.force.0 > 0.0);
            measured.fold([f64::INFINITY; 2], |[v, f], c| [v.min(c.speed.mm_per_s()), f.min(c.force.0)])
        };
        self.models(library).map(of_model).fold([0.0; 2], |[v, f], [of_v, of_f]| [v.max(of_v), f.max(of_f)])
    }

    /// Returns the texture of the library that was named, without the shape; `None` if none was.
    pub fn named_entry<'a>(&self, library: &'a Library) -> Option<&'a TextureEntry> {
        library.index_of(self.texture.as_deref()?).map(|index| &library.textures[index])
    }

    /// Returns the contributing textures and their weights as JSON.
    pub fn parents_json(&self, library: &Library) -> Value {
        let parent =
            |(index, weight): &(usize, f64)| json!({"id": library.textures[*index].id, "weight": weight});
        self.parents.iter().map(parent).collect()
    }

    /// Returns the contributing textures with the largest weights as text, and the number of others.
    pub fn parents_text(&self, library: &Library) -> String {
        let percent = |(index, weight): &(usize, f64)| {
            format!("{} {:.0} %", library.textures[*index].id, 100.0 * weight)
        };
        let named = self.parents.iter().take(MOST_NAMED).map(percent).collect::<Vec<_>>().join(", ");
        match self.parents.len().saturating_sub(MOST_NAMED) {
            0 => named,
            n => format!("{named} and {n} more"),
        }
    }

    /// Returns the coordinates of the point, one for each axis, as JSON.
    pub fn at_json(&self) -> Option<Vec<f64>> {
        self.at.map(|at| at.coordinates().to_vec())
    }
}

/// Returns whether more than half of the moving contact in a motion is slower or lighter than these limits by more than a
/// rounding error.
fn is_mostly_below(trace: &TraceV1, lowest_mm_per_s: f64, lowest_n: f64) -> bool {
    let pairs = trace.speed_mm_per_s.iter().zip(&trace.force_n);
    let moving: Vec<(f64, f64)> =
        pairs.map(|(v, f)| (*v, *f)).filter(|(v, f)| *v > 0.0 && *f > 0.0).collect();
    let is_below = |(v, f): &&(f64, f64)| *v < 0.999 * lowest_mm_per_s || *f < 0.999 * lowest_n;
    2 * moving.iter().filter(is_below).count() > moving.len()
}

/// Warns of a point outside the convex hull of the textures, unless the point that is used instead looks the same.
fn warn_outside_hull(point: SpacePoint, authored: &Authored, reporter: &dyn Reporter) {
    let at = authored.location.at;
    let is_moved = authored.location.clamped && point.most_different_axis(at).is_some();
    match (is_moved, authored.is_extrapolated) {
        (false, false) => {}
        (true, false) => reporter.warn(&format!(
            "{point} lies outside the convex hull of the textures; the nearest point of the hull, {at}, is used"
        )),
        (false, true) => reporter.warn(&format!(
            "{point} lies outside the convex hull of the textures; the texture there is extrapolated"
        )),
        (true, true) => reporter.warn(&format!(
            "{point} lies too far outside the convex hull of the textures; {at}, the farthest point that can be computed, is \
             extrapolated"
        )),
    }
}

/// Returns the position and the interpolation options of an authored texture in the space of a library, and notes what differs.
fn placed(library: &Library, authored: &AuthoredTexture, reporter: &dyn Reporter) -> (SpacePoint, Blending) {
    // The library of a project may have other axes than when the texture was authored.
    let n_axes = library.axis_names().len();
    let blend = authored.blend.in_space(n_axes);
    if blend.mode != authored.blend.mode {
        reporter.note(&format!(
            "\"{}\" has mode {}, which needs a space with one or two axes; it is interpolated in mode {}",
            authored.name,
            authored.blend.mode.id(),
            blend.mode.id()
        ));
    }
    note_lost_pins(library, &blend, reporter);
    (authored.at.on(n_axes), blend.blending(|id| library.index_of(id)))
}

/// Notes pins of an authored texture that have no effect, because a texture is not in the list or has no position in the space.
fn note_lost_pins(library: &Library, blend: &BlendChoice, reporter: &dyn Reporter) {
    if !blend.can_lock() {
        return;
    }
    for id in &blend.locked {
        let reason = match library.index_of(id) {
            None => "the project has no such texture".to_owned(),
            Some(texture) if library.textures[texture].place.is_none() => {
                format!("it has no position on the axes {}", library.axis_names().join(", "))
            }
            Some(_) => continue,
        };
        reporter.note(&format!("the pin of \"{id}\" has no effect: {reason}"));
    }
}

#[cfg(test)]
mod tests;
