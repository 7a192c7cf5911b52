//! Attributes of a texture, predicted from all of its pictures.

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::maths::statistics::mean;
use shagreen_learn::picture_model::PictureModel;
use shagreen_learn::picture_set::Seen;

/// Returns the prediction for a texture from all its pictures, of which there is at least one: the mean, and the root mean
/// square of the standard deviations. The errors of pictures of one texture are not independent, so more pictures do not
/// lower it.
///
/// # Errors
/// A picture has other features than those that the model was trained on.
pub fn predict_texture(model: &PictureModel, pictures: &[Seen]) -> anyhow::Result<Vec<Estimate>> {
    let of_pictures =
        pictures.iter().map(|seen| model.predict(&seen.features)).collect::<Result<Vec<_>, _>>()?;
    Ok(prediction_of_texture(&of_pictures))
}

fn prediction_of_texture(of_pictures: &[Vec<Estimate>]) -> Vec<Estimate> {
    let n_attributes = of_pictures.first().map_or(0, Vec::len);
    let of = |attribute: usize| {
        let all = |value: fn(&Estimate) -> f64| {
            mean(&of_pictures.iter().map(|estimates| value(&estimates[attribute])).collect::<Vec<f64>>())
        };
        Estimate { mean: all(|of| of.mean), deviation: all(|of| of.deviation * of.deviation).sqrt() }
    };
    (0..n_attributes).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::{Estimate, prediction_of_texture};

    #[test]
    fn the_prediction_for_a_texture_is_the_mean_of_those_for_its_pictures() {
        let of = |mean: f64, deviation: f64| Estimate { mean, deviation };
        let pictures = [vec![of(10.0, 3.0), of(50.0, 1.0)], vec![of(30.0, 5.0), of(70.0, 1.0)]];
        let [rough, hard] = prediction_of_texture(&pictures)[..] else { panic!("two attributes") };
        assert_eq!((rough.mean, hard.mean, hard.deviation), (20.0, 60.0, 1.0));
        assert!((rough.deviation - 17.0_f64.sqrt()).abs() < 1e-12, "{}", rough.deviation);
        let one = &pictures[..1];
        assert_eq!(prediction_of_texture(one), pictures[0], "one picture is its own mean");
        assert!(prediction_of_texture(&[]).is_empty());
    }
}
