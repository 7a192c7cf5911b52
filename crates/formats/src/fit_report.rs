//! Reports of a model fit for people: a page of plots (SVG) and a table of the segments (CSV).

use std::ops::Range;

use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{
    BindKeyPoints as _, Cartesian2d, ChartBuilder, Circle, DrawingArea, IntoDrawingArea as _, IntoFont as _,
    IntoLogRange as _, LineSeries, RGBColor, SVGBackend, TextStyle,
};
use plotters::style::Color as _;
use shagreen_core::recording::fit::{FitReport, HeldOut, Segment};

/// Size of the page in pixels.
const SIZE: (u32, u32) = (1200, 820);
/// Height of the page header in pixels.
const TITLE_HEIGHT: u32 = 76;
/// Number of segments whose spectra are shown.
const SPECTRA: usize = 4;

const INK: RGBColor = RGBColor(0x22, 0x2B, 0x2F);
const FAINT: RGBColor = RGBColor(0xDD, 0xE2, 0xE4);
const MEASURED: RGBColor = RGBColor(0x8A, 0x96, 0x9C);
const MODEL: RGBColor = RGBColor(0x0B, 0x7A, 0x63);
const BAD: RGBColor = RGBColor(0xC0, 0x4A, 0x1B);

/// Goodness of fit (GFC) below which a segment is marked as bad: the usual criterion for texture models.
const GOOD_GFC: f64 = 0.9;

/// States what all figures are based on.
const MEASURED_ON: &str = "(measured on signals)";
/// Header of the CSV table.
const COLUMNS: &str =
    "recording,start_s,seconds,speed_mm_per_s,force_n,level_mps2,gfc,level_error_db,held_out";

type Page<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a> = ChartContext<'a, SVGBackend<'a>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type Drawn = Result<(), DrawingAreaErrorKind<std::io::Error>>;

/// Renders the page of plots: the segments in the speed-force plane, their goodness of fit and level errors, and the
/// spectra of four segments from the lowest to the highest level.
pub fn fit_report_svg(name: &str, report: &FitReport) -> String {
    let mut svg = String::new();
    let drawn = draw(&mut svg, name, report);
    // Writing to a string cannot fail, and every range below consists of distinct finite numbers.
    assert!(drawn.is_ok(), "cannot draw the fit report: {drawn:?}");
    svg
}

/// Returns whether bytes are such a page.
pub fn is_fit_report_svg(bytes: &[u8]) -> bool {
    std::str::from_utf8(bytes).is_ok_and(|text| text.starts_with("<svg") && text.contains(MEASURED_ON))
}

/// Returns whether bytes are such a table.
pub fn is_fit_report_csv(bytes: &[u8]) -> bool {
    bytes.starts_with(COLUMNS.as_bytes())
}

/// Writes the table, one segment per line, in mm/s, N and m/s².
pub fn fit_report_csv(report: &FitReport) -> Vec<u8> {
    let mut text = format!("{COLUMNS}\n");
    for s in &report.segments {
        let line = format!(
            "{},{:.3},{:.3},{:.2},{:.4},{:.5},{:.4},{:.3},{}\n",
            s.recording,
            s.start_secs,
            s.seconds,
            s.speed.mm_per_s(),
            s.force.0,
            s.level_mps2,
            s.comparison.gfc,
            s.comparison.level_error_db,
            report.held_out.is_any()
        );
        text.push_str(&line);
    }
    text.into_bytes()
}

fn draw(svg: &mut String, name: &str, report: &FitReport) -> Drawn {
    let page = SVGBackend::with_string(svg, SIZE).into_drawing_area();
    page.fill(&plotters::style::WHITE)?;
    let (head, rest) = page.split_vertically(TITLE_HEIGHT);
    head.draw_text(name, &text(26.0), (28, 16))?;
    head.draw_text(&summary(report), &text(14.0), (28, 48))?;
    let (top, bottom) = rest.split_vertically((SIZE.1 - TITLE_HEIGHT) / 2);
    let panels = top.split_evenly((1, 3));
    plane(&panels[0], report)?;
    let caption = "goodness of fit (GFC), segment and neighbors";
    by_segment(&panels[1], report, caption, &|s| s.comparison.gfc, (0.5, 1.0))?;
    by_segment(
        &panels[2],
        report,
        "level error in dB, segment and neighbors",
        &|s| s.comparison.level_error_db,
        (-3.0, 3.0),
    )?;
    for (panel, segment) in bottom.split_evenly((1, SPECTRA)).iter().zip(chosen(report)) {
        spectrum(panel, report, segment)?;
    }
    page.present()
}

