use super::{PenTracker, TrackerOptions, stroke_samples};
use crate::hid::descriptor::parse;
use crate::hid::descriptor::tests::PEN;
use crate::hid::pen::PenDecoder;
use crate::kinematics::SpeedFilter;
use crate::pressure::PressureMap;
use crate::track::Track;
use shagreen_synth::contact::Contact;

const OPTIONS: TrackerOptions =
    TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: PressureMap::USUAL };

fn tracker() -> PenTracker {
    PenTracker::new(PenDecoder::of_descriptor(&parse(PEN).unwrap()).unwrap(), OPTIONS)
}

/// A report of [`PEN`], with 209.66 × 157.25 mm in units of 0.01 mm and 4.016 N in 4095 steps.
pub(crate) fn report(x: u16, y: u16, pressure: u16, switches: u8) -> Vec<u8> {
    let mut bytes = vec![0x1a, switches];
    for number in [x, y, pressure, 0, 0] {
        bytes.extend(number.to_le_bytes());
    }
    bytes
}

/// Switches for tip and in range, and for in range alone.
pub(crate) const DOWN: u8 = 0x21;
pub(crate) const HOVER: u8 = 0x20;

#[test]
fn a_steady_stroke_has_its_speed_force_and_places() {
    let mut tracker = tracker();
    let mut last = tracker.report(0.0, &report(5000, 7862, 0, HOVER)).unwrap();
    assert_eq!(last.touch.contact, Contact::LIFTED);
    // The tip moves 1 mm to the right every 5 ms.
    for i in 0..100_u16 {
        last = tracker.report(0.005 * f64::from(i + 1), &report(5000 + 100 * i, 7862, 2048, DOWN)).unwrap();
    }
    assert!((last.touch.contact.speed_mps - 0.2).abs() < 1e-4);
    let force_n = 2048.0 / 4095.0 * 4.016;
    assert!(
        (f64::from(last.touch.contact.force_n) - force_n).abs() < 1e-6
            && (last.force_n - force_n).abs() < 1e-9
    );
    let [x_m, y_m] = last.place_m.unwrap();
    assert!((x_m - (0.149 - 0.104_83)).abs() < 1e-9 && y_m.abs() < 1e-5);
}

#[test]
fn up_is_away_from_the_person() {
    let upper = tracker().report(0.0, &report(0, 0, 0, DOWN)).unwrap().place_m.unwrap();
    assert!((upper[0] + 0.104_83).abs() < 1e-9 && (upper[1] - 0.078_625).abs() < 1e-9);
}

#[test]
fn a_new_stroke_begins_at_rest_and_a_lost_pen_is_lifted_where_it_was() {
    let mut tracker = tracker();
    for i in 0..50_u16 {
        tracker.report(0.005 * f64::from(i), &report(100 * i, 0, 1000, DOWN)).unwrap();
    }
    let out = tracker.report(0.250, &report(0, 0, 0, 0)).unwrap();
    assert_eq!((out.place_m, out.touch.contact.force_n), (None, 0.0));
    let lifted = tracker.lift();
    // Out of range, the position values are invalid.
    assert!((f64::from(lifted.x_m) - (0.049 - 0.104_83)).abs() < 1e-6 && lifted.contact.force_n == 0.0);
    let again = tracker.report(0.260, &report(15_000, 9000, 1000, DOWN)).unwrap();
    assert_eq!(again.touch.contact.speed_mps, 0.0);
}

#[test]
fn pressure_without_a_unit_goes_through_the_map() {
    let plain: Vec<u8> = {
        // The same pen with a pressure that has no unit.
        let at = PEN.windows(2).position(|w| w == [0x67, 0x11]).unwrap();
        let mut bytes = PEN.to_vec();
        bytes[at + 1..at + 5].fill(0);
        bytes
    };
    let mut tracker = PenTracker::new(PenDecoder::of_descriptor(&parse(&plain).unwrap()).unwrap(), OPTIONS);
    let force_n = tracker.report(0.0, &report(0, 0, 2048, DOWN)).unwrap().force_n;
    assert_eq!(force_n, PressureMap::USUAL.force_n(2048.0 / 4095.0, true));
    let line = PressureMap { bend: 0.0, ..PressureMap::USUAL };
    tracker.set_pressure_map(line);
    let force_n = tracker.report(0.1, &report(0, 0, 2048, DOWN)).unwrap().force_n;
    assert_eq!(force_n, line.force_n(2048.0 / 4095.0, true));
    assert_eq!(tracker.report(0.2, &report(0, 0, 2048, HOVER)).unwrap().force_n, 0.0);
}

#[test]
fn a_recorded_stretch_replays_as_it_was_felt() {
    let mut tracker = tracker();
    let moments: Vec<_> = (0..200_u16)
        .filter_map(|i| {
            let angle = f64::from(i) * 0.05;
            let at = |f: f64| (8000.0 + 3000.0 * f) as u16;
            let switches = if (5..=190).contains(&i) { DOWN } else { HOVER };
            let pressure = if switches == DOWN { 900 + 10 * i } else { 0 };
            tracker
                .report(f64::from(i) * 0.005, &report(at(angle.cos()), at(angle.sin()), pressure, switches))
        })
        .collect();
    assert_eq!(moments.len(), 200);
    let track = Track::new(&stroke_samples(&moments)).unwrap();
    for pair in moments[..199].windows(2) {
        let moment = &pair[1];
        if pair[0].report.tip != moment.report.tip {
            // A track has one point per ms, so contact onset and lift may fall between two points.
            continue;
        }
        let replayed = track.touch_at(moment.time_secs + 1e-9);
        let (a, b) = (replayed.contact, moment.touch.contact);
        assert!(
            (a.speed_mps - b.speed_mps).abs() < 1e-4 && (a.force_n - b.force_n).abs() < 1e-4,
            "{moment:?}"
        );
        assert!(
            (replayed.x_m - moment.touch.x_m).abs() < 1e-5 && (replayed.y_m - moment.touch.y_m).abs() < 1e-5
        );
    }
}

#[test]
fn a_tap_tells_its_landing() {
    let mut tracker = tracker();
    let moments: Vec<_> = [0, 0, 400, 1200, 2000, 2000, 2000, 0, 0]
        .iter()
        .enumerate()
        .map(|(i, pressure)| {
            let switches = if *pressure > 0 { DOWN } else { HOVER };
            tracker.report(0.004 * i as f64, &report(5000, 5000, *pressure, switches)).unwrap()
        })
        .collect();
    let landings: Vec<_> = moments.iter().filter_map(|moment| moment.landing).collect();
    assert_eq!(landings.len(), 1);
    // The force rises by 800 counts in 4 ms; the stiffness is 10 N/mm.
    let expected = 800.0 / 4095.0 * 4.016 / 0.004 / 1e4;
    assert!((f64::from(landings[0].speed_mps) / expected - 1.0).abs() < 1e-6 && !landings[0].is_from_height);
    assert!((landings[0].time_secs - 0.008).abs() < 1e-12);
    // The first report of the contact has half of that rise, and a tap transient starts with it.
    let known: Vec<bool> = moments.iter().map(|moment| moment.impact_mps.is_some()).collect();
    assert_eq!(known, [false, false, true, false, false, false, false, false, false]);
    let impact_mps = f64::from(moments[2].impact_mps.unwrap());
    assert!((impact_mps - 0.5 * (0.1 + expected)).abs() < 1e-6, "{impact_mps}");
    assert_eq!(moments[2].sample().unwrap().impact_mps, Some(impact_mps));
}
