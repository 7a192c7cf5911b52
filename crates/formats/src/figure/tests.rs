use super::{
    Chart, Figure, Map, Mark, Point, Scale, Series, Table, Tone, compared_line, figure_csv, figure_svg,
    is_figure_csv, page_svg,
};

fn chart() -> Chart {
    let series = |name: &str, mark: Mark, tone: Tone| Series {
        name: name.to_owned(),
        mark,
        tone,
        points: vec![Point::named(1.0, 2.0, "a, \"b\""), Point::new(3.0, -4.5)],
    };
    Chart {
        title: "A <figure>".to_owned(),
        x_label: "x".to_owned(),
        y_label: "y".to_owned(),
        is_isotropic: false,
        x_scale: Scale::Linear,
        shown: None,
        source: "simulated raters".to_owned(),
        series: vec![
            series("edges", Mark::Segments, Tone::Faint),
            series("line", Mark::Line, Tone::Second),
            series("dots", Mark::Dots, Tone::Main),
        ],
    }
}

fn table() -> Table {
    Table {
        title: "Correlations".to_owned(),
        columns: vec!["one".to_owned(), "two".to_owned()],
        rows: vec![("rough-smooth".to_owned(), vec![Some(-0.756_51), None])],
        decimals: 3,
        n_counts: 0,
        source: "simulated raters".to_owned(),
    }
}

#[test]
fn counts_have_no_decimals() {
    let counted = Table { n_counts: 1, ..table() };
    assert_eq!(counted.shown(0, Some(12.0)), "12.000");
    assert_eq!(counted.shown(1, Some(12.0)), "12");
    assert_eq!(
        (counted.shown(1, None), table().shown(1, Some(12.0))),
        ("\u{2013}".to_owned(), "12.000".to_owned())
    );
    assert_eq!(counted.shown(0, Some(-0.000_1)), "0.000");
}

#[test]
fn a_figure_is_saved_with_all_its_numbers() {
    let csv = String::from_utf8(figure_csv(&Figure::Chart(chart()))).unwrap();
    assert_eq!(csv.lines().next(), Some("series,label,x: x,y: y,source"));
    let with_units = Chart {
        x_label: "time in ms".to_owned(),
        y_label: "acceleration in m/s², waveforms 2 m/s² apart".to_owned(),
        ..chart()
    };
    let named = String::from_utf8(figure_csv(&Figure::Chart(with_units))).unwrap();
    let header = "series,label,x: time in ms,\"y: acceleration in m/s², waveforms 2 m/s² apart\",source";
    assert_eq!(named.lines().next(), Some(header));
    assert!(is_figure_csv(named.as_bytes()));
    // Files without names of the axes may be replaced as well.
    assert!(is_figure_csv(b"series,label,x,y,source\n") && is_figure_csv(b"x,y,value,source\n"));
    assert!(!is_figure_csv(b"x,y,source\n"));
    assert!(is_figure_csv(csv.as_bytes()) && !is_figure_csv(b"participant,texture\n"));
    assert_eq!(csv.lines().nth(1), Some("edges,\"a, \"\"b\"\"\",1,2,simulated raters"));
    assert_eq!(csv.lines().count(), 1 + 6);
    let csv = String::from_utf8(figure_csv(&Figure::Table(table()))).unwrap();
    assert_eq!(csv, "row,one,two,source\nrough-smooth,-0.75651,,simulated raters\n");
    assert!(is_figure_csv(csv.as_bytes()));
}

#[test]
fn a_figure_is_drawn_and_names_what_it_draws() {
    let svg = figure_svg(&Figure::Chart(chart()));
    assert!(svg.contains("A &lt;figure&gt;") && svg.contains("a, &quot;b&quot;"), "{svg}");
    assert!(svg.matches("<circle").count() >= 2);
    let svg = figure_svg(&Figure::Table(table()));
    assert!(svg.contains("-0.757") && svg.contains("rough-smooth"), "{svg}");
    let page = page_svg("A page", "what it is", &[Figure::Chart(chart()), Figure::Table(table())]);
    assert!(page.contains("A page") && page.contains("-0.757") && page.contains("A &lt;figure&gt;"));
}

/// Every line of text of a page stands in its own figure: no title reaches the next one.
#[test]
fn long_titles_stand_on_several_lines() {
    let long = "rough–smooth: nested cross-validation r 0.68, p = 0.007; r 0.86 with features selected on all textures";
    let figures = [
        Figure::Chart(Chart { title: long.to_owned(), ..chart() }),
        Figure::Table(Table { title: long.to_owned(), ..table() }),
    ];
    let page = page_svg("A page", "what it is", &figures);
    let texts: Vec<&str> =
        page.split("</text>").filter_map(|part| part.rsplit_once('>').map(|(_, text)| text.trim())).collect();
    assert!(!texts.iter().any(|text| text.contains(long)), "{texts:?}");
    for part in ["rough–smooth: nested cross-validation", "features selected on all textures"] {
        assert_eq!(texts.iter().filter(|text| text.contains(part)).count(), 2, "{part}: {texts:?}");
    }
    assert!(texts.iter().all(|text| text.chars().count() <= 65), "{texts:?}");
}

