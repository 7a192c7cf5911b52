//! Encodings of samples in WAV files, and the level that they are written at.

use std::io::Cursor;

use hound::{SampleFormat, WavSpec, WavWriter};

/// Bytes of a WAV file before its first sample.
pub(crate) const HEADER_BYTES: u32 = 68;
/// Peak of a signal that is scaled for players, as a fraction of digital full scale: 1 dB below it.
pub const PEAK: f64 = 0.891_250_938_133_745_5;

/// Type of the samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SampleType {
    /// 32-bit floats, which may exceed 1.
    #[default]
    Float32,
    /// 24-bit integers.
    Pcm24,
    /// 16-bit integers.
    Pcm16,
}

impl SampleType {
    /// All types.
    pub const ALL: [Self; 3] = [Self::Float32, Self::Pcm24, Self::Pcm16];

    /// Bits of a sample.
    pub fn bits(self) -> u16 {
        match self {
            Self::Float32 => 32,
            Self::Pcm24 => 24,
            Self::Pcm16 => 16,
        }
    }
}

/// Level of the samples.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Level {
    /// Samples are accelerations in m/s²: a sample of 1 is 1 m/s². Players clip what exceeds 1. Only for floats: integers
    /// are always scaled to their peak.
    #[default]
    Kept,
    /// The peak is at [`PEAK`]; the sidecar states the acceleration of a sample of 1.
    Peak,
}

/// How samples are written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct WavEncoding {
    /// Type of the samples.
    pub samples: SampleType,
    /// Their level.
    pub level: Level,
}

impl WavEncoding {
    /// Whether the level of the samples is changed, so that the scale of one signal is not that of another.
    pub fn is_scaled(self) -> bool {
        self.samples != SampleType::Float32 || self.level == Level::Peak
    }

    /// Acceleration in m/s² of a sample of 1.
    pub fn full_scale(self, samples: &[f32]) -> f64 {
        let peak_mps2 = samples.iter().fold(0.0_f32, |peak, x| peak.max(x.abs()));
        if peak_mps2 == 0.0 || !self.is_scaled() { 1.0 } else { f64::from(peak_mps2) / PEAK }
    }
}

/// Encodes samples as a WAV file; `full_scale` becomes 1.
pub(crate) fn pack(
    samples: &[f32],
    full_scale: f64,
    rate_hz: u32,
    of: SampleType,
) -> Result<Vec<u8>, hound::Error> {
    let sample_format = if of == SampleType::Float32 { SampleFormat::Float } else { SampleFormat::Int };
    let spec = WavSpec { channels: 1, sample_rate: rate_hz, bits_per_sample: of.bits(), sample_format };
    let mut bytes = Cursor::new(Vec::with_capacity(HEADER_BYTES as usize + size_of_val(samples)));
    let mut writer = WavWriter::new(&mut bytes, spec)?;
    let largest = f64::from((1_i32 << (of.bits() - 1).min(30)) - 1);
    for sample in samples {
        match of {
            SampleType::Float32 if full_scale == 1.0 => writer.write_sample(*sample)?,
            SampleType::Float32 => writer.write_sample((f64::from(*sample) / full_scale) as f32)?,
            SampleType::Pcm24 | SampleType::Pcm16 => {
                let share = (f64::from(*sample) / full_scale).clamp(-1.0, 1.0);
                writer.write_sample((share * largest).round() as i32)?;
            }
        }
    }
    writer.finalize()?;
    Ok(bytes.into_inner())
}
