//! All authored textures of a project, for an export in the background: they are computed only when they are needed.

use std::sync::Arc;

use shagreen_core::space::LabelSource;
use shagreen_core::space::authoring::{Authored, Authoring};
use shagreen_core::texture::plane::Plane;
use shagreen_core::units::{Contact, Hertz};
use shagreen_device::track::Track;
use shagreen_formats::library::{Library, TextureEntry};
use shagreen_formats::project::{AuthoredTexture, Project};

use super::Session;
use super::audible::plane_of;
use super::signal::{SignalContext, entry_of, placed};
use crate::state::signal_file::{SignalFile, Sounding};
use crate::strings::export::of_texture;
use crate::strings::signal as strings;

/// Copy of what the authored textures are computed from.
pub(crate) struct AuthoredSources {
    authoring: Authoring,
    library: Library,
    planes: Vec<Arc<Plane>>,
    source: Option<LabelSource>,
    stroke: Option<Arc<Track>>,
    model_rate: Hertz,
    contact: Contact,
    textures: Vec<Arc<AuthoredTexture>>,
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
        let SignalContext { library, source, stroke, model_rate, contact } = self.signal_context(contact);
        Ok(AuthoredSources {
            authoring: self.authoring().clone(),
            library: library.clone(),
            planes: self.textures.planes.clone(),
            source,
            stroke,
            model_rate,
            contact,
            textures: project.authored.clone(),
        })
    }
}

impl AuthoredSources {
    /// Names of the textures.
    pub(crate) fn names(&self) -> impl Iterator<Item = &str> {
        self.textures.iter().map(|texture| texture.name.as_str())
    }

    /// Signals of the textures, in the order of their names: the blend at each point.
    ///
    /// # Errors
    /// Names a texture that cannot be interpolated.
    pub(crate) fn signals(&self) -> Result<Vec<SignalFile>, String> {
        let signal = |texture: &AuthoredTexture| {
            let authored = self.authored(texture)?;
            let plane = |voice| plane_of(voice, &authored.shape, &self.library, &self.planes);
            let voices = authored.voices().into_iter();
            let voices = voices.map(|(voice, share)| plane(voice).map(|plane| (plane, share)));
            let voices: Vec<_> = voices.collect::<Result<_, String>>()?;
            if voices.is_empty() {
                return Err(strings::NO_TEXTURE.to_owned());
            }
            let sounding = Sounding::Mix(voices, authored.mixing());
            let file = self.context().signal(&authored, sounding, &authored.parents);
            let sidecar = placed(file.sidecar, Some(&authored));
            Ok(SignalFile { sidecar, ..file })
        };
        self.each(signal)
    }

    /// Library entries of the textures, in the order of their names.
    ///
    /// # Errors
    /// Names a texture that has no model, or whose model no file can hold.
    pub(crate) fn entries(&self) -> Result<Vec<TextureEntry>, String> {
        self.each(|texture| entry_of(&self.library, &texture.name, &self.authored(texture)?))
    }

    /// Results for all textures, or the first error with the name of its texture.
    fn each<T>(&self, of: impl Fn(&AuthoredTexture) -> Result<T, String>) -> Result<Vec<T>, String> {
        let named =
            |texture: &Arc<AuthoredTexture>| of(texture).map_err(|reason| of_texture(&texture.name, &reason));
        self.textures.iter().map(named).collect()
    }

    fn authored(&self, texture: &AuthoredTexture) -> Result<Authored, String> {
        let blending = texture.blend.blending(|id| self.library.index_of(id));
        let authored = self.authoring.author(texture.at, &blending);
        let authored = authored.ok_or_else(|| strings::NO_TEXTURE.to_owned())?;
        authored.shaped(&texture.shape).map_err(|error| error.to_string())
    }

    fn context(&self) -> SignalContext<'_> {
        SignalContext {
            library: &self.library,
            source: self.source,
            stroke: self.stroke.clone(),
            model_rate: self.model_rate,
            contact: self.contact,
        }
    }
}
