//! A figure as a file: a picture, or its numbers.

use std::sync::Arc;

use shagreen_formats::figure::{Figure, figure_csv, figure_svg};

/// A figure on its way into a file.
#[derive(Clone, Debug)]
pub struct FigureFile {
    /// Name of the file without its ending.
    pub stem: String,
    /// The figure.
    pub figure: Arc<Figure>,
    /// What is written of it.
    pub format: FigureFormat,
}

/// What is written of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFormat {
    /// The picture.
    Svg,
    /// The numbers.
    Csv,
}

impl FigureFormat {
    /// The word for people.
    pub fn word(self) -> &'static str {
        match self {
            Self::Svg => "SVG",
            Self::Csv => "CSV",
        }
    }

    /// The ending of the names of its files.
    fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Csv => "csv",
        }
    }
}

impl FigureFile {
    /// Name of the file.
    pub fn file_name(&self) -> String {
        format!("{}.{}", self.stem, self.format.ending())
    }

    /// What the figure shows, in a line.
    pub fn title(&self) -> String {
        self.figure.title()
    }

    /// What goes into the file.
    pub(super) fn bytes(&self) -> Vec<u8> {
        match self.format {
            FigureFormat::Svg => figure_svg(&self.figure).into_bytes(),
            FigureFormat::Csv => figure_csv(&self.figure),
        }
    }

    /// Whether a file of these bytes is of the same kind: a picture, or a table with the same columns.
    pub(super) fn is_like(&self, bytes: &[u8]) -> bool {
        match self.format {
            // A picture may begin with a declaration, a comment and a document type.
            FigureFormat::Svg => {
                let head = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
                head.trim_start().starts_with('<') && head.contains("<svg")
            }
            FigureFormat::Csv => {
                let first_line = |bytes: &[u8]| bytes.split(|b| *b == b'\n').next().map(<[u8]>::to_vec);
                first_line(bytes) == first_line(&self.bytes())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{FigureFile, FigureFormat};
    use shagreen_formats::figure::{Figure, Table};

    #[test]
    fn a_figure_takes_the_place_of_its_like_only() {
        let table = |name: &str| {
            Figure::Table(Table {
                title: String::new(),
                columns: vec![name.to_owned()],
                rows: vec![("a".to_owned(), vec![Some(1.0)])],
                decimals: 1,
                source: String::new(),
            })
        };
        let file =
            |name: &str, format| FigureFile { stem: "figure".to_owned(), figure: table(name).into(), format };
        let (svg, csv) = (file("one", FigureFormat::Svg), file("one", FigureFormat::Csv));
        assert_eq!((svg.file_name(), csv.file_name()), ("figure.svg".to_owned(), "figure.csv".to_owned()));
        assert!(svg.is_like(&svg.bytes()) && csv.is_like(&csv.bytes()));
        assert!(!svg.is_like(&csv.bytes()) && !csv.is_like(&svg.bytes()));
        assert!(!csv.is_like(&file("two", FigureFormat::Csv).bytes()), "other columns");
        assert!(svg.is_like(b"<?xml version=\"1.0\"?>\n<!-- a --><svg/>") && !svg.is_like(b"my <svg> notes"));
        assert!(!svg.is_like(b"") && !csv.is_like(b""));
    }
}
