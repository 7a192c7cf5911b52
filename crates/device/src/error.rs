//! Errors of devices.

/// Kind of a [`DeviceError`], which determines what the caller should do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum DeviceErrorKind {
    /// No device with this id is present. List the devices and let the person choose another, or plug it in. Unlike
    /// [`Self::Lost`], the device was never open.
    NotFound,
    /// Another program uses the device. Ask the person to close that program, then try again.
    Busy,
    /// Another Shagreen plays on the output. Ask the person whether to take it over.
    Claimed,
    /// The system refuses access. The person must grant it; trying again does not help.
    Denied,
    /// An open device was disconnected or failed permanently. It is silent. Reopen it when the person requests it, and
    /// never open another device instead.
    Lost,
    /// The device does not support the request. Use another rate, buffer size or channel.
    Unsupported,
    /// The settings are contradictory: a bug in the caller.
    Config,
    /// The system service or driver does not respond. Start it, then try again.
    Unavailable,
    /// The person canceled the operation.
    Canceled,
    /// Any other error that the system reports. Show the message; trying again may help.
    Backend,
}

/// Error of a device: a kind to act on, and a message that says what is wrong, where, and what to do.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{message}")]
pub struct DeviceError {
    kind: DeviceErrorKind,
    message: String,
}

impl DeviceError {
    /// An error of `kind` with the text `message`.
    pub fn new(kind: DeviceErrorKind, message: impl Into<String>) -> Self {
        Self { kind, message: message.into() }
    }

    /// Kind of the error.
    pub fn kind(&self) -> DeviceErrorKind {
        self.kind
    }

    /// Text to show.
    pub fn message(&self) -> &str {
        &self.message
    }
}
