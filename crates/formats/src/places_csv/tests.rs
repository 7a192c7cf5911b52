use super::{
    Placement, Places, PlacesCsvError, Scale, looks_rescaled, place_textures, places_csv, read_places,
};
use crate::starter::starter_library;
use shagreen_core::space::LabelSource;

fn read_places_csv(bytes: &[u8], source: Option<LabelSource>) -> Result<Vec<Placement>, PlacesCsvError> {
    read_places(bytes, source, Scale::OF_SPACE).map(|imported| imported.value.placements)
}

#[test]
fn axes_may_be_other_attributes() {
    let text = "id,X: warm-cold,y:flat-bumpy,source,warm-cold\ncork,40.5,71,human,39\nfelt,90,95,human,88\n";
    let places = read_places(text.as_bytes(), None, Scale::OF_SPACE).unwrap().value;
    assert_eq!(places.axes, Some(["warm-cold", "flat-bumpy"].map(str::to_owned).to_vec()));
    let cork = &places.placements[0];
    assert_eq!((cork.place.at.x(), cork.place.at.y()), (40.5, 71.0));
    assert_eq!(cork.attributes.get("flat-bumpy"), Some(71.0));
    assert_eq!(cork.attributes.get("warm-cold"), Some(39.0));
    assert_eq!(cork.attributes.get("rough-smooth"), None);
    let mut library = starter_library().unwrap();
    place_textures(&mut library, &places);
    assert_eq!(library.axis_names(), ["warm-cold", "flat-bumpy"]);
    let written = places_csv(&library);
    assert!(written.starts_with(b"id,x:warm-cold,y:flat-bumpy,source,"));
    assert_eq!(read_places(&written, None, Scale::OF_SPACE).unwrap().value, places);
    // A table on the usual axes removes the axis names.
    let usual = read_places(b"id,x:Rough-Smooth,y:hard-soft,source\ncork,1,2,human\n", None, Scale::OF_SPACE);
    place_textures(&mut library, &usual.unwrap().value);
    assert_eq!(library.axes, None);
    let twice = read_places_csv(b"id,x:a-b,y:A-B,source\ncork,1,2,human\n", None).unwrap_err().to_string();
    assert!(twice.contains("both axes"), "{twice}");
    let half = read_places_csv(b"id,x:a-b,hs,source\ncork,1,2,human\n", None).unwrap_err().to_string();
    assert!(half.contains("\"x:a-b\" is one axis") && half.contains("\"y:\""), "{half}");
    let half = read_places_csv(b"id,rs,hs,y:a-b,source\ncork,1,2,3,human\n", None).unwrap_err().to_string();
    assert!(half.contains("\"x:\""), "{half}");
}

