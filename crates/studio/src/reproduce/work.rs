//! State of a reproduction: the printed items that are still to be computed, and those that are done.

use std::borrow::Cow;
use std::time::Instant;

use anyhow::ensure;
use shagreen_formats::built_in::BuiltIn;
use shagreen_formats::library::{Library, free_id};
use shagreen_formats::printed_results::{Paper, PrintedItem, printed_results};
use shagreen_formats::reproduction_report::ReproducedItem;

use crate::report::Reporter;
use crate::reproduce::ReproduceOptions;

/// A reproduction that is under way.
pub(super) struct Work<'a> {
    pub(super) options: &'a ReproduceOptions<'a>,
    pub(super) reporter: &'a dyn Reporter,
    on_step: &'a mut dyn FnMut(&'static str) -> bool,
    /// Identifiers of all items, in the order of the paper.
    order: Vec<String>,
    /// Items that nobody has computed.
    printed: Vec<PrintedItem>,
    done: Vec<ReproducedItem>,
    /// When the last item was done.
    last: Instant,
}

impl<'a> Work<'a> {
    pub(super) fn new(
        paper: Paper,
        options: &'a ReproduceOptions<'a>,
        on_step: &'a mut dyn FnMut(&'static str) -> bool,
        reporter: &'a dyn Reporter,
    ) -> anyhow::Result<Self> {
        let printed = printed_results(paper)?;
        let order = printed.iter().map(|item| item.id.clone()).collect();
        Ok(Self { options, reporter, on_step, order, printed, done: Vec::new(), last: Instant::now() })
    }

    /// Reports what is computed next.
    pub(super) fn step(&mut self, what: &'static str) -> anyhow::Result<()> {
        ensure!((self.on_step)(what), "the paper was not reproduced: the work was ended");
        Ok(())
    }

    /// The printed item with this identifier, without numbers of ours.
    pub(super) fn item(&mut self, id: &str, source: impl Into<String>) -> ReproducedItem {
        let Some(index) = self.printed.iter().position(|item| item.id == id) else {
            unreachable!("\"{id}\" is no item of the paper, or is computed twice")
        };
        ReproducedItem::new(self.printed.remove(index), source)
    }

    /// Keeps an item with the time since the last one. Figures of the same name get names of their own.
    pub(super) fn done(&mut self, mut item: ReproducedItem) {
        let mut names: Vec<String> = Vec::with_capacity(item.figures.len());
        for (name, _) in &mut item.figures {
            *name = free_id(name, |name| names.iter().any(|taken| taken == name));
            names.push(name.clone());
        }
        let now = Instant::now();
        item.seconds = now.duration_since(self.last).as_secs_f64();
        self.last = now;
        self.done.push(item);
    }

    /// All items, in the order of the paper.
    pub(super) fn finish(mut self) -> anyhow::Result<Vec<ReproducedItem>> {
        let rest: Vec<&str> = self.printed.iter().map(|item| item.id.as_str()).collect();
        ensure!(rest.is_empty(), "these items of the paper were not computed: {}", rest.join(", "));
        let place = |item: &ReproducedItem| self.order.iter().position(|id| *id == item.id);
        self.done.sort_by_key(place);
        Ok(self.done)
    }

    /// Name of a library in quotation marks. The materials of the built-in ones are called simulated.
    pub(super) fn named(&self, library: &Library) -> String {
        let materials = if self.options.library.is_none() { "SIMULATED materials of " } else { "" };
        format!("{materials}\"{}\"", library.name)
    }

    /// The given library or a built-in one, with at most as many textures as the extent allows.
    pub(super) fn library(&self, built_in: BuiltIn) -> anyhow::Result<Cow<'a, Library>> {
        let library = match self.options.library {
            Some(library) => Cow::Borrowed(library),
            None => Cow::Owned(built_in.read()?),
        };
        let (n, n_most) = (library.textures.len(), self.options.extent.n_textures);
        if n <= n_most {
            return Ok(library);
        }
        let mut few = library.into_owned();
        let mut index = 0;
        few.textures.retain(|_| {
            // Texture i is kept if i·most/n is the first one with its whole part.
            let is_kept = index == 0 || index * n_most / n > (index - 1) * n_most / n;
            index += 1;
            is_kept
        });
        Ok(Cow::Owned(few))
    }
}
