use std::time::Instant;

use super::{Contact, ContactSource as _, FADE_SECS, Input, Player, Takeover, TimedTouch};
use crate::hand::{Hand, Path};
use crate::repeat::{LIFT_SECS, Repeat};
use crate::touch::Touch;
use crate::track::{PenSample, Track};

const TICK: f64 = 0.005;
const HAND: Hand = Hand { path: Path::Circle, speed_mps: 0.1, force_n: 1.0, extent_m: 0.06 };

/// Sends a stylus report without delay.
fn report(player: &mut Player, touch: Touch) {
    player.report(0, TimedTouch::new(touch, Instant::now(), None), 0.0);
}

/// Runs the player for some ticks; returns each touch with the time of its tick.
fn run(player: &mut Player, n_ticks: usize) -> Vec<(f64, Touch)> {
    let one = |_| {
        let next = player.stream_secs + TICK;
        player.contact_at(next);
        (player.clock_secs, player.touch())
    };
    (0..n_ticks).map(one).collect()
}

/// A stroke of 1 s at one position, pressed from its first report on, which states its impact speed.
fn pressed_stroke() -> Track {
    let sample = |i| PenSample {
        time_secs: 0.01 * f64::from(i),
        force_n: 2.0,
        touching: true,
        impact_mps: (i == 0).then_some(0.1),
        ..PenSample::default()
    };
    let samples: Vec<PenSample> = (0..100).map(sample).collect();
    Track::new(&samples).unwrap()
}

/// A stroke of 0.5 s to the right at 0.1 m/s with a force of 0.5 N, which starts in contact.
fn straight_stroke() -> Track {
    landed_stroke(None)
}

/// The same stroke; its first sample states this impact speed.
fn landed_stroke(impact_mps: Option<f64>) -> Track {
    let sample = |i| PenSample {
        time_secs: 0.01 * f64::from(i),
        x_m: 1e-3 * f64::from(i),
        force_n: 0.5,
        touching: true,
        impact_mps: impact_mps.filter(|_| i == 0),
        ..PenSample::default()
    };
    Track::new(&(0..=50).map(sample).collect::<Vec<_>>()).unwrap()
}

fn distance(a: Touch, b: Touch) -> f32 {
    (a.x_m - b.x_m).hypot(a.y_m - b.y_m)
}

#[test]
fn the_hand_starts_when_it_is_chosen() {
    let mut player = Player::new();
    run(&mut player, 13);
    player.set_input(Input::Hand(HAND));
    for (i, (_, touch)) in run(&mut player, 50).into_iter().enumerate() {
        let expected = HAND.touch_at((i + 1) as f64 * TICK);
        assert!(distance(touch, expected) < 1e-6);
        if (i + 1) as f64 * TICK >= FADE_SECS {
            assert!((touch.contact.speed_mps - 0.1).abs() < 1e-7 && touch.contact.force_n == 1.0);
        }
    }
    assert!((player.input_secs() - 50.0 * TICK).abs() < 1e-12);
}

#[test]
fn a_hand_that_changes_its_numbers_goes_on_from_where_it_is() {
    for path in [Path::Line, Path::Circle, Path::Scribble] {
        let mut player = Player::new();
        let mut last = Touch::default();
        for (i, speed_mps) in [0.1, 0.3, 0.02, 0.25].into_iter().enumerate() {
            player.set_input(Input::Hand(Hand { path, speed_mps, force_n: 0.5 + i as f32, ..HAND }));
            for (_, touch) in run(&mut player, 37) {
                if player.clock_secs > 0.0 && i > 0 {
                    // The distance of a tick plus 3 %: the scribble's spread of 2 %, and `f32` positions of
                    // micrometers.
                    assert!(
                        distance(last, touch) <= 1.03 * speed_mps * TICK as f32,
                        "{path:?} at {speed_mps}"
                    );
                }
                last = touch;
            }
        }
        assert!((player.input_secs() - 4.0 * 37.0 * TICK).abs() < 1e-9, "it must remain one stroke");
    }
}

