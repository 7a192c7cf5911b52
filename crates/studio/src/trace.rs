//! Trace of a motion for the sidecar of a signal: speed, force and position of the tip over time.

use shagreen_core::texture::render::Hand;
use shagreen_core::units::Contact;
use shagreen_device::track::Track;
use shagreen_formats::wav::TraceV1;

/// Largest number of points of the trace of a stroke.
const MAX_POINTS: f64 = 20_000.0;
/// Usual interval between its points, in seconds.
const STEP_SECS: f64 = 0.01;

/// Motion of a recorded stroke, with positions.
#[derive(Clone, Copy, Debug)]
pub struct TrackHand<'a>(pub &'a Track);

impl Hand for TrackHand<'_> {
    fn contact_at(&mut self, time_secs: f64) -> Contact {
        self.0.touch_at(time_secs).contact.into()
    }

    fn place_m_at(&mut self, time_secs: f64) -> Option<[f64; 2]> {
        let touch = self.0.touch_at(time_secs);
        Some([touch.x_m, touch.y_m].map(f64::from))
    }
}

/// Returns the trace of a steady contact.
pub fn steady_trace(contact: Contact, seconds: f64) -> TraceV1 {
    trace_at(vec![0.0, seconds], &mut |_: f64| contact, &[])
}

/// Returns the trace of a recorded stroke.
pub fn track_trace(track: &Track) -> TraceV1 {
    let known = track.landings().iter().filter_map(|landing| Some((landing.time_secs, landing.impact_mps?)));
    let impacts: Vec<(f64, f64)> = known.map(|(secs, mps)| (secs, f64::from(mps))).collect();
    stroke_trace(track.duration_secs(), &mut TrackHand(track), &impacts)
}

/// Returns the trace of a motion. `impacts` are the landings with a known impact speed: time in s and speed in m/s.
pub fn stroke_trace(seconds: f64, hand: &mut dyn Hand, impacts: &[(f64, f64)]) -> TraceV1 {
    let step_secs = STEP_SECS.max(seconds / MAX_POINTS);
    let times = (0..=(seconds / step_secs) as usize).map(|i| i as f64 * step_secs).collect();
    trace_at(times, hand, impacts)
}

fn trace_at(times: Vec<f64>, hand: &mut dyn Hand, impacts: &[(f64, f64)]) -> TraceV1 {
    let contacts: Vec<Contact> = times.iter().map(|secs| hand.contact_at(*secs)).collect();
    // A motion has a position at all times or at none.
    let places_m: Option<Vec<[f64; 2]>> = times.iter().map(|secs| hand.place_m_at(*secs)).collect();
    let x_mm = places_m.as_ref().map(|places| places.iter().map(|[x_m, _]| short(1e3 * x_m)).collect());
    let y_mm = places_m.as_ref().map(|places| places.iter().map(|[_, y_m]| short(1e3 * y_m)).collect());
    let mut speed_normal_mm_per_s = vec![None; times.len()];
    for (landed_secs, impact_mps) in impacts {
        let at = times.partition_point(|secs| secs < landed_secs).min(times.len().saturating_sub(1));
        // The force of a table begins to rise at the landing: the next point is the first one in contact.
        let mut near = contacts.iter().enumerate().skip(at).take(2);
        let index = near.find(|(_, contact)| contact.force.0 > 0.0).map_or(at, |(index, _)| index);
        if let Some(slot) = speed_normal_mm_per_s.get_mut(index) {
            *slot = Some(short(1e3 * impact_mps));
        }
    }
    TraceV1 {
        time_s: times.into_iter().map(short).collect(),
        speed_mm_per_s: contacts.iter().map(|contact| short(contact.speed.mm_per_s())).collect(),
        force_n: contacts.iter().map(|contact| short(contact.force.0)).collect(),
        x_mm,
        y_mm,
        speed_normal_mm_per_s: (!impacts.is_empty()).then_some(speed_normal_mm_per_s),
    }
}

