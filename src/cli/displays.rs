//! Displays that the environment names, and whether they respond.

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use shagreen_studio::doctor::{DisplayFact, DisplayFacts};

/// Folder of the sockets of X11 displays.
const X11_FOLDER: &str = "/tmp/.X11-unix";

/// Tries the displays that the environment names.
pub(crate) fn displays() -> DisplayFacts {
    DisplayFacts { x11: x11(), wayland: wayland() }
}

/// Value of an environment variable that is not empty.
pub(crate) fn value_of(variable: &str) -> Option<OsString> {
    std::env::var_os(variable).filter(|value| !value.is_empty())
}

/// The X11 display that the environment names.
fn x11() -> DisplayFact {
    value_of("DISPLAY").map_or(DisplayFact::Unset, |name| match x11_socket(&name.to_string_lossy()) {
        Some(socket) => responding(&socket),
        None => DisplayFact::Untried,
    })
}

/// Socket of an X11 display of this computer, such as `:1.0` or `unix:1`; `None` for one on the network.
fn x11_socket(name: &str) -> Option<PathBuf> {
    let number = name.strip_prefix("unix").unwrap_or(name).strip_prefix(':')?;
    let number = number.split('.').next()?;
    Some(Path::new(X11_FOLDER).join(format!("X{number}")))
}

/// The Wayland display that the environment names: a path, or a name in the folder of the session.
fn wayland() -> DisplayFact {
    value_of("WAYLAND_DISPLAY").map_or(DisplayFact::Unset, |name| {
        let folder = value_of("XDG_RUNTIME_DIR").map_or(PathBuf::from("/"), PathBuf::from);
        responding(&folder.join(name))
    })
}

/// Whether a display accepts connections at this socket.
fn responding(socket: &Path) -> DisplayFact {
    #[cfg(target_os = "linux")]
    {
        use std::os::linux::net::SocketAddrExt as _;
        use std::os::unix::ffi::OsStrExt as _;
        use std::os::unix::net::{SocketAddr, UnixStream};
        // Some servers listen at the same name without a file only.
        let without_file = || {
            let address = SocketAddr::from_abstract_name(socket.as_os_str().as_bytes())?;
            UnixStream::connect_addr(&address)
        };
        let connection = UnixStream::connect(socket).or_else(|_| without_file());
        if connection.is_ok() { DisplayFact::Responds } else { DisplayFact::Silent }
    }
    #[cfg(not(target_os = "linux"))]
    {
        let _ = socket;
        DisplayFact::Untried
    }
}

#[cfg(test)]
mod tests {
    #[cfg(target_os = "linux")]
    use super::{DisplayFact, responding};
    use super::{Path, x11_socket};

    #[test]
    fn displays_of_this_computer_are_found_by_their_name() {
        for (name, socket) in [(":0", "X0"), (":12.1", "X12"), ("unix:3", "X3")] {
            assert_eq!(x11_socket(name).unwrap(), Path::new("/tmp/.X11-unix").join(socket), "{name}");
        }
        for name in ["localhost:10.0", "example.org:0", "unix", "nonsense"] {
            assert_eq!(x11_socket(name), None, "{name}");
        }
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn a_display_responds_if_something_listens() {
        let folder = tempfile::tempdir().unwrap();
        let socket = folder.path().join("wayland-0");
        assert_eq!(responding(&socket), DisplayFact::Silent);
        let _display = std::os::unix::net::UnixListener::bind(&socket).unwrap();
        assert_eq!(responding(&socket), DisplayFact::Responds);
    }
}
