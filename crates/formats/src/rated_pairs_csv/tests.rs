use super::{CountedPair, RatedPairsTable, RatedRow, rated_pairs_csv, read_rated_pairs};
use shagreen_core::people::study::same_different::{Correction, Counts, d_prime};
use shagreen_core::signals::quality::{Distances, Feature};

fn read(text: &str) -> RatedPairsTable {
    let read = read_rated_pairs(text.as_bytes()).unwrap();
    assert_eq!(read.warnings, [""; 0]);
    read.value
}

#[test]
fn every_form_of_ratings_says_the_same() {
    let counts = Counts { hits: 30, n_different: 40, false_alarms: 6, n_same: 24 };
    let rated = d_prime(counts, Correction::LogLinear).unwrap();
    let answers = "reference,comparison,n_same,n_different,n_trials_identical,n_different_on_identical\n\
        a.wav,b.wav,10,30,24,6\n";
    let trials = "Reference;Comparison;Hits;N different;False alarms;N same\na.wav;b.wav;30;40;6;24\n";
    for text in [answers, trials] {
        let RatedRow { d_prime, counts: found, line, texture, .. } = read(text).rows.remove(0);
        assert_eq!((d_prime, found, line, texture.as_str()), (rated, Some(counts), 2, "a.wav"), "{text}");
    }
    // A stated d′ is used as it is; without one, the counts of the row are.
    let both = "reference,comparison,d_prime,hits,n_different,false_alarms,n_same\n\
        a,b,1.5,,,,\na,c,,30,40,6,24\na,d,-0.5,30,40,6,24\n";
    let rows = read(both).rows;
    assert_eq!(rows.iter().map(|row| row.d_prime).collect::<Vec<_>>(), [1.5, rated, -0.5]);
    assert_eq!(rows.iter().map(|row| row.counts).collect::<Vec<_>>(), [None, Some(counts), None]);
}

#[test]
fn counts_of_a_study_come_back() {
    let pair = |comparison: &str, hits: u64, is_simulated: bool| CountedPair {
        reference: "steel, polished".to_owned(),
        comparison: comparison.to_owned(),
        counts: Counts { hits, n_different: 144, false_alarms: 20, n_same: 144 },
        is_simulated,
    };
    let pairs = [pair("steel-3.15", 40, false), pair("steel-1.75", 144, true)];
    let bytes = rated_pairs_csv(&pairs);
    let first = "reference,comparison,n_same,n_different,n_trials_identical,n_different_on_identical,d_prime,simulated";
    assert_eq!(String::from_utf8_lossy(&bytes).lines().next(), Some(first));
    let rows = read_rated_pairs(&bytes).unwrap().value.rows;
    for (row, pair) in rows.iter().zip(&pairs) {
        assert_eq!((&row.reference, &row.comparison), (&pair.reference, &pair.comparison));
        assert_eq!(Some(row.d_prime), d_prime(pair.counts, Correction::LogLinear));
        assert_eq!((row.is_simulated, row.weight, row.distances), (pair.is_simulated, 1.0, None));
    }
    // Without the stated d′, it follows from the counts.
    let text = String::from_utf8(bytes).unwrap().replace("d_prime", "note");
    let read = read_rated_pairs(text.as_bytes()).unwrap();
    assert!(read.warnings[0].starts_with("the column note is not used; "), "{:?}", read.warnings);
    assert_eq!(read.value.rows[1].counts, Some(pairs[1].counts));
    assert_eq!(read.value.rows[0].d_prime, rows[0].d_prime);
    // A pair without one kind of trials has no d′ to state.
    let none =
        CountedPair { counts: Counts { n_same: 0, false_alarms: 0, ..pairs[0].counts }, ..pairs[0].clone() };
    let error = read_rated_pairs(&rated_pairs_csv(&[none])).unwrap_err().to_string();
    assert!(error.contains("line 2 has no trials with identical signals"), "{error}");
}

#[test]
fn distances_weights_and_textures_are_read() {
    let text = "reference,comparison,texture,d_prime,weight,Spectral Power,envelope\n\
        1,2,steel,0.7,2,100.5,0.25\n1,3,,1.7,,80,0\n";
    let table = read(text);
    assert_eq!(table.features, [Feature::SpectralPower, Feature::Envelope]);
    let mut distances = Distances::default();
    distances.0[Feature::SpectralPower as usize] = 100.5;
    distances.0[Feature::Envelope as usize] = 0.25;
    let [first, second] = &table.rows[..] else { panic!("{table:?}") };
    assert_eq!((first.distances, first.weight, first.texture.as_str()), (Some(distances), 2.0, "steel"));
    assert_eq!((second.weight, second.texture.as_str()), (1.0, "1"));
}

#[test]
fn what_cannot_be_used_says_where_and_what_to_do() {
    let check = |text: &str, words: &[&str]| {
        let message = read_rated_pairs(text.as_bytes()).unwrap_err().to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
    };
    check("reference,d_prime\na,1\n", &["no column is named \"comparison\""]);
    check("", &["no rows", "per pair of signals"]);
    check("reference,comparison,hits\na,b,1\n", &["no column is named \"n_different\""]);
    check(
        "reference,comparison,n_same\na,b,1\n",
        &["no column has ratings", "n_trials_identical", "reference, comparison, n_same"],
    );
    check("reference,comparison,hits,n_trials_identical\na,b,1,1\n", &["remove one form"]);
    check("reference,comparison,d_prime\na,,1\n", &["line 2 has no comparison"]);
    check(
        "reference,comparison,d_prime\na,b,\n",
        &["line 2 has neither d_prime nor counts", "remove the line"],
    );
    check("reference,comparison,d_prime\na,b,41\n", &["d_prime in line 2 is 41", "between -40 and 40"]);
    check("reference,comparison,d_prime\n\na,b,x\n", &["d_prime in line 3 is \"x\", not a number"]);
    let counts = "reference,comparison,hits,n_different,false_alarms,n_same\n";
    check(&format!("{counts}a,b,3,4,,4\n"), &["line 2 has neither d_prime nor false_alarms"]);
    check(&format!("{counts}a,b,5,4,0,4\n"), &["line 2 has 5", "only 4 trials with different signals"]);
    check(&format!("{counts}a,b,3,4,9,4\n"), &["line 2 has 9", "only 4 trials with identical signals"]);
    check(&format!("{counts}a,b,0,0,0,4\n"), &["line 2 has no trials with different signals"]);
    check(&format!("{counts}a,b,2.5,4,0,4\n"), &["hits in line 2 is 2.5", "whole number"]);
    check(&format!("{counts}a,b,-1,4,0,4\n"), &["hits in line 2 is -1"]);
    let more = "reference,comparison,d_prime,weight,simulated,roughness\n";
    check(&format!("{more}a,b,1,0,0,1\n"), &["weight in line 2 is 0", "above 0"]);
    check(&format!("{more}a,b,1,1,2,1\n"), &["simulated in line 2 is 2", "0 or 1"]);
    check(&format!("{more}a,b,1,1,0,-1\n"), &["roughness in line 2 is -1", "from 0"]);
    check(&format!("{more}a,b,1,1,0,\n"), &["line 2 has no roughness", "all of them"]);
}
