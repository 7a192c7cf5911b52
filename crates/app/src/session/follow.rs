//! The session follows the project: its library and textures, its space and axes, and what is audible of it.

use std::sync::Arc;

use shagreen_core::texture::TextureModel;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::Hertz;
use shagreen_formats::library::{Place, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project};
use shagreen_studio::authoring::plane_at;
use shagreen_studio::axes::list_places;
use shagreen_studio::report::Warnings;

use super::audible::Audible;
use super::loaded_textures::{rate_in, rate_of_space};
use super::messages::Said;
use super::places::{names_of, poles_of};
use super::player::Wanted;
use super::{Session, Spectra, drawn_frequencies};

impl Session {
    /// Follows the project once a frame: updates the library and its textures, interpolates the audible texture, and
    /// sends it to the output. Without `heard`, the audible texture is the selected one.
    pub fn follow(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        if self.textures.base != project.library {
            let is_same = self.open_library(project);
            self.textures.columns.clear();
            self.take(project, &is_same);
        }
        let is_same = |(a, b): (&Arc<TextureEntry>, &Arc<TextureEntry>)| Arc::ptr_eq(a, b);
        let n_same =
            self.textures.joined.iter().zip(&project.joined).take_while(|pair| is_same(*pair)).count();
        let has_same_textures = n_same == self.textures.joined.len() && n_same == project.joined.len();
        let has_same_names = self.textures.renamed == project.renamed;
        // A space is large and never modified, so that comparing pointers is sufficient.
        let spaces = (self.textures.used.as_ref(), project.space.as_ref());
        let has_same_space = match spaces {
            (Some(before), Some(now)) => Arc::ptr_eq(before, now),
            (before, now) => before.is_none() && now.is_none(),
        };
        let has_same_own = self.textures.own_ids == project.own;
        let has_same_axes = self.textures.axes == project.axes;
        let has_same_list =
            has_same_textures && has_same_space && self.textures.coordinates == project.coordinates;
        if !has_same_list {
            self.textures.columns.clear();
        }
        if !(has_same_list && has_same_names && has_same_own && has_same_axes) {
            self.take(project, &vec![true; self.textures.opened.n_textures() + n_same]);
        }
        self.follow_space(&heard.unwrap_or(project.texture()).blend);
        if heard.is_some() {
            self.follow_unheard(&project.texture().blend);
        }
        if let Some(outcome) = self.authored.models.collect() {
            let models = match outcome {
                Ok(models) => Some(models),
                Err(reason) => {
                    self.say(reason);
                    None
                }
            };
            if self.authored.spaces.put(models) {
                self.sound.player.wanted = None;
            }
        }
        self.ask_for_models();
        if !self.follow_felt(ctx) {
            self.follow_texture(project, heard, ctx);
        }
        self.sound.player.send_mix(
            &self.sound.heard,
            self.textures.planes_ahead.prepared(),
            self.sound.rate_hz,
        );
    }

    /// Interpolates the audible texture if it has changed.
    fn follow_texture(&mut self, project: &Project, heard: Option<&AuthoredTexture>, ctx: &egui::Context) {
        let has_rate = |model: &TextureModel| model.rate().0 == self.sound.rate_hz;
        let ready = self.authored.audible.collect();
        if let Some(ready) = ready.filter(|ready| ready.authored.model.as_ref().is_none_or(has_rate)) {
            for texture in ready.shaped {
                self.sound.shaped.take(texture, &mut self.authored.n_made);
            }
            self.play(Some(&ready.authored), ready.made);
        }
        let texture = heard.unwrap_or(project.texture());
        self.authored.path_point = self.follow_path(texture.path.as_ref());
        // A path overrides solo.
        let solo = self.solo(project).filter(|_| self.authored.path_point.is_none() && heard.is_none());
        let at = self.fitted(self.authored.path_point.unwrap_or(texture.at));
        let key = self.follow_key(solo);
        let wanted = (at, self.blending(&texture.blend), texture.shape, solo, key);
        if self.sound.player.wanted.as_ref() != Some(&wanted) {
            let is_dragged = heard.is_none() && self.is_dragged(&wanted, ctx);
            self.authored.current = match solo {
                Some(texture) => Some(self.alone(texture, key, at, wanted.1.mode)),
                None => self.shaped_at(at, &wanted.1, &wanted.2),
            };
            self.hear(is_dragged);
            self.sound.player.wanted = Some(wanted);
            // A soloed texture without a position may have another sample rate than the space.
            let alone = solo.filter(|texture| self.textures.places[*texture].is_none());
            self.set_rate(
                alone.map_or(self.textures.space_rate_hz, |texture| self.textures.rates_hz[texture]),
                ctx,
            );
        }
        self.authored.audible.begin(ctx);
    }

