//! Training set of strokes over rated textures, split into segments.

use candle_core::{Device, Result, Tensor};
use shagreen_core::recording::fit::Stroke;

/// Strokes over one texture, with its attributes.
#[derive(Clone, Debug, PartialEq)]
pub struct StrokedTexture {
    /// Identifier of the texture.
    pub id: String,
    /// Strokes, at the sampling rate of the network.
    pub strokes: Vec<Stroke>,
    /// Attributes, 0 to 100.
    pub attributes: Vec<f64>,
}

/// Scale factors that normalize the channels of a segment to about one.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Scale {
    /// RMS acceleration of the training strokes, in m/s².
    pub(crate) accel_mps2: f64,
    /// Highest speed of the paper's stroke patterns, in m/s.
    pub(crate) speed_mps: f64,
    /// Highest force of the paper's stroke patterns, in N.
    pub(crate) force_n: f64,
}

impl Scale {
    /// Returns the scale of these textures.
    pub(crate) fn of(textures: &[&StrokedTexture]) -> Self {
        let (mut sum, mut n) = (0.0, 0_usize);
        for value in
            textures.iter().flat_map(|texture| &texture.strokes).flat_map(|stroke| &stroke.accel_mps2)
        {
            sum += value * value;
            n += 1;
        }
        let rms = (sum / n.max(1) as f64).sqrt();
        Self { accel_mps2: if rms > 0.0 { rms } else { 1.0 }, speed_mps: 0.25, force_n: 0.5 }
    }
}

/// Segments with the attributes of their textures.
#[derive(Clone, Debug)]
pub(crate) struct Segments {
    /// Interleaved channels, sample by sample, segment by segment.
    values: Vec<f32>,
    /// Attributes divided by 100, segment by segment.
    targets: Vec<f32>,
    n_samples: usize,
    n_targets: usize,
}

/// Channels per sample: acceleration, speed, force.
pub(crate) const N_CHANNELS: usize = 3;

impl Segments {
    /// Returns all whole segments of the strokes.
    pub(crate) fn of(textures: &[&StrokedTexture], n_samples: usize, scale: &Scale) -> Self {
        let (mut values, mut targets, mut n_targets) = (Vec::new(), Vec::new(), 0);
        for texture in textures {
            n_targets = texture.attributes.len();
            for stroke in &texture.strokes {
                let n_segments = stroke.accel_mps2.len() / n_samples;
                values.extend(samples(stroke, n_segments * n_samples, scale));
                for _ in 0..n_segments {
                    targets.extend(texture.attributes.iter().map(|attribute| (attribute / 100.0) as f32));
                }
            }
        }
        Self { values, targets, n_samples, n_targets }
    }

    /// Returns the number of segments.
    pub(crate) fn len(&self) -> usize {
        self.values.len() / (self.n_samples * N_CHANNELS)
    }

    /// Returns a batch of segments (segments × samples × channels) and their attributes (segments × attributes).
    pub(crate) fn batch(&self, indices: &[usize], device: &Device) -> Result<(Tensor, Tensor)> {
        let of_segment = self.n_samples * N_CHANNELS;
        let values: Vec<f32> = indices
            .iter()
            .flat_map(|i| &self.values[i * of_segment..(i + 1) * of_segment])
            .copied()
            .collect();
        let targets: Vec<f32> = indices
            .iter()
            .flat_map(|i| &self.targets[i * self.n_targets..(i + 1) * self.n_targets])
            .copied()
            .collect();
        let values = Tensor::from_vec(values, (indices.len(), self.n_samples, N_CHANNELS), device)?;
        Ok((values, Tensor::from_vec(targets, (indices.len(), self.n_targets), device)?))
    }
}

/// Returns the normalized channels of the first `n` samples of a stroke.
fn samples(stroke: &Stroke, n: usize, scale: &Scale) -> impl Iterator<Item = f32> {
    let channels = stroke.accel_mps2.iter().zip(&stroke.speed_mps).zip(&stroke.force_n).take(n);
    channels.flat_map(|((accel, speed), force)| {
        [accel / scale.accel_mps2, speed / scale.speed_mps, force / scale.force_n].map(|value| value as f32)
    })
}
