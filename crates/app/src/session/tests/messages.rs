//! Messages in the status bar.

use std::time::{Duration, Instant};

use super::starter;
use crate::session::Session;

/// A refusal is not about the output, and it goes with the next edit once it could be read. What is said of the output
/// stays until it is dismissed.
#[test]
fn a_message_goes_when_the_user_goes_on() {
    let mut session = Session::new(starter()).unwrap();
    session.say_of_output("the output is gone".to_owned());
    session.say("nothing to export".to_owned());
    let both = ["the output is gone", "nothing to export"];
    assert_eq!(session.messages().collect::<Vec<_>>(), both);
    assert_eq!((session.output_message(), session.message()), (Some(both[0]), Some(both[1])));
    session.forget_read_message(Instant::now());
    assert_eq!(session.message(), Some(both[1]), "nobody could read it yet");
    session.forget_read_message(Instant::now() + Duration::from_mins(1));
    assert_eq!(session.messages().collect::<Vec<_>>(), both[..1]);
    session.forget_messages();
    assert_eq!(session.messages().next(), None);
}
