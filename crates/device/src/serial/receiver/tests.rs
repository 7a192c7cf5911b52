use super::{About, Configure, Control, HostMessage, MAX_WIRE, Mode, Receiver, RunState};
use crate::serial::frame::Decoder;
use crate::serial::message::tests::CONFIGURE;
use crate::serial::message::{DeviceMessage, from_device, write_samples, write_to_device};
use proptest::prelude::{any, prop, proptest};

type Small = Receiver<256>;

fn tell(receiver: &mut Small, message: HostMessage<'_>) {
    let mut wire = [0; MAX_WIRE];
    let len = write_to_device(message, &mut wire);
    wire[..len].iter().for_each(|&byte| receiver.receive(byte));
}

fn feed(receiver: &mut Small, seq: u16, run: u8, samples: &[i16]) {
    let mut wire = [0; MAX_WIRE];
    let len = write_samples(seq, run, samples, &mut wire);
    wire[..len].iter().for_each(|&byte| receiver.receive(byte));
}

fn play(receiver: &mut Small, n: usize) -> Vec<i16> {
    (0..n).map(|_| receiver.tick(0)).collect()
}

/// A configured receiver of both modes, with its run number.
fn configured(configure: Configure) -> (Small, u8) {
    let mut receiver = Receiver::new(About { has_control: true, name: "test", ..About::STREAM });
    tell(&mut receiver, HostMessage::Configure(configure));
    let status = receiver.status();
    assert_eq!((status.config, status.state), (configure.config, RunState::Armed));
    (receiver, status.run)
}

/// Output of a run of constant samples: the fade-in, then the samples.
fn faded_in(sample: i16, n: usize) -> Vec<i16> {
    (1..).take(n).map(|k| (i32::from(sample) * k.min(12) / 12) as i16).collect()
}

/// Returns a name for the next message to the host.
fn sent(receiver: &mut Small) -> Option<&'static str> {
    let mut wire = [0; MAX_WIRE];
    let len = receiver.transmit(&mut wire);
    let mut decoder = Decoder::new();
    wire[..len].iter().find_map(|&byte| {
        decoder.push(byte).map(|frame| match from_device(frame).unwrap().unwrap() {
            DeviceMessage::HelloReply(reply) if reply.nonce == 0 => "reset",
            DeviceMessage::HelloReply(_) => "hello",
            DeviceMessage::Status(_) => "status",
            DeviceMessage::Sensor { .. } => "sensor",
            DeviceMessage::Fault { .. } => "fault",
        })
    })
}

#[test]
fn says_hello_after_a_reset_and_when_asked() {
    let mut receiver = Small::new(About::STREAM);
    assert_eq!((sent(&mut receiver), sent(&mut receiver)), (Some("reset"), None));
    assert_eq!(receiver.status().state, RunState::Unconfigured);
    tell(&mut receiver, HostMessage::Hello { nonce: 7, version: 1 });
    assert_eq!((sent(&mut receiver), sent(&mut receiver)), (Some("hello"), Some("status")));
    // Samples for a receiver after a reset: the status tells the host about the reset.
    feed(&mut receiver, 0, 0, &[1]);
    assert_eq!(sent(&mut receiver), Some("status"));
    assert_eq!(play(&mut receiver, 1000), [0; 1000]);
}

#[test]
fn waits_for_the_prefill_then_fades_in_and_plays_exactly() {
    let (mut receiver, run) = configured(CONFIGURE);
    feed(&mut receiver, 1000, run, &[6000; 23]);
    assert_eq!(play(&mut receiver, 20), [0; 20]);
    assert_eq!((receiver.status().state, receiver.status().queued), (RunState::Filling, 23));
    feed(&mut receiver, 1023, run, &[6000; 16]);
    assert_eq!((receiver.status().free, receiver.status().seq), (1, 1039));
    assert_eq!(play(&mut receiver, 39), faded_in(6000, 39));
    assert_eq!(receiver.status().state, RunState::Playing);
}

#[test]
fn a_gap_fades_out_and_in_again_without_a_jump() {
    let (mut receiver, run) = configured(CONFIGURE);
    feed(&mut receiver, 0, run, &[12_000; 16]);
    feed(&mut receiver, 16, run, &[12_000; 4]);
    // Four samples are lost, and then the stream continues.
    feed(&mut receiver, 24, run, &[12_000; 16]);
    let mut played = play(&mut receiver, 40);
    let expected_end: Vec<i16> = (0..12).rev().map(|k| 1000 * k).collect();
    assert_eq!(played[..20], faded_in(12_000, 20));
    assert_eq!(played[20..32], expected_end);
    assert_eq!(played[32..40], faded_in(12_000, 8));
    assert_eq!(receiver.status().underruns, 0);
    feed(&mut receiver, 40, run, &[12_000; 16]);
    played.extend(play(&mut receiver, 16));
    assert!(played.windows(2).all(|w| (w[1] - w[0]).abs() <= 1000), "{played:?}");
}