#[test]
fn every_change_of_input_is_a_ramp() {
    let mut player = Player::new();
    let samples = [0.0, 0.02, 0.04].map(|time_secs| PenSample {
        time_secs,
        force_n: 2.0,
        touching: true,
        x_m: time_secs,
        ..PenSample::default()
    });
    player.play(Box::new(Track::new(&samples).unwrap()));
    report(&mut player, Touch { contact: Contact { speed_mps: 0.4, force_n: 2.0 }, ..Touch::default() });
    let mut last = 0.0;
    for input in
        [Input::Hand(HAND), Input::Lifted, Input::Live, Input::Hand(HAND), Input::Track, Input::Lifted]
    {
        player.set_input(input);
        let touches = run(&mut player, 4);
        for (_, touch) in touches {
            // The force changes by 2 N within four ticks.
            assert!((touch.contact.force_n - last).abs() <= 0.5 + 1e-6, "{input:?}");
            last = touch.contact.force_n;
        }
    }
    assert_eq!(last, 0.0);
}

#[test]
fn a_live_hand_that_stops_reporting_falls_silent() {
    let mut player = Player::new();
    player.set_input(Input::Live);
    run(&mut player, 10);
    let live = Touch { x_m: 0.01, y_m: 0.02, contact: Contact { speed_mps: 0.2, force_n: 1.0 } };
    // The report is 5 ms old.
    player.report(0, TimedTouch::new(live, Instant::now(), None), 0.005);
    let touches = run(&mut player, 100);
    assert_eq!(touches[2].1, live, "must be held at an age of 20 ms");
    assert!(touches[3].1.contact.speed_mps < 0.2);
    assert!(touches[99].1.contact.speed_mps < 1e-9);
    assert_eq!((touches[99].1.x_m, touches[99].1.contact.force_n), (0.01, 1.0));
    // Invalid values act as a lifted tip.
    report(&mut player, Touch { contact: Contact { speed_mps: f32::NAN, force_n: f32::INFINITY }, ..live });
    assert_eq!(run(&mut player, 1)[0].1.contact, Contact::LIFTED);
}

#[test]
fn a_track_starts_at_its_beginning_and_ends_lifted() {
    let samples: Vec<_> = (0..30)
        .map(|i| PenSample {
            time_secs: 7.0 + 0.01 * f64::from(i),
            x_m: 1e-3 * f64::from(i),
            force_n: 0.5,
            touching: true,
            ..PenSample::default()
        })
        .collect();
    let track = Track::new(&samples).unwrap();
    let mut player = Player::new();
    player.set_input(Input::Track);
    assert!(run(&mut player, 20).iter().all(|(_, touch)| touch.contact == Contact::LIFTED));
    assert!(player.play(Box::new(track.clone())).is_none());
    for (i, (_, touch)) in run(&mut player, 80).into_iter().enumerate() {
        let secs = (i + 1) as f64 * TICK;
        assert!(distance(touch, track.touch_at(secs)) < 1e-6);
        // At the very end, rounding decides whether the tip is lifted.
        if secs >= FADE_SECS && (secs - track.duration_secs()).abs() > 1e-9 {
            assert!((touch.contact.speed_mps - track.touch_at(secs).contact.speed_mps).abs() < 1e-6);
        }
    }
    // A new track, or selecting the input again, restarts it.
    assert_eq!(player.play(Box::new(track.clone())), Some(Box::new(track)));
    run(&mut player, 3);
    assert!((player.input_secs() - 3.0 * TICK).abs() < 1e-12);
}

#[test]
fn the_stream_may_start_its_clock_again() {
    let mut player = Player::new();
    player.set_input(Input::Hand(HAND));
    let before = run(&mut player, 20)[19].1;
    player.restart_clock();
    let after = run(&mut player, 1)[0].1;
    assert!(distance(before, after) <= 0.1 * TICK as f32 * 1.01);
    assert!((player.input_secs() - 21.0 * TICK).abs() < 1e-12);
}

const TAKEOVER: Takeover = Takeover { lifted_secs: 0.1, stale_secs: 0.5 };
const PEN: Touch = Touch { x_m: 0.01, y_m: 0.02, contact: Contact { speed_mps: 0.2, force_n: 2.0 } };

