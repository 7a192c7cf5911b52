//! Figures of an actuator calibration.

use shagreen_core::actuator::calibration::{Calibration, CurvePoint};

use crate::figure::{Chart, Figure, Mark, Point, Scale, Series, Tone};

/// Returns the named figures of a calibration: gain over frequency, residual of the fit, harmonic distortion. `source`
/// describes the measurement.
pub fn calibration_figures(calibration: &Calibration, source: &str) -> Vec<(&'static str, Figure)> {
    let db = |ratio: f64| 20.0 * ratio.log10();
    let chart = |title: &str, y_label: &str, series: Vec<Series>| {
        Figure::Chart(Chart {
            title: title.to_owned(),
            x_label: "frequency in Hz".to_owned(),
            y_label: y_label.to_owned(),
            is_isotropic: false,
            x_scale: Scale::Logarithmic,
            shown: None,
            series,
            source: source.to_owned(),
        })
    };
    let over = |name: &str, tone: Tone, mark: Mark, value: &dyn Fn(&CurvePoint) -> Option<f64>| {
        let point = |p: &CurvePoint| value(p).map(|y| Point::new(p.frequency.0, y));
        let points = calibration.curve.iter().filter_map(point).filter(|p| p.y.is_finite()).collect();
        Series { name: name.to_owned(), mark, tone, points }
    };
    let fit = calibration.fit.as_ref().ok().map(|fit| fit.response);
    let fitted = |p: &CurvePoint| fit.map(|response| response.magnitude_at(p.frequency));
    let mut gains = vec![
        over("noise", Tone::Faint, Mark::Line, &|p| p.noise_mps2_per_v.map(db)),
        over("measured", Tone::Main, Mark::Line, &|p| Some(db(p.gain_mps2_per_v))),
        over("fit", Tone::Second, Mark::Line, &|p| fitted(p).map(db)),
    ];
    gains.retain(|series| !series.points.is_empty());
    let left =
        over("measured / fit", Tone::Main, Mark::Line, &|p| fitted(p).map(|f| db(p.gain_mps2_per_v / f)));
    let harmonics = calibration.distortion.iter();
    let harmonics = harmonics.map(|p| Point::new(p.frequency.0, 100.0 * p.share)).collect();
    let harmonics = Series {
        name: "second to fifth harmonic".to_owned(),
        mark: Mark::Line,
        tone: Tone::Third,
        points: harmonics,
    };
    let mut figures = vec![("gain", chart("Gain of the actuator", "gain in dB re 1 (m/s²)/V", gains))];
    if !left.points.is_empty() {
        let title = "Residual of the fit";
        figures.push(("residual", chart(title, "measured / fit in dB", vec![left])));
    }
    figures.push(("distortion", chart("Harmonics", "amplitude in % of the fundamental", vec![harmonics])));
    figures
}

#[cfg(test)]
mod tests {
    use super::calibration_figures;
    use crate::figure::{Figure, figure_csv, figure_svg};
    use shagreen_core::actuator::calibration::{Sweep, calibrate};
    use shagreen_core::actuator::{Drive, Response};
    use shagreen_core::units::Hertz;

    #[test]
    fn the_gain_and_its_fit_are_drawn() {
        let rate = Hertz(4000.0);
        let sweep = Sweep { seconds: 4.0, ..Sweep::USUAL };
        let response = Response::new(Hertz(65.0), 4.0, 2.0).unwrap();
        let recording = response.drive(&sweep.signal(rate).unwrap(), rate);
        let calibration = calibrate(&recording, rate, &sweep, Drive::ASSUMED).unwrap();
        let figures = calibration_figures(&calibration, "a test");
        assert_eq!(
            figures.iter().map(|(name, _)| *name).collect::<Vec<_>>(),
            ["gain", "residual", "distortion"]
        );
        let Figure::Chart(gain) = &figures[0].1 else { panic!("the gain figure is not a chart") };
        let measured = gain.series.iter().find(|s| s.name == "measured").unwrap();
        let most = measured.points.iter().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
        // The maximum lies at 65 Hz / √(1 - 1/2Q²), at about 20 log10 8 dB, on a grid of 24 points per octave.
        assert!((most.x / 66.04 - 1.0).abs() < 0.016 && (most.y - 18.06).abs() < 0.3, "{most:?}");
        for (_, figure) in &figures {
            assert!(figure_svg(figure).ends_with("</svg>\n"));
            assert!(String::from_utf8(figure_csv(figure)).unwrap().contains("a test"));
        }
    }
}
