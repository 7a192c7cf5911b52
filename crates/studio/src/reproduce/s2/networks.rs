//! Networks of the paper and its rivals, each trained once without each texture.

use anyhow::Context as _;
use shagreen_core::words::counted;
use shagreen_formats::attribute_table::AttributeTable;
use shagreen_formats::library::Library;
use shagreen_learn::cnn_lstm::Architecture;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

use crate::method_predictions::MethodPredictions;
use crate::parallel::in_parallel;
use crate::reproduce::work::Work;
use crate::training_strokes::rendered_strokes;

/// Number of epochs of the paper.
const N_EPOCHS: usize = 200;

/// A network of Table 3.
pub(super) struct Kind {
    /// First part of the identifiers of its printed numbers.
    pub(super) id: &'static str,
    name: &'static str,
    /// Its sizes, for a number of attributes.
    architecture: fn(usize) -> Architecture,
}

/// The networks of Table 3, that of the paper last.
pub(super) const KINDS: [Kind; 4] = [
    Kind { id: "convolutions", name: "1D-CNN", architecture: Architecture::convolutions },
    Kind { id: "memory", name: "LSTM", architecture: Architecture::memory },
    Kind { id: "serial", name: "CNN-LSTM of others", architecture: Architecture::serial },
    Kind { id: "paper320", name: "proposed CNN-LSTM", architecture: Architecture::paper320 },
];

/// Predictions by each network of [`KINDS`], in their order, each texture left out.
pub(super) fn network_predictions(
    work: &Work<'_>,
    library: &Library,
    attributes: &AttributeTable,
) -> anyhow::Result<Vec<MethodPredictions>> {
    let (extent, seed) = (work.options.extent, work.options.seed);
    let textures = rendered_strokes(library, attributes, extent.stroke_share, seed, work.reporter)?;
    let n_epochs = extent.n_epochs.unwrap_or(N_EPOCHS);
    let mut all = Vec::with_capacity(KINDS.len());
    for kind in &KINDS {
        // The paper trains all epochs; an early end needs textures that nothing is learned from.
        let architecture = (kind.architecture)(attributes.names.len());
        let config = TrainingConfig::paper(architecture, n_epochs, None, seed);
        let predicted = in_parallel(textures.len(), |left_out| prediction(&textures, left_out, &config));
        let predicted = predicted.into_iter().collect::<anyhow::Result<Vec<Vec<f64>>>>()?;
        work.reporter.note(&format!(
            "{}: {} trained for {}",
            kind.name,
            counted(predicted.len(), "network"),
            counted(n_epochs, "epoch")
        ));
        all.push(MethodPredictions { name: kind.name.to_owned(), predicted });
    }
    Ok(all)
}

/// Attributes of a texture by a network that is trained on the others.
fn prediction(
    textures: &[StrokedTexture],
    left_out: usize,
    config: &TrainingConfig,
) -> anyhow::Result<Vec<f64>> {
    let mut others: Vec<&StrokedTexture> = textures.iter().collect();
    let asked = others.remove(left_out);
    let mut training = Training::new(&others, config.clone())?;
    while !training.is_over() {
        training.run_epoch(|_| true)?;
    }
    let predicted = training.finish()?.predict(&asked.strokes)?;
    predicted.context("the strokes are shorter than the input segment of the network")
}

#[cfg(test)]
mod tests {
    use super::{KINDS, prediction};
    use shagreen_core::maths::rng::lcg_noise;
    use shagreen_core::recording::fit::Stroke;
    use shagreen_learn::cnn_lstm::Architecture;
    use shagreen_learn::stroke_set::StrokedTexture;
    use shagreen_learn::training::TrainingConfig;

    #[test]
    fn a_texture_is_predicted_by_a_network_of_the_others() {
        let texture = |index: u64| StrokedTexture {
            id: format!("texture {index}"),
            strokes: vec![Stroke {
                axes_mps2: vec![lcg_noise(400, index)],
                speed_mps: vec![0.1; 400],
                force_n: vec![0.3; 400],
            }],
            attributes: vec![10.0 * index as f64, 50.0],
        };
        let textures: Vec<StrokedTexture> = (1..=3).map(texture).collect();
        let config = TrainingConfig::paper(Architecture::convolutions(2), 1, None, 1);
        let predicted = prediction(&textures, 1, &config).unwrap();
        assert!(predicted.len() == 2 && predicted.iter().all(|x| (0.0..=100.0).contains(x)));
        assert_eq!(prediction(&textures, 1, &config).unwrap(), predicted);
        assert_ne!(prediction(&textures, 0, &config).unwrap(), predicted);
        // The network of the paper is the last one.
        assert_eq!((KINDS[3].architecture)(5), Architecture::paper320(5));
    }
}
