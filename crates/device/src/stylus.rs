//! Styluses: the mouse, which is always available and uses a set force, and pens, which can be unplugged.

use crate::error::DeviceError;
use crate::hid::identity::{HidPen, denied_on};
use crate::hid::live::PenBus as _;
use crate::hid::system::SystemPens;
use crate::kinematics::{SpeedEstimator, SpeedFilter, held_speed};
use crate::operating_system::OperatingSystem;
use crate::pen_backend::{Access, Backend, Provides};
use crate::touch::Touch;
use shagreen_synth::contact::Contact;

/// Type of a stylus.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum StylusKind {
    /// The mouse, with a set force.
    Mouse,
    /// A pen or finger, as the window system reports it beside the mouse.
    Window,
    /// A pen that is read directly: see [`crate::hid`].
    Pen,
}

/// One stylus of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StylusInfo {
    /// Id by which it is chosen.
    pub id: String,
    /// Display name.
    pub name: String,
    /// Type of the stylus.
    pub kind: StylusKind,
    /// Whether it measures pressure. For a pen with unknown capabilities, this is assumed to be true.
    pub has_pressure: bool,
    /// USB vendor and product id; `None` for the mouse and the window system.
    pub product: Option<(u16, u16)>,
    /// How it is read.
    pub backend: Backend,
    /// Quantities that it provides, as far as they are known before it is read.
    pub provides: Provides,
    /// Whether this program may read it.
    pub access: Access,
    /// What to do to be permitted to read it; `None` if nothing is known to be necessary.
    pub advice: Option<String>,
}

/// The styluses of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StylusList {
    /// The mouse, the pointer of the window system, then the pens.
    pub styluses: Vec<StylusInfo>,
    /// Reason why the list may lack pens, if any.
    pub warning: Option<DeviceError>,
}

/// Lists the styluses of this machine. None is opened.
pub fn list_styluses() -> StylusList {
    let mouse = StylusInfo {
        id: "mouse".into(),
        name: "Mouse (set force)".into(),
        kind: StylusKind::Mouse,
        has_pressure: false,
        product: None,
        backend: Backend::Mouse,
        provides: Provides::MOUSE,
        access: Access::Granted,
        advice: None,
    };
    let window = StylusInfo {
        id: "window".into(),
        name: "Pen or finger, as the window system reports it".into(),
        kind: StylusKind::Window,
        has_pressure: Provides::WINDOW.pressure == Some(true),
        backend: Backend::Window,
        provides: Provides::WINDOW,
        ..mouse.clone()
    };
    let (pens, warning) = match SystemPens.list() {
        Ok(pens) => (pens, None),
        Err(error) => (Vec::new(), Some(error)),
    };
    StylusList {
        styluses: [mouse, window].into_iter().chain(pens.into_iter().map(StylusInfo::from)).collect(),
        warning,
    }
}

impl From<HidPen> for StylusInfo {
    fn from(pen: HidPen) -> Self {
        let advice = (!pen.access.may_open()).then(|| denied_on(OperatingSystem::HERE, &pen));
        Self {
            id: pen.id,
            name: pen.name,
            kind: StylusKind::Pen,
            has_pressure: pen.provides.pressure.unwrap_or(true),
            product: Some((pen.vendor_id, pen.product_id)),
            backend: pen.backend,
            provides: pen.provides,
            access: pen.access,
            advice,
        }
    }
}

/// The mouse as a stylus, which presses with a set force while its button is down.
#[derive(Clone, Debug)]
pub struct MouseStylus {
    force_n: f64,
    estimator: SpeedEstimator,
    touch: Touch,
    last_secs: f64,
}

impl MouseStylus {
    /// A lifted stylus with a set force of `force_n` newtons.
    pub fn new(force_n: f64) -> Self {
        let estimator = SpeedEstimator::new(SpeedFilter::KALMAN);
        Self { force_n, estimator, touch: Touch::default(), last_secs: 0.0 }
    }

    /// Sets the force in newtons from the next report on.
    pub fn set_force_n(&mut self, force_n: f64) {
        self.force_n = force_n;
    }

    /// Processes a pointer position in m from the center of the pad, with its button pressed or not. Times are seconds
    /// on any clock that does not decrease. Returns the touch.
    pub fn report(&mut self, time_secs: f64, x_m: f64, y_m: f64, pressed: bool) -> Touch {
        let contact = if pressed {
            let speed_mps = self.estimator.report(time_secs, x_m, y_m) as f32;
            Contact { speed_mps, force_n: self.force_n as f32 }
        } else {
            self.estimator.lift();
            Contact::LIFTED
        };
        self.touch = Touch { x_m: x_m as f32, y_m: y_m as f32, contact }.sanitized();
        self.last_secs = time_secs;
        self.touch
    }

    /// Returns the touch at `time_secs`: the speed of the last report is held and then decays.
    pub fn touch_at(&self, time_secs: f64) -> Touch {
        let mut touch = self.touch;
        touch.contact.speed_mps =
            held_speed(f64::from(touch.contact.speed_mps), time_secs - self.last_secs) as f32;
        touch
    }
}

#[cfg(test)]
mod tests {
    use super::{MouseStylus, list_styluses};
    use shagreen_synth::contact::Contact;

    #[test]
    fn the_mouse_is_there() {
        let styluses = list_styluses().styluses;
        assert_eq!((styluses[0].id.as_str(), styluses[1].id.as_str()), ("mouse", "window"));
        assert!(!styluses[0].has_pressure);
        assert!(styluses.iter().all(|stylus| stylus.access.may_open() == stylus.advice.is_none()));
    }

    #[test]
    fn presses_with_the_set_force_and_measures_speed() {
        let mut mouse = MouseStylus::new(0.5);
        let mut touch = mouse.report(0.0, 0.0, 0.0, false);
        assert_eq!(touch.contact, Contact::LIFTED);
        for i in 1..200 {
            let t = f64::from(i) * 0.008;
            touch = mouse.report(t, 0.0, 0.1 * t, true);
        }
        assert!((touch.contact.speed_mps - 0.1).abs() < 1e-6 && touch.contact.force_n == 0.5);
        assert_eq!(touch.x_m, 0.0);
        mouse.set_force_n(0.8);
        assert_eq!(mouse.report(1.6, 0.0, 0.16, true).contact.force_n, 0.8);
    }

    #[test]
    fn a_mouse_that_rests_falls_silent_and_a_new_stroke_starts_at_rest() {
        let mut mouse = MouseStylus::new(0.5);
        for i in 0..100 {
            mouse.report(f64::from(i) * 0.008, f64::from(i) * 0.001, 0.0, true);
        }
        let moving = mouse.touch_at(0.8).contact.speed_mps;
        assert!(moving > 0.1);
        assert!(mouse.touch_at(1.2).contact.speed_mps < 1e-6 * moving);
        mouse.report(2.0, 0.5, 0.5, false);
        assert_eq!(mouse.report(2.008, 0.0, 0.0, true).contact.speed_mps, 0.0);
    }

    #[test]
    fn nonsense_places_are_no_speed() {
        let mut mouse = MouseStylus::new(f64::NAN);
        let touch = mouse.report(0.0, f64::NAN, f64::INFINITY, true);
        assert_eq!((touch.x_m, touch.y_m, touch.contact), (0.0, 0.0, Contact::LIFTED));
    }
}
