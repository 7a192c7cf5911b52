//! Training of one network, saved after every epoch, resumable.

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use anyhow::Context as _;
use shagreen_core::words::two_digits;
use shagreen_formats::atomic;
use shagreen_formats::bounded_file::FileKind;
use shagreen_learn::stroke_set::StrokedTexture;
use shagreen_learn::training::{Training, TrainingConfig};

use crate::cli::output;
use crate::cli::progress::Progress;
use shagreen_studio::file;

/// Training of one network among several.
pub(super) struct Run<'a> {
    /// File of its state.
    pub(super) kept: Option<PathBuf>,
    /// Its name in messages.
    pub(super) what: String,
    /// When it must stop.
    pub(super) until: Option<Instant>,
    pub(super) progress: &'a Progress,
    /// Whether another training has failed, so that this one is in vain.
    pub(super) failed: &'a AtomicBool,
}

/// Trains to the end or until its time is over, from the saved state if there is one; `None` if another training has
/// failed.
pub(super) fn train(
    textures: &[&StrokedTexture],
    config: TrainingConfig,
    run: &Run<'_>,
) -> anyhow::Result<Option<Training>> {
    let Run { what, progress, failed, .. } = run;
    let n_epochs = config.n_epochs;
    let mut training = match run.kept.as_ref().filter(|path| path.exists()) {
        Some(path) => Training::resume(textures, config, &file::read_file(path, FileKind::Network)?)
            .with_context(|| file::in_file(path))?,
        None => Training::new(textures, config)?,
    };
    let keep = |training: &Training| -> anyhow::Result<()> {
        if let Some(path) = &run.kept {
            atomic::write(path, &training.keep()?)?;
        }
        Ok(())
    };
    let mut done = 1000 * training.epochs().len().min(n_epochs);
    progress.leave_out(done);
    // A network is trained on one batch at least, however little time there is.
    let mut is_begun = training.n_epochs() > 0.0;
    while !training.is_over() {
        let started = Instant::now();
        let before = 1000 * training.epochs().len();
        let epoch = training.run_epoch(|share| {
            let now = before + (1000.0 * share) as usize;
            progress.steps(now.saturating_sub(done));
            done = done.max(now);
            let is_late = is_begun && run.until.is_some_and(|until| Instant::now() >= until);
            is_begun = true;
            !is_late && !failed.load(Ordering::Relaxed)
        })?;
        let Some(epoch) = epoch else {
            if failed.load(Ordering::Relaxed) {
                return Ok(None);
            }
            output::note(&format!(
                "{what}: the time is over after {} of {n_epochs} epochs",
                two_digits(training.n_epochs())
            ));
            keep(&training)?;
            break;
        };
        progress.steps((before + 1000).saturating_sub(done));
        done = before + 1000;
        let aside = epoch.aside_rmse.map_or(String::new(), |rmse| format!(", validation RMSE {rmse:.2}"));
        output::note(&format!(
            "{what}: epoch {} of {n_epochs}, {:.0} s, training RMSE {:.2}{aside}",
            epoch.number,
            started.elapsed().as_secs_f64(),
            epoch.learned_rmse
        ));
        keep(&training)?;
    }
    // Epochs that an early stop skips.
    progress.leave_out((1000 * n_epochs).saturating_sub(done));
    Ok(Some(training))
}
