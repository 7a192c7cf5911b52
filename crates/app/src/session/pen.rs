//! The pen, which is read directly from the device in addition to the mouse.

use std::collections::VecDeque;
use std::sync::mpsc::Receiver;

use shagreen_device::error::DeviceErrorKind;
use shagreen_device::hid::choice::AUTOMATIC_ID;
use shagreen_device::hid::live::{PenNotice, PenOptions, PenThread};
use shagreen_device::hid::system::SystemPens;
use shagreen_device::hid::tracker::{TrackedSample, TrackerOptions};
use shagreen_device::kinematics::SpeedFilter;
use shagreen_device::live::LiveInput;
use shagreen_device::pen_backend::{Backend, Provides};
use shagreen_device::stylus::{StylusInfo, StylusKind, list_styluses};

use crate::state::background::in_background;
use crate::state::rig::Rig;

/// Number of samples kept for display.
const KEPT: usize = 512;

/// Properties that a pen reports.
#[derive(Clone, Debug, PartialEq)]
pub struct PenFacts {
    /// Name of the pen.
    pub name: String,
    /// Width and height of the active area in m, reported by the pen or set by the user.
    pub size_m: Option<[f64; 2]>,
    /// Whether the reported size is probably wrong.
    pub is_size_doubtful: bool,
    /// Whether the pen reports pressure.
    pub has_pressure: bool,
    /// Force at full pressure in N, if the pen reports force.
    pub full_n: Option<f64>,
    /// How the pen is read.
    pub backend: Backend,
    /// Quantities that the pen provides.
    pub provides: Provides,
}

/// Thread that reads a pen, and its newest samples.
#[derive(Default)]
pub(super) struct Pen {
    thread: Option<PenThread>,
    id: Option<String>,
    /// Whether the window has the keyboard focus.
    has_focus: bool,
    pub(super) pens: Vec<StylusInfo>,
    listing: Option<Receiver<Vec<StylusInfo>>>,
    pub(super) facts: Option<PenFacts>,
    pub(super) message: Option<String>,
    pub(super) moments: VecDeque<TrackedSample>,
    /// Samples since the previous frame.
    pub(super) fresh: Vec<TrackedSample>,
}

impl Pen {
    /// Lists pens in the background.
    pub(super) fn list(&mut self, ctx: egui::Context) {
        self.listing = Some(in_background(ctx, || {
            let mut found = list_styluses().styluses;
            found.retain(|stylus| stylus.kind == StylusKind::Pen);
            found
        }));
    }

    /// Notes whether the window has the keyboard focus. A pen that was chosen automatically strokes only while it has:
    /// nobody asked for it, and it also moves the pointer of other programs.
    pub(super) fn set_focus(&mut self, has_focus: bool) {
        let has_changed = std::mem::replace(&mut self.has_focus, has_focus) != has_focus;
        if let Some(thread) = self.thread.as_ref().filter(|_| has_changed && self.is_automatic()) {
            thread.set_active(has_focus);
        }
    }

    fn is_automatic(&self) -> bool {
        self.id.as_deref() == Some(AUTOMATIC_ID)
    }

    /// Reads the selected pen with the present settings. A new thread takes `live`, the pen's input to the engine.
    pub(super) fn follow(&mut self, rig: &Rig, live: &mut Option<LiveInput>, ctx: &egui::Context) {
        if self.id == rig.pen {
            if let Some(thread) = &self.thread {
                thread.set_pressure_map(rig.pressure_map);
                thread.set_size_m(size_m(rig));
            }
            return;
        }
        self.id.clone_from(&rig.pen);
        if let Some(returned) = self.thread.take().and_then(PenThread::finish) {
            // The next pen uses the same input.
            live.get_or_insert(returned);
        }
        (self.facts, self.message) = (None, None);
        self.moments.clear();
        let Some(id) = rig.pen.clone() else { return };
        let tracking = TrackerOptions { speed_filter: SpeedFilter::KALMAN, pressure_map: rig.pressure_map };
        let options = PenOptions { id, tracking, size_m: size_m(rig) };
        match PenThread::start(SystemPens, options, live.take()) {
            Ok(thread) => {
                // While nothing sounds, the window draws hardly any frames by itself.
                let ctx = ctx.clone();
                thread.set_doorbell(move || ctx.request_repaint());
                thread.set_active(self.has_focus || !self.is_automatic());
                self.thread = Some(thread);
            }
            Err(error) => self.message = Some(error.to_string()),
        }
    }

    /// Moves the thread's touches to the input of another engine.
    pub(super) fn give(&mut self, live: &mut Option<LiveInput>) {
        if let Some(thread) = &self.thread
            && let Some(live) = live.take()
        {
            thread.set_live(live);
        }
    }

    /// Takes in samples and notices of the thread.
    pub(super) fn collect(&mut self) {
        if let Some(pens) = self.listing.as_ref().and_then(|r| r.try_recv().ok()) {
            self.pens = pens;
            self.listing = None;
        }
        self.fresh.clear();
        let is_automatic = self.is_automatic();
        let Some(thread) = &mut self.thread else { return };
        while let Some(moment) = thread.next_moment() {
            if self.moments.len() == KEPT {
                self.moments.pop_front();
            }
            self.moments.push_back(moment);
            self.fresh.push(moment);
        }
        while let Some(notice) = thread.next_notice() {
            match notice {
                PenNotice::Connected { pen, size_m, is_size_doubtful, has_pressure, full_n, provides } => {
                    let (name, backend) = (pen.name, pen.backend);
                    self.facts = Some(PenFacts {
                        name,
                        size_m,
                        is_size_doubtful,
                        has_pressure,
                        full_n,
                        backend,
                        provides,
                    });
                    self.message = None;
                }
                PenNotice::Lost(error) | PenNotice::Waiting(error) => {
                    self.facts = None;
                    self.moments.clear();
                    // Without any pen, the mouse strokes, and nobody asked for more.
                    let is_expected = is_automatic && error.kind() == DeviceErrorKind::NotFound;
                    self.message = (!is_expected).then(|| error.to_string());
                }
                _ => {}
            }
        }
    }
}

fn size_m(rig: &Rig) -> Option<[f64; 2]> {
    rig.pen_size_mm.map(|mm| mm.map(|x| 1e-3 * x))
}
