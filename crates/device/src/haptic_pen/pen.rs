//! An open haptic pen.

use crate::error::{DeviceError, DeviceErrorKind};
use crate::haptic_pen::controller::{HapticController, OfferedWaveform, ReportShape};
use crate::haptic_pen::waveform::{Play, Waveform};
use crate::hid::descriptor;

/// Connection to a haptic pen: reads and writes its reports. Reports begin with their id if they have one.
pub trait HapticPort: Send {
    /// Returns the report descriptor.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the pen was disconnected.
    fn descriptor(&mut self) -> Result<Vec<u8>, DeviceError>;

    /// Reads a feature report.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the pen was disconnected or does not answer.
    fn feature(&mut self, shape: ReportShape) -> Result<Vec<u8>, DeviceError>;

    /// Writes the feature report with this id.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the pen was disconnected or refuses the report.
    fn set_feature(&mut self, id: Option<u8>, report: &[u8]) -> Result<(), DeviceError>;

    /// Writes the output report with this id.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the pen was disconnected or refuses the report.
    fn write(&mut self, id: Option<u8>, report: &[u8]) -> Result<(), DeviceError>;
}

/// An open haptic pen. When it is dropped, it falls silent and gets its own settings back.
pub struct HapticPen {
    port: Box<dyn HapticPort>,
    controller: HapticController,
    offered: Vec<OfferedWaveform>,
    /// The feature report of the waveform for a touching tip, as it was found.
    automatic_before: Option<Vec<u8>>,
    played: Play,
    n_reports: u64,
}

impl std::fmt::Debug for HapticPen {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("HapticPen").field("offered", &self.offered).finish_non_exhaustive()
    }
}

impl HapticPen {
    /// Reads the controller and the waveforms of the pen `name`, and silences it.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Unsupported`] if it has no continuous waveform, [`DeviceErrorKind::Lost`] if it does not
    /// answer.
    pub fn open(mut port: Box<dyn HapticPort>, name: &str) -> Result<Self, DeviceError> {
        let unsupported = |why: &str| {
            let message = format!("the pen {name} is no haptic output: {why}; choose another output");
            DeviceError::new(DeviceErrorKind::Unsupported, message)
        };
        let bytes = port.descriptor()?;
        let declared = descriptor::parse(&bytes).map_err(|error| unsupported(&error.to_string()))?;
        let controller = HapticController::of_descriptor(&declared)
            .ok_or_else(|| unsupported("its report descriptor declares no haptic controller"))?;
        let mut lists = Vec::new();
        for shape in controller.list_reports() {
            lists.push((shape, port.feature(shape)?));
        }
        let offered = controller.waveforms(&lists);
        if !offered.iter().any(|offered| offered.waveform.is_continuous()) {
            return Err(unsupported("it has no continuous waveform"));
        }
        let automatic_before = controller.automatic_shape().map(|shape| port.feature(shape)).transpose()?;
        let mut pen =
            Self { port, controller, offered, automatic_before, played: Play::SILENCE, n_reports: 0 };
        pen.silence()?;
        Ok(pen)
    }

    /// The waveforms of the pen.
    pub fn waveforms(&self) -> impl Iterator<Item = Waveform> + '_ {
        self.offered.iter().map(|offered| offered.waveform)
    }

    /// The waveform and the intensity of the last report.
    pub fn played(&self) -> Play {
        self.played
    }

    /// Number of reports that were written.
    pub fn n_reports(&self) -> u64 {
        self.n_reports
    }

    /// Plays a waveform that the pen has, until the next call; a click plays once. A waveform that the pen lacks is
    /// silence.
    ///
    /// A continuous waveform is set to play whenever the tip touches, if the pen can do this, because such a pen falls
    /// silent by itself when it is lifted. Otherwise it is triggered.
    ///
    /// # Errors
    /// [`DeviceErrorKind::Lost`] if the pen was disconnected.
    pub fn play(&mut self, play: Play) -> Result<(), DeviceError> {
        let offered = play
            .waveform
            .and_then(|waveform| self.offered.iter().find(|offered| offered.waveform == waveform).copied());
        let Some(offered) = offered.filter(|_| play.intensity_percent > 0) else {
            return self.silence();
        };
        let automatic = self.automatic_before.as_deref().filter(|_| offered.waveform.is_continuous());
        let automatic = automatic.and_then(|before| {
            self.controller.automatic_report(before, Some(offered), play.intensity_percent)
        });
        if let Some(report) = automatic {
            self.set_automatic(&report)?;
        } else if let Some(report) = self.controller.manual_report(offered, play.intensity_percent) {
            self.write(&report)?;
        }
        self.played = play;
        Ok(())
    }

    /// Ends what plays, now and for a touching tip.
    fn silence(&mut self) -> Result<(), DeviceError> {
        let automatic = self.automatic_before.as_deref();
        let automatic = automatic.and_then(|before| self.controller.automatic_report(before, None, 0));
        if let Some(report) = automatic {
            self.set_automatic(&report)?;
        }
        if let Some(report) = self.controller.stop_report() {
            self.write(&report)?;
        }
        self.played = Play::SILENCE;
        Ok(())
    }

    fn set_automatic(&mut self, report: &[u8]) -> Result<(), DeviceError> {
        let id = self.controller.automatic_shape().and_then(|shape| shape.id);
        self.port.set_feature(id, report)?;
        self.n_reports += 1;
        Ok(())
    }

    fn write(&mut self, report: &[u8]) -> Result<(), DeviceError> {
        self.port.write(self.controller.output_id(), report)?;
        self.n_reports += 1;
        Ok(())
    }
}

impl Drop for HapticPen {
    fn drop(&mut self) {
        self.silence().ok(); // A pen that is gone is silent.
        if let Some(before) = self.automatic_before.take() {
            self.set_automatic(&before).ok(); // The same.
        }
    }
}
