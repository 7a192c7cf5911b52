//! `shagreen evaluate codec`: measures the loss of textures at each rate of the codec.

use std::borrow::Borrow;
use std::sync::Arc;

use anyhow::{Context as _, ensure};
use serde_json::json;
use shagreen_core::dsp::spectrum::rms;
use shagreen_core::maths::shard::Shard;
use shagreen_core::maths::statistics::mean;
use shagreen_core::signals::codec::bitrate::Bitrate;
use shagreen_core::signals::codec::books::Codebooks;
use shagreen_core::signals::codec::coded::Coded;
use shagreen_core::signals::codec::corpus::{is_held_out, signal};
use shagreen_core::signals::quality::{PAPER_RATE, QualityMeter, QualityModel, snr_db};
use shagreen_core::units::Contact;
use shagreen_core::words::counted;
use shagreen_formats::codec_tables::built_in_codebooks;
use shagreen_formats::library::{Library, TextureEntry};

use crate::cli::library_args::LibraryArgs;
use crate::cli::output;
use crate::cli::progress::Progress;
use crate::cli::quality_model_args::{ModelArgs, model_json};
use crate::cli::quantity::{positive, within};

/// Encodes every texture of a library at the codec's five bit rates and measures the loss: the signal-to-noise ratio,
/// the level of the decoded signal relative to the original, and the discriminability d' that a model predicts.
///
/// The codec's codebooks were trained on two thirds of the starter library's textures; the others are marked as held
/// out. The values are computed from signals, not from human ratings.
#[derive(clap::Args)]
pub(crate) struct Args {
    #[command(flatten)]
    library: LibraryArgs,
    #[command(flatten)]
    model: ModelArgs,
    /// Tip speed, in mm/s.
    #[arg(long, value_name = "V", value_parser = positive, default_value = "100")]
    speed: f64,
    /// Normal force, in N.
    #[arg(long, value_name = "F", value_parser = positive, default_value = "1")]
    force: f64,
    /// Duration of each signal, in s: 0.8 to 60.
    #[arg(long, value_name = "S", value_parser = seconds, default_value = "4")]
    seconds: f64,
    /// Random seed of the noise; the same seed repeats all signals exactly.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Part of the textures to measure, such as 2/4, to divide the work among computers. The rows of all parts are those of the
    /// whole; the means are those of the part.
    #[arg(long, value_name = "I/N", default_value_t = Shard::WHOLE, hide_default_value = true)]
    shard: Shard,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

/// Shortest and longest signal, in s: one compared segment, and a limit on computing time.
const SIGNAL_SECS: std::ops::RangeInclusive<f64> = 0.8..=60.0;

fn seconds(text: &str) -> Result<f64, String> {
    within(text, &SIGNAL_SECS, "seconds")
}

/// Results of a texture at each rate, in the order of [`Bitrate::ALL`].
struct Row<'a> {
    texture: &'a TextureEntry,
    /// `None` for libraries other than the starter library.
    is_held_out: Option<bool>,
    snr_db: [f64; 5],
    /// Level of the decoded signal relative to the original, in dB.
    level_db: [f64; 5],
    d_prime: [f64; 5],
}

