//! The command line: the functions of the program without its window.
//!
//! Results go to standard output, as text or as one JSON object. Progress, notes, warnings and errors go to standard
//! error. The exit status is 0 for success, 1 for failure and 2 for wrong usage.

mod actuator_acf;
mod actuator_list;
mod actuator_show;
mod actuator_source;
mod axes_args;
mod axis_name;
mod backbone_source;
mod batch;
mod blending;
mod bundle;
mod calibrate;
mod calibrate_args;
mod calibrate_live;
mod calibrate_recording;
mod calibrate_result;
mod calibrate_sweep;
mod check;
mod class_figures;
mod codec_decode;
mod codec_encode;
mod devices;
mod devices_pens;
mod displays;
mod doctor;
mod doctor_facts;
mod drawn_pictures;
mod drawn_touches;
mod evaluate;
mod evaluate_axes;
mod evaluate_codec;
mod export;
mod export_signals;
mod fit_args;
mod generate;
mod generated_texture;
mod guide;
mod hid_files;
mod import;
mod import_directional;
mod import_file;
mod import_hatt;
mod import_models;
mod import_recording;
mod labelled_photos;
mod latency;
mod latency_onsets;
mod library_args;
mod library_list;
mod library_make;
mod library_places;
mod library_relief;
mod limiter_summary;
mod method_predictions;
mod model_add;
mod model_fetch;
mod model_folder;
mod model_list;
mod model_show;
mod motion;
mod out_name;
mod output;
mod own_folder;
mod play;
mod point;
mod predict_attributes;
mod prediction_figures;
mod profile_source;
mod progress;
mod project_gallery;
mod project_new;
mod project_show;
mod prompt_summary;
mod quality;
mod quality_fit;
mod quality_model_args;
mod quantity;
mod receiver;
mod recording_answers;
mod recording_source;
mod render;
mod reproduce;
mod rig;
mod sample_args;
mod seen_json;
mod shape_args;
mod signal_args;
mod signal_source;
mod space_build;
mod space_judgments;
mod space_panel;
mod space_place;
mod space_questionnaire;
mod spatial_analyse;
mod spatial_make;
mod spatial_reconstruct;
mod stroke;
mod stroke_args;
mod stroke_recordings;
mod stroke_signal;
mod study;
mod sweep_checks;
mod target;
mod terminal_line;
mod texture_path;
mod texture_pictures;
mod texture_psd;
mod train_attributes;
mod train_labelled_photos;
mod train_networks;
mod train_photo;
mod watch;
mod wav_name;
pub(crate) mod window;
mod words;

use std::process::ExitCode;
use std::time::Instant;

use clap::{CommandFactory as _, FromArgMatches as _};

use crate::cli::window::OpenWindow;

/// A tool for authoring haptic textures. Without a command, it opens the window.
#[derive(clap::Parser)]
#[command(name = "shagreen", version, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(flatten)]
    window: window::Args,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(clap::Subcommand)]
enum Command {
    /// Lists, simulates and edits texture libraries.
    #[command(subcommand)]
    Library(LibraryCommand),
    /// Creates and shows projects, and lists the example projects.
    #[command(subcommand)]
    Project(ProjectCommand),
    Import(Box<import_file::ImportArgs>),
    Render(render::Args),
    /// Computes the power spectral density of a texture, or makes a texture that follows a path through the space.
    #[command(subcommand)]
    Texture(TextureCommand),
    Check(check::Args),
    Export(export::Args),
    Batch(batch::Args),
    Bundle(bundle::Args),
    /// Builds a space of textures from ratings, with or without sorts, writes questionnaires, simulates raters, or reads
    /// positions from a table.
    #[command(subcommand)]
    Space(SpaceCommand),
    /// Plans studies with people, simulates participants, and analyzes the answers. People answer in the window.
    #[command(subcommand)]
    Study(study::Command),
    /// Measures the errors of interpolation and codec on signals, without human participants.
    #[command(subcommand)]
    Evaluate(EvaluateCommand),
    Reproduce(Box<reproduce::Args>),
    Devices(devices::Args),
    Doctor(doctor::Args),
    Play(play::Args),
    Latency(latency::Args),
    /// Lists, shows and exports actuator profiles.
    #[command(subcommand)]
    Actuator(ActuatorCommand),
    Calibrate(Box<calibrate_args::Args>),
    Quality(quality::Args),
    Generate(generate::Args),
    Guide(guide::Args),
    /// Encodes and decodes texture signals at 1.75 to 3.15 kbit/s.
    #[command(subcommand)]
    Codec(CodecCommand),
    /// Analyzes spatial spectrograms of surface profiles: the power in each window along the surface, by spatial
    /// frequency.
    #[command(subcommand)]
    Spatial(SpatialCommand),
    /// Predicts perceptual attributes of a recording, a photo or a text prompt, with standard deviations.
    #[command(subcommand)]
    Predict(PredictCommand),
    /// Trains attribute predictors and reports their leave-one-texture-out error.
    #[command(subcommand)]
    Train(TrainCommand),
    /// Registers, downloads and lists third-party neural networks, and shows the cards of trained models.
    #[command(subcommand)]
    Model(ModelCommand),
}

