use super::{ratings_csv, read_ratings, read_ratings_csv, read_relevance_csv, relevance_csv};

const LONG: &str = "participant,texture,adjective,value\n\
                    p1,cork,rough-smooth,41\np1,cork,hard-soft,70.5\n\
                    p2,cork,rough-smooth,\np2,cork,hard-soft,60\n";
const WIDE: &str = "subject\ttexture id\trough-smooth\thard-soft\np1\tcork\t41\t70,5\np2\tcork\t\t60\n";

#[test]
fn both_shapes_say_the_same() {
    let long = read_ratings_csv(LONG.as_bytes()).unwrap();
    assert_eq!(read_ratings_csv(WIDE.as_bytes()), Ok(long.clone()));
    assert_eq!((long.len(), long[2].value, long[1].value), (4, None, Some(70.5)));
    assert_eq!(read_ratings_csv(&ratings_csv(&long)), Ok(long));
}

#[test]
fn what_is_no_rating_says_why() {
    let check = |text: &str, words: &str| {
        let message = read_ratings_csv(text.as_bytes()).unwrap_err().to_string();
        assert!(message.contains(words), "{message}");
    };
    for sorts in [
        "participant,trial,groups,texture,group\np,1,2,cork,a\n",
        "participant,trial,cork,felt\np,1,a,b\n",
        "participant,groups,cork,felt\np,2,a,b\n",
    ] {
        check(sorts, "this looks like the sorting table: the columns are participant");
    }
    check("participant,texture\np,cork\n", "no column holds ratings");
    check("participant,texture,smoothness\np,cork,3\n", "the columns are participant, texture, smoothness");
    check("participant,texture,non-stick-sticky\np,cork,3\n", "line 1: \"non-stick-sticky\" can be split");
    check("sep=,\nparticipant,texture,non-stick-sticky\np,cork,3\n", "line 2: \"non-stick-sticky\"");
    check(
        "participant,texture,a-b\np,cork,101\n",
        "a-b in line 2 is \"101\"; a rating is a number from 0 to 100",
    );
    check("participant,texture,a-b,pre-post\np,cork,1,12:30\n", "pre-post in line 2 is \"12:30\"");
    check(
        "participant,texture,a-b,pre-post\np,cork,1,12:30\n",
        "if the column is not an adjective pair, remove it",
    );
    check("participant,texture,pair,value\np,cork,a-b,-1\n", "value in line 2 is \"-1\"");
    check("participant,texture,a-b\np,cork,\"1,234,5\"\n", "a-b in line 2 is \"1,234,5\"");
    check("participant,texture,adjective,value\np,cork,smooth,3\n", "line 2: \"smooth\"");
    check("participant,texture,a-b\np,cork,much\n", "a-b in line 2 is \"much\"");
    check("participant,texture,a-b\np,,3\n", "line 2 has no texture");
    check("texture,a-b\ncork,3\n", "\"participant\"");
}

#[test]
fn other_columns_are_named_and_not_used() {
    let expected = read_ratings(WIDE.as_bytes()).unwrap();
    assert!(expected.warnings.is_empty());
    let wide = "subject,age,texture id,rough-smooth,start-time,hard-soft,test date\n\
                p1,31,cork,41,12:30,\"70,5\",2026-11-21\np2,27,cork,,12:40,60,2026-11-21\n";
    let read = read_ratings(wide.as_bytes()).unwrap();
    assert_eq!(read.value, expected.value);
    assert!(read.warnings[0].starts_with("the columns age, start-time, test date are not used;"), "{read:?}");
    let long = "participant,trial,texture,adjective,value\np1,1,cork,rough-smooth,41\n";
    let read = read_ratings(long.as_bytes()).unwrap();
    assert!(
        read.value.len() == 1 && read.warnings[0].starts_with("the column trial is not used;"),
        "{read:?}"
    );
}

#[test]
fn votes_are_read_in_both_shapes() {
    let long = "participant,adjective,relevant\np1,rough,yes\np1,warm,0\np2,rough,1\np2,warm,\n";
    let wide = "participant,rough,warm\np1,1,0\np2,x,\n";
    let votes = read_relevance_csv(long.as_bytes()).unwrap();
    assert_eq!(read_relevance_csv(wide.as_bytes()), Ok(votes.clone()));
    assert_eq!(votes.iter().filter(|vote| vote.relevant).count(), 2);
    assert_eq!(read_relevance_csv(&relevance_csv(&votes)), Ok(votes));
    let message = read_relevance_csv(b"participant,rough\np1,maybe\n").unwrap_err().to_string();
    assert!(message.contains("rough in line 2 is \"maybe\""), "{message}");
}
