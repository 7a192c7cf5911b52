//! A project file that another window or program changed after it was read: the differences, by texture.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use shagreen_formats::project::{AuthoredTexture, Project};

use crate::choices::conflict::{Change, Part};

/// Project file that changed since it was read.
#[derive(Debug)]
pub struct Conflict {
    /// Path of the file.
    pub path: PathBuf,
    /// SHA-256 of its present content.
    pub sha256: String,
    /// Differences between the open project, the file, and the project as it was read; `None` if the file is no project
    /// any more.
    pub differences: Option<Vec<Difference>>,
}

/// One difference.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What differs.
    pub part: Part,
    /// How it was changed.
    pub change: Change,
}

/// Compares the open project (`here`) and the one in the file (`there`) with the one that was read (`base`). Without
/// `base`, every difference is one of both sides.
pub(crate) fn differences(base: Option<&Project>, here: &Project, there: &Project) -> Vec<Difference> {
    let empty = BTreeMap::new();
    let (of_base, of_here, of_there) = (base.map(by_key), by_key(here), by_key(there));
    let of_base = of_base.as_ref().unwrap_or(&empty);
    let keys: std::collections::BTreeSet<u32> = of_here.keys().chain(of_there.keys()).copied().collect();
    let texture = |key: u32| {
        let [base, here, there] = [of_base, &of_here, &of_there].map(|all| all.get(&key).copied());
        let part = Part::Texture(here.or(there)?.name.clone());
        let change = match (here, there) {
            (Some(here), Some(there)) if here == there => return None,
            (Some(here), None) if base == Some(here) => Change::RemovedThere,
            (Some(_), None) if base.is_none() => Change::AddedHere,
            (None, Some(there)) if base == Some(there) => Change::RemovedHere,
            (None, Some(_)) if base.is_none() => Change::AddedThere,
            (here, there) => changed(base.as_ref(), here.as_ref(), there.as_ref()),
        };
        Some(Difference { part, change })
    };
    let mut all: Vec<Difference> = keys.into_iter().filter_map(texture).collect();
    let mut add =
        |part: Part, change: Option<Change>| all.extend(change.map(|change| Difference { part, change }));
    add(
        Part::Library,
        compared(base, here, there, |p| (&p.library, &p.joined, &p.own, &p.coordinates, &p.renamed)),
    );
    add(Part::Space, compared(base, here, there, |p| (&p.space, &p.axes)));
    add(Part::Notes, compared(base, here, there, |p| &p.notes));
    add(Part::Snapshots, compared(base, here, there, |p| &p.snapshots));
    add(Part::Other, compared(base, here, there, |p| (&p.starred, &p.compared, &p.unknown, order(p))));
    all
}

/// Keys of the authored textures, in the order of the list.
fn order(project: &Project) -> Vec<u32> {
    project.authored.iter().map(|texture| texture.key).collect()
}

fn by_key(project: &Project) -> BTreeMap<u32, &Arc<AuthoredTexture>> {
    project.authored.iter().map(|texture| (texture.key, texture)).collect()
}

/// How a part was changed, or `None` if both sides are equal.
fn compared<'a, T: PartialEq>(
    base: Option<&'a Project>,
    here: &'a Project,
    there: &'a Project,
    part: impl Fn(&'a Project) -> T,
) -> Option<Change> {
    let (here, there) = (part(here), part(there));
    (here != there).then(|| changed(base.map(part).as_ref(), Some(&here), Some(&there)))
}

/// How something was changed that differs between both sides.
fn changed<T: PartialEq>(base: Option<&T>, here: Option<&T>, there: Option<&T>) -> Change {
    if base.is_some() && base == there {
        Change::Here
    } else if base.is_some() && base == here {
        Change::There
    } else {
        Change::Both
    }
}

#[cfg(test)]
mod tests {
    use super::differences;
    use crate::choices::conflict::{Change, Part};
    use crate::state::edit::{Edit, edited};
    use shagreen_formats::built_in::BuiltIn;
    use shagreen_formats::project::{AuthoredTexture, Project, ProjectLibrary};
    use std::sync::Arc;

    fn with(project: &Project, key: u32, name: &str) -> Project {
        let mut project = project.clone();
        project.authored.push(Arc::new(AuthoredTexture::new(key, name)));
        project
    }

    fn without(project: &Project, key: u32) -> Project {
        let mut project = project.clone();
        project.authored.retain(|texture| texture.key != key);
        project
    }

    #[test]
    fn each_texture_is_compared_with_what_was_read() {
        let base = Project::new(ProjectLibrary::BuiltIn(BuiltIn::Starter), "Oak");
        let base = with(&with(&base, 2, "Pine"), 3, "Fir");
        let renamed = |name: &str| edited(&base, Edit::Rename(name.to_owned()));
        let found = |here: &Project, there: &Project| -> Vec<(Part, Change)> {
            differences(Some(&base), here, there).into_iter().map(|d| (d.part, d.change)).collect()
        };
        let texture = |name: &str, change| vec![(Part::Texture(name.to_owned()), change)];
        // The order of the list differs too where a texture was added or deleted.
        let found = |here: &Project, there: &Project| {
            found(here, there).into_iter().filter(|(part, _)| *part != Part::Other).collect::<Vec<_>>()
        };
        assert_eq!(found(&base, &base), []);
        assert_eq!(found(&renamed("Elm"), &base), texture("Elm", Change::Here));
        assert_eq!(found(&base, &renamed("Elm")), texture("Oak", Change::There));
        assert_eq!(found(&renamed("Elm"), &renamed("Ash")), texture("Elm", Change::Both));
        assert_eq!(found(&renamed("Elm"), &renamed("Elm")), []);
        assert_eq!(found(&with(&base, 9, "New"), &base), texture("New", Change::AddedHere));
        assert_eq!(found(&base, &with(&base, 9, "New")), texture("New", Change::AddedThere));
        assert_eq!(found(&without(&base, 2), &base), texture("Pine", Change::RemovedHere));
        assert_eq!(found(&base, &without(&base, 2)), texture("Pine", Change::RemovedThere));
        let noted = edited(&base, Edit::SetProjectNotes("mine".to_owned()));
        assert_eq!(found(&noted, &base), [(Part::Notes, Change::Here)]);
        // A recovered project does not know what was read.
        let unknown = differences(None, &renamed("Elm"), &base);
        assert_eq!(unknown[0].change, Change::Both);
    }
}
