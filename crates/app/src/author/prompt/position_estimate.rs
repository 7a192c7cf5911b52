//! Position estimated from a prompt or photo, with its uncertainty.

use std::sync::Arc;

use shagreen_core::maths::gaussian_process::Estimate;
use shagreen_core::space::SpacePoint;
use shagreen_core::surfaces::generated::{Witness, agree};
use shagreen_core::surfaces::prompt::{OPEN, PromptInterpretation};
use shagreen_core::surfaces::touch_words::ATTRIBUTES;
use shagreen_formats::picture::Picture;
use shagreen_formats::project::plain_axis_name;
use shagreen_studio::axes::axis_poles;
use shagreen_studio::felt::GeneratedSurface;
use shagreen_studio::seen_materials::SeenMaterial;

use crate::session::Session;
use crate::strings::prompt as strings;

/// Estimate made from a prompt or photo.
#[derive(Clone, Debug, PartialEq)]
pub struct PositionEstimate {
    /// Key of the authored texture that was made from the estimate.
    pub key: Option<u32>,
    /// Prompt or photo that the estimate was made from.
    pub origin: Origin,
    /// Name of the generator that made the picture.
    pub made_by: String,
    /// Generated picture or photo.
    pub picture: Arc<Picture>,
    /// Surface that a procedural picture shows.
    pub surface: Option<GeneratedSurface>,
    /// Name of the texture.
    pub name: String,
    /// Names of the axes of the space, as in the project: words at their ends are not unique.
    pub names: Vec<String>,
    /// Estimates along these axes (0 to 100), with standard deviations.
    pub axes: Vec<Estimate>,
    /// Local mean of the textures on each axis of which neither words nor picture say anything, in a space with more axes than the
    /// canvas; `None` on the others. Empty if the estimates alone are the position.
    pub means: Vec<Option<f64>>,
    /// Explanations as sentences, the most important ones first.
    pub said: Vec<String>,
    /// Whether words and an independent picture lead to different estimates on an axis.
    pub is_disputed: bool,
    /// Materials that the picture is likely to show, the most likely first. Empty for a picture that was made from the words.
    pub materials: Vec<MaterialEstimate>,
    /// Doubts about the picture, as sentences with what to do.
    pub doubts: Vec<String>,
    /// Material whose lexicon entry the user has taken instead of the estimate from the picture.
    pub taken: Option<String>,
}

/// Material that a picture is likely to show.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialEstimate {
    /// Name of the material.
    pub name: String,
    /// Name and probability, in percent.
    pub label: String,
    /// Estimates of its lexicon entry along the axes, if it has one.
    pub axes: Option<Vec<Estimate>>,
}

/// Source of an estimate.
#[derive(Clone, Debug, PartialEq)]
pub enum Origin {
    /// Prompt, and the seed of its picture.
    Words {
        /// Text of the prompt.
        prompt: String,
        /// Seed of the picture generator.
        seed: u64,
    },
    /// Photo.
    Photo {
        /// Name of the file.
        name: String,
        /// Words that were given with it.
        prompt: Option<String>,
    },
}

impl PositionEstimate {
    /// Estimated position, limited to the space (0 to 100 on each axis).
    pub fn at(&self) -> SpacePoint {
        let coordinates: Vec<f64> =
            (0..self.axes.len()).filter_map(|axis| Some(self.coordinate(axis)?.clamp(0.0, 100.0))).collect();
        SpacePoint::of(&coordinates).unwrap_or_default()
    }

    /// The estimate with the local mean of the textures on every axis without an estimate, in a space with more axes than the
    /// canvas.
    pub(crate) fn in_space(self, session: &Session) -> Self {
        if session.is_sliced() { self.completed(|told| session.completed(told)) } else { self }
    }

    /// Coordinate on an axis: that of the estimate, or its local mean without one.
    fn coordinate(&self, axis: usize) -> Option<f64> {
        let estimate = self.axes.get(axis)?;
        Some(self.mean(axis).unwrap_or(estimate.mean))
    }

    /// Local mean of the textures on an axis without an estimate.
    pub fn mean(&self, axis: usize) -> Option<f64> {
        *self.means.get(axis)?
    }

    /// Estimates along both axes of the canvas; `None` in a space with one axis.
    pub(crate) fn on_canvas(&self) -> Option<[Estimate; 2]> {
        let [across, up, ..] = self.axes[..] else { return None };
        let on = |axis: usize, estimate: Estimate| {
            self.coordinate(axis).map_or(estimate, |mean| Estimate { mean, ..estimate })
        };
        Some([on(0, across), on(1, up)])
    }

