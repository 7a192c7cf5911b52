//! Training set of strokes over rated textures, split into segments.

use candle_core::{Device, Result, Tensor};
use shagreen_core::recording::fit::Stroke;

use crate::cnn_lstm::Architecture;
use crate::training_error::TrainingError;

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
    /// RMS acceleration of the training strokes, in m/s², over all axes: their ratios stay.
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
        let strokes = textures.iter().flat_map(|texture| &texture.strokes);
        for value in strokes.flat_map(|stroke| stroke.axes_mps2.iter().flatten()) {
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
    /// Channels per sample: the axes of acceleration, speed, force.
    n_channels: usize,
    n_targets: usize,
}

impl Segments {
    /// Returns all whole segments of the strokes.
    ///
    /// # Errors
    /// [`TrainingError::Axes`] if a stroke has another number of axes than the network reads.
    pub(crate) fn of(
        textures: &[&StrokedTexture],
        architecture: &Architecture,
        scale: &Scale,
    ) -> std::result::Result<Self, TrainingError> {
        let (n_samples, n_axes) = (architecture.n_samples, architecture.n_axes());
        let (mut values, mut targets, mut n_targets) = (Vec::new(), Vec::new(), 0);
        for texture in textures {
            n_targets = texture.attributes.len();
            for stroke in &texture.strokes {
                let n_found = stroke.axes_mps2.len();
                if n_found != n_axes {
                    return Err(TrainingError::Axes { n_found, n_needed: n_axes });
                }
                let columns = stroke.axes_mps2.iter().chain([&stroke.speed_mps, &stroke.force_n]);
                let n_segments = columns.map(Vec::len).min().unwrap_or(0) / n_samples;
                values.extend(samples(stroke, n_segments * n_samples, scale));
                for _ in 0..n_segments {
                    targets.extend(texture.attributes.iter().map(|attribute| (attribute / 100.0) as f32));
                }
            }
        }
        Ok(Self { values, targets, n_samples, n_channels: architecture.n_channels, n_targets })
    }

    /// Returns the number of segments.
    pub(crate) fn len(&self) -> usize {
        self.values.len() / (self.n_samples * self.n_channels)
    }

    /// Returns a batch of segments (segments × samples × channels) and their attributes (segments × attributes).
    pub(crate) fn batch(&self, indices: &[usize], device: &Device) -> Result<(Tensor, Tensor)> {
        let of_segment = self.n_samples * self.n_channels;
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
        let values = Tensor::from_vec(values, (indices.len(), self.n_samples, self.n_channels), device)?;
        Ok((values, Tensor::from_vec(targets, (indices.len(), self.n_targets), device)?))
    }
}

/// Returns the normalized channels of the first `n` samples of a stroke.
fn samples(stroke: &Stroke, n: usize, scale: &Scale) -> impl Iterator<Item = f32> {
    (0..n).flat_map(move |i| {
        let axes = stroke.axes_mps2.iter().map(move |axis| axis[i] / scale.accel_mps2);
        let contact = [stroke.speed_mps[i] / scale.speed_mps, stroke.force_n[i] / scale.force_n];
        axes.chain(contact).map(|value| value as f32)
    })
}

#[cfg(test)]
mod tests {
    use super::{Scale, Segments, StrokedTexture};
    use crate::cnn_lstm::Architecture;
    use crate::training_error::TrainingError;
    use candle_core::Device;
    use shagreen_core::recording::fit::Stroke;

    /// A stroke whose axes are multiples of its row number.
    fn texture(shares: &[f64]) -> StrokedTexture {
        let axis = |share: &f64| -> Vec<f64> { (0..5).map(|row| share * f64::from(row)).collect() };
        let stroke = Stroke {
            axes_mps2: shares.iter().map(axis).collect(),
            speed_mps: vec![0.25; 5],
            force_n: vec![0.25; 5],
        };
        StrokedTexture { id: String::new(), strokes: vec![stroke], attributes: vec![50.0] }
    }

    #[test]
    fn channels_are_the_axes_then_speed_and_force() {
        let scale = Scale { accel_mps2: 2.0, speed_mps: 0.25, force_n: 0.5 };
        for shares in [&[1.0][..], &[1.0, 10.0, 100.0]] {
            let n_channels = shares.len() + 2;
            let architecture = Architecture { n_samples: 2, n_channels, ..Architecture::paper320(1) };
            let segments = Segments::of(&[&texture(shares)], &architecture, &scale).unwrap();
            // The fifth sample begins a segment that is not whole.
            assert_eq!(segments.len(), 2);
            let (values, targets) = segments.batch(&[1], &Device::Cpu).unwrap();
            let row = |row: f32| {
                let axes = shares.iter().map(move |share| *share as f32 * row / 2.0);
                axes.chain([1.0, 0.5]).collect::<Vec<f32>>()
            };
            assert_eq!(values.to_vec3::<f32>().unwrap(), [[row(2.0), row(3.0)]]);
            assert_eq!(targets.to_vec2::<f32>().unwrap(), [[0.5]]);
        }
    }

    #[test]
    fn the_scale_is_one_for_all_axes() {
        // The mean square of 0 to 4 is 6.
        let scale = Scale::of(&[&texture(&[1.0, 2.0, 2.0])]);
        assert!((scale.accel_mps2 - (6.0 * 9.0 / 3.0_f64).sqrt()).abs() < 1e-12);
    }

    #[test]
    fn strokes_with_other_axes_are_refused() {
        let scale = Scale { accel_mps2: 1.0, speed_mps: 1.0, force_n: 1.0 };
        let three = Architecture { n_samples: 2, ..Architecture::paper320(1).with_three_axes() };
        let error = Segments::of(&[&texture(&[1.0])], &three, &scale).unwrap_err();
        assert!(matches!(error, TrainingError::Axes { n_found: 1, n_needed: 3 }), "{error}");
    }
}
