//! Projects on the command line: created, shown, and their authored textures rendered.

use crate::support::Bench;
use serde_json::json;

#[test]
fn the_gallery_is_listed_and_begun_from() {
    let bench = Bench::new();
    let gallery = bench.json("project gallery");
    let projects = gallery["projects"].as_array().unwrap();
    assert!(projects.len() >= 12);
    for project in projects {
        let id = project["id"].as_str().unwrap();
        let made = bench.json(&format!("project new --from {id} -o {id}.shagreen"));
        let shown = bench.json(&format!("project show {id}.shagreen"));
        assert_eq!(made["authored"], shown["authored"].as_array().unwrap().len());
        assert_eq!(shown["library_kept"], json!({"built_in": "starter"}));
        let names: Vec<_> = shown["authored"].as_array().unwrap().iter().map(|t| t["name"].clone()).collect();
        assert_eq!(project["authored"].as_array().unwrap(), &names);
    }
    bench.fails("project new --from none -o x.shagreen", 1, &["no project \"none\"", "couch-fabrics"]);
    bench.fails("project new -o journeys.shagreen", 1, &["already", "journeys.shagreen"]);
    bench.fails("project new -o notes.txt", 1, &["must end with .shagreen"]);
}

/// An authored texture of a project renders as the same point with the same interpolation does.
#[test]
fn what_was_authored_is_rendered() {
    let bench = Bench::new();
    bench.json("project new --from wooden-desk -o desk.shagreen");
    let psd = |what: &str| bench.json(&format!("texture psd {what} --speed 100 --force 1"));
    for (authored, point) in [("2", "--at 57,16"), ("1", "--at 38,18 --lock rough-sawn-wood")] {
        let of_project = psd(&format!("--project desk.shagreen --authored {authored}"));
        assert_eq!(of_project, psd(point));
        assert!(of_project["rms"].as_f64().unwrap() > 0.0);
    }
    bench.json("project new --from ways-to-blend -o ways.shagreen");
    for mode in ["field", "shared", "power", "paper"] {
        let name = mode[..1].to_uppercase() + &mode[1..];
        let of_project = psd(&format!("--project ways.shagreen --authored {name}"));
        assert_eq!(of_project, psd(&format!("--at 55,40 --blend {mode}")), "{mode}");
    }
    assert_eq!(psd("--project ways.shagreen --texture cork"), psd("--texture cork"));
}

#[test]
fn what_is_no_project_or_not_in_it_is_said() {
    let bench = Bench::new();
    bench.json("project new --from ways-to-blend -o ways.shagreen");
    bench.write("library.json", shagreen_formats::starter::starter_bytes());
    bench.write("notes.txt", "hello");
    bench.fails("project show notes.txt", 1, &["neither a project nor", "notes.txt"]);
    bench.fails("project show library.json", 1, &["is a library, not a project"]);
    bench.fails("project show none.shagreen", 1, &["cannot be read", "none.shagreen"]);
    let render = |rest: &str| format!("render {rest} --speed 100 --force 1 --seconds 1 -o out.wav");
    bench.fails(
        &render("--project ways.shagreen --authored Oak"),
        1,
        &["no authored texture \"Oak\"", "\"Paper\""],
    );
    bench.fails(&render("--authored Paper"), 2, &["--project"]);
    bench.fails(&render("--project ways.shagreen --authored Paper --blend field"), 2, &["--blend"]);
    bench.fails(&render("--project ways.shagreen --library library.json --at 5,5"), 2, &["--library"]);
    assert!(!bench.path("out.wav").exists());
}
