//! User guide, as a sheet over the window.

use egui::{Align, Context, Frame, Label, Margin, RichText, ScrollArea, Ui};
use egui_commonmark::{CommonMarkCache, CommonMarkViewer};
use shagreen_studio::guide::{GuidePage, PAGES};

use crate::command::Command;
use crate::look::sheet_frame::{foot_ui, sheet};
use crate::look::theme::{GAP, RADIUS, SCROLL_BAR_ROOM, tokens};
use crate::strings::help as strings;

/// Width of the list of pages, in points.
const LIST_WIDTH: f32 = 200.0;
/// Width of a page, in points: its lines are easy to read.
const PAGE_WIDTH: f32 = 620.0;
/// Share of the window height that the sheet takes.
const HEIGHT_SHARE: f32 = 0.72;

pub(crate) struct GuideSheet {
    shown: &'static GuidePage,
    cache: CommonMarkCache,
    /// Whether the page was just opened and must be scrolled to its beginning.
    is_fresh: bool,
}

impl GuideSheet {
    /// The guide, open at its table of contents.
    pub(crate) fn new() -> Self {
        let mut cache = CommonMarkCache::default();
        for page in &PAGES {
            cache.add_link_hook(link_to(page));
        }
        Self { shown: &PAGES[0], cache, is_fresh: true }
    }

    /// Draws the sheet; returns the requested commands.
    pub(crate) fn show(&mut self, ctx: &Context) -> Vec<Command> {
        let mut commands = Vec::new();
        let height = HEIGHT_SHARE * ctx.content_rect().height();
        sheet(ctx, "guide", |ui| {
            ui.set_width(LIST_WIDTH + PAGE_WIDTH + SCROLL_BAR_ROOM + 3.0 * GAP);
            ui.add(Label::new(RichText::new(strings::GUIDE).heading().strong()).selectable(false));
            ui.add_space(GAP);
            ui.horizontal_top(|ui| {
                ui.set_height(height);
                self.list_ui(ui);
                ui.separator();
                self.page_ui(ui);
            });
            ui.add_space(GAP);
            if foot_ui(ui, |ui| ui.button(strings::CLOSE).clicked()) {
                commands.push(Command::CloseSheet);
            }
        });
        commands
    }

    fn list_ui(&mut self, ui: &mut Ui) {
        ui.vertical(|ui| {
            ui.set_width(LIST_WIDTH);
            ScrollArea::vertical().id_salt("pages").auto_shrink(false).show(ui, |ui| {
                for page in &PAGES {
                    if ui.selectable_label(self.shown.id == page.id, page.title()).clicked() {
                        self.open(page);
                    }
                }
            });
        });
    }

    fn page_ui(&mut self, ui: &mut Ui) {
        ui.vertical(|ui| {
            ui.set_width(PAGE_WIDTH + SCROLL_BAR_ROOM);
            let mut area = ScrollArea::vertical().id_salt("page").auto_shrink(false);
            if std::mem::take(&mut self.is_fresh) {
                area = area.vertical_scroll_offset(0.0);
            }
            area.show(ui, |ui| {
                ui.set_max_width(PAGE_WIDTH);
                // The Markdown library draws links at the top of their row; so the text beside them is there, too.
                ui.style_mut().override_text_valign = Some(Align::TOP);
                for (index, piece) in pieces(self.shown.text).into_iter().enumerate() {
                    match piece {
                        Piece::Prose(text) => {
                            ui.push_id(index, |ui| {
                                let viewer = CommonMarkViewer::new().default_width(Some(PAGE_WIDTH as usize));
                                viewer.show(ui, &mut self.cache, &with_titles(&with_captions(text)));
                            });
                        }
                        Piece::Code(text) => code_ui(ui, text),
                    }
                }
            });
        });
        let followed = PAGES.iter().find(|page| self.cache.get_link_hook(&link_to(page)) == Some(true));
        if let Some(page) = followed {
            self.open(page);
        }
    }

    fn open(&mut self, page: &'static GuidePage) {
        (self.shown, self.is_fresh) = (page, true);
    }
}

/// Part of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Piece<'a> {
    Prose(&'a str),
    Code(&'a str),
}

/// Page in pieces. The Markdown library draws code with a button whose glyph our fonts lack, so code is drawn here.
fn pieces(text: &str) -> Vec<Piece<'_>> {
    let mut pieces = Vec::new();
    for (index, part) in text.split("\n```").enumerate() {
        // Every second part is code. It begins with the name of its language.
        let is_code = index % 2 == 1;
        let content =
            if is_code || index > 0 { part.split_once('\n').map_or("", |(_, rest)| rest) } else { part };
        if !content.trim().is_empty() {
            pieces.push(if is_code { Piece::Code(content) } else { Piece::Prose(content) });
        }
    }
    pieces
}

/// The text with pictures replaced by their captions in italics: the window has no picture files.
fn with_captions(text: &str) -> String {
    let line = |line: &str| {
        let picture = line.strip_prefix("![").and_then(|rest| rest.split_once("]("));
        picture.map_or_else(|| line.to_owned(), |(caption, _)| format!("*{caption}*"))
    };
    text.lines().map(line).collect::<Vec<_>>().join("\n")
}

/// The text with the titles of pages as texts of links to them, in place of their file names.
fn with_titles(text: &str) -> String {
    PAGES.iter().fold(text.to_owned(), |text, page| {
        let link = link_to(page);
        text.replace(&format!("[{link}]("), &format!("[{}](", page.title()))
    })
}

fn code_ui(ui: &mut Ui, text: &str) {
    let t = tokens(ui.ctx());
    Frame::new().fill(t.control).corner_radius(RADIUS).inner_margin(Margin::same(8)).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ScrollArea::horizontal().id_salt(text).show(ui, |ui| {
            ui.add(Label::new(RichText::new(text).monospace()).extend());
        });
    });
    ui.add_space(GAP);
}

/// Target of a link to a page.
fn link_to(page: &GuidePage) -> String {
    format!("{}.md", page.id)
}

#[cfg(test)]
mod tests {
    use super::{Piece, link_to, pieces, with_captions, with_titles};
    use shagreen_studio::guide::{GuidePage, PAGES};

    #[test]
    fn code_is_cut_out_of_pages() {
        let text = "# Title\n\nSay:\n\n```sh\n./run\n./test\n```\n\nThen more.\n";
        let expected =
            [Piece::Prose("# Title\n\nSay:\n"), Piece::Code("./run\n./test"), Piece::Prose("\nThen more.\n")];
        assert_eq!(pieces(text), expected);
        assert_eq!(pieces("only prose"), [Piece::Prose("only prose")]);
        for page in &PAGES {
            assert_eq!(page.text.matches("\n```").count() % 2, 0, "{} has an open code block", page.id);
        }
    }

    #[test]
    fn links_to_pages_have_their_titles() {
        let page = &PAGES[1];
        let [link, title] = [link_to(page), page.title().to_owned()];
        let text = format!("See [{link}]({link}) and [the start]({link}).");
        assert_eq!(with_titles(&text), format!("See [{title}]({link}) and [the start]({link})."));
        for page in &PAGES {
            let shown = with_titles(page.text);
            let is_file_name = |other: &GuidePage| shown.contains(&format!("[{}](", link_to(other)));
            assert!(!PAGES.iter().any(is_file_name), "{} has a link named after a file", page.id);
        }
    }

    #[test]
    fn pictures_become_their_captions() {
        assert_eq!(with_captions("One.\n\n![Two three](four.png)\n"), "One.\n\n*Two three*");
    }
}
