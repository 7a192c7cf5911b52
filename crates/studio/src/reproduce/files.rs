//! Files of reproductions: a page, tables and figures of each paper, and an index of all papers in the folder.

use std::path::{Path, PathBuf};

use anyhow::ensure;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::{self, FileKind};
use shagreen_formats::figure::is_figure_csv;
use shagreen_formats::printed_results::Paper;
use shagreen_formats::reproduction_report::{
    FORMAT, ItemCounts, Reproduction, counts_in_report, is_reproduction_csv, is_reproduction_page, page_file,
    reproduction_csv, reproduction_index, reproduction_page, reproduction_report,
};

use crate::figure_files::{figure_files, make, write_together};
use crate::file::ending_of;
use crate::replace::{has_format, refuse_foreign};

/// Name of the index.
const INDEX: &str = "index.md";

/// Checks before the work that the pages of these papers would replace no file of another kind and can be written, and creates
/// the folder.
///
/// # Errors
/// The folder is a file or cannot be created, or a page or report would replace a file of another kind or cannot be written.
pub fn check_reproduction_folder(folder: &Path, papers: &[Paper]) -> anyhow::Result<()> {
    ensure!(
        !folder.exists() || folder.is_dir(),
        "the results are written into a folder, but this is a file; choose another folder: {}",
        folder.display()
    );
    let names = papers.iter().flat_map(|paper| [page_file(*paper), report_file(*paper)]);
    let paths: Vec<PathBuf> = names.chain([INDEX.to_owned()]).map(|name| folder.join(name)).collect();
    paths.iter().try_for_each(|path| check(path))?;
    make(Some(folder))?;
    let paths: Vec<&Path> = paths.iter().map(PathBuf::as_path).collect();
    Ok(atomic::check_all(&paths)?)
}

fn report_file(paper: Paper) -> String {
    format!("{}.json", paper.id())
}

/// Checks that a file would replace none of another kind.
fn check(path: &Path) -> anyhow::Result<()> {
    refuse_foreign(path, "a result of the reproduction", |bytes| match ending_of(path).as_str() {
        "md" => is_reproduction_page(bytes),
        "json" => has_format(bytes, FORMAT),
        "csv" => is_figure_csv(bytes) || is_reproduction_csv(bytes),
        _ => bytes.starts_with(b"<svg"),
    })
}

/// Writes the pages, reports, tables and figures of papers into a folder, all or none, and the index of all papers there. The
/// folder is created if it does not exist. Returns the path of the index.
///
/// # Errors
/// A file would replace one of another kind, or cannot be written.
pub fn write_reproductions(folder: &Path, all: &[Reproduction]) -> anyhow::Result<PathBuf> {
    let mut files: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    for of in all {
        for item in &of.items {
            if let Some(name) = of.table_file(item) {
                files.push((folder.join(name), reproduction_csv(item)));
            }
            for ((_, figure), name) in item.figures.iter().zip(of.figure_names(item)) {
                files.extend(figure_files(folder, &name, figure));
            }
        }
        let mut report = serde_json::to_vec_pretty(&reproduction_report(std::slice::from_ref(of), true))?;
        report.push(b'\n');
        files.push((folder.join(report_file(of.paper)), report));
        files.push((folder.join(of.page_file()), reproduction_page(of).into_bytes()));
    }
    let index = folder.join(INDEX);
    files.push((index.clone(), reproduction_index(all, |paper| earlier(folder, paper)).into_bytes()));
    files.iter().try_for_each(|(path, _)| check(path))?;
    write_together(&files, Some(folder))?;
    Ok(index)
}

/// Counts of a paper whose page lies in the folder; none of them if its report cannot be read, and `None` without a page.
fn earlier(folder: &Path, paper: Paper) -> Option<Vec<ItemCounts>> {
    if !folder.join(page_file(paper)).is_file() {
        return None;
    }
    // The index still links to a page without a report.
    let bytes = bounded_file::read(&folder.join(report_file(paper)), FileKind::Document).ok();
    let report = bytes.and_then(|bytes| serde_json::from_slice::<serde_json::Value>(&bytes).ok());
    Some(report.and_then(|report| counts_in_report(&report, paper)).unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::{check_reproduction_folder, write_reproductions};
    use shagreen_formats::printed_results::{Paper, printed_results};
    use shagreen_formats::reproduction_report::{ReproducedItem, Reproduction};

    fn reproduction(paper: Paper) -> Reproduction {
        let items = printed_results(paper).unwrap().into_iter();
        Reproduction {
            paper,
            items: items.map(|item| ReproducedItem::new(item, "nothing")).collect(),
            command: format!("shagreen reproduce {}", paper.id()),
            seed: 1,
            is_full: false,
            seconds: 0.0,
        }
    }

    #[test]
    fn papers_of_several_runs_stand_in_one_index_and_foreign_files_stay() {
        let bench = tempfile::tempdir().unwrap();
        let folder = bench.path().join("papers");
        check_reproduction_folder(&folder, &Paper::ALL).unwrap();
        assert!(std::fs::read_dir(&folder).unwrap().next().is_none(), "a check writes no file");
        write_reproductions(&folder, &[reproduction(Paper::S0)]).unwrap();
        let index = write_reproductions(&folder, &[reproduction(Paper::S3)]).unwrap();
        let index = std::fs::read_to_string(index).unwrap();
        assert!(index.contains("](S0.md)") && index.contains("](S3.md)") && !index.contains("](S4.md)"));
        // Both have counts, S0 those of its report.
        assert!(
            index.contains("- Table I (section III-B): ") && index.contains("Equal: 0 of 8; "),
            "{index}"
        );
        std::fs::remove_file(folder.join("S0.json")).unwrap();
        let index = write_reproductions(&folder, &[reproduction(Paper::S3)]).unwrap();
        let index = std::fs::read_to_string(index).unwrap();
        assert!(index.contains("](S0.md)") && !index.contains("- Table I (section III-B): "), "{index}");
        let table = std::fs::read_to_string(folder.join("S0-table-1.csv")).unwrap();
        assert!(table.contains("hard-soft, dimension 2"), "{table}");
        // Results may be replaced by newer ones, other files may not.
        write_reproductions(&folder, &[reproduction(Paper::S0)]).unwrap();
        std::fs::write(folder.join("S0-table-1.csv"), "mine").unwrap();
        let error = write_reproductions(&folder, &[reproduction(Paper::S0)]).unwrap_err().to_string();
        assert!(error.contains("would replace a file of another kind"), "{error}");
        std::fs::write(folder.join("S1.md"), "# Mine").unwrap();
        assert!(check_reproduction_folder(&folder, &[Paper::S0]).is_ok());
        assert!(check_reproduction_folder(&folder, &[Paper::S1]).is_err());
        let error = check_reproduction_folder(&folder.join("S1.md"), &[Paper::S0]).unwrap_err().to_string();
        assert!(error.contains("this is a file"), "{error}");
        // A folder that cannot be created is refused before the work.
        let error = check_reproduction_folder(&folder.join("S1.md/in"), &[Paper::S0]).unwrap_err();
        assert!(format!("{error:#}").contains("cannot create the folder"), "{error:#}");
    }
}
