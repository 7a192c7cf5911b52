//! Adapter between the window and `eframe`, which also measures frame times.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::Instant;

use crate::command::Command;
use crate::window::Window;

/// Frame times of a measured run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WindowTimes {
    /// Time from the start of the program until the first frame is handed to the screen, in seconds.
    pub first_frame_secs: f64,
    /// Layout time of each later frame, in seconds, without painting.
    pub frame_secs: Vec<f64>,
    /// Interval from each later frame to the next, in seconds.
    pub interval_secs: Vec<f64>,
}

/// Runs a window, and measures its frame times on request.
pub(crate) struct Stopwatch {
    window: Window,
    started: Instant,
    frames_left: Option<usize>,
    last_frame: Option<Instant>,
    times: Rc<RefCell<WindowTimes>>,
}

impl Stopwatch {
    pub(crate) fn new(
        window: Window,
        started: Instant,
        frames_left: Option<usize>,
        times: Rc<RefCell<WindowTimes>>,
    ) -> Self {
        Self { window, started, frames_left, last_frame: None, times }
    }
}

impl eframe::App for Stopwatch {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        let begin = Instant::now();
        self.window.frame_ui(ui);
        let Some(left) = self.frames_left else { return };
        let mut times = self.times.borrow_mut();
        match self.last_frame {
            None => {
                self.window.carry_out(Command::ToggleHand, ui.ctx());
            }
            Some(last) => {
                if times.frame_secs.is_empty() {
                    // The second frame begins once the first has been handed to the screen.
                    times.first_frame_secs = begin.duration_since(self.started).as_secs_f64();
                }
                times.interval_secs.push(begin.duration_since(last).as_secs_f64());
                times.frame_secs.push(begin.elapsed().as_secs_f64());
            }
        }
        self.last_frame = Some(begin);
        ui.ctx().request_repaint();
        if left == 0 {
            ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
        }
        self.frames_left = Some(left.saturating_sub(1));
    }
}