    /// The estimate with the local mean on every axis without an estimate. `complete` returns a point with coordinates on
    /// all axes, from the estimated ones.
    pub(crate) fn completed(self, complete: impl FnOnce(&[Option<f64>]) -> SpacePoint) -> Self {
        let is_told = |axis: &Estimate| *axis != OPEN;
        let told: Vec<Option<f64>> =
            self.axes.iter().map(|axis| is_told(axis).then(|| axis.mean.clamp(0.0, 100.0))).collect();
        let whole = complete(&told);
        let mean = |(axis, told): (usize, &Option<f64>)| whole.get(axis).filter(|_| told.is_none());
        Self { means: told.iter().enumerate().map(mean).collect(), ..self }
    }

    /// Key of the authored texture that was made from the estimate, and its picture.
    pub(super) fn replaced(&self) -> Option<(u32, Arc<Picture>)> {
        Some((self.key?, Arc::clone(&self.picture)))
    }

    /// Notes for the texture that is made from the estimate.
    pub(crate) fn notes(&self) -> String {
        match (&self.origin, &self.taken) {
            (Origin::Words { prompt, seed }, None) => strings::note_of_words(&self.made_by, *seed, prompt),
            (Origin::Words { prompt, seed }, Some(material)) => {
                let note = strings::note_of_words(&self.made_by, *seed, prompt);
                format!("{note}\n{}", strings::by_material(material))
            }
            (Origin::Photo { name, prompt }, None) => strings::note_of_photo(name, prompt.as_deref()),
            (Origin::Photo { name, .. }, Some(material)) => {
                strings::note_of_material_in_photo(name, material)
            }
        }
    }

    /// The estimate with the lexicon entry of one of its materials; `None` if it has none.
    pub(super) fn with_material(&self, name: &str) -> Option<Self> {
        let axes = self.materials.iter().find(|material| material.name == name)?.axes.clone()?;
        Some(Self {
            // In memory of its own, so that undo brings the former estimate back together with its picture.
            picture: Arc::new(Picture::clone(&self.picture)),
            axes,
            means: Vec::new(),
            said: vec![strings::by_material(name), strings::NO_SCALE.to_owned()],
            is_disputed: false,
            doubts: Vec::new(),
            taken: Some(name.to_owned()),
            ..self.clone()
        })
    }
}

impl MaterialEstimate {
    /// A material with the estimates of its lexicon entry along these axes. An axis without an estimate is [`OPEN`].
    pub(super) fn new(seen: &SeenMaterial, axes: &[String]) -> Self {
        let along = |name: &String| {
            let index = attribute_of(name);
            let hint = index.and_then(|index| seen.entry.as_ref()?.hints[index]);
            hint.unwrap_or(OPEN)
        };
        Self {
            name: seen.name.clone(),
            label: seen.label(),
            axes: seen.entry.as_ref().map(|_| axes.iter().map(along).collect()),
        }
    }
}

/// Index of the attribute of which words and pictures say something on the axis with this name, among [`ATTRIBUTES`].
fn attribute_of(axis: &str) -> Option<usize> {
    let name = axis_poles(axis).join("-");
    ATTRIBUTES.iter().position(|attribute| *attribute == name)
}