#[test]
fn a_space_may_have_one_to_six_axes() {
    let of = |text: &str| {
        let places = read_places(text.as_bytes(), Some(LabelSource::HumanRatings), Scale::OF_SPACE);
        places.map(|imported| imported.value)
    };
    for (text, axes, at) in [
        ("id,x:warm-cold\ncork,4\n", "warm-cold", vec![4.0]),
        ("id,rs,hs,z:warm-cold\ncork,1,2,3\n", "rough-smooth,hard-soft,warm-cold", vec![1.0, 2.0, 3.0]),
        ("id,Axis2: c-d,axis1:a-b,axis3:e-f\ncork,2,1,3\n", "a-b,c-d,e-f", vec![1.0, 2.0, 3.0]),
        ("id,rs,hs,axis3:warm-cold\ncork,1,2,3\n", "rough-smooth,hard-soft,warm-cold", vec![1.0, 2.0, 3.0]),
        ("id,w:f,v:e,u:d,z:c,y:b,x:a\ncork,6,5,4,3,2,1\n", "a,b,c,d,e,f", vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
    ] {
        let places = of(text).unwrap();
        assert_eq!(places.axes.as_ref().map(|axes| axes.join(",")).as_deref(), Some(axes));
        assert_eq!(places.placements[0].place.at.coordinates(), at);
        let mut library = starter_library().unwrap();
        place_textures(&mut library, &places);
        let written = places_csv(&library);
        assert_eq!(read_places(&written, None, Scale::OF_SPACE).unwrap().value, places);
    }
    let error = |text: &str| of(text).unwrap_err().to_string();
    let gap = error("id,rs,hs,u:a-b\ncork,1,2,3\n");
    assert!(gap.contains("\"u:a-b\" is one axis") && gap.contains("\"z:\""), "{gap}");
    let gap = error("id,x:a-b,z:c-d\ncork,1,2\n");
    assert!(gap.contains("\"z:c-d\"") && gap.contains("\"y:\""), "{gap}");
    assert!(error("id,rs,hs,z:Hard-Soft\ncork,1,2,3\n").contains("both axes are \"Hard-Soft\""));
    assert!(error("id,rs,hs,z:a-b\ncork,1,2,\n").contains("z:a-b of \"cork\" is empty"));
}

#[test]
fn places_and_attributes_are_read() {
    let text = "id,rs,hs,flat-bumpy,source\ncork,40.5,71,33,human\nfelt,90,95,,\n";
    let placements = read_places_csv(text.as_bytes(), Some(LabelSource::PhysicalLabels)).unwrap();
    let cork = &placements[0];
    assert_eq!((cork.place.at.x(), cork.place.at.y()), (40.5, 71.0));
    assert_eq!(cork.place.source, LabelSource::HumanRatings);
    assert_eq!(cork.attributes.get("flat-bumpy"), Some(33.0));
    assert_eq!(cork.attributes.get("hard-soft"), Some(71.0));
    assert_eq!(placements[1].place.source, LabelSource::PhysicalLabels);
    assert_eq!(placements[1].attributes.values.len(), 2);
    let by_poles = "texture;Rough-Smooth;Hard-Soft\ncork;40,5;71\n";
    let placements = read_places_csv(by_poles.as_bytes(), Some(LabelSource::HumanRatings)).unwrap();
    assert_eq!(placements[0].place.at.x(), 40.5);
}

#[test]
fn a_library_is_placed_again_by_its_own_table() {
    let text =
        "id,rs,hs,source,rough-smooth,flat-bumpy\ncork,40.5,71,human,39,33\nfelt,90,95,simulated,,12.5\n";
    let placements = read_places_csv(text.as_bytes(), None).unwrap();
    assert_eq!(placements[0].attributes.get("rough-smooth"), Some(39.0));
    let mut library = starter_library().unwrap();
    let missing = place_textures(&mut library, &Places { axes: None, placements: placements.clone() });
    assert_eq!((missing.len(), missing.contains(&"cork".to_owned())), (23, false));
    let again = read_places_csv(&places_csv(&library), None).unwrap();
    assert_eq!(again, placements);
}

#[test]
fn another_scale_is_brought_to_that_of_the_space() {
    let text = "id,rs,hs,flat-bumpy\ncork,1,7,\nfelt,4,\"2,5\",6\n";
    let read = |scale| read_places(text.as_bytes(), Some(LabelSource::HumanRatings), scale);
    let placements = read(Scale::new(1.0, 7.0).unwrap()).unwrap().value.placements;
    let at = |i: usize| (placements[i].place.at.x(), placements[i].place.at.y());
    assert_eq!((at(0), at(1)), ((0.0, 100.0), (50.0, 25.0)));
    assert_eq!(placements[1].attributes.get("rough-smooth"), Some(50.0));
    assert!((placements[1].attributes.get("flat-bumpy").unwrap() - 500.0 / 6.0).abs() < 1e-12);
    assert_eq!(looks_rescaled(&placements), None);
    assert_eq!(looks_rescaled(&read(Scale::OF_SPACE).unwrap().value.placements), Some((1.0, 7.0)));
    assert_eq!(looks_rescaled(&read(Scale::OF_SPACE).unwrap().value.placements[..1]), None);
    let message = read(Scale::new(1.0, 6.0).unwrap()).unwrap_err().to_string();
    assert!(message.contains("hs in line 2 is 7; it must be between 1 and 6"), "{message}");
    for (low, high) in [(7.0, 1.0), (1.0, 1.0), (f64::NAN, 1.0), (0.0, f64::INFINITY), (-1e308, 1e308)] {
        assert!(Scale::new(low, high).is_err(), "{low} {high}");
    }
    // Rounding stays within both the space and the scale of the table.
    let odd = Scale::new(0.1, 0.7).unwrap();
    assert_eq!((odd.to_space(0.1), odd.to_space(0.7)), (0.0, 100.0));
    assert_eq!(Scale::OF_SPACE.to_space(28.999_999_999_999_996), 28.999_999_999_999_996);
}

#[test]
fn other_columns_are_named_and_not_used() {
    let text = "id,rs,hs,warm,color,flat-bumpy,start-time,age\ncork,40,71,5,red,33,12:30,5\n";
    let read = read_places(text.as_bytes(), Some(LabelSource::HumanRatings), Scale::OF_SPACE).unwrap();
    let names: Vec<&str> =
        read.value.placements[0].attributes.values.iter().map(|a| a.name.as_str()).collect();
    assert_eq!(names, ["rough-smooth", "hard-soft", "warm", "flat-bumpy"]);
    assert!(read.warnings[0].starts_with("the columns color, start-time, age are not used;"), "{read:?}");
}

#[test]
fn what_places_nothing_says_why() {
    let check = |text: &str, words: &str| {
        let message = read_places_csv(text.as_bytes(), Some(LabelSource::HumanRatings)).unwrap_err();
        assert!(message.to_string().contains(words), "{message}");
    };
    check("id,rs,hs\na,1,2\na,3,4\n", "line 2 and again in line 3");
    check("id,rs,hs\na,,2\n", "rs of \"a\" is empty");
    check("id,rs,hs\na,101,2\n", "rs in line 2 is 101; it must be between 0 and 100");
    check("id,rs,hs,warm-cold\na,1,2,-3\n", "warm-cold in line 2 is -3");
    check("id,rs,hs,warm-cold\na,1,2,12:30\n", "warm-cold in line 2 is \"12:30\"");
    check("id,rs,hs,so-so-so\na,1,2,3\n", "line 1: \"so-so-so\" can be split");
    check("id,rs,hs,source\na,1,2,me\n", "human, simulated, physical or estimated");
    check("id,rs\na,1\n", "\"hs\"");
    let unsaid = read_places_csv(b"id,rs,hs\na,1,2\n", None).unwrap_err();
    assert!(unsaid.to_string().contains("column `source`"));
}
