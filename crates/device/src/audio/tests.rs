use super::{Reporter, Way, explain, find, is_by_number, list, note_error};
use crate::error::DeviceErrorKind;
use crate::link::{Monitor, link};
use crate::status::Status;
use cpal::{Error, ErrorKind};
use std::time::Instant;

fn status(monitor: &Monitor) -> Status {
    let mut status = Status::default();
    monitor.complete(&mut status, Instant::now());
    status
}

fn reported(kind: ErrorKind) -> (Reporter, Monitor) {
    let (mut reporter, monitor) = link();
    note_error("alsa:this", &mut reporter, &Error::new(kind));
    (reporter, monitor)
}

#[test]
fn what_is_gone_or_goes_elsewhere_is_lost() {
    for kind in [ErrorKind::DeviceNotAvailable, ErrorKind::DeviceChanged, ErrorKind::StreamInvalidated] {
        let (_reporter, mut monitor) = reported(kind);
        let loss = monitor.loss().unwrap();
        assert_eq!(loss.kind(), DeviceErrorKind::Lost);
        assert!(loss.message().contains("`alsa:this`") && loss.message().contains("open it again"), "{loss}");
    }
}

#[test]
fn cards_are_known_by_name_and_never_by_number() {
    for id in [
        "alsa:hw:CARD=0,DEV=0",
        "alsa:plughw:CARD=12,DEV=3",
        "alsa:hw:0,0",
        "alsa:hw:1",
        "alsa:hw:DEV=0,CARD=1",
    ] {
        assert!(is_by_number(id), "{id}");
        let error = find(Way::Out, id).map(|_| ()).unwrap_err();
        assert_eq!(error.kind(), DeviceErrorKind::NotFound);
        assert!(error.message().contains("by its number"), "{error}");
    }
    for id in [
        "alsa:hw:CARD=PCH,DEV=0",
        "alsa:sysdefault:CARD=U18dB",
        "alsa:default",
        "alsa:pulse",
        "null",
        "wasapi:{0.0}",
    ] {
        assert!(!is_by_number(id), "{id}");
    }
    assert!(list().iter().all(|output| !is_by_number(&output.id)));
}

#[test]
fn what_goes_on_is_counted_and_not_lost() {
    for (kind, underruns, backend_errors) in
        [(ErrorKind::Xrun, 1, 0), (ErrorKind::BackendError, 0, 1), (ErrorKind::RealtimeDenied, 0, 0)]
    {
        let (_reporter, mut monitor) = reported(kind);
        assert!(monitor.loss().is_none());
        let status = status(&monitor);
        assert_eq!((status.underruns, status.backend_errors), (underruns, backend_errors), "{kind:?}");
    }
}

#[test]
fn errors_say_what_where_and_what_to_do() {
    let error = explain(Way::Out, "alsa:this", "opened", &Error::new(ErrorKind::DeviceBusy));
    assert_eq!(error.kind(), DeviceErrorKind::Busy);
    assert!(error.message().starts_with("the output `alsa:this` cannot be opened: "), "{error}");
    assert!(error.message().contains("close the program") && !error.message().contains(".;"), "{error}");
}