    /// Whether this mix is a further step of a drag of the point or of a control of its shape. Outside comparisons and
    /// studies, the previous step may then play a little longer.
    fn is_dragged(&self, wanted: &Wanted, ctx: &egui::Context) -> bool {
        // The frame of the press can bring another texture.
        let is_held = ctx.input(|i| i.pointer.any_down() && !i.pointer.any_pressed());
        let (_, blending, _, solo, _) = wanted;
        let is_step = |(_, before, _, alone, _): &Wanted| before == blending && alone.is_none();
        let is_free = solo.is_none() && self.authored.path_point.is_none() && !self.is_hidden();
        is_held && is_free && self.sound.player.wanted.as_ref().is_some_and(is_step)
    }

    /// Takes over textures, positions and axes from the project. `is_same` states, by index, which models are unchanged
    /// since the last call.
    fn take(&mut self, project: &Project, is_same: &[bool]) {
        self.textures.opened.restore(&mut self.textures.library);
        self.textures.library = project.textures_on(std::mem::take(&mut self.textures.library));
        let axes = project.axes.as_deref();
        let columns = &mut self.textures.columns;
        self.textures.places = list_places(&self.textures.library, axes, columns, &project.coordinates);
        self.textures.own = project.own_textures(self.textures.library.textures.len());
        let rate_before_hz = self.textures.space_rate_hz;
        self.textures.space_rate_hz = self.rate_of_places(project).0;
        let mut is_kept = vec![false; self.textures.places.len()];
        let (mut planes, mut rates_hz) = (Vec::new(), Vec::new());
        for (i, entry) in self.textures.library.textures.iter_mut().enumerate() {
            let mut rate =
                rate_in(entry, self.textures.places[i].as_ref(), Hertz(self.textures.space_rate_hz));
            if is_same.get(i).is_some_and(|is_same| *is_same) && self.textures.rates_hz[i] == rate.0 {
                is_kept[i] = true;
                planes.push(Arc::clone(&self.textures.planes[i]));
            } else {
                let plane = plane_at(entry, rate, &Warnings::default()).unwrap_or_else(|error| {
                    // The texture cannot be interpolated, but it can still be soloed.
                    self.said = Some(Said::new(format!("{error:#}")));
                    self.textures.places[i] = None;
                    if axes.is_none() {
                        entry.place = None;
                    }
                    rate = entry.model.rate();
                    Plane::new(&entry.model)
                });
                planes.push(Arc::new(plane));
            }
            rates_hz.push(rate.0);
        }
        (self.textures.planes, self.textures.rates_hz) = (planes, rates_hz);
        self.textures.planes_ahead.follow(&self.textures.planes, &is_kept);
        self.sound.player.keep(&is_kept);
        // What it makes names textures by their index.
        self.authored.audible.cancel();
        if rate_before_hz != self.textures.space_rate_hz
            || !self.sound.heard.survives(&is_kept, Hertz(self.sound.rate_hz))
        {
            self.sound.heard = Audible::default();
            self.sound.player.mix_is_new = true;
        }
        // Computing a field takes seconds, so it is kept while neither positions nor textures change.
        if self.authored.spaces.forget_changed(&is_kept) {
            self.authored.models.cancel();
        }
        (self.authored.pins, self.authored.unheard) = (None, None);
        self.textures.axis_names = names_of(&self.textures.library, axes);
        self.textures.poles = poles_of(&self.textures.axis_names);
        (self.textures.joined, self.textures.used, self.textures.axes) =
            (project.joined.clone(), project.space.clone(), project.axes.clone());
        self.textures.renamed.clone_from(&project.renamed);
        self.textures.own_ids.clone_from(&project.own);
        self.textures.coordinates.clone_from(&project.coordinates);
        self.sound.player.wanted = None;
        if let Some(felt) = &mut self.sound.felt {
            felt.is_new = true;
        }
    }

    /// Sample rate of the space. With the library's own positions, only textures of the library determine it. Textures that
    /// belong to authored textures never do, so that the others do not change. Textures that do not determine it are
    /// converted to it or left out.
    fn rate_of_places(&self, project: &Project) -> Hertz {
        let is_as_opened = project.space.is_none() && project.axes.is_none();
        let n_opened = self.textures.opened.n_textures();
        let n_deciding = if is_as_opened && self.textures.places[..n_opened].iter().any(Option::is_some) {
            n_opened
        } else {
            self.textures.places.len()
        };
        let places: Vec<Option<Place>> = self.textures.places[..n_deciding]
            .iter()
            .enumerate()
            .map(|(texture, place)| place.filter(|_| !self.textures.own.contains(texture)))
            .collect();
        rate_of_space(&self.textures.library.textures[..n_deciding], &places)
    }

    /// Sets the sample rate of the audible textures in Hz, and reopens the output if it changes.
    pub(super) fn set_rate(&mut self, rate_hz: f64, ctx: &egui::Context) {
        if rate_hz != self.sound.rate_hz {
            self.sound.rate_hz = rate_hz;
            self.sound.spectra = Spectra { frequencies: drawn_frequencies(rate_hz), ..Spectra::default() };
            self.open_output_again(ctx);
        }
    }
}