#[test]
fn a_figure_of_nothing_is_drawn_too() {
    let empty = Chart { series: Vec::new(), ..chart() };
    assert_eq!(empty.bounds(), [(0.0, 1.0); 2]);
    assert!(figure_svg(&Figure::Chart(empty)).ends_with("</svg>\n"));
    let point = Series { points: vec![Point::new(2.0, 2.0)], ..chart().series[0].clone() };
    let one = Chart { series: vec![point], ..chart() };
    assert_eq!(one.bounds(), [(1.5, 2.5); 2]);
    assert!(figure_svg(&Figure::Chart(one)).ends_with("</svg>\n"));
    assert!(figure_svg(&Figure::Table(Table { rows: Vec::new(), ..table() })).ends_with("</svg>\n"));
}

#[test]
fn a_logarithmic_axis_gives_decades_the_same_room() {
    let dots = Series {
        name: String::new(),
        mark: Mark::Dots,
        tone: Tone::Main,
        points: [10.0, 100.0, 1000.0].map(|x| Point::new(x, 1.0)).to_vec(),
    };
    let chart = Chart {
        x_scale: Scale::Logarithmic,
        shown: Some([(5.0, 2000.0), (0.0, 2.0)]),
        series: vec![dots],
        ..chart()
    };
    assert_eq!(chart.bounds()[0], (5.0, 2000.0));
    let svg = figure_svg(&Figure::Chart(chart));
    let circles = svg.split("<circle cx=\"").skip(1);
    let at: Vec<f64> = circles.map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect();
    assert_eq!(at.len(), 3, "{svg}");
    assert!((at[1] - at[0] - (at[2] - at[1])).abs() <= 1.0, "{at:?}");
}

#[test]
fn a_map_is_drawn_and_saved_cell_by_cell() {
    let map = Map {
        title: "Spectrogram".to_owned(),
        x_label: "time in s".to_owned(),
        y_label: "frequency in Hz".to_owned(),
        value_label: "density".to_owned(),
        value_unit: "dB".to_owned(),
        x: (-2.0, 0.0),
        y: (0.0, 100.0),
        range: (-60.0, 0.0),
        rows: vec![vec![-60.0, -60.0, 0.0, -30.0], vec![-90.0, 10.0, -30.0, -30.0]],
        source: String::new(),
    };
    assert_eq!((map.share(-90.0), map.share(-30.0), map.share(10.0)), (0.0, 0.5, 1.0));
    let figure = Figure::Map(map);
    let csv = String::from_utf8(figure_csv(&figure)).unwrap();
    assert!(is_figure_csv(csv.as_bytes()));
    assert_eq!(csv.lines().next(), Some("x: time in s,y: frequency in Hz,value: density in dB,source"));
    assert_eq!(csv.lines().nth(1), Some("-1.75,25,-60,"));
    assert_eq!(csv.lines().last(), Some("-0.25,75,-30,"));
    let svg = figure_svg(&figure);
    assert!(svg.contains("Spectrogram") && svg.contains("density"), "{svg}");
    // The values below and above the range take its end colors.
    assert!(svg.contains("#00224E") && svg.contains("#FEE838"), "{svg}");
}

/// Seven participants have seven colors, and the lines after the fourth are dashed.
#[test]
fn compared_lines_have_colors_and_styles_of_their_own() {
    let of = |n: usize| {
        let line = |index: usize| {
            let (mark, tone) = compared_line(index);
            let points = (0..20).map(|x| Point::new(f64::from(x), index as f64)).collect();
            Series { name: format!("P{index}"), mark, tone, points }
        };
        figure_svg(&Figure::Chart(Chart { series: (0..n).map(line).collect(), ..chart() }))
    };
    let colors = |svg: &str| {
        let strokes =
            svg.split("<polyline").skip(1).filter_map(|line| line.split("stroke=\"").nth(1)?.get(..7));
        strokes.map(str::to_owned).collect::<std::collections::BTreeSet<String>>()
    };
    let (four, seven) = (of(4), of(7));
    assert_eq!(colors(&seven).difference(&colors(&of(1))).count(), 6, "{:?}", colors(&seven));
    // Each dash is a line.
    let n_lines = |svg: &str| svg.matches("<polyline").count();
    assert!(n_lines(&seven) > n_lines(&four) + 60, "{} and {}", n_lines(&four), n_lines(&seven));
}
