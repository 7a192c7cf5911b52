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

/// The window opens a project whose axes no texture has. Its textures can be selected by their identifiers, which needs no
/// positions.
#[test]
fn a_texture_of_a_project_needs_none_of_its_axes() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let mut project: Value =
        serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    project["version"] = json!("1.3");
    project["axes"] = json!(["warm-cold", "flat-bumpy", "centroid"]);
    bench.write("a.shagreen", project.to_string());
    let note = "note: no texture can be placed on the axes of the project (warm-cold, flat-bumpy, centroid)";
    let psd = |what: &str| {
        let said = bench.run(&format!("texture psd {what} --speed 100 --force 1 --json"));
        assert_eq!(said.code, 0, "{said:?}");
        (said.stdout, said.stderr.contains(note))
    };
    let (of_library, is_noted) = psd("--texture cork");
    assert!(!is_noted);
    assert_eq!(psd("--project a.shagreen --texture cork"), (of_library, true));
    for out in ["--texture cork -o cork.xml", "--all -o models"] {
        let said = bench.run(&format!("export --project a.shagreen --format hatt {out}"));
        assert!(said.code == 0 && said.stderr.contains(note), "{said:?}");
    }
    // Points have coordinates on these axes.
    for point in ["--at 1,2,3", "--authored 1"] {
        let psd = format!("texture psd --project a.shagreen {point} --speed 100 --force 1");
        bench.fails(&psd, 1, &["\"warm-cold\""]);
    }
}

/// The library file of a project can get other axes; their number decides which modes interpolate.
#[test]
fn an_authored_texture_is_interpolated_on_the_axes_that_its_library_has_now() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let mut project: Value =
        serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    project["library"] = json!({"file": "l.json"});
    project["authored"][0]["blend"]["mode"] = json!("shared");
    bench.write("a.shagreen", project.to_string());
    bench.write("l.json", shagreen_formats::starter::starter_bytes());
    let psd = || {
        let said = bench.run("texture psd --project a.shagreen --authored 1 --speed 100 --force 1 --json");
        assert_eq!(said.code, 0, "{said:?}");
        let found: Value = serde_json::from_str(&said.stdout).unwrap();
        (found["at"].as_array().unwrap().len(), said.stderr.contains("has mode shared, which needs a space"))
    };
    assert_eq!(psd(), (2, false));
    bench.json("library places --axes rough-smooth,hard-soft,centroid --out p.csv");
    bench.json("space place --attributes p.csv --out three.json");
    bench.write("l.json", std::fs::read(bench.path("three.json")).unwrap());
    assert_eq!(psd(), (3, true));
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

/// An own texture has estimated coordinates on the axes that neither its attributes nor its vibration give.
#[test]
fn an_own_texture_is_rendered_on_chosen_axes_and_a_pin_without_effect_is_noted() {
    let bench = Bench::new();
    bench.json("project new -o a.shagreen");
    let mut project: Value =
        serde_json::from_slice(&std::fs::read(bench.path("a.shagreen")).unwrap()).unwrap();
    let starter: Value = serde_json::from_slice(shagreen_formats::starter::starter_bytes()).unwrap();
    let mut own = starter["textures"][0].clone();
    own.as_object_mut().unwrap().remove("space");
    (own["id"], own["own"]) = (json!("made"), json!(true));
    let axes = "rough-smooth,hard-soft,centroid,flat-bumpy";
    let list = bench.json(&format!("library list --library simulated --axes {axes}"));
    let glass = list["textures"].as_array().unwrap().iter().find(|texture| texture["id"] == "glass").unwrap();
    project["version"] = json!("1.3");
    project["library"] = json!({"built_in": "simulated"});
    project["axes"] = json!(axes.split(',').collect::<Vec<_>>());
    let texture = &mut project["authored"][0];
    (texture["rough_smooth"], texture["hard_soft"]) = (json!(33.0), json!(44.0));
    // The vibration gives its centroid.
    texture["further"] = json!([glass["at"][2], 55.0]);
    texture["blend"]["locked"] = json!(["made", "gone"]);
    let mut psd = |coordinates: Value| {
        let mut own = own.clone();
        own["coordinates"] = coordinates;
        project["joined"] = json!([own]);
        bench.write("a.shagreen", project.to_string());
        let said = bench.run("texture psd --project a.shagreen --authored 1 --speed 100 --force 1 --json");
        assert_eq!(said.code, 0, "{said:?}");
        let found: Value = serde_json::from_str(&said.stdout).unwrap();
        (found["parents"][0].clone(), said.stderr)
    };
    let (parent, said) = psd(json!({"rough-smooth": 33.0, "hard-soft": 44.0, "flat-bumpy": 55.0}));
    assert!(parent["id"] == "made" && parent["weight"].as_f64().unwrap() > 0.999, "{parent}");
    assert!(said.contains("the pin of \"gone\" has no effect: the project has no such texture"), "{said}");
    assert!(!said.contains("the pin of \"made\""), "{said}");
    let (parent, said) = psd(json!({"rough-smooth": 33.0, "hard-soft": 44.0}));
    assert_ne!(parent["id"], "made");
    let note = "note: the pin of \"made\" has no effect: it has no position on the axes";
    assert!(said.contains(note) && said.contains("centroid, flat-bumpy"), "{said}");
}