/// A player with an automatic stroke in progress, which live input may take over.
fn under_way(takeover: Option<Takeover>) -> Player {
    let mut player = Player::new();
    player.set_takeover(takeover);
    player.set_input(Input::Hand(HAND));
    run(&mut player, 20);
    player
}

/// Number of ticks until the given input is followed.
fn ticks_until(player: &mut Player, input: Input) -> usize {
    (0..1000).find(|_| player.input() == input || run(player, 1).is_empty()).unwrap()
}

#[test]
fn a_touch_takes_over_at_once_with_its_landing_and_its_contact_fades() {
    let mut player = under_way(Some(TAKEOVER));
    report(&mut player, PEN);
    assert_eq!(player.input(), Input::Live);
    assert_eq!(player.take_landing(0.123).unwrap().stream_secs, 0.123);
    let mut last = HAND.force_n;
    for (_, touch) in run(&mut player, 4) {
        assert!((touch.contact.force_n - last).abs() <= 0.25 + 1e-6 && touch.contact.force_n > last);
        last = touch.contact.force_n;
    }
    assert_eq!(last, 2.0);
    // Without permission, live input does not take over.
    let mut player = under_way(None);
    report(&mut player, PEN);
    assert_eq!((player.input(), player.take_landing(0.0)), (Input::Hand(HAND), None));
    // Permission may come later, as on an output that is opened while a pen touches.
    player.set_takeover(Some(TAKEOVER));
    assert_eq!(player.input(), Input::Live);
    player.set_takeover(None);
    assert_eq!(player.input(), Input::Hand(HAND));
}

#[test]
fn the_chosen_input_goes_on_from_where_it_was() {
    let mut player = under_way(Some(TAKEOVER));
    let (before, secs) = (player.touch(), player.input_secs());
    report(&mut player, PEN);
    run(&mut player, 30);
    assert!((player.input_secs() - secs).abs() < 1e-9);
    report(&mut player, PEN.lifted());
    // 100 ms, and the tick after that.
    assert!((20..=21).contains(&ticks_until(&mut player, Input::Hand(HAND))));
    let mut last = 0.0;
    for (_, touch) in run(&mut player, 3) {
        assert!((touch.contact.force_n - last) <= 0.25 + 1e-6, "the contact must fade");
        last = touch.contact.force_n;
    }
    // Four ticks of the stroke have passed; each moves the tip by 0.5 mm.
    assert!(distance(before, player.touch()) < 4.1 * 0.5e-3);
    assert!((player.input_secs() - secs - 4.0 * TICK).abs() < TICK + 1e-9);
}

#[test]
fn a_stylus_that_says_nothing_more_is_given_up_after_a_while() {
    let mut player = under_way(Some(TAKEOVER));
    report(&mut player, PEN);
    assert!((100..=101).contains(&ticks_until(&mut player, Input::Hand(HAND))));
    // A report that is older than the limit does not take over.
    player.report(0, TimedTouch::new(PEN, Instant::now(), None), 0.6);
    assert_eq!(player.input(), Input::Hand(HAND));
    // A duration that is not a number counts as zero.
    player.set_takeover(Some(Takeover { lifted_secs: f32::NAN, stale_secs: f32::NAN }));
    report(&mut player, PEN);
    assert_eq!(player.input(), Input::Hand(HAND));
}

#[test]
fn what_is_near_takes_over_and_a_mouse_that_moves_along_does_not_matter() {
    let mut player = under_way(Some(TAKEOVER));
    let mouse =
        |player: &mut Player, touch| player.report(1, TimedTouch::new(touch, Instant::now(), None), 0.0);
    let hover = TimedTouch { is_near: true, ..TimedTouch::new(PEN.lifted(), Instant::now(), None) };
    mouse(&mut player, PEN.lifted());
    assert_eq!(player.input(), Input::Hand(HAND), "a mouse that is not pressed must not take over");
    player.report(0, hover, 0.0);
    assert_eq!(player.input(), Input::Live);
    run(&mut player, 10);
    assert_eq!(player.touch().contact, Contact::LIFTED);
    report(&mut player, PEN);
    mouse(&mut player, PEN.lifted());
    run(&mut player, 4);
    assert_eq!(player.touch().contact.force_n, 2.0, "the mouse must not lift the pen");
    let pressed = Touch { contact: Contact { force_n: 0.7, ..PEN.contact }, ..PEN };
    mouse(&mut player, pressed);
    run(&mut player, 4);
    assert_eq!(player.touch().contact.force_n, 2.0, "the mouse must not replace the pen");
    player.report(0, hover, 0.0);
    mouse(&mut player, pressed);
    run(&mut player, 10);
    assert_eq!(player.touch().contact, Contact::LIFTED, "the mouse must not replace a hovering pen");
    report(&mut player, PEN);
    report(&mut player, PEN.lifted());
    mouse(&mut player, PEN.lifted());
    assert!((20..=21).contains(&ticks_until(&mut player, Input::Hand(HAND))));
    // The pen has left, so the mouse may press.
    mouse(&mut player, pressed);
    run(&mut player, 10);
    assert_eq!(player.touch().contact.force_n, 0.7);
}

