//! Simulated haptic pens, for tests and to see what would be sent to a real one.
//!
//! Their report descriptors were written for this program, after published facts about such pens. No descriptor of a
//! real pen was at hand.

use std::sync::{Arc, Mutex, PoisonError};

use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen::controller::ReportShape;
use crate::haptic_pen::pen::HapticPort;
use crate::haptic_pen::waveform::Waveform;

/// Descriptor of a simulated pen that lists its waveforms in a feature report and plays the continuous ones by itself:
/// a stylus with report 7 for triggers and report 8 for the lists, of six entries each.
pub const LISTING_PEN: &[u8] = &[
    0x05, 0x0d, 0x09, 0x20, 0xa1, 0x01, // page digitizer, usage stylus, application
    0x05, 0x0e, 0x09, 0x01, 0xa1, 0x02, // page haptics, usage controller, logical
    0x85, 0x07, 0x15, 0x00, 0x25, 0x64, 0x75, 0x08, 0x95, 0x01, // report 7, 0 to 100, one byte each
    0x09, 0x23, 0xb1, 0x02, 0x09, 0x23, 0x91, 0x02, // intensity, feature and output
    0x25, 0x10, 0x09, 0x24, 0xb1, 0x02, 0x09, 0x24, 0x91, 0x02, // repeat count 0 to 16
    0x15, 0x01, 0x25, 0x08, 0x09, 0x20, 0xb1, 0x02, // automatic trigger, ordinals 1 to 8
    0x09, 0x21, 0x91, 0x02, // manual trigger
    0x85, 0x08, 0x15, 0x00, 0x26, 0xff, 0x0f, 0x75, 0x10, 0x95,
    0x06, // report 8, six numbers of 16 bits
    0x09, 0x11, 0xa1, 0x02, 0x05, 0x0a, 0x19, 0x03, 0x29, 0x08, 0xb1, 0x02,
    0xc0, // durations by ordinals 3 to 8
    0x05, 0x0e, 0x09, 0x10, 0xa1, 0x02, 0x05, 0x0a, // waveforms by ordinals 3 to 8
    0x16, 0x00, 0x00, 0x26, 0xff, 0x2f, 0x19, 0x03, 0x29, 0x08, 0xb1, 0x02, 0xc0, //
    0xc0, 0xc0,
];

/// Waveforms of [`LISTING_PEN`] by their ordinals from 3; the last entry is empty.
pub const LISTED: [Waveform; 6] =
    [Waveform::CLICK, Waveform::INK, Waveform::PENCIL, Waveform::MARKER, Waveform::BRUSH, Waveform(0)];

/// Descriptor of a simulated pen that states its waveforms in the descriptor, has no report ids, no automatic trigger, and
/// intensities from 0 to 127: ordinal 3 is a click, ordinal 4 is the ball pen.
pub const STATING_PEN: &[u8] = &[
    0x05, 0x0d, 0x09, 0x02, 0xa1, 0x01, // page digitizer, usage pen, application
    0x05, 0x0e, 0x09, 0x01, 0xa1, 0x02, // page haptics, usage controller, logical
    0x75, 0x08, 0x95, 0x01, // one byte each
    0x09, 0x10, 0xa1, 0x02, 0x05, 0x0a, // list of waveforms
    0x15, 0x03, 0x25, 0x03, 0x36, 0x03, 0x10, 0x46, 0x03, 0x10, 0x09, 0x03, 0xb1,
    0x03, // ordinal 3: 0x1003
    0x15, 0x04, 0x25, 0x04, 0x36, 0x0b, 0x10, 0x46, 0x0b, 0x10, 0x09, 0x04, 0xb1,
    0x03, // ordinal 4: 0x100B
    0xc0, 0x05, 0x0e, 0x35, 0x00, 0x45, 0x00, // page haptics, no physical range
    0x15, 0x01, 0x25, 0x04, 0x09, 0x21, 0x91, 0x02, // manual trigger
    0x15, 0x00, 0x25, 0x7f, 0x09, 0x23, 0x91, 0x02, // intensity
    0xc0, 0xc0,
];

/// A report that a simulated pen got.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Got {
    /// An output report.
    Output(Vec<u8>),
    /// A feature report.
    Feature(Vec<u8>),
}

/// A simulated haptic pen. Its clones are the same pen.
#[derive(Clone, Debug)]
pub struct SimulatedPen {
    descriptor: &'static [u8],
    state: Arc<Mutex<State>>,
}

#[derive(Debug, Default)]
struct State {
    features: Vec<Vec<u8>>,
    got: Vec<Got>,
    is_gone: bool,
}

impl SimulatedPen {
    /// A pen with [`LISTING_PEN`] as its descriptor, which plays the ball pen at 50 % by itself.
    pub fn listing() -> Self {
        let mut lists = vec![8];
        lists.extend([30_u16, 0, 0, 0, 0, 0].iter().flat_map(|millis| millis.to_le_bytes()));
        lists.extend(LISTED.iter().flat_map(|waveform| waveform.0.to_le_bytes()));
        let features = vec![vec![7, 50, 0, 4], lists];
        let state = State { features, ..State::default() };
        Self { descriptor: LISTING_PEN, state: Arc::new(Mutex::new(state)) }
    }

    /// A pen with [`STATING_PEN`] as its descriptor.
    pub fn stating() -> Self {
        Self { descriptor: STATING_PEN, state: Arc::default() }
    }

    /// All reports that the pen got, oldest first.
    pub fn got(&self) -> Vec<Got> {
        self.with(|state| state.got.clone())
    }

    /// Unplugs the pen.
    pub fn unplug(&self) {
        self.with(|state| state.is_gone = true);
    }

    fn with<T>(&self, work: impl FnOnce(&mut State) -> T) -> T {
        work(&mut self.state.lock().unwrap_or_else(PoisonError::into_inner))
    }

    fn answer<T>(&self, work: impl FnOnce(&mut State) -> Option<T>) -> Result<T, DeviceError> {
        let answer = self.with(|state| if state.is_gone { None } else { work(state) });
        let lost = || DeviceError::new(DeviceErrorKind::Lost, "the simulated pen does not answer");
        answer.ok_or_else(lost)
    }
}

impl HapticPort for SimulatedPen {
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError> {
        let bytes = self.descriptor.to_vec();
        self.answer(|_| Some(bytes))
    }

    fn feature(&mut self, shape: ReportShape) -> Result<Vec<u8>, DeviceError> {
        self.answer(|state| {
            let is_asked = |report: &&Vec<u8>| report.first().copied() == shape.id;
            state.features.iter().find(is_asked).cloned()
        })
    }

    fn set_feature(&mut self, _id: Option<u8>, report: &[u8]) -> Result<(), DeviceError> {
        self.answer(|state| {
            let known = state.features.iter_mut().find(|known| known.first() == report.first())?;
            report.clone_into(known);
            state.got.push(Got::Feature(report.to_vec()));
            Some(())
        })
    }

    fn write(&mut self, _id: Option<u8>, report: &[u8]) -> Result<(), DeviceError> {
        self.answer(|state| {
            state.got.push(Got::Output(report.to_vec()));
            Some(())
        })
    }
}
