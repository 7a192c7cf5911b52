//! Facts about this machine for `shagreen doctor`.

use std::path::{Path, PathBuf};

use directories::ProjectDirs;
use shagreen_device::audio_input::{list_inputs, list_refused_inputs};
use shagreen_device::haptic_pen;
use shagreen_device::operating_system::OperatingSystem;
use shagreen_device::output::{list_outputs, list_refused_outputs, sound_server};
use shagreen_device::pen_backend::Access;
use shagreen_device::serial::{SerialPortInfo, list_serial_ports};
use shagreen_device::stylus::list_styluses;
use shagreen_device::urgency;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_studio::doctor::{Facts, FolderFact, KNOWN_LIBRARIES, NetworkFacts};
use shagreen_studio::file::one_line;

use crate::cli::displays::{displays, value_of};
use crate::cli::model_folder::model_folder;
use crate::cli::own_folder::own_folder;

/// List of the libraries that the system has found.
const LIBRARY_CACHE: &str = "/etc/ld.so.cache";
/// Folders of libraries on systems without that list.
const LIBRARY_FOLDERS: [&str; 6] =
    ["/lib", "/usr/lib", "/lib64", "/usr/lib64", "/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu"];
/// File by which a message bus starts the portal of the desktop, in a folder of data.
const PORTAL_FILE: &str = "dbus-1/services/org.freedesktop.portal.Desktop.service";
/// Folder of the device files of graphics cards.
const GRAPHICS_FOLDER: &str = "/dev/dri";

/// Gathers the facts. No device plays, and the folders and files of a trial are removed again.
pub(crate) fn facts() -> Facts {
    let ports = list_serial_ports().map_err(|error| error.message().to_owned());
    let with_access = |ports: Vec<_>| {
        let access = |port: SerialPortInfo| {
            let access = Access::to_file(&port.port);
            (port, access)
        };
        ports.into_iter().map(access).collect()
    };
    Facts {
        system: OperatingSystem::HERE,
        sound_server: sound_server(),
        outputs: list_outputs(),
        refused_outputs: list_refused_outputs(),
        // A system that cannot list its devices has no haptic pen to play on.
        haptic_pens: haptic_pen::system::list().unwrap_or_default(),
        n_inputs: list_inputs().iter().filter(|input| input.monitor_of.is_none()).count(),
        refused_inputs: list_refused_inputs(),
        has_priority: urgency::is_granted(),
        styluses: list_styluses(),
        serial_ports: ports.map(with_access),
        displays: displays(),
        graphics_cards: graphics_cards(),
        libraries: libraries(),
        has_portal: has_portal(),
        has_zenity: folders_of("PATH").iter().any(|folder| folder.join("zenity").is_file()),
        folders: folders(),
        networks: networks(),
    }
}

/// Folders of an environment variable that lists some.
fn folders_of(variable: &str) -> Vec<PathBuf> {
    std::env::var_os(variable).map_or(Vec::new(), |folders| std::env::split_paths(&folders).collect())
}

fn graphics_cards() -> Vec<(String, Access)> {
    let entries = std::fs::read_dir(GRAPHICS_FOLDER).into_iter().flatten().flatten();
    let names = entries.filter_map(|entry| entry.file_name().into_string().ok()); // Others are not ours.
    let mut cards: Vec<String> = names
        .filter(|name| name.starts_with("renderD"))
        .map(|name| format!("{GRAPHICS_FOLDER}/{name}"))
        .collect();
    cards.sort();
    cards
        .into_iter()
        .map(|card| {
            let access = Access::to_file(&card);
            (card, access)
        })
        .collect()
}

/// The installed ones of the known libraries; `None` if the system has no list, and they are not in the usual folders.
fn libraries() -> Option<Vec<String>> {
    let cache = bounded_file::read(Path::new(LIBRARY_CACHE), FileKind::Small).ok(); // Some systems have none.
    let folders: Vec<PathBuf> =
        folders_of("LD_LIBRARY_PATH").into_iter().chain(LIBRARY_FOLDERS.map(PathBuf::from)).collect();
    let is_installed = |file: &str| {
        cache.as_deref().is_some_and(|cache| names_file(cache, file))
            || folders.iter().any(|folder| folder.join(file).exists())
    };
    let files = KNOWN_LIBRARIES.iter().map(|library| library.file);
    let installed: Vec<String> = files.filter(|file| is_installed(file)).map(str::to_owned).collect();
    (cache.is_some() || installed.len() == KNOWN_LIBRARIES.len()).then_some(installed)
}

