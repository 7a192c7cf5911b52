//! Feature table of the textures in a space.

use crate::space::features::{
    FeatureError, FeaturePlan, FeatureTable, NamedTexture, Statistic, per_frame, per_pattern, physical_table,
};
use crate::space::space_build::{FeatureKind, SpaceOptions};
use crate::texture::patterns::{PAPER_RATE, PAPER_SECS, PatternPlan, paper_patterns};

/// Features of the textures' vibrations. `go_on` is called before every texture; if it returns `false`, the work stops.
///
/// # Errors
/// See [`FeatureError`].
pub(super) fn features(
    textures: &[NamedTexture<'_>],
    options: &SpaceOptions,
    go_on: &(dyn Fn() -> bool + Sync),
) -> Result<FeatureTable, FeatureError> {
    let contacts = paper_patterns();
    let patterns =
        PatternPlan { contacts: &contacts, seconds: PAPER_SECS, rate: PAPER_RATE, seed: options.seed };
    let plan = FeaturePlan { patterns, mfcc: &options.mfcc };
    Ok(match options.features {
        FeatureKind::Mfcc => per_pattern(textures, &plan, Statistic::Mean, go_on)?,
        FeatureKind::MfccFrames => per_frame(textures, &plan, go_on)?,
        FeatureKind::Physical => physical_table(textures, &contacts)?,
        FeatureKind::MfccAndPhysical => per_pattern(textures, &plan, Statistic::Mean, go_on)?
            .beside(&physical_table(textures, &contacts)?),
    })
}