#[derive(clap::Subcommand)]
enum PredictCommand {
    Attributes(predict_attributes::Args),
}

#[derive(clap::Subcommand)]
enum TrainCommand {
    Attributes(train_attributes::Args),
    Photo(train_photo::Args),
}

#[derive(clap::Subcommand)]
enum ModelCommand {
    Add(model_add::Args),
    Fetch(model_fetch::Args),
    List(model_list::Args),
    Show(model_show::Args),
}

#[derive(clap::Subcommand)]
enum SpatialCommand {
    Analyse(spatial_analyse::Args),
    Reconstruct(spatial_reconstruct::Args),
    Make(spatial_make::Args),
}

#[derive(clap::Subcommand)]
enum CodecCommand {
    Encode(codec_encode::Args),
    Decode(codec_decode::Args),
}

#[derive(clap::Subcommand)]
enum ActuatorCommand {
    List(actuator_list::Args),
    Show(actuator_show::Args),
    Acf(actuator_acf::Args),
}

#[derive(clap::Subcommand)]
enum LibraryCommand {
    /// Lists the textures of a library.
    List(library_list::Args),
    Make(library_make::Args),
    Places(library_places::Args),
    Relief(library_relief::Args),
}

#[derive(clap::Subcommand)]
enum ProjectCommand {
    Gallery(project_gallery::Args),
    New(project_new::Args),
    Show(project_show::Args),
}

#[derive(clap::Subcommand)]
enum SpaceCommand {
    Build(Box<space_build::Args>),
    Panel(space_panel::Args),
    Place(space_place::Args),
    Questionnaire(space_questionnaire::Args),
}

#[derive(clap::Subcommand)]
enum EvaluateCommand {
    Axes(evaluate_axes::Args),
    LeaveOneOut(evaluate::Args),
    Codec(evaluate_codec::Args),
}

#[derive(clap::Subcommand)]
enum TextureCommand {
    /// Computes the power spectral density of a texture's model.
    Psd(Box<texture_psd::Args>),
    Path(Box<texture_path::Args>),
}

/// Returns the command with options that accept negative numbers as values. A wrong negative value is then reported as
/// such, not as an unknown option.
fn with_negative_numbers(command: clap::Command) -> clap::Command {
    command
        .mut_args(|arg| {
            let takes_value = arg.get_action().takes_values() && !arg.is_positional();
            if takes_value { arg.allow_negative_numbers(true) } else { arg }
        })
        .mut_subcommands(with_negative_numbers)
}

