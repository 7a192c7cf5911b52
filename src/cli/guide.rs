//! `shagreen guide`: prints the pages of the guide.

use anyhow::Context as _;
use serde_json::json;
use shagreen_studio::guide::{PAGES, page};

use crate::cli::output;

/// Prints a page of the guide as Markdown, or the table of contents.
#[derive(clap::Args)]
pub(crate) struct Args {
    /// Page to print. Default: the table of contents.
    #[arg(value_name = "PAGE", default_value = "index", hide_default_value = true)]
    page: String,
    /// Print the result as one JSON object.
    #[arg(long)]
    json: bool,
}

pub(crate) fn run(args: &Args) -> anyhow::Result<()> {
    let ids: Vec<&str> = PAGES.iter().map(|page| page.id).collect();
    let found = page(&args.page).with_context(|| {
        format!("the guide has no page \"{}\"; choose one of {}", args.page, ids.join(", "))
    })?;
    let result = json!({"page": found.id, "title": found.title(), "text": found.text, "pages": ids});
    output::print(args.json, &result, || found.text.trim_end().to_owned());
    Ok(())
}
