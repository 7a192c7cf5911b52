//! State of the sound server of this session; [`crate::output::sound_server`] asks for it.

/// State of the sound server.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SoundServer {
    /// It responds, under this name and version.
    Responds(String),
    /// None runs here.
    Missing,
    /// It does not respond as it should, for this reason.
    Fails(String),
    /// The sound system of this operating system has no server that programs talk to.
    Unused,
}