/// Runs the command that the program's arguments specify and returns the exit status.
pub(crate) fn run(open_window: OpenWindow) -> ExitCode {
    let started = Instant::now();
    let matches = with_negative_numbers(Cli::command()).try_get_matches();
    let cli = match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => cli,
        Err(error) => return output::usage(&error),
    };
    let done = match &cli.command {
        None => window::run(&cli.window, started, open_window),
        Some(Command::Library(LibraryCommand::List(args))) => library_list::run(args),
        Some(Command::Library(LibraryCommand::Make(args))) => library_make::run(args),
        Some(Command::Library(LibraryCommand::Places(args))) => library_places::run(args),
        Some(Command::Library(LibraryCommand::Relief(args))) => library_relief::run(args),
        Some(Command::Project(ProjectCommand::Gallery(args))) => project_gallery::run(args),
        Some(Command::Project(ProjectCommand::New(args))) => project_new::run(args),
        Some(Command::Project(ProjectCommand::Show(args))) => project_show::run(args),
        Some(Command::Check(args)) => check::run(args),
        Some(Command::Export(args)) => export::run(args),
        Some(Command::Batch(args)) => batch::run(args),
        Some(Command::Bundle(args)) => bundle::run(args),
        Some(Command::Import(args)) => import_file::run(args),
        Some(Command::Render(args)) => render::run(args),
        Some(Command::Space(SpaceCommand::Build(args))) => space_build::run(args),
        Some(Command::Space(SpaceCommand::Panel(args))) => space_panel::run(args),
        Some(Command::Space(SpaceCommand::Place(args))) => space_place::run(args),
        Some(Command::Space(SpaceCommand::Questionnaire(args))) => space_questionnaire::run(args),
        Some(Command::Texture(TextureCommand::Psd(args))) => texture_psd::run(args),
        Some(Command::Evaluate(EvaluateCommand::LeaveOneOut(args))) => evaluate::run(args),
        Some(Command::Evaluate(EvaluateCommand::Axes(args))) => evaluate_axes::run(args),
        Some(Command::Reproduce(args)) => reproduce::run(args),
        Some(Command::Texture(TextureCommand::Path(args))) => texture_path::run(args),
        Some(Command::Study(command)) => study::run(command),
        Some(Command::Devices(args)) => devices::run(args),
        Some(Command::Doctor(args)) => {
            doctor::run(args);
            Ok(())
        }
        Some(Command::Play(args)) => play::run(args),
        Some(Command::Latency(args)) => latency::run(args),
        Some(Command::Actuator(ActuatorCommand::List(args))) => actuator_list::run(args),
        Some(Command::Actuator(ActuatorCommand::Show(args))) => actuator_show::run(args),
        Some(Command::Actuator(ActuatorCommand::Acf(args))) => actuator_acf::run(args),
        Some(Command::Quality(args)) => quality::run(args),
        Some(Command::Generate(args)) => generate::run(args),
        Some(Command::Guide(args)) => guide::run(args),
        Some(Command::Codec(CodecCommand::Encode(args))) => codec_encode::run(args),
        Some(Command::Codec(CodecCommand::Decode(args))) => codec_decode::run(args),
        Some(Command::Spatial(SpatialCommand::Analyse(args))) => spatial_analyse::run(args),
        Some(Command::Spatial(SpatialCommand::Reconstruct(args))) => spatial_reconstruct::run(args),
        Some(Command::Spatial(SpatialCommand::Make(args))) => spatial_make::run(args),
        Some(Command::Evaluate(EvaluateCommand::Codec(args))) => evaluate_codec::run(args),
        Some(Command::Calibrate(args)) => calibrate::run(args),
        Some(Command::Predict(PredictCommand::Attributes(args))) => predict_attributes::run(args),
        Some(Command::Train(TrainCommand::Attributes(args))) => train_attributes::run(args),
        Some(Command::Train(TrainCommand::Photo(args))) => train_photo::run(args),
        Some(Command::Model(ModelCommand::Add(args))) => model_add::run(args),
        Some(Command::Model(ModelCommand::Fetch(args))) => model_fetch::run(args),
        Some(Command::Model(ModelCommand::List(args))) => model_list::run(args),
        Some(Command::Model(ModelCommand::Show(args))) => model_show::run(args),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => output::failure(&error),
    }
}

#[cfg(test)]
mod tests {
    use super::{Cli, with_negative_numbers};
    use clap::CommandFactory as _;

    #[test]
    fn the_arguments_do_not_contradict_each_other() {
        with_negative_numbers(Cli::command()).debug_assert();
    }
}
