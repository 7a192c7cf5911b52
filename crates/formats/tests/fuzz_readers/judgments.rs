//! Tables of judgments, positions, recordings and photos: small valid files, and properties of the results from mutated ones.

use shagreen_core::space::LabelSource;
use shagreen_formats::photo_table::read_photo_table;
use shagreen_formats::places_csv::{Scale, read_places};
use shagreen_formats::rated_pairs_csv::read_rated_pairs;
use shagreen_formats::ratings_csv::{ratings_csv, read_ratings_csv, read_relevance_csv};
use shagreen_formats::sorting_csv::{read_sorting_csv, sorting_csv};
use shagreen_formats::texture_files::{TextureFileKind, read_texture_files};

pub(crate) fn sorting_seeds() -> Vec<Vec<u8>> {
    let long = "participant,trial,groups,texture,group\np1,1,2,cork,a\np1,1,2,felt,a\np1,1,2,glass,b\n";
    let wide = "subject;trial;n groups;cork;felt;glass\np1;1;2;a;a;b\np2;1;2;x;;y\n# note\n";
    let unicode = wide.replace(';', "\t").encode_utf16().flat_map(u16::to_be_bytes).collect();
    [long.as_bytes().to_vec(), wide.as_bytes().to_vec(), [vec![0xfe, 0xff], unicode].concat()].to_vec()
}

pub(crate) fn ratings_seeds() -> Vec<Vec<u8>> {
    let long =
        "participant,texture,adjective,value\np1,cork,rough-smooth,41\np2,\"cork, old\",hard - soft,\n";
    let wide = "subject\ttexture id\trough-smooth\thard-soft\np1\tcork\t41\t70,5\np2\tcork\tNA\t60\n";
    let votes = "participant,adjective,relevant\np1,rough,yes\np1,warm,0\n";
    let stray = "sep=,\nparticipant,age,texture,rough-smooth,start-time\np1,31,cork,\"3,5\",12:30\n";
    [long, wide, votes, stray].map(|text| text.as_bytes().to_vec()).to_vec()
}

pub(crate) fn places_seeds() -> Vec<Vec<u8>> {
    let plain = "id,rs,hs,flat-bumpy,source\ncork,40.5,71,33,human\nfelt,90,95,,\n";
    let by_poles = "texture;Rough-Smooth;Hard-Soft\ncork;40,5;71\n";
    let stray = "sep=|\nid|rs|hs|color|flat-bumpy\ncork|1|7|red|4\n";
    let further =
        "id,x:warm-cold,y:hard-soft,z:a-b,u:c,source\ncork,40.5,71,33,2,human\nfelt,90,95,1,5,human\n";
    [plain, by_poles, stray, further].map(|text| text.as_bytes().to_vec()).to_vec()
}

pub(crate) fn recordings_seeds() -> Vec<Vec<u8>> {
    let plain = "texture,recording\ncork,cork-1.csv\ncork,cork-2.csv\n";
    let quoted = "texture id;file;note\ncork;\"a;b.wav\";slow\n";
    [plain, quoted].map(|text| text.as_bytes().to_vec()).to_vec()
}

pub(crate) fn photo_table_seeds() -> Vec<Vec<u8>> {
    let plain = "file,class,softness,softness_sd,source,license\na.jpg,brick,9,7,mine,CC0\n";
    let other =
        "file;cls;repo;licence;author;softness;softness_sd;note\nb/c.png;felt;x;MIT;A;70,5;9;by eye\n";
    [plain, other].map(|text| text.as_bytes().to_vec()).to_vec()
}

pub(crate) fn rated_pairs_seeds() -> Vec<Vec<u8>> {
    let answers = "reference,comparison,n_same,n_different,n_trials_identical,n_different_on_identical,d_prime,simulated\n\
        a.wav,b.wav,10,30,24,6,,0\n";
    let trials = "reference;comparison;hits;n different;false alarms;n same;weight\na;b;30;40;6;24;2,5\n";
    let distances =
        "sep=,\nreference,comparison,texture,d_prime,roughness,envelope\n1,2,steel,0.7,\"0,5\",0.25\n";
    [answers, trials, distances].map(|text| text.as_bytes().to_vec()).to_vec()
}