struct Bench {
    books: Arc<Codebooks>,
    meter: QualityMeter,
    model: QualityModel,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let library = args.library.load()?;
    let model = args.model.load()?;
    let of_model = model_json(&model);
    let by = model
        .sha256
        .as_ref()
        .map(|_| format!("d' is predicted by the model {} ({})", model.name, model.origin()));
    let bench = Bench {
        books: Arc::new(built_in_codebooks()?),
        meter: QualityMeter::new(PAPER_RATE, &model.threshold().read()?)?,
        model: model.file.model,
    };
    let is_known = args.library.path().is_none();
    let indices: Vec<usize> = args.shard.indices(library.textures.len()).collect();
    ensure!(
        !indices.is_empty(),
        "the part {} has none of the {}; use fewer parts",
        args.shard,
        counted(library.textures.len(), "texture")
    );
    let progress = Progress::new("encoding the textures", indices.len());
    let mut rows = Vec::with_capacity(indices.len());
    for index in indices {
        let texture = &library.textures[index];
        let held_out = is_known.then(|| is_held_out(index));
        let row = bench.measure(texture, held_out, args, index);
        rows.push(row.with_context(|| format!("the texture \"{}\" cannot be measured", texture.id))?);
        progress.step();
    }
    progress.finish();
    let held_out: Vec<&Row<'_>> = rows.iter().filter(|row| row.is_held_out == Some(true)).collect();
    let of_held_out = |of: fn(&Row<'_>) -> [f64; 5]| (!held_out.is_empty()).then(|| means(&held_out, of));
    let textures: Vec<_> = rows
        .iter()
        .map(|row| {
            json!({
                "id": row.texture.id,
                "held_out": row.is_held_out,
                "snr_db": row.snr_db,
                "level_db": row.level_db,
                "dprime": row.d_prime,
            })
        })
        .collect();
    let answer = json!({
        "measured_on": "signals",
        "model": of_model,
        "kbps": Bitrate::ALL.map(Bitrate::kbps),
        "speed_mm_per_s": args.speed,
        "force_n": args.force,
        "seconds": args.seconds,
        "shard": args.shard.to_string(),
        "n": rows.len(),
        "snr_db_mean": means(&rows, |row| row.snr_db),
        "level_db_mean": means(&rows, |row| row.level_db),
        "dprime_mean": means(&rows, |row| row.d_prime),
        "held_out_snr_db_mean": of_held_out(|row| row.snr_db),
        "held_out_dprime_mean": of_held_out(|row| row.d_prime),
        "textures": textures,
    });
    output::print(args.json, &answer, || table(&library, &rows, by));
    Ok(())
}

impl Bench {
    fn measure<'a>(
        &self,
        texture: &'a TextureEntry,
        is_held_out: Option<bool>,
        args: &Args,
        index: usize,
    ) -> anyhow::Result<Row<'a>> {
        let contact = Contact::from_mm_per_s_and_n(args.speed, args.force);
        let seed = args.seed.wrapping_mul(1000).wrapping_add(index as u64);
        let felt = signal(&texture.model, contact, args.seconds, seed)?;
        ensure!(rms(&felt) > 0.0, "it is silent at this speed and force; choose another --speed or --force");
        let mut row = Row { texture, is_held_out, snr_db: [0.0; 5], level_db: [0.0; 5], d_prime: [0.0; 5] };
        for (i, rate) in Bitrate::ALL.into_iter().enumerate() {
            let decoded = Coded::encode(&felt, rate, &self.books)?.decode(&self.books);
            row.snr_db[i] = snr_db(&felt, &decoded);
            row.level_db[i] = 20.0 * (rms(&decoded) / rms(&felt)).log10();
            row.d_prime[i] = self.model.d_prime(&self.meter.distances(&felt, &decoded)?);
        }
        Ok(row)
    }
}

/// Returns the mean at each rate.
fn means<'a, R: Borrow<Row<'a>>>(rows: &[R], of: impl Fn(&Row<'a>) -> [f64; 5]) -> [f64; 5] {
    std::array::from_fn(|i| mean(&rows.iter().map(|row| of(row.borrow())[i]).collect::<Vec<f64>>()))
}

fn table(library: &Library, rows: &[Row<'_>], by: Option<String>) -> String {
    let five = |numbers: &[f64; 5]| numbers.map(|x| format!("{x:6.2}")).join("");
    let line = |name: &str, snr: &[f64; 5], d_prime: &[f64; 5]| {
        format!("{name:24} {}   {}", five(snr), five(d_prime))
    };
    let rates = five(&Bitrate::ALL.map(Bitrate::kbps));
    let mut lines = vec![
        format!(
            "{}: {} encoded and decoded (left: signal-to-noise ratio in dB; right: predicted d'; measured on signals, not rated by people)",
            library.name,
            counted(rows.len(), "texture")
        ),
        format!("{:24} {rates}   {rates}", "kbit/s"),
    ];
    for row in rows {
        let mark = if row.is_held_out == Some(true) { "*" } else { "" };
        lines.push(line(&format!("{}{mark}", row.texture.id), &row.snr_db, &row.d_prime));
    }
    lines.push(line("mean", &means(rows, |row| row.snr_db), &means(rows, |row| row.d_prime)));
    let is_marked = |row: &&Row<'_>| row.is_held_out == Some(true);
    let marked: Vec<&Row<'_>> = rows.iter().filter(is_marked).collect();
    if !marked.is_empty() {
        lines.push(line("mean of *", &means(&marked, |row| row.snr_db), &means(&marked, |row| row.d_prime)));
        lines.push("* held out: the codec's codebooks were not trained on these".to_owned());
    }
    lines.push(format!(
        "{:24} {}   (of the decoded signals relative to the originals, in dB)",
        "mean level",
        five(&means(rows, |row| row.level_db))
    ));
    lines.extend(by);
    lines.join("\n")
}