/// Whether the list of libraries contains the name of a file, which ends with a zero there.
fn names_file(cache: &[u8], file: &str) -> bool {
    let name = [file.as_bytes(), &[0]].concat();
    cache.windows(name.len()).any(|window| window == name)
}

/// Whether the session has a message bus, and the desktop a portal that the bus starts.
fn has_portal() -> bool {
    let runtime = value_of("XDG_RUNTIME_DIR").map(PathBuf::from);
    let has_bus = value_of("DBUS_SESSION_BUS_ADDRESS").is_some()
        || runtime.is_some_and(|folder| folder.join("bus").exists());
    let listed = folders_of("XDG_DATA_DIRS");
    let usual = ["/usr/local/share", "/usr/share"].map(PathBuf::from);
    let folders = if listed.is_empty() { &usual[..] } else { &listed[..] };
    has_bus && folders.iter().any(|folder| folder.join(PORTAL_FILE).is_file())
}

fn folders() -> Vec<FolderFact> {
    let folders = ProjectDirs::from("", "", "shagreen");
    let settings = folders.as_ref().map(|folders| folders.config_dir().to_owned());
    let state =
        folders.as_ref().map(|folders| folders.state_dir().unwrap_or(folders.data_local_dir()).to_owned());
    [("settings", settings), ("unsaved work", state), ("networks and libraries", own_folder())]
        .into_iter()
        .map(|(content, path)| FolderFact {
            content,
            access: path.as_deref().map_or(Access::Unknown, access_to_folder),
            path,
        })
        .collect()
}

/// Whether a folder can be made and a file be written in it. Both are tried, because permissions do not say it for the
/// administrator and for special file systems; what the trial makes, it removes again.
fn access_to_folder(folder: &Path) -> Access {
    let mut missing: Vec<&Path> = folder.ancestors().take_while(|folder| !folder.is_dir()).collect();
    missing.reverse();
    let mut made: Vec<&Path> = Vec::new();
    let is_made = missing.into_iter().all(|folder| match std::fs::create_dir(folder) {
        Ok(()) => {
            made.push(folder);
            true
        }
        // Another program may have made it at this moment.
        Err(_) => folder.is_dir(),
    });
    let is_writable = is_made && tempfile::NamedTempFile::new_in(folder).is_ok();
    for folder in made.into_iter().rev() {
        std::fs::remove_dir(folder).ok(); // Another program keeps something in it by now.
    }
    if is_writable { Access::Granted } else { Access::Denied }
}

fn networks() -> NetworkFacts {
    let folder = match model_folder() {
        Ok(folder) => folder,
        Err(error) => {
            let reason = one_line(&error);
            return NetworkFacts { pictures: Err(reason.clone()), diffusion: Err(reason) };
        }
    };
    let pictures = folder.backbone().map(|found| found.map(|backbone| backbone.kind().name().to_owned()));
    let diffusion = folder.added_diffusion().map(|found| found.map(|added| added.name()));
    NetworkFacts {
        pictures: pictures.map_err(|error| one_line(&error)),
        diffusion: diffusion.map_err(|error| one_line(&error)),
    }
}

#[cfg(test)]
mod tests {
    use super::{Access, Path, access_to_folder, facts, names_file};

    #[test]
    fn the_list_of_libraries_is_searched_for_whole_names() {
        let cache = b"ld.so-1.7\0libX11.so.6\0/usr/lib/libX11.so.6\0";
        assert!(names_file(cache, "libX11.so.6"));
        assert!(!names_file(cache, "libX11.so") && !names_file(cache, "libXi.so.6"));
        assert!(!names_file(b"", "libX11.so.6"));
    }

    #[test]
    fn a_folder_that_is_not_made_yet_is_tried_and_removed_again() {
        let folder = tempfile::tempdir().unwrap();
        assert_eq!(access_to_folder(&folder.path().join("a/b")), Access::Granted);
        assert_eq!(access_to_folder(folder.path()), Access::Granted);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
        let file = folder.path().join("file");
        std::fs::write(&file, "").unwrap();
        assert_eq!(access_to_folder(&file), Access::Denied);
        assert_eq!(access_to_folder(&file.join("a/b")), Access::Denied);
        // Permissions say here that the administrator may write.
        if cfg!(target_os = "linux") {
            assert_eq!(access_to_folder(Path::new("/proc/shagreen")), Access::Denied);
        }
    }

    #[test]
    fn facts_are_gathered_on_any_machine() {
        let facts = facts();
        assert!(!facts.outputs.is_empty() && facts.styluses.styluses.len() >= 2);
        assert_eq!(facts.folders.len(), 3);
    }
}