/// Small tables that request much memory or time: many columns, many lines, many names.
pub(crate) fn table_bombs() -> Vec<Vec<u8>> {
    let columns = |first: &str| {
        format!("{first},{}\n", (0..100_000).map(|i| i.to_string()).collect::<Vec<_>>().join(","))
    };
    let wide = format!("{}{}\n", columns("participant"), ",".repeat(100_000));
    let long = "participant,texture,adjective,value\n".to_owned() + &"p,t,a-b,1\n".repeat(1 << 16);
    let lines = |line: &dyn Fn(u32) -> String| (0..1 << 15).map(line).collect::<Vec<_>>().join("\n");
    let sorts = "participant,trial,texture,group\n".to_owned() + &lines(&|i| format!("p{i},1,t{i},g"));
    let places = "id,rs,hs\n".to_owned() + &lines(&|i| format!("t{i},1,2"));
    [",".repeat(1 << 20), "\n".repeat(1 << 20), wide, long, sorts, places].map(String::into_bytes).to_vec()
}

/// The result can be written, and reading it again gives the same.
pub(crate) fn read_a_sorting(bytes: &[u8]) -> Result<(), String> {
    let Ok(table) = read_sorting_csv(bytes) else { return Ok(()) };
    let mut sorts = table.sorts;
    // An empty sort has no line.
    sorts.retain(|sort| !sort.placements.is_empty());
    if sorts.is_empty() {
        return Ok(());
    }
    let again = read_sorting_csv(&sorting_csv(&sorts)).map_err(|error| error.to_string())?;
    if again.sorts == sorts { Ok(()) } else { Err(format!("{sorts:?} became {:?}", again.sorts)) }
}

pub(crate) fn read_some_ratings(bytes: &[u8]) -> Result<(), String> {
    let votes = read_relevance_csv(bytes);
    if let Some(vote) = votes.iter().flatten().find(|vote| vote.participant.is_empty()) {
        return Err(format!("a vote has no participant: {vote:?}"));
    }
    let Ok(ratings) = read_ratings_csv(bytes) else { return Ok(()) };
    let again = read_ratings_csv(&ratings_csv(&ratings)).map_err(|error| error.to_string())?;
    if again == ratings { Ok(()) } else { Err(format!("{ratings:?} became {again:?}")) }
}

pub(crate) fn read_some_places(bytes: &[u8]) -> Result<(), String> {
    let human = Some(LabelSource::HumanRatings);
    let on_seven = Scale::new(1.0, 7.0).map_err(|error| error.to_string())?;
    let mut placements = [Scale::OF_SPACE, on_seven]
        .into_iter()
        .filter_map(|scale| read_places(bytes, human, scale).ok())
        .flat_map(|imported| imported.value.placements);
    let is_inside = |value: f64| (0.0..=100.0).contains(&value);
    let outside = placements.find(|p| {
        let at = p.place.at;
        let is_in_space = at.coordinates().iter().all(|coordinate| is_inside(*coordinate));
        !(is_in_space && p.attributes.values.iter().all(|a| is_inside(a.value)))
    });
    outside.map_or(Ok(()), |placement| Err(format!("{placement:?}")))
}

pub(crate) fn read_some_recordings(bytes: &[u8]) -> Result<(), String> {
    let recordings = read_texture_files(bytes, TextureFileKind::Recording).unwrap_or_default();
    let empty = recordings.iter().find(|of| of.texture.is_empty() || of.file.is_empty());
    empty.map_or(Ok(()), |recording| Err(format!("{recording:?}")))
}

/// All numbers of a pair can be fitted.
pub(crate) fn read_some_rated_pairs(bytes: &[u8]) -> Result<(), String> {
    let Ok(read) = read_rated_pairs(bytes) else { return Ok(()) };
    let broken = read.value.rows.iter().find(|row| {
        let mut distances = row.distances.iter().flat_map(|distances| distances.0);
        let are_distances = distances.all(|distance| distance.is_finite() && distance >= 0.0);
        let has_names = !(row.reference.is_empty() || row.comparison.is_empty() || row.texture.is_empty());
        !(are_distances && has_names && row.d_prime.abs() <= 40.0 && row.weight > 0.0)
    });
    broken.map_or(Ok(()), |row| Err(format!("{row:?}")))
}

/// All indices and numbers of a table are possible.
pub(crate) fn read_some_photos(bytes: &[u8]) -> Result<(), String> {
    let Ok(table) = read_photo_table(bytes) else { return Ok(()) };
    let is_label = |softness: f64, sd: f64| (0.0..=100.0).contains(&softness) && sd > 0.0 && sd <= 50.0;
    let is_sound = table.classes.iter().all(|class| is_label(class.softness, class.softness_sd))
        && table.photos.iter().all(|photo| {
            photo.class < table.classes.len() && photo.source < table.sources.len() && !photo.file.is_empty()
        });
    if is_sound { Ok(()) } else { Err(format!("{table:?}")) }
}
