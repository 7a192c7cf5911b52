//! Export of a figure as an image or as numbers.

use std::sync::Arc;

use shagreen_formats::figure::{Figure, figure_csv, figure_png, figure_svg};

/// First bytes of a PNG file.
const PNG_SIGNATURE: &[u8] = b"\x89PNG\r\n\x1a\n";

/// Figure to be exported.
#[derive(Clone, Debug)]
pub struct FigureFile {
    /// File name without its ending.
    pub stem: String,
    /// The figure.
    pub figure: Arc<Figure>,
    /// File format.
    pub format: FigureFormat,
}

/// File format of a figure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FigureFormat {
    /// Vector image.
    Svg,
    /// Pixel image.
    Png,
    /// Table of the numbers.
    Csv,
}

impl FigureFormat {
    /// All formats, in the order of menus.
    pub const ALL: [Self; 3] = [Self::Svg, Self::Png, Self::Csv];

    /// Label of the format.
    pub fn word(self) -> &'static str {
        match self {
            Self::Svg => "SVG",
            Self::Png => "PNG",
            Self::Csv => "CSV",
        }
    }

    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Svg => "svg",
            Self::Png => "png",
            Self::Csv => "csv",
        }
    }
}

impl FigureFile {
    /// File name with its ending.
    pub fn file_name(&self) -> String {
        format!("{}.{}", self.stem, self.format.ending())
    }

    /// Title of the figure, in one line.
    pub fn title(&self) -> String {
        self.figure.title()
    }

    pub(crate) fn bytes(&self) -> Result<Vec<u8>, String> {
        match self.format {
            FigureFormat::Svg => Ok(figure_svg(&self.figure).into_bytes()),
            FigureFormat::Png => figure_png(&self.figure).map_err(|error| error.to_string()),
            FigureFormat::Csv => Ok(figure_csv(&self.figure)),
        }
    }

    /// Whether a file with these bytes has the same kind of content: an image, or a table with the same columns.
    pub(crate) fn is_like(&self, bytes: &[u8]) -> bool {
        match self.format {
            // A declaration, a comment and a document type may precede the `svg` element.
            FigureFormat::Svg => {
                let head = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
                head.trim_start().starts_with('<') && head.contains("<svg")
            }
            FigureFormat::Png => bytes.starts_with(PNG_SIGNATURE),
            FigureFormat::Csv => {
                let first_line = |bytes: &[u8]| bytes.split(|b| *b == b'\n').next().map(<[u8]>::to_vec);
                first_line(bytes) == first_line(&figure_csv(&self.figure))
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
                n_counts: 0,
                source: String::new(),
            })
        };
        let file =
            |name: &str, format| FigureFile { stem: "figure".to_owned(), figure: table(name).into(), format };
        let files = FigureFormat::ALL.map(|format| file("one", format));
        let bytes = files.each_ref().map(|file| file.bytes().unwrap());
        assert_eq!(files.each_ref().map(FigureFile::file_name), ["figure.svg", "figure.png", "figure.csv"]);
        for (i, file) in files.iter().enumerate() {
            assert_eq!(bytes.each_ref().map(|bytes| file.is_like(bytes)), std::array::from_fn(|j| i == j));
        }
        let [svg, _, csv] = files;
        assert!(!csv.is_like(&file("two", FigureFormat::Csv).bytes().unwrap()), "other columns");
        assert!(svg.is_like(b"<?xml version=\"1.0\"?>\n<!-- a --><svg/>") && !svg.is_like(b"my <svg> notes"));
        assert!(!svg.is_like(b"") && !csv.is_like(b""));
    }
}