/// Returns the estimates along the `axes`, combined from words and picture, and the plain names of axes on which both disagree.
/// A picture yields estimates for the first two of [`ATTRIBUTES`] only. An axis without an estimate is [`OPEN`].
pub(super) fn on_axes<'a>(
    axes: &'a [String],
    words: Option<&PromptInterpretation>,
    picture: &[Estimate],
    witness: Witness,
) -> (Vec<Estimate>, Vec<&'a str>) {
    let mut disputed = Vec::new();
    let mut estimate = |axis: &'a String| {
        let index = attribute_of(axis);
        let said = index.and_then(|index| words.map(|words| words.attributes[index]));
        let seen = index.and_then(|index| picture.get(index).copied());
        match (said, seen) {
            (Some(said), Some(seen)) => {
                let agreed = agree(said, seen, witness);
                if agreed.differ {
                    disputed.push(plain_axis_name(axis));
                }
                agreed.estimate
            }
            (Some(one), None) | (None, Some(one)) => one,
            (None, None) => OPEN,
        }
    };
    let estimates = axes.iter().map(&mut estimate).collect();
    (estimates, disputed)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{MaterialEstimate, Origin, PositionEstimate, on_axes};
    use shagreen_core::maths::gaussian_process::Estimate;
    use shagreen_core::space::SpacePoint;
    use shagreen_core::surfaces::generated::Witness;
    use shagreen_core::surfaces::prompt::{OPEN, interpret};
    use shagreen_formats::lexicon_toml::built_in_lexicon;
    use shagreen_formats::starter::starter_library;
    use shagreen_learn::picture_predictor::LikelyMaterial;
    use shagreen_studio::seen_materials::seen_materials;

    #[test]
    fn axes_are_told_by_their_names() {
        let words = interpret("a very bumpy, rough stone", built_in_lexicon().unwrap());
        let picture = [Estimate { mean: 95.0, deviation: 2.0 }, Estimate { mean: 10.0, deviation: 5.0 }];
        let axes = |names: [&str; 2]| names.map(str::to_owned);
        let usual = axes(["rough-smooth", "hard-soft"]);
        let (both, disputed) = on_axes(&usual, Some(&words), &picture, Witness::OnItsOwn);
        assert_eq!(disputed, ["rough-smooth"]);
        // So do an attribute of the same name, and the same poles in another spelling.
        let attribute = axes(["attribute:rough-smooth", "hard - soft"]);
        let found = on_axes(&attribute, Some(&words), &picture, Witness::OnItsOwn);
        assert_eq!(found, (both.clone(), vec!["rough-smooth"]));
        assert!(both[1].mean < 25.0 && both[0].deviation > 2.0);
        let other = axes(["warm-cold", "flat-bumpy"]);
        let (open, disputed) = on_axes(&other, Some(&words), &picture, Witness::OnItsOwn);
        assert_eq!((open[0], disputed.len()), (OPEN, 0));
        assert!(open[1].mean > 70.0, "{open:?}");
        assert_eq!(on_axes(&usual, None, &picture, Witness::OnItsOwn).0, picture);
        assert_eq!(on_axes(&other, None, &picture, Witness::OnItsOwn).0, [OPEN; 2]);
    }

    #[test]
    fn a_material_has_the_estimates_of_the_lexicon_along_the_axes() {
        let lexicon = built_in_lexicon().unwrap();
        let likely = [("carpet", 0.6), ("plasma", 0.3)]
            .map(|(name, probability)| LikelyMaterial { name: name.to_owned(), probability });
        let seen = seen_materials(&likely, lexicon);
        let hints = lexicon.material("carpet").unwrap().1;
        let axes = ["hard-soft", "warm-cold"].map(str::to_owned);
        let carpet = MaterialEstimate::new(&seen[0], &axes);
        assert_eq!(carpet.label, "carpet 60 %");
        assert_eq!(carpet.axes, Some(vec![hints[1].unwrap(), OPEN]));
        assert_eq!(MaterialEstimate::new(&seen[1], &axes).axes, None);

        let starter = starter_library().unwrap();
        let estimate = PositionEstimate {
            key: Some(1),
            origin: Origin::Photo { name: "floor.jpg".to_owned(), prompt: None },
            made_by: "photo".to_owned(),
            picture: Arc::new(starter.textures[0].picture.clone().unwrap()),
            surface: None,
            name: "floor".to_owned(),
            names: axes.to_vec(),
            axes: vec![OPEN; 2],
            means: Vec::new(),
            said: Vec::new(),
            is_disputed: false,
            materials: seen.iter().map(|seen| MaterialEstimate::new(seen, &axes)).collect(),
            doubts: vec!["The picture is blurred.".to_owned()],
            taken: None,
        };
        assert!(estimate.notes().contains("from the photo floor.jpg"));
        let taken = estimate.with_material("carpet").unwrap();
        assert_eq!((&taken.axes, &taken.taken), (&carpet.axes.unwrap(), &Some("carpet".to_owned())));
        assert!(taken.notes().contains("carpet in the lexicon") && taken.doubts.is_empty());
        assert!(taken.picture == estimate.picture && !Arc::ptr_eq(&taken.picture, &estimate.picture));
        // An axis that the entry does not tell is completed.
        assert_eq!((taken.at().y(), taken.mean(1)), (50.0, None));
        let completed = taken.clone().completed(|told| {
            assert_eq!(told, [Some(hints[1].unwrap().mean), None]);
            SpacePoint::plane(1.0, 43.0)
        });
        assert_eq!((completed.at().x(), completed.at().y()), (hints[1].unwrap().mean, 43.0));
        assert_eq!((completed.mean(0), completed.mean(1)), (None, Some(43.0)));
        assert_eq!(completed.on_canvas().map(|axes| axes[1]), Some(Estimate { mean: 43.0, ..OPEN }));
        assert_eq!(estimate.with_material("plasma"), None);
        assert_eq!(estimate.with_material("brick"), None);
    }
}