/// One-line summary of the fit.
fn summary(report: &FitReport) -> String {
    let tap = report.tap.as_ref().map_or_else(String::new, |t| {
        format!(
            " · tap {:.0} Hz, decay {:.0} 1/s, from {} contact transients",
            t.tap.frequency.0, t.tap.decay_per_sec, t.n_landings
        )
    });
    format!(
        "{} segments · model at {:.0} Hz, AR order {} · {:.0} % of the speed-force plane · {}: median GFC {:.3}, level error {:.2} dB {MEASURED_ON}{tap}",
        report.segments.len(),
        report.rate.0,
        report.order,
        100.0 * report.coverage,
        held_out(report.held_out),
        report.gfc_median(),
        report.level_error_db_median(),
    )
}

fn held_out(held_out: HeldOut) -> &'static str {
    match held_out {
        HeldOut::Segments => "held-out segments",
        HeldOut::Blocks => "held-out blocks of the same strokes",
        HeldOut::Nothing => "training segments, none held out",
    }
}

fn text(size: f64) -> TextStyle<'static> {
    ("sans-serif", size).into_font().color(&INK)
}

fn color(segment: &Segment) -> RGBColor {
    if segment.comparison.gfc >= GOOD_GFC { MODEL } else { BAD }
}

/// A chart with a caption and a grid over these ranges.
fn axes<'a>(
    panel: &Page<'a>,
    caption: &str,
    x: Range<f64>,
    y: Range<f64>,
) -> Result<Chart<'a>, DrawingAreaErrorKind<std::io::Error>> {
    let mut chart = ChartBuilder::on(panel)
        .margin(14)
        .caption(caption, text(15.0))
        .x_label_area_size(28)
        .y_label_area_size(44)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(plotters::style::WHITE)
        .bold_line_style(FAINT)
        .axis_style(MEASURED)
        .label_style(text(12.0))
        .x_labels(6)
        .x_label_formatter(&|x| format!("{x:.0}"))
        .y_labels(6)
        .draw()?;
    Ok(chart)
}

/// Plots segments over speed and force; longer segments have larger dots.
fn plane(panel: &Page<'_>, report: &FitReport) -> Drawn {
    let highest =
        |value: &dyn Fn(&Segment) -> f64| 1.05 * report.segments.iter().map(value).fold(1e-3, f64::max);
    let speeds = 0.0..highest(&|s| s.speed.mm_per_s());
    let mut chart =
        axes(panel, "segments: force in N over speed in mm/s", speeds, 0.0..highest(&|s| s.force.0))?;
    let size = |s: &Segment| (3.0 + 4.0 * s.seconds.min(1.0)) as i32;
    chart.draw_series(
        report
            .segments
            .iter()
            .map(|s| Circle::new((s.speed.mm_per_s(), s.force.0), size(s), color(s).mix(0.6).filled())),
    )?;
    Ok(())
}

/// Plots one quantity of every segment, in their order.
fn by_segment(
    panel: &Page<'_>,
    report: &FitReport,
    caption: &str,
    value: &dyn Fn(&Segment) -> f64,
    (low, high): (f64, f64),
) -> Drawn {
    let last = report.segments.len().max(2) as f64;
    let mut chart = axes(panel, caption, 0.0..last, low..high)?;
    // Values outside the range are drawn at its edge, not omitted.
    let dot = |(i, s): (usize, &Segment)| {
        Circle::new((i as f64 + 0.5, value(s).clamp(low, high)), 3, color(s).filled())
    };
    chart.draw_series(report.segments.iter().enumerate().map(dot))?;
    Ok(())
}

/// Returns up to [`SPECTRA`] segments, evenly spaced in rank from the lowest to the highest level.
fn chosen(report: &FitReport) -> Vec<&Segment> {
    let mut by_level: Vec<&Segment> = report.segments.iter().collect();
    by_level.sort_by(|a, b| a.level_mps2.total_cmp(&b.level_mps2));
    let n = by_level.len();
    if n <= SPECTRA {
        by_level
    } else {
        (0..SPECTRA).map(|i| by_level[i * (n - 1) / (SPECTRA - 1)]).collect()
    }
}