#[test]
fn a_stroke_that_begins_under_a_persons_hand_lands_when_its_turn_comes() {
    let mut player = under_way(Some(TAKEOVER));
    report(&mut player, PEN);
    run(&mut player, 10);
    player.play(Box::new(pressed_stroke()));
    player.set_input(Input::Track);
    run(&mut player, 10);
    while player.take_landing(0.0).is_some() {}
    report(&mut player, PEN.lifted());
    ticks_until(&mut player, Input::Track);
    run(&mut player, 2);
    assert!(player.take_landing(0.0).is_some());
}

#[test]
fn a_hand_that_has_taken_over_stays_when_the_chosen_input_changes() {
    let mut player = under_way(Some(TAKEOVER));
    report(&mut player, PEN);
    run(&mut player, 10);
    for input in [Input::Live, Input::Lifted, Input::Track, Input::Hand(HAND)] {
        player.set_input(input);
        let touches = run(&mut player, 3);
        assert!(touches.iter().all(|(_, touch)| touch.contact.force_n == 2.0), "{input:?}");
    }
    // Resuming a stroke in its middle is not a contact onset.
    report(&mut player, PEN.lifted());
    run(&mut player, 40);
    player.play(Box::new(pressed_stroke()));
    player.set_input(Input::Lifted);
    run(&mut player, 10);
    player.set_input(Input::Track);
    run(&mut player, 10);
    assert!(player.take_landing(0.0).is_some());
    run(&mut player, 10);
    report(&mut player, PEN);
    assert!(player.take_landing(0.0).is_some());
    run(&mut player, 10);
    report(&mut player, PEN.lifted());
    ticks_until(&mut player, Input::Track);
    run(&mut player, 10);
    assert_eq!((player.take_landing(0.0), player.touch().contact.force_n), (None, 2.0));
}

#[test]
fn a_repeated_stroke_has_its_speed_and_is_lifted_in_between() {
    for (tempo, force) in [(1.0, 1.0), (0.5, 2.0), (2.0, 0.5)] {
        let mut player = Player::new();
        player.play(Box::new(straight_stroke()));
        player.set_input(Input::Repeat(Repeat { tempo, force }));
        let stroke_secs = 0.5 / f64::from(tempo);
        let cycle_secs = stroke_secs + LIFT_SECS;
        for (i, (_, touch)) in run(&mut player, 600).into_iter().enumerate() {
            let secs = ((i + 1) as f64 * TICK).rem_euclid(cycle_secs);
            // The change of input fades, and at the very ends rounding decides.
            if i < 5 || secs.min((secs - stroke_secs).abs()).min(cycle_secs - secs) < 1e-6 {
                continue;
            }
            if secs > stroke_secs {
                assert_eq!(touch.contact, Contact::LIFTED, "{tempo} at {secs}");
                continue;
            }
            assert_eq!(touch.contact.force_n, 0.5 * force, "{tempo} at {secs}");
            assert!((f64::from(touch.x_m) - 0.1 * f64::from(tempo) * secs).abs() < 1e-6, "{tempo} at {secs}");
            // The speed estimate starts at rest and is exact once it has settled.
            if secs > 0.1 / f64::from(tempo) {
                let off = touch.contact.speed_mps - 0.1 * tempo;
                assert!(off.abs() < 1e-4 * tempo, "{tempo} at {secs}: {}", touch.contact.speed_mps);
            }
        }
    }
}

