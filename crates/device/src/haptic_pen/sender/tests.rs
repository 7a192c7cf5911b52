use std::sync::Arc;
use std::sync::mpsc::channel;
use std::time::{Duration, Instant};

use super::{HapticMonitor, HapticReading, HapticSender, is_new, packed, unpacked};
use crate::haptic_pen::pen::HapticPen;
use crate::haptic_pen::simulated::{Got, SimulatedPen};
use crate::haptic_pen::waveform::{Play, Waveform};
use crate::link::link;

fn play(waveform: Waveform, intensity_percent: u8) -> Play {
    Play { waveform: Some(waveform), intensity_percent }
}

#[test]
fn a_pen_plays_what_it_is_sent_and_gets_its_own_settings_back() {
    let simulated = SimulatedPen::listing();
    let pen = HapticPen::open(Box::new(simulated.clone()), "test").unwrap();
    let (reporter, _monitor) = link();
    let monitor = Arc::new(HapticMonitor::default());
    let (plays_in, plays) = channel();
    let sender = HapticSender::start(pen, plays, reporter, Arc::clone(&monitor)).unwrap();
    let begun = Instant::now();
    for sent in [play(Waveform::INK, 40), play(Waveform::INK, 41), play(Waveform::CLICK, 60), Play::SILENCE] {
        plays_in.send(sent).unwrap();
        // Each is sent before the next comes.
        while monitor.reading().now != sent && sent.intensity_percent != 41 {
            assert!(begun.elapsed() < Duration::from_secs(5), "{:?}", monitor.reading());
            std::thread::sleep(Duration::from_millis(1));
        }
    }
    assert_eq!(monitor.reading().strongest, Some(play(Waveform::INK, 40)));
    drop(plays_in);
    drop(sender);
    let expected = [
        // Opening silences the pen, which played the ball pen at 50 % by itself.
        Got::Feature(vec![7, 0, 0, 1]),
        Got::Output(vec![7, 0, 0, 2]),
        // A change of one percent is not worth a report.
        Got::Feature(vec![7, 40, 0, 4]),
        Got::Output(vec![7, 60, 0, 3]),
        Got::Feature(vec![7, 0, 0, 1]),
        Got::Output(vec![7, 0, 0, 2]),
        // Closing silences it again and restores its setting.
        Got::Feature(vec![7, 0, 0, 1]),
        Got::Output(vec![7, 0, 0, 2]),
        Got::Feature(vec![7, 50, 0, 4]),
    ];
    assert_eq!(simulated.got(), expected);
}

#[test]
fn the_strongest_waveform_outlasts_a_fade() {
    let monitor = HapticMonitor::default();
    let steps = [
        (Play::SILENCE, None),
        (play(Waveform::CLICK, 90), Some(play(Waveform::CLICK, 90))),
        (play(Waveform::BRUSH, 12), Some(play(Waveform::BRUSH, 12))),
        (play(Waveform::INK, 26), Some(play(Waveform::INK, 26))),
        (play(Waveform::BRUSH, 1), Some(play(Waveform::INK, 26))),
        (Play::SILENCE, Some(play(Waveform::INK, 26))),
    ];
    for (n_reports, (noted, strongest)) in (1..).zip(steps) {
        monitor.note(noted, n_reports);
        assert_eq!(monitor.reading(), HapticReading { now: noted, strongest, n_reports });
    }
}

#[test]
fn a_pen_that_disappears_is_reported() {
    let simulated = SimulatedPen::stating();
    let pen = HapticPen::open(Box::new(simulated.clone()), "test").unwrap();
    let (reporter, mut link) = link();
    let shared = Arc::clone(&reporter.shared);
    let (plays_in, plays) = channel();
    let _sender = HapticSender::start(pen, plays, reporter, Arc::default()).unwrap();
    simulated.unplug();
    plays_in.send(play(Waveform::INK, 40)).unwrap();
    let begun = Instant::now();
    while !shared.is_lost() {
        assert!(begun.elapsed() < Duration::from_secs(5));
        std::thread::sleep(Duration::from_millis(1));
    }
    assert!(link.loss().unwrap().message().contains("does not answer"));
    drop(plays_in);
}

#[test]
fn a_pen_without_an_automatic_trigger_is_triggered() {
    let simulated = SimulatedPen::stating();
    let mut pen = HapticPen::open(Box::new(simulated.clone()), "test").unwrap();
    pen.play(play(Waveform::INK, 100)).unwrap();
    // It has no brush.
    pen.play(play(Waveform::BRUSH, 100)).unwrap();
    assert_eq!((pen.played(), pen.n_reports()), (Play::SILENCE, 3));
    drop(pen);
    let expected = [vec![2, 0], vec![4, 127], vec![2, 0], vec![2, 0]].map(Got::Output);
    assert_eq!(simulated.got(), expected);
}

#[test]
fn devices_that_are_no_haptic_pens_are_refused() {
    let gone = SimulatedPen::listing();
    gone.unplug();
    assert!(HapticPen::open(Box::new(gone), "test").is_err());
}

#[test]
fn only_changes_are_worth_a_report() {
    let ink = play(Waveform::INK, 40);
    assert!(is_new(Play::SILENCE, ink) && is_new(ink, Play::SILENCE));
    assert!(!is_new(ink, play(Waveform::INK, 42)) && is_new(ink, play(Waveform::INK, 43)));
    assert!(is_new(ink, play(Waveform::PENCIL, 40)));
    let click = play(Waveform::CLICK, 40);
    assert!(is_new(click, click) && !is_new(Play::SILENCE, Play::SILENCE));
    for reading in [ink, click, Play::SILENCE, play(Waveform(0x2fff), 100)] {
        assert_eq!(unpacked(packed(reading)), reading);
    }
    assert_eq!(HapticMonitor::default().reading(), HapticReading::default());
}
