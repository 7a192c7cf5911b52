//! The guide: the pages of `docs/guide`, built into the program, for the window and the command line.
//!
//! A new page is a file there and a line in [`PAGES`], in the order of the table of contents.

/// A page of the guide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GuidePage {
    /// Name of the page's file, without the ending.
    pub id: &'static str,
    /// The page as Markdown.
    pub text: &'static str,
}

macro_rules! page {
    ($id:literal) => {
        GuidePage { id: $id, text: include_str!(concat!("../../../docs/guide/", $id, ".md")) }
    };
}

/// All pages, the table of contents first.
pub static PAGES: [GuidePage; 60] = [
    page!("index"),
    page!("first-steps"),
    page!("terms"),
    page!("troubleshooting"),
    page!("systems"),
    page!("author"),
    page!("window"),
    page!("touch"),
    page!("shape-a-texture"),
    page!("interpolation-modes"),
    page!("more-axes"),
    page!("strokes"),
    page!("compare-textures"),
    page!("pens-and-strokes"),
    page!("paths"),
    page!("scope"),
    page!("projects"),
    page!("find-textures"),
    page!("import-recordings"),
    page!("import-clips"),
    page!("directional-recordings"),
    page!("make-materials"),
    page!("hatt-models"),
    page!("build-a-space"),
    page!("ratings-alone"),
    page!("validate-a-space"),
    page!("judgment-tables"),
    page!("questionnaires"),
    page!("run-a-study"),
    page!("analyze-a-study"),
    page!("prompts-and-photos"),
    page!("predict-attributes"),
    page!("train"),
    page!("train-networks"),
    page!("diffusion-models"),
    page!("outputs-and-actuators"),
    page!("controllers"),
    page!("haptic-pens"),
    page!("calibrate"),
    page!("latency"),
    page!("serial"),
    page!("runtime"),
    page!("signals"),
    page!("codec"),
    page!("quality"),
    page!("fit-a-difference-model"),
    page!("spatial-spectrograms"),
    page!("reliefs"),
    page!("height-maps"),
    page!("exports"),
    page!("export-models"),
    page!("batch"),
    page!("share"),
    page!("render-and-play"),
    page!("evaluate"),
    page!("reproduce"),
    page!("measures"),
    page!("command-line"),
    page!("python"),
    page!("files-and-formats"),
];

impl GuidePage {
    /// Returns the heading of the page.
    pub fn title(&self) -> &'static str {
        self.text.lines().next().unwrap_or_default().trim_start_matches('#').trim()
    }

    /// Returns the ids of the pages that this page links to.
    pub fn links(&self) -> impl Iterator<Item = &'static str> {
        self.text.split("](").skip(1).filter_map(|rest| {
            let target = rest.split([')', '#']).next()?.strip_suffix(".md")?;
            PAGES.iter().find(|page| page.id == target).map(|page| page.id)
        })
    }
}

/// Returns the page with this id, which may end in `.md` as in a link.
pub fn page(id: &str) -> Option<&'static GuidePage> {
    let id = id.strip_suffix(".md").unwrap_or(id);
    PAGES.iter().find(|page| page.id == id)
}

#[cfg(test)]
mod tests {
    use super::{PAGES, page};
    use std::collections::BTreeSet;
    use std::path::Path;

    /// Every file is a page, every page a file, and the table of contents leads to all of them.
    #[test]
    fn the_guide_is_whole() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide");
        let files = std::fs::read_dir(folder).unwrap().map(|file| file.unwrap().path());
        let files: BTreeSet<String> =
            files.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
        let pages: BTreeSet<String> = PAGES.iter().map(|page| page.id.to_owned()).collect();
        assert_eq!(files, pages);
        let listed: BTreeSet<&str> = page("index").unwrap().links().chain(["index"]).collect();
        assert_eq!(listed.len(), PAGES.len(), "the table of contents lacks a page");
        for page in &PAGES {
            assert!(page.text.starts_with("# ") && !page.title().is_empty(), "{}", page.id);
            assert!(page.text.split_whitespace().count() < 1000, "{} is too long", page.id);
        }
        assert!(page("none").is_none() && page("projects.md").is_some());
    }

    #[test]
    fn every_feature_has_a_known_state_on_every_system() {
        let rows: Vec<&str> =
            page("systems").unwrap().text.lines().filter(|line| line.starts_with('|')).collect();
        assert_eq!(rows[0], "| feature | Linux | Windows | macOS |");
        assert!(rows.len() > 12);
        for row in &rows[2..] {
            let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
            assert_eq!(cells.len(), 4, "{row}");
            for cell in &cells[1..] {
                assert!(["tested", "compiles", "untried", "–"].contains(cell), "{row}");
            }
        }
    }
}