#[test]
fn every_beginning_of_a_repeated_stroke_lands_unless_the_stroke_starts_in_contact() {
    // Almost three seconds, with a period of 0.6 s.
    for (impact_mps, n_landings) in [(Some(0.1), 5), (Some(0.0), 0), (None, 0)] {
        let mut player = Player::new();
        player.play(Box::new(landed_stroke(impact_mps)));
        player.set_input(Input::Repeat(Repeat::AS_RECORDED));
        let landed = (0..590).filter(|_| {
            run(&mut player, 1);
            player.take_landing(0.0).is_some()
        });
        assert_eq!(landed.count(), n_landings, "{impact_mps:?}");
    }
}

#[test]
fn a_repeated_stroke_that_is_stopped_is_lifted_once_it_has_faded() {
    let mut player = Player::new();
    player.play(Box::new(straight_stroke()));
    player.set_input(Input::Repeat(Repeat::AS_RECORDED));
    run(&mut player, 20);
    assert_eq!(player.touch().contact.force_n, 0.5);
    player.set_input(Input::Lifted);
    let touches = run(&mut player, 5);
    // The force decreases from the first tick on and is zero after the fade of four ticks.
    assert!(touches.windows(2).all(|pair| pair[1].1.contact.force_n <= pair[0].1.contact.force_n));
    assert!(touches[0].1.contact.force_n < 0.5);
    assert_eq!(touches[4].1.contact, Contact::LIFTED);
}

#[test]
fn a_repeated_stroke_goes_on_where_its_tempo_changes_and_waits_for_a_persons_hand() {
    let mut player = Player::new();
    player.set_takeover(Some(TAKEOVER));
    player.play(Box::new(straight_stroke()));
    player.set_input(Input::Repeat(Repeat::AS_RECORDED));
    run(&mut player, 40);
    let before = player.touch();
    player.set_input(Input::Repeat(Repeat { tempo: 2.0, force: 1.0 }));
    run(&mut player, 1);
    assert!((player.touch().x_m - before.x_m - 0.2 * TICK as f32).abs() < 1e-6, "the stroke must continue");
    let before = player.touch();
    report(&mut player, PEN);
    run(&mut player, 30);
    assert_eq!(player.input(), Input::Live);
    report(&mut player, PEN.lifted());
    ticks_until(&mut player, Input::Repeat(Repeat { tempo: 2.0, force: 1.0 }));
    assert!((player.touch().x_m - before.x_m) <= 0.2 * 2.0 * TICK as f32, "the stroke must have paused");
    // A new stroke starts at its beginning.
    player.play(Box::new(straight_stroke()));
    run(&mut player, 1);
    assert!((player.touch().x_m - 0.2 * TICK as f32).abs() < 1e-6);
}

#[test]
fn both_coordinates_of_a_stroke_are_followed() {
    let mut player = Player::new();
    player.set_input(Input::Hand(HAND));
    for _ in 0..50 {
        let (_, touch) = run(&mut player, 1)[0];
        let place = player.place();
        assert_eq!([place.x_m, place.y_m], [touch.x_m, touch.y_m].map(f64::from));
    }
    let n_jumps = player.place().n_jumps;
    player.set_input(Input::Live);
    for i in 0..100 {
        let y_m = 5e-4 * i as f32;
        let contact = Contact { speed_mps: 0.1, force_n: 1.0 };
        report(&mut player, Touch { x_m: 0.01, y_m, contact });
        run(&mut player, 1);
        let place = player.place();
        // The first reports serve to estimate the velocity.
        let expected_m = f64::from(y_m) + if i < 20 { 0.0 } else { 5e-4 };
        let tolerance_m = if i < 20 { 2e-3 } else { 1e-4 };
        assert!((place.x_m - 0.01).abs() < 1e-6, "{place:?} at {i}");
        assert!((place.y_m - expected_m).abs() < tolerance_m, "{place:?} for {expected_m} m at {i}");
    }
    assert!(player.place().n_jumps > n_jumps, "a change of input is a jump");
}
