//! Facts about the machine.

use std::path::PathBuf;

use shagreen_device::error::DeviceError;
use shagreen_device::hid::identity::HidPen;
use shagreen_device::operating_system::OperatingSystem;
use shagreen_device::output::OutputInfo;
use shagreen_device::pen_backend::Access;
use shagreen_device::serial::SerialPortInfo;
use shagreen_device::sound_server::SoundServer;
use shagreen_device::stylus::StylusList;

/// Facts about the machine. No device plays, and whatever is made to find them is removed again.
#[derive(Clone, Debug)]
pub struct Facts {
    /// Operating system.
    pub system: OperatingSystem,
    /// Sound server of the session.
    pub sound_server: SoundServer,
    /// Outputs.
    pub outputs: Vec<OutputInfo>,
    /// Ids of audio outputs that the system does not open, with the reasons.
    pub refused_outputs: Vec<(String, DeviceError)>,
    /// Haptic pens, which are outputs too.
    pub haptic_pens: Vec<HidPen>,
    /// Number of audio inputs of devices, without the monitors of outputs.
    pub n_inputs: usize,
    /// Ids of those inputs that the system does not open, with the reasons.
    pub refused_inputs: Vec<(String, DeviceError)>,
    /// Whether threads of this program get real-time priority.
    pub has_priority: bool,
    /// Mouse and pens.
    pub styluses: StylusList,
    /// Serial ports with permissions, or the reason why they cannot be listed.
    pub serial_ports: Result<Vec<(SerialPortInfo, Access)>, String>,
    /// Displays that the environment names.
    pub displays: DisplayFacts,
    /// Device files of graphics cards with permissions (Linux).
    pub graphics_cards: Vec<(String, Access)>,
    /// Those of [`KNOWN_LIBRARIES`](super::KNOWN_LIBRARIES) that are installed; `None` if this is unknown.
    pub libraries: Option<Vec<String>>,
    /// Whether the session has a message bus and a portal, by which the desktop shows file dialogs.
    pub has_portal: bool,
    /// Whether the program zenity is installed, which offers file dialogs too.
    pub has_zenity: bool,
    /// Folders in which this program keeps files.
    pub folders: Vec<FolderFact>,
    /// Networks of the user.
    pub networks: NetworkFacts,
}

/// Displays that the environment names. On systems other than Linux, the window system needs no name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DisplayFacts {
    /// X11 display.
    pub x11: DisplayFact,
    /// Wayland display, which the window prefers.
    pub wayland: DisplayFact,
}

/// A display that the environment may name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DisplayFact {
    /// The environment names none.
    Unset,
    /// It accepts connections.
    Responds,
    /// It accepts none.
    Silent,
    /// It is on another computer, and was not tried.
    Untried,
}

impl DisplayFact {
    /// Whether the environment names it.
    pub fn is_named(self) -> bool {
        self != Self::Unset
    }
}

/// A folder in which this program keeps files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FolderFact {
    /// Content of the folder.
    pub content: &'static str,
    /// Its path; `None` without a home folder.
    pub path: Option<PathBuf>,
    /// Permission to make it and to write in it.
    pub access: Access,
}

/// Networks of the user, or why they cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NetworkFacts {
    /// Name of the network that sees pictures, if it was downloaded.
    pub pictures: Result<Option<String>, String>,
    /// Name of the registered diffusion model.
    pub diffusion: Result<Option<String>, String>,
}
