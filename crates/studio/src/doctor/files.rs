//! Folders and networks of the user.

use super::{Facts, FolderFact, Line, State};

/// Lines about folders and networks.
pub(super) fn lines(facts: &Facts) -> Vec<Line> {
    let mut lines: Vec<Line> = facts.folders.iter().map(folder).collect();
    lines.push(network(
        "image network",
        &facts.networks.pictures,
        "there is none; predictions from photos use statistics of the picture; `shagreen model fetch` downloads one",
        "fetch it again with `shagreen model fetch`",
    ));
    lines.push(network(
        "diffusion model",
        &facts.networks.diffusion,
        "there is none; pictures are drawn procedurally; `shagreen model add FOLDER` registers one",
        "register it again with `shagreen model add FOLDER`",
    ));
    lines
}

fn folder(folder: &FolderFact) -> Line {
    let topic = "folders";
    let content = folder.content;
    let Some(path) = &folder.path else {
        return Line::new(
            topic,
            State::Limited,
            format!("there is no home folder for {content}; nothing is kept"),
        )
        .with("set the environment variable HOME to your home folder");
    };
    let path = path.display();
    if folder.access.may_open() {
        return Line::new(topic, State::Works, format!("{content}: {path}"));
    }
    Line::new(topic, State::Fails, format!("{content} cannot be written to {path}"))
        .with("make the folder writable for you, free it from a read-only file system, or set HOME to your home folder")
}

fn network(topic: &'static str, found: &Result<Option<String>, String>, absent: &str, remedy: &str) -> Line {
    match found {
        Ok(Some(name)) => Line::new(topic, State::Works, name),
        Ok(None) => Line::new(topic, State::Absent, absent),
        Err(reason) => Line::new(topic, State::Fails, reason).with(remedy),
    }
}
