//! Projects on the command line: created, shown, and their authored textures rendered.

use crate::support::Bench;
use serde_json::{Value, json};

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

/// A command can ask no question, so a library outside the folder of its project gets a warning. One in the folder of
/// Shagreen needs none, and one on another computer is never asked for.
#[test]
fn where_the_library_of_a_project_lies_decides() {
    let bench = Bench::new();
    for folder in ["elsewhere", "near", "data/shagreen"] {
        bench.write(&format!("{folder}/mine.json"), shagreen_formats::starter::starter_bytes());
    }
    bench.json("project new -o near/new.shagreen");
    let begun = std::fs::read(bench.path("near/new.shagreen")).unwrap();
    let show = |library: &str| {
        let mut wire: Value = serde_json::from_slice(&begun).unwrap();
        wire["library"] = json!({"file": library});
        bench.write("near/a.shagreen", wire.to_string());
        bench.run("project show near/a.shagreen")
    };
    let warning = "outside the folder of the project";
    for (library, is_warned) in [
        ("mine.json", false),
        ("../near/mine.json", false),
        ("../data/shagreen/mine.json", false),
        ("../elsewhere/mine.json", true),
    ] {
        let said = show(library);
        assert_eq!((said.code, said.stderr.contains(warning)), (0, is_warned), "{library}: {}", said.stderr);
    }
    for library in ["//server/share/mine.json", r"\\server\share\mine.json"] {
        let said = show(library);
        assert!(said.code == 1 && said.stderr.contains("on another computer"), "{library}: {}", said.stderr);
    }
}

/// A texture that was generated for one authored texture leaves the signals of the others as they are.
#[test]
fn a_second_generated_texture_leaves_the_first_authored_texture_as_it_is() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let begun: Value = serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    let starter: Value = serde_json::from_slice(shagreen_formats::starter::starter_bytes()).unwrap();
    let generated = |id: &str, rs: f64, is_own: bool| {
        let mut texture = starter["textures"][3].clone();
        texture["id"] = json!(id);
        texture["own"] = json!(is_own);
        texture["space"] = json!({"rough_smooth": rs, "hard_soft": 50.0, "label_source": "estimated"});
        texture
    };
    let authored = |key: u32, id: &str, mode: &str| {
        let blend = json!({"mode": mode, "weights": "barycentric", "outside": "clamped", "locked": [id]});
        json!({"key": key, "name": id, "rough_smooth": 50.0, "hard_soft": 50.0, "blend": blend})
    };
    for mode in ["field", "parametric", "shared", "paper"] {
        let rendered = |joined: &[Value]| {
            let mut project = begun.clone();
            project["version"] = json!("1.2");
            project["joined"] = json!(joined);
            project["authored"] = json!([authored(1, "first", mode), authored(2, "second", mode)]);
            bench.write("a.shagreen", project.to_string());
            let render = "render --project a.shagreen --authored first --speed 100 --force 1 --seconds 0.2";
            bench.json(&format!("{render} -o out.wav"));
            (std::fs::read(bench.path("out.wav")).unwrap(), std::fs::read(bench.path("out.json")).unwrap())
        };
        let first = generated("first", 49.5, true);
        let before = rendered(std::slice::from_ref(&first));
        assert_eq!(rendered(&[first.clone(), generated("second", 50.4, true)]), before, "{mode}");
        let shown = bench.json("project show a.shagreen");
        assert_eq!((&shown["joined"], &shown["own"]), (&json!(2), &json!(["first", "second"])));
        assert_ne!(rendered(&[first, generated("second", 50.4, false)]), before, "{mode}");
    }
}