#[test]
fn lost_repeated_and_exchanged_frames_leave_the_rest_as_it_was() {
    let (mut receiver, run) = configured(CONFIGURE);
    let samples: Vec<i16> = (0..40).map(|i| 100 * i).collect();
    for begin in [8_usize, 0, 8, 24, 16, 32] {
        feed(&mut receiver, begin as u16, run, &samples[begin..begin + 8]);
        if begin == 8 {
            // The first arriving samples define the start; earlier ones are late.
            assert_eq!(receiver.status().state, RunState::Filling);
        }
    }
    assert_eq!(receiver.status().dropped, 16);
    let played = play(&mut receiver, 32);
    let expected: Vec<i32> = (0..32).map(|k| (100 * (k + 8)) * (k + 1).min(12) / 12).collect();
    assert_eq!(played.iter().map(|&x| i32::from(x)).collect::<Vec<_>>(), expected);
}

#[test]
fn an_underrun_ends_the_run_and_what_was_on_its_way_is_not_played() {
    let (mut receiver, run) = configured(CONFIGURE);
    feed(&mut receiver, 0, run, &[3000; 24]);
    play(&mut receiver, 24);
    let end = play(&mut receiver, 20);
    assert_eq!(end[..3], [2750, 2500, 2250]);
    assert_eq!(end[12..], [0; 8]);
    let status = receiver.status();
    assert_eq!((status.underruns, status.run, status.state), (1, run.wrapping_add(1), RunState::Armed));
    feed(&mut receiver, 24, run, &[3000; 40]);
    assert_eq!(play(&mut receiver, 100), [0; 100]);
    feed(&mut receiver, 500, run.wrapping_add(1), &[3000; 24]);
    assert_eq!(play(&mut receiver, 24), faded_in(3000, 24));
}

#[test]
fn late_samples_within_the_fade_go_on_in_the_same_run() {
    let (mut receiver, run) = configured(CONFIGURE);
    feed(&mut receiver, 0, run, &[3000; 24]);
    play(&mut receiver, 30);
    feed(&mut receiver, 24, run, &[3000; 40]);
    let played = play(&mut receiver, 20);
    assert_eq!(played[5..7], [0, 250]);
    assert_eq!(receiver.status().run, run);
}

#[test]
fn nothing_is_played_above_the_ceiling() {
    for ceiling in [0, 1, 1000, 32_767, 65_535] {
        let (mut receiver, run) = configured(Configure { ceiling, ..CONFIGURE });
        feed(&mut receiver, 0, run, &[i16::MIN; 20]);
        feed(&mut receiver, 20, run, &[i16::MAX; 20]);
        let played = play(&mut receiver, 60);
        let highest = played.iter().map(|x| x.unsigned_abs()).max().unwrap();
        assert_eq!(highest, ceiling.min(32_767));
    }
}

#[test]
fn the_watchdog_silences_what_waits_and_what_plays() {
    // The watchdog time is 50 ms at 4 kHz.
    let (mut receiver, run) = configured(CONFIGURE);
    feed(&mut receiver, 0, run, &[3000; 10]);
    play(&mut receiver, 199);
    assert_eq!(receiver.status().state, RunState::Filling);
    play(&mut receiver, 1);
    assert_eq!((receiver.status().state, receiver.status().underruns), (RunState::Armed, 1));
    // Remaining samples of the old run do not start the new run.
    feed(&mut receiver, 10, run, &[3000; 30]);
    assert_eq!(play(&mut receiver, 100), [0; 100]);

    let (mut receiver, run) = configured(Configure { mode: Mode::Control, ..CONFIGURE });
    let control = Control { speed_dmmps: 1000, force_mn: 500, texture: 3, gain_permille: 1000 };
    assert_eq!((receiver.control(), receiver.tick(100)), (None, 0));
    tell(&mut receiver, HostMessage::Control { seq: 9, run, control });
    assert_eq!(receiver.control(), Some(control));
    let played: Vec<i16> = (0..300).map(|_| receiver.tick(1200)).collect();
    assert_eq!(played[..14], faded_in(1200, 14));
    assert_eq!(played[198], 1200);
    assert_eq!(played[199..212], [1100, 1000, 900, 800, 700, 600, 500, 400, 300, 200, 100, 0, 0]);
    assert_eq!(receiver.control(), None);
}

#[test]
fn old_control_and_control_of_another_run_are_dropped() {
    let (mut receiver, run) = configured(Configure { mode: Mode::Control, ..CONFIGURE });
    let control = |speed_dmmps| Control { speed_dmmps, ..Control::default() };
    for (seq, run, speed, expected) in [
        (65_535, run, 1, 1),
        (65_534, run, 2, 1),
        (65_535, run, 3, 1),
        (1, run, 4, 4),
        (0, run, 5, 4),
        (2, run.wrapping_sub(1), 6, 4),
    ] {
        tell(&mut receiver, HostMessage::Control { seq, run, control: control(speed) });
        assert_eq!(receiver.control().unwrap().speed_dmmps, expected);
    }
    assert_eq!(receiver.status().dropped, 4);
    // Samples are ignored in this mode.
    feed(&mut receiver, 0, run, &[1; 5]);
    assert_eq!((receiver.status().dropped, receiver.status().queued), (9, 0));
}

