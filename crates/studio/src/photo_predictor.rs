//! The predictor of attributes from photos that the user has chosen: an image network, and the heads that belong to it.

use std::path::Path;

use anyhow::{Context as _, anyhow, ensure};
use shagreen_core::words::counted;
use shagreen_formats::bounded_file::FileKind;
use shagreen_formats::library::USUAL_AXES;
use shagreen_formats::photo_networks::{ImageNetwork, PhotoNetworks};
use shagreen_learn::backbone::{Backbone, BackboneKind};
use shagreen_learn::picture_model::FeatureExtractor;
use shagreen_learn::picture_predictor::PicturePredictor;

use crate::file::{in_file, read_file};
use crate::models::ModelFolder;

const NOT_DOWNLOADED: &str = "EfficientNet-Lite0 is not on this computer; download it with `shagreen model fetch`, or choose another network";

/// Returns the predictor for these networks, whose files are read; `models` is the folder of downloaded networks. If the
/// user has not chosen any, it is the downloaded network with its built-in heads, or else statistics of the picture.
///
/// # Errors
/// A file cannot be read or is of another kind, the heads belong to another network, or they do not predict roughness and
/// hardness; the message says what to choose.
pub fn photo_predictor(
    chosen: Option<&PhotoNetworks>,
    models: Option<&ModelFolder>,
) -> anyhow::Result<PicturePredictor> {
    let Some(PhotoNetworks { network, heads }) = chosen else {
        return match models {
            Some(models) => models.looker(),
            None => Ok(PicturePredictor::built_in(None)?),
        };
    };
    ensure!(
        heads.is_some() || !matches!(network, ImageNetwork::Resnet50(_)),
        "ResNet-50 has no built-in heads; train them with `shagreen train photo --backbone`, and choose the model that it writes"
    );
    let backbone = match network {
        ImageNetwork::Statistics => None,
        ImageNetwork::EfficientnetLite0 => {
            let downloaded = models.map_or(Ok(None), ModelFolder::backbone)?;
            Some(downloaded.context(NOT_DOWNLOADED)?)
        }
        ImageNetwork::Resnet50(path) => Some(resnet_50(path)?),
    };
    let kind = backbone.as_ref().map(Backbone::kind);
    let Some(heads) = heads else { return Ok(PicturePredictor::built_in(backbone)?) };
    let bytes = read_file(heads, FileKind::Network)?;
    let predictor = PicturePredictor::new(&bytes, backbone).with_context(|| in_file(heads))?;
    check(&predictor, kind).with_context(|| in_file(heads))?;
    Ok(predictor)
}

/// Describes a predictor: its features, and what it was trained on.
pub fn described(predictor: &PicturePredictor) -> String {
    let model = predictor.model();
    format!("{}, trained on {}", model.eyes().name(), model.learned_from())
}

/// Reads ResNet-50.
fn resnet_50(path: &Path) -> anyhow::Result<Backbone> {
    let backbone =
        Backbone::from_bytes(&read_file(path, FileKind::Network)?).with_context(|| in_file(path))?;
    if backbone.kind() == BackboneKind::Resnet50 {
        return Ok(backbone);
    }
    Err(anyhow!(
        "this is {}, not ResNet-50; choose the file of ResNet-50 (with the tensor names of torchvision)",
        backbone.kind().name()
    ))
    .with_context(|| in_file(path))
}

/// Checks that the heads use the chosen network, and that they predict what the window needs. Heads of a predictor without
/// a network ignore the network that they are given.
fn check(predictor: &PicturePredictor, chosen: Option<BackboneKind>) -> anyhow::Result<()> {
    let model = predictor.model();
    let wanted = chosen.map_or(FeatureExtractor::Statistics.name(), BackboneKind::name);
    ensure!(
        model.eyes().name() == wanted,
        "these heads were trained on {}, not on {wanted}; choose the heads of this network, or the other network",
        model.eyes().name()
    );
    ensure!(
        model.attributes().iter().map(String::as_str).eq(USUAL_AXES),
        "these heads predict {} ({}), but the window needs {}; choose others",
        counted(model.attributes().len(), "attribute"),
        model.attributes().join(", "),
        USUAL_AXES.join(" and ")
    );
    Ok(())
}

#[cfg(test)]
mod tests;
