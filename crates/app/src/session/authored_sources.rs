//! All authored textures of a project, for an export in the background: they are computed only when they are needed.

use std::sync::{Arc, OnceLock};

use shagreen_core::space::LabelSource;
use shagreen_core::space::authoring::{Authored, Authoring};
use shagreen_core::space::texture_path::UserPath;
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::Track;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project};

use super::Session;
use super::audible::planes_of;
use super::models_worker::Job;
use super::signal::{SignalContext, entry_of, placed};
use crate::state::signal_file::{SignalFile, Sounding};
use crate::strings::export::of_texture;
use crate::strings::signal as strings;

/// Copy of what the authored textures are computed from.
pub(crate) struct AuthoredSources {
    library: Library,
    planes: Vec<Arc<Plane>>,
    stroke: Option<Arc<Track>>,
    model_rate: Hertz,
    contact: Contact,
    /// Names of the axes of all spaces.
    axes: Vec<String>,
    /// The spaces of the textures.
    spaces: Vec<SpaceSource>,
    /// The textures, and the indices of their spaces.
    textures: Vec<(Arc<AuthoredTexture>, usize)>,
}

/// A space of authored textures, with models that are computed when they are needed.
struct SpaceSource {
    authoring: Authoring,
    /// Common source of the positions.
    source: Option<LabelSource>,
    /// What the models are computed from; `None` if they are there.
    job: Option<Job>,
    computed: OnceLock<Result<Authoring, String>>,
}

impl Session {
    /// Sources of all authored textures; their signals are at one contact.
    ///
    /// # Errors
    /// States why there are none: a blind comparison hides them, a signal of the Signals workspace plays, or the models
    /// are still being computed.
    pub(crate) fn authored_sources(
        &self,
        project: &Project,
        contact: Contact,
    ) -> Result<AuthoredSources, String> {
        if self.authored().is_none() {
            return Err(strings::NOTHING.to_owned());
        }
        if self.is_preparing() {
            return Err(strings::PREPARING.to_owned());
        }
        let SignalContext { library, source: _, stroke, model_rate, contact } = self.signal_context(contact);
        let (mut spaces, mut textures) = (Vec::<SpaceSource>::new(), Vec::new());
        for texture in &project.authored {
            let found = self.found(texture);
            let is_its = |known: &SpaceSource| known.authoring.space() == found.authoring.space();
            let index = spaces.iter().position(is_its).unwrap_or(spaces.len());
            if index == spaces.len() {
                let space = found.authoring.space();
                let source = self.source_in(space);
                let job = (!found.is_done).then(|| self.job(space.clone()));
                let authoring = found.authoring.into_owned();
                spaces.push(SpaceSource { authoring, source, job, computed: OnceLock::new() });
            }
            textures.push((Arc::clone(texture), index));
        }
        Ok(AuthoredSources {
            library: library.clone(),
            planes: self.textures.planes.clone(),
            stroke,
            model_rate,
            contact,
            axes: self.axes().to_vec(),
            spaces,
            textures,
        })
    }
}

impl SpaceSource {
    /// Interpolation with models. The first call may compute them.
    fn authoring(&self) -> Result<&Authoring, String> {
        let Some(job) = &self.job else { return Ok(&self.authoring) };
        let computed = self.computed.get_or_init(|| Ok(self.authoring.clone().with_models(job.run()?)));
        computed.as_ref().map_err(Clone::clone)
    }
}

/// Whether a texture has a path that can play.
fn has_path(texture: &AuthoredTexture) -> bool {
    texture.path.as_ref().and_then(UserPath::route).is_some()
}

impl AuthoredSources {
    /// Names of the textures.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.textures.iter().map(|(texture, _)| texture.name.as_str())
    }

    /// Names of the textures with a path.
    pub(crate) fn names_with_paths(&self) -> impl Iterator<Item = &str> {
        let with_paths = self.textures.iter().filter(|(texture, _)| has_path(texture));
        with_paths.map(|(texture, _)| texture.name.as_str())
    }

    /// Signals of the textures, in the order of their names: the blend at each point.
    ///
    /// # Errors
    /// Names a texture that cannot be interpolated.
    pub(crate) fn signals(&self) -> Result<Vec<SignalFile>, String> {
        let signal = |texture: &AuthoredTexture, space: &SpaceSource| {
            let authored = self.authored(texture, space)?;
            let voices = planes_of(&authored, &self.library, &self.planes)?;
            if voices.is_empty() {
                return Err(strings::NO_TEXTURE.to_owned());
            }
            let sounding = Sounding::Mix(voices, authored.mixing());
            let file = self.context(space.source).signal(&authored, sounding, &authored.parents);
            let mut sidecar = placed(file.sidecar, Some(&authored), &self.axes);
            sidecar.name = Some(texture.name.clone());
            Ok(SignalFile { sidecar, ..file })
        };
        self.each(signal)
    }

    /// Library entries of the textures, in the order of their names.
    ///
    /// # Errors
    /// Names a texture that has no model, or whose model no file can hold.
    pub(crate) fn entries(&self) -> Result<Vec<TextureEntry>, String> {
        self.each(|texture, space| entry_of(&self.library, &texture.name, &self.authored(texture, space)?))
    }

    /// Results for all textures, or the first error with the name of its texture.
    fn each<T>(
        &self,
        of: impl Fn(&AuthoredTexture, &SpaceSource) -> Result<T, String>,
    ) -> Result<Vec<T>, String> {
        let named = |(texture, space): &(Arc<AuthoredTexture>, usize)| {
            of(texture, &self.spaces[*space]).map_err(|reason| of_texture(&texture.name, &reason))
        };
        self.textures.iter().map(named).collect()
    }

    fn authored(&self, texture: &AuthoredTexture, space: &SpaceSource) -> Result<Authored, String> {
        let authoring = space.authoring()?;
        let blend = texture.blend.in_space(authoring.space().n_axes());
        let blending = blend.blending(|id| self.library.index_of(id));
        let authored = authoring.author(texture.at, &blending);
        let authored = authored.ok_or_else(|| strings::NO_TEXTURE.to_owned())?;
        authored.shaped(&texture.shape).map_err(|error| error.to_string())
    }

    fn context(&self, source: Option<LabelSource>) -> SignalContext<'_> {
        SignalContext {
            library: &self.library,
            source,
            stroke: self.stroke.clone(),
            model_rate: self.model_rate,
            contact: self.contact,
        }
    }
}
