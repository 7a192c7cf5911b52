//! Sample rates of signals, checked when the batch is planned: otherwise each job would find the same problem.

use anyhow::bail;
use shagreen_core::space::authoring::{Authoring, Blending};
use shagreen_core::texture::blend::Mode;
use shagreen_core::texture::rate::highest_rate;
use shagreen_core::units::Hertz;
use shagreen_core::words::counted;

use super::{BatchPlan, Target, TargetChoice};
use crate::export::signal_format;
use crate::project::find_authored;

impl BatchPlan {
    /// Returns outputs that cannot hold their textures, each as a key of the manifest and what is wrong.
    pub(super) fn rate_problems(&self) -> Vec<(String, String)> {
        let mut rates: Vec<(&str, Hertz)> = Vec::with_capacity(self.targets.len());
        for target in &self.targets {
            rates.extend(self.model_rate(target).map(|rate| (target.name.as_str(), rate)));
        }
        let outputs = self.manifest.outputs.iter().enumerate();
        let of_signals = outputs.filter(|(_, output)| signal_format(&output.format).is_some());
        of_signals
            .filter_map(|(index, output)| {
                let text = match output.rate_hz {
                    Some(rate_hz) => too_low(rate_hz, &rates),
                    None => not_whole(&rates),
                };
                Some((format!("output[{}].rate_hz", index + 1), text?))
            })
            .collect()
    }

    /// Model rate of a texture; `None` if only its job knows it.
    fn model_rate(&self, target: &Target) -> Option<Hertz> {
        let library = &self.sources.library;
        match &target.choice {
            TargetChoice::Texture(id) => {
                let entry = &library.textures[library.index_of(id)?];
                let of_path = entry.path.as_ref().map(|path| path.keys().iter().map(|key| &key.model));
                of_path.and_then(highest_rate).or(Some(entry.model.rate()))
            }
            TargetChoice::Point(point) => {
                let space = self.spaces.get(target.blend.id())?;
                if makes_models(space, target.blend) {
                    return self.rate_of_models(space);
                }
                let authored = space.author(*point, &Blending::from(target.blend))?;
                let parents = authored.parents.iter().map(|(texture, _)| &library.textures[*texture].model);
                highest_rate(parents)
            }
            TargetChoice::Authored(name) => {
                let authored = find_authored(&self.sources.project.as_ref()?.project, name).ok()?; // Reported before.
                let mode = authored.blend.mode_in_space(library.axis_names().len());
                let space = self.spaces.get(mode.id())?;
                // Pins can add textures to a mixture.
                if makes_models(space, mode) { self.rate_of_models(space) } else { None }
            }
        }
    }

    /// Rate of all interpolated models of a space: its textures are converted to the highest one.
    fn rate_of_models(&self, space: &Authoring) -> Option<Hertz> {
        let sites = space.space().sites().iter();
        highest_rate(sites.map(|(texture, _)| &self.sources.library.textures[*texture].model))
    }
}

/// Whether the textures of a space are interpolated as models in this mode.
fn makes_models(space: &Authoring, mode: Mode) -> bool {
    mode.makes_a_model() || !space.space().is_triangulated()
}

fn too_low(rate_hz: u32, rates: &[(&str, Hertz)]) -> Option<String> {
    let above: Vec<&(&str, Hertz)> =
        rates.iter().filter(|(_, model_rate)| model_rate.0 > f64::from(rate_hz)).collect();
    let (name, highest) = above.iter().max_by(|a, b| a.1.0.total_cmp(&b.1.0))?;
    let (n, least_hz) = (counted(above.len(), "texture"), highest.0.ceil());
    Some(format!(
        "it is {rate_hz} Hz, below the model rate of {n}; \"{name}\" needs a sample rate of at least {least_hz} Hz"
    ))
}

fn not_whole(rates: &[(&str, Hertz)]) -> Option<String> {
    rates.iter().find_map(|(name, rate)| {
        let error = whole_rate_hz(*rate).err()?;
        Some(format!("\"{name}\": {error}"))
    })
}

/// Returns a rate as a whole number, as files need it.
///
/// # Errors
/// It is not whole.
pub(super) fn whole_rate_hz(rate: Hertz) -> anyhow::Result<u32> {
    if rate.0.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&rate.0) {
        Ok(rate.0 as u32)
    } else {
        bail!("the model's rate of {rate} is not a whole number; state `rate_hz` of the output")
    }
}

#[cfg(test)]
mod tests {
    use super::{not_whole, too_low, whole_rate_hz};
    use shagreen_core::units::Hertz;

    #[test]
    fn a_rate_below_that_of_a_model_is_named_with_the_least_that_is_enough() {
        let rates = [("cork", Hertz(1000.0)), ("felt", Hertz(2000.5)), ("oak", Hertz(500.0))];
        assert_eq!(too_low(2001, &rates), None);
        let said = too_low(800, &rates).unwrap();
        assert!(
            said.contains("2 textures") && said.contains("\"felt\"") && said.contains("2001 Hz"),
            "{said}"
        );
        assert!(not_whole(&rates).unwrap().starts_with("\"felt\": "));
        assert_eq!((not_whole(&rates[..1]), not_whole(&[])), (None, None));
        assert_eq!(whole_rate_hz(Hertz(1000.0)).unwrap(), 1000);
        assert!(whole_rate_hz(Hertz(0.0)).is_err() && whole_rate_hz(Hertz(f64::NAN)).is_err());
    }
}
