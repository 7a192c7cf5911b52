//! What goes wrong at the edge of the machine.

/// What the caller should do about a [`DeviceError`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DeviceErrorKind {
    /// There is no device of this id now: list the devices and let the person choose another, or plug it in.
    /// Unlike [`Self::Lost`], it was never open.
    NotFound,
    /// Another program holds the device: ask to close it, then try again.
    Busy,
    /// The system refuses access: the person must grant it; trying again does not help.
    Denied,
    /// An open device went away or failed for good. It is silent; open it again when the person asks for it, and
    /// never another in its place.
    Lost,
    /// The device is there but cannot do what was asked: ask for another rate, buffer or channel.
    Unsupported,
    /// The settings contradict themselves: a fault of the caller, to be fixed there.
    Config,
    /// The system of devices (sound server, driver) does not answer: start it, then try again.
    Unavailable,
    /// The person stopped it.
    Canceled,
    /// Anything else that the system reports: show the message; trying again may help.
    Backend,
}

/// What went wrong with a device: a kind to act on and a message to show, with what, where and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct DeviceError {
    kind: DeviceErrorKind,
    message: String,
}

impl DeviceError {
    /// An error of `kind` that reads as `message`.
    pub fn new(kind: DeviceErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    /// What to do about it.
    pub fn kind(&self) -> DeviceErrorKind {
        self.kind
    }

    /// What to show.
    pub fn message(&self) -> &str {
        &self.message
    }
}
