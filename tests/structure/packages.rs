//! The files of the packages agree with each other, and continuous integration calls scripts that exist.

use std::path::Path;

use shagreen_studio::doctor::KNOWN_LIBRARIES;

fn read(name: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The value of a key of a desktop entry.
fn value<'a>(entry: &'a str, key: &str) -> &'a str {
    let found = entry.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix('='));
    found.expect("the desktop entry has this key")
}

/// The text between two marks of a file.
fn between<'a>(text: &'a str, before: &str, after: &str) -> &'a str {
    let rest = text.split_once(before).map(|(_, rest)| rest).expect("the first mark");
    rest.split_once(after).map(|(inner, _)| inner).expect("the second mark")
}

#[test]
fn the_files_of_the_packages_agree() {
    let entry = read("assets/package/shagreen.desktop");
    let (mime, metainfo) =
        (read("assets/package/shagreen.mime.xml"), read("assets/package/shagreen.metainfo.xml"));
    let kind = between(&mime, "<mime-type type=\"", "\"");
    assert_eq!(value(&entry, "MimeType"), format!("{kind};"));
    assert_eq!(between(&metainfo, "<mediatype>", "</mediatype>"), kind);
    assert_eq!(between(&mime, "<glob pattern=\"", "\""), "*.shagreen");
    assert_eq!(value(&entry, "Exec"), "shagreen %f");
    assert_eq!((value(&entry, "Icon"), value(&entry, "StartupWMClass")), ("shagreen", "shagreen"));
    assert_eq!(between(&metainfo, "<binary>", "</binary>"), "shagreen");
    assert_eq!(between(&metainfo, "type=\"desktop-id\">", "<"), "shagreen.desktop");
    // The id and the makers are stated there only.
    let (script, id) = (read("scripts/package"), between(&metainfo, "<id>", "</id>"));
    let makers = between(between(&metainfo, "<developer", "</developer>"), "<name>", "</name>");
    assert!(script.contains("/$id.metainfo.xml") && script.contains("Maintainer: $maker <"));
    assert!(!script.contains(id) && !script.contains(makers), "{id}, {makers}");
    assert!(read("crates/app/src/lib.rs").contains("with_app_id(\"shagreen\")"), "the class of the window");
    // The magic of the file type is what projects begin with.
    let project = read("assets/gallery/kitchen.shagreen");
    let magic = between(&mime, "value=\"", "\"").replace("&quot;", "\"");
    assert!(project[..64 + magic.len()].contains(&magic), "{magic}");
}

#[test]
fn the_package_recommends_what_the_window_loads() {
    let script = read("scripts/package");
    let recommended: Vec<&str> = between(&script, "\nRecommends: ", "\n").split(", ").collect();
    for library in KNOWN_LIBRARIES {
        assert!(recommended.contains(&library.package), "{}", library.package);
    }
}

/// Runs a shell script. Returns what it prints.
#[cfg(target_os = "linux")]
fn output_of(script: &Path, arguments: &[&str], folder: &Path) -> String {
    // By name, because a file that a test has just written may not be executed yet.
    let mut command = std::process::Command::new("bash");
    let output = command.arg(script).args(arguments).current_dir(folder).env("DPKG_ROOT", folder).output();
    let output = output.expect("the script starts");
    assert!(output.status.success(), "{}: {output:?}", script.display());
    String::from_utf8(output.stdout).expect("UTF-8")
}

#[cfg(target_os = "linux")]
#[test]
fn the_script_of_the_package_does_nothing_in_another_root_folder() {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/package/apply-pen-rule");
    let folder = tempfile::tempdir().expect("a folder");
    for arguments in [&["configure", ""][..], &["remove"], &["purge"], &["abort-install"]] {
        assert_eq!(output_of(&script, arguments, folder.path()), "", "{arguments:?}");
    }
}

/// The archive for other Linux systems, unpacked in a folder with a space, installs into another and removes itself.
#[cfg(target_os = "linux")]
#[test]
fn the_archive_installs_and_removes_its_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let unpacked = folder.path().join("un packed");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copy = |from: &str, to: &str| {
        let to = unpacked.join(to);
        std::fs::create_dir_all(to.parent().expect("it is in a folder")).expect("a folder");
        std::fs::copy(root.join(from), to).expect("a copy");
    };
    copy("scripts/install-from-folder", "install");
    copy("assets/package/shagreen.desktop", "share/applications/shagreen.desktop");
    copy("assets/package/shagreen.mime.xml", "share/mime/packages/shagreen.xml");
    copy("assets/package/apply-pen-rule", "bin/shagreen");
    // A relative prefix is one of the folder in which the person is.
    output_of(&unpacked.join("install"), &["own prefix"], folder.path());
    let prefix = folder.path().join("own prefix");
    let entry = std::fs::read_to_string(prefix.join("share/applications/shagreen.desktop"));
    let program = prefix.join("bin/shagreen");
    assert_eq!(value(&entry.expect("a menu entry"), "Exec"), format!("\"{}\" %f", program.display()));
    assert!(program.is_file() && prefix.join("share/mime/packages/shagreen.xml").is_file());
    output_of(&unpacked.join("install"), &["--remove", "own prefix"], folder.path());
    for file in ["bin", "share/applications/shagreen.desktop", "share/mime/packages/shagreen.xml"] {
        assert!(!prefix.join(file).exists(), "{file}");
    }
    assert!(unpacked.join("bin/shagreen").is_file());
}

/// Vendors that make tablets only: a rule for a vendor of keyboards would let every program read them.
const VENDORS: [&str; 5] = ["056a", "256c", "28bd", "5543", "172f"];

#[test]
fn the_package_permits_tablets_only() {
    let rules = read("assets/package/70-shagreen-pens.rules");
    let rules: Vec<&str> = rules.lines().filter(|line| !line.starts_with('#')).collect();
    for rule in &rules {
        assert!(rule.starts_with("KERNEL==\"hidraw*\", ") && rule.ends_with(", TAG+=\"uaccess\""), "{rule}");
        let lower = rule.to_lowercase();
        assert!(VENDORS.iter().any(|vendor| lower.contains(vendor)), "{rule}");
    }
    assert!(rules.len() >= VENDORS.len());
}

/// Commands of the steps of a workflow.
fn commands(workflow: &str) -> impl Iterator<Item = &str> {
    workflow.lines().filter_map(|line| line.trim().strip_prefix("- run: "))
}

/// Returns the scripts that a workflow calls and that are missing. Other commands than scripts are only those that
/// install the toolchain.
fn problems(workflow: &str) -> Vec<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let problem = |command: &str| {
        let program = command.split_whitespace().next().unwrap_or_default();
        let is_ours = program.starts_with("scripts/") || program.starts_with("./");
        if is_ours && !root.join(program).is_file() {
            return Some(format!("{program} does not exist"));
        }
        (!is_ours && !command.starts_with("rustup ")).then(|| format!("{command} is no script"))
    };
    commands(workflow).filter_map(problem).collect()
}

#[test]
fn continuous_integration_calls_scripts_that_run_here_too() {
    for name in ["check", "release"] {
        let workflow = read(&format!(".github/workflows/{name}.yml"));
        assert!(commands(&workflow).count() > 3, "{name} has no steps");
        assert!(problems(&workflow).is_empty(), "{name}: {:?}", problems(&workflow));
    }
}

/// Negative control.
#[test]
fn a_step_that_is_no_script_is_found() {
    let workflow = "steps:\n  - run: ./test\n  - run: scripts/none\n  - run: cargo build\n";
    assert_eq!(problems(workflow), ["scripts/none does not exist", "cargo build is no script"]);
}
