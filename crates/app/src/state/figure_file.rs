//! Export of a figure as an image or as numbers.

use std::sync::Arc;

use shagreen_formats::figure::{Figure, figure_csv, figure_png, figure_svg, is_figure_csv};

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

    /// Whether a file with these bytes has the same kind of content: an image, points of a chart or map, or a table with
    /// the same columns.
    pub(crate) fn is_like(&self, bytes: &[u8]) -> bool {
        match self.format {
            // A declaration, a comment and a document type may precede the `svg` element.
            FigureFormat::Svg => {
                let head = String::from_utf8_lossy(&bytes[..bytes.len().min(2000)]).into_owned();
                head.trim_start().starts_with('<') && head.contains("<svg")
            }
            FigureFormat::Png => bytes.starts_with(PNG_SIGNATURE),
            FigureFormat::Csv if !matches!(*self.figure, Figure::Table(_)) => {
                // Names and units of the axes may differ.
                let is_chart = matches!(*self.figure, Figure::Chart(_));
                is_figure_csv(bytes)
                    && !bytes.starts_with(b"row,")
                    && bytes.starts_with(b"series,") == is_chart
            }
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
    use shagreen_formats::figure::{Chart, Figure, Scale, Table};

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

    /// A chart of another quantity has other column names, and is a chart nevertheless.
    #[test]
    fn the_points_of_a_chart_take_the_place_of_a_chart() {
        let chart = |x_label: &str| {
            let figure = Figure::Chart(Chart {
                title: String::new(),
                x_label: x_label.to_owned(),
                y_label: "level".to_owned(),
                is_isotropic: false,
                x_scale: Scale::Linear,
                shown: None,
                series: Vec::new(),
                source: String::new(),
            });
            FigureFile { stem: "figure".to_owned(), figure: figure.into(), format: FigureFormat::Csv }
        };
        let in_ms = chart("time in ms");
        assert!(in_ms.is_like(&chart("position in mm").bytes().unwrap()));
        assert!(in_ms.is_like(b"series,label,x,y,source\n"));
        assert!(!in_ms.is_like(b"x,y,value,source\n") && !in_ms.is_like(b"row,one,source\n"));
    }
}