/// Rounds to four decimals: 0.1 ms, 0.1 µm/s, 0.1 mN, 0.1 µm.
fn short(value: f64) -> f64 {
    (value * 1e4).round() / 1e4
}

#[cfg(test)]
mod tests {
    use super::{steady_trace, stroke_trace, track_trace};
    use shagreen_core::units::{Contact, MetersPerSecond, Newtons};
    use shagreen_device::track::{PenSample, Track};

    const CONTACT: Contact = Contact { speed: MetersPerSecond(0.1), force: Newtons(0.5) };

    #[test]
    fn a_recorded_stroke_keeps_its_positions_and_its_impact_speeds() {
        // In contact, in the air from 0.2 to 0.3 s, and in contact again.
        let sample = |i: u32| PenSample {
            time_secs: 0.01 * f64::from(i),
            x_m: 1e-3 * f64::from(i),
            y_m: -2e-3,
            force_n: 0.5,
            touching: !(20..30).contains(&i),
            impact_mps: (i == 30).then_some(0.2),
        };
        let track = Track::new(&(0..=50).map(sample).collect::<Vec<_>>()).unwrap();
        let trace = track_trace(&track);
        let (x_mm, y_mm) = (trace.x_mm.unwrap(), trace.y_mm.unwrap());
        let n = trace.time_s.len();
        assert!(n >= 50 && x_mm.len() == n && y_mm.len() == n);
        for ((secs, x_mm), y_mm) in trace.time_s.iter().zip(x_mm).zip(y_mm) {
            // Rounding to a tenth of a micrometer.
            assert!((x_mm - 100.0 * secs).abs() < 1.1e-4 && y_mm == -2.0, "{x_mm} mm, {y_mm} mm at {secs} s");
        }
        let impacts = trace.speed_normal_mm_per_s.unwrap();
        let stated: Vec<usize> = (0..n).filter(|i| impacts[*i].is_some()).collect();
        assert_eq!((stated.len(), impacts.len()), (1, n));
        assert_eq!(impacts[stated[0]], Some(200.0));
        assert!((trace.time_s[stated[0]] - 0.3).abs() < 0.011 && trace.force_n[stated[0]] > 0.0);
    }

    #[test]
    fn what_is_unknown_is_absent() {
        let steady = steady_trace(CONTACT, 2.0);
        assert_eq!((steady.time_s, steady.speed_mm_per_s), (vec![0.0, 2.0], vec![100.0; 2]));
        assert_eq!((steady.x_mm, steady.y_mm, steady.speed_normal_mm_per_s), (None, None, None));
        let stroke = stroke_trace(0.1, &mut |_: f64| CONTACT, &[(0.0, 0.05), (9.0, 0.1)]);
        let impacts = stroke.speed_normal_mm_per_s.unwrap();
        // A landing after the last point of the trace stands at this point.
        assert_eq!((impacts[0], impacts[1], impacts[impacts.len() - 1]), (Some(50.0), None, Some(100.0)));
        assert_eq!((stroke.x_mm, stroke.y_mm), (None, None));
    }

    /// The force rises from 50 ms on, where it is still zero.
    #[test]
    fn an_impact_is_stated_where_the_tip_touches() {
        let mut rising =
            |secs: f64| Contact { speed: MetersPerSecond(0.1), force: Newtons((secs - 0.05).max(0.0)) };
        let trace = stroke_trace(0.1, &mut rising, &[(0.05, 0.2)]);
        let impacts = trace.speed_normal_mm_per_s.unwrap();
        let stated: Vec<usize> = (0..impacts.len()).filter(|i| impacts[*i].is_some()).collect();
        assert_eq!(stated, [6]);
        assert_eq!((impacts[6], trace.force_n[5]), (Some(200.0), 0.0));
        assert!(trace.force_n[6] > 0.0);
    }
}
