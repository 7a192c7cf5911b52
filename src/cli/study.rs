//! `shagreen study`: plans, previews, simulates and analyzes studies with people.

mod analyse;
mod new;
mod observers;
mod power;
mod preview;
mod run;
mod templates;
pub(crate) mod textures;

#[derive(clap::Subcommand)]
pub(crate) enum Command {
    New(new::Args),
    Templates(templates::Args),
    Preview(preview::Args),
    Run(run::Args),
    Analyse(analyse::Args),
    Power(power::Args),
}

pub(crate) fn run(command: &Command) -> anyhow::Result<()> {
    match command {
        Command::New(args) => new::run(args),
        Command::Templates(args) => templates::run(args),
        Command::Preview(args) => preview::run(args),
        Command::Run(args) => run::run(args),
        Command::Analyse(args) => analyse::run(args),
        Command::Power(args) => power::run(args),
    }
}