#[test]
fn levels_of_friction_are_played_as_samples_without_a_sign() {
    let mut receiver = Small::new(About { has_friction: true, ..About::STREAM });
    tell(&mut receiver, HostMessage::Configure(Configure { mode: Mode::Friction, ..CONFIGURE }));
    let run = receiver.status().run;
    feed(&mut receiver, 0, run, &[12_000; 24]);
    feed(&mut receiver, 24, run, &[-5000, 32_767, 0, 1]);
    let played = play(&mut receiver, 28);
    assert_eq!(played[..24], faded_in(12_000, 24));
    assert_eq!(played[24..], [0, 29_490, 0, 1]);
    // Controls are dropped in this mode.
    let control = Control { speed_dmmps: 1, ..Control::default() };
    tell(&mut receiver, HostMessage::Control { seq: 0, run, control });
    assert_eq!((receiver.control(), receiver.status().dropped), (None, 1));
}

#[test]
fn stop_hello_and_faults_fade_out() {
    let acts: [fn(&mut Small); 4] = [
        |receiver| tell(receiver, HostMessage::Stop),
        |receiver| tell(receiver, HostMessage::Hello { nonce: 1, version: 1 }),
        |receiver| receiver.fault(true, "hot"),
        Small::skip,
    ];
    for act in acts {
        let (mut receiver, run) = configured(CONFIGURE);
        feed(&mut receiver, 0, run, &[1200; 40]);
        play(&mut receiver, 20);
        act(&mut receiver);
        feed(&mut receiver, 40, run, &[1200; 20]);
        let played = play(&mut receiver, 20);
        assert_eq!(played[..12], [1100, 1000, 900, 800, 700, 600, 500, 400, 300, 200, 100, 0]);
        assert_eq!(played[12..], [0; 8]);
    }
}

#[test]
fn what_it_cannot_do_is_a_fault_and_what_is_too_much_is_cut() {
    let mut receiver = Small::new(About::STREAM);
    sent(&mut receiver);
    for bad in [
        Configure { mode: Mode::Control, ..CONFIGURE },
        Configure { mode: Mode::Friction, ..CONFIGURE },
        Configure { rate_hz: 999, ..CONFIGURE },
    ] {
        tell(&mut receiver, HostMessage::Configure(bad));
        assert_eq!((sent(&mut receiver), receiver.status().config), (Some("fault"), 0));
    }
    let huge =
        Configure { window: 65_535, prefill: 65_535, report: 0, fade: 0, watchdog_ms: 65_535, ..CONFIGURE };
    tell(&mut receiver, HostMessage::Configure(huge));
    let settings = receiver.settings().unwrap();
    assert_eq!((settings.window, settings.prefill, settings.report, settings.fade), (256, 256, 1, 1));
    assert_eq!(receiver.status().free, 256);
    play(&mut receiver, 10);
}

#[test]
fn reports_come_by_its_own_clock() {
    let (mut receiver, _) = configured(CONFIGURE);
    while sent(&mut receiver).is_some() {}
    let n_reports = (0..800).filter(|_| {
        receiver.tick(0);
        sent(&mut receiver).is_some()
    });
    assert_eq!(n_reports.count(), 100);
    assert_eq!(receiver.status().clock, 800);
    tell(&mut receiver, HostMessage::Ping { id: 99 });
    assert_eq!((sent(&mut receiver), receiver.status().ping), (Some("status"), 99));
}

proptest! {
    /// For any bytes at any time, there is no panic, no sample above the ceiling, and no jump larger than a step of
    /// fade and signal.
    #[test]
    fn arbitrary_bytes_are_never_heard_above_the_ceiling(
        acts in prop::collection::vec((prop::collection::vec(any::<u8>(), 0..12), any::<u8>(), 0_u16..100, 0_usize..30), 0..60),
    ) {
        let (mut receiver, run) = configured(Configure { ceiling: 2000, ..CONFIGURE });
        let mut last = 0_i16;
        for (bytes, kind, seq, n_ticks) in acts {
            match kind {
                0..=99 => {
                    receiver.receive(0);
                    let run = receiver.status().run;
                    feed(&mut receiver, seq, run, &[1200; 16]);
                }
                100..=150 => bytes.iter().for_each(|&byte| receiver.receive(byte)),
                151..=170 => tell(&mut receiver, HostMessage::Stop),
                171..=190 => tell(&mut receiver, HostMessage::Hello { nonce: seq, version: kind }),
                191..=220 => tell(&mut receiver, HostMessage::Configure(Configure { ceiling: 2000, ..CONFIGURE })),
                _ => feed(&mut receiver, seq, run, &[1200; 16]),
            }
            for sample in play(&mut receiver, n_ticks) {
                assert!(sample.unsigned_abs() <= 2000);
                assert!((sample - last).abs() <= 100, "{last} then {sample}");
                last = sample;
            }
        }
    }
}