/// Plots the measured and the model power spectral density, in dB re 1 (m/s²)²/Hz. The panel is too narrow for the unit.
fn spectrum(panel: &Page<'_>, report: &FitReport, segment: &Segment) -> Drawn {
    let db = |psd: &[f64]| -> Vec<(f64, f64)> {
        let points = report.frequencies.iter().zip(psd).filter(|(f, p)| f.0 >= 5.0 && **p > 0.0);
        points.map(|(f, p)| (f.0, 10.0 * p.log10())).collect()
    };
    let (measured, model) = (db(&segment.comparison.measured_psd), db(&segment.comparison.model_psd));
    let top = measured.iter().chain(&model).map(|p| p.1).fold(f64::NEG_INFINITY, f64::max);
    let top = if top.is_finite() { (top / 10.0).ceil() * 10.0 } else { 0.0 };
    let last = report.frequencies.last().map_or(500.0, |f| f.0.max(20.0));
    let ticks =
        [10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0].into_iter().filter(|f| *f <= last).collect();
    let caption = format!(
        "{:.0} mm/s, {:.2} N · GFC {:.3}, {:+.1} dB",
        segment.speed.mm_per_s(),
        segment.force.0,
        segment.comparison.gfc,
        segment.comparison.level_error_db
    );
    let mut chart = ChartBuilder::on(panel)
        .margin(14)
        .caption(caption, text(14.0))
        .x_label_area_size(44)
        .y_label_area_size(44)
        .build_cartesian_2d((10.0..last).log_scale().with_key_points(ticks), top - 60.0..top)?;
    chart
        .configure_mesh()
        .light_line_style(plotters::style::WHITE)
        .bold_line_style(FAINT)
        .axis_style(MEASURED)
        .label_style(text(12.0))
        .x_desc("Hz; PSD in dB, gray measured, green model")
        .x_label_formatter(&|f| format!("{f:.0}"))
        .y_label_formatter(&|db| format!("{db:.0}"))
        .y_labels(7)
        .draw()?;
    let inside = |(f, p): (f64, f64)| (f >= 10.0).then_some((f, p.clamp(top - 60.0, top)));
    chart.draw_series(LineSeries::new(measured.into_iter().filter_map(inside), MEASURED.stroke_width(1)))?;
    chart.draw_series(LineSeries::new(model.into_iter().filter_map(inside), MODEL.stroke_width(2)))?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::{fit_report_csv, fit_report_svg};
    use shagreen_core::recording::fit::{Comparison, FitReport, HeldOut, Segment};
    use shagreen_core::units::{Hertz, MetersPerSecond, Newtons};

    fn report(n: usize) -> FitReport {
        let frequencies: Vec<Hertz> = (0..129).map(|i| Hertz(500.0 / 128.0 * f64::from(i))).collect();
        let psd =
            |gain: f64| frequencies.iter().map(|f| gain / (1.0 + (f.0 / 80.0).powi(4))).collect::<Vec<f64>>();
        let segment = |i: usize| Segment {
            recording: 0,
            start_secs: i as f64,
            seconds: 0.5,
            speed: MetersPerSecond::from_mm_per_s(40.0 + 20.0 * i as f64),
            force: Newtons(0.3 + 0.2 * (i % 5) as f64),
            level_mps2: 0.5 + 0.1 * i as f64,
            comparison: Comparison {
                measured_psd: psd(1e-2),
                model_psd: psd(1.2e-2),
                gfc: if i == 3 { 0.4 } else { 0.97 },
                level_error_db: 0.8 - 0.2 * i as f64,
            },
        };
        FitReport {
            segments: (0..n).map(segment).collect(),
            rate: Hertz(1000.0),
            order: 14,
            coverage: 0.61,
            frequencies: frequencies.clone(),
            tap: None,
            held_out: HeldOut::Segments,
            notes: Vec::new(),
        }
    }

    #[test]
    fn the_page_shows_every_segment_and_says_what_it_compares() {
        let svg = fit_report_svg("Cork <1>", &report(9));
        // Each segment is a dot in three plots.
        assert_eq!(svg.matches("<circle").count(), 3 * 9);
        assert!(svg.contains("held-out segments") && svg.contains("Cork &lt;1&gt;"), "{svg}");
        for (held_out, words) in [(HeldOut::Nothing, "none held out"), (HeldOut::Blocks, "held-out blocks")] {
            let page = fit_report_svg("x", &FitReport { held_out, ..report(9) });
            assert!(page.contains(words), "{held_out:?}");
        }
    }

    /// Reports of few or silent segments, or with NaN values, are drawn too.
    #[test]
    fn a_poor_report_is_drawn() {
        for n in [0, 1, 2] {
            let mut poor = report(n);
            for segment in &mut poor.segments {
                segment.comparison.measured_psd.fill(0.0);
                segment.comparison.model_psd.fill(f64::NAN);
                segment.comparison.gfc = f64::NAN;
                segment.level_mps2 = 0.0;
            }
            assert!(fit_report_svg("poor", &poor).ends_with("</svg>\n"));
        }
    }

    #[test]
    fn the_table_has_a_line_a_segment() {
        let csv = String::from_utf8(fit_report_csv(&report(2))).unwrap();
        assert_eq!(csv.lines().nth(2), Some("0,1.000,0.500,60.00,0.5000,0.60000,0.9700,0.600,true"));
        assert_eq!(csv.lines().count(), 3);
        assert!(super::is_fit_report_csv(csv.as_bytes()) && !super::is_fit_report_csv(b"time,acc\n"));
        assert!(super::is_fit_report_svg(fit_report_svg("x", &report(2)).as_bytes()));
        assert!(!super::is_fit_report_svg(b"<svg><text>mine</text></svg>"));
    }
}
