//! Files that are being imported, and the textures made from them.

mod entries;
mod fitting;

use shagreen_formats::library::{TextureEntry, name_from_file};
use shagreen_formats::recording::Question;

use crate::sheets::import::draft::{Draft, FitState};
use crate::sheets::import::recording_state::RecordingState;
use crate::sheets::import::shown_model::ShownModel;
use crate::sheets::import::worker::{Loaded, LoadedContent, Message, ReadOutcome, Request, Worker};
use crate::state::source::Source;

/// Files of one import.
pub struct Batch {
    files: Vec<File>,
    drafts: Vec<Draft>,
    /// Textures of the previous grouping of recordings; their names and tags are reused.
    set_aside: Vec<Draft>,
    worker: Worker,
    are_one: bool,
    last_id: u64,
    /// Photos that were read, until they are taken.
    photos: Vec<Source>,
    /// Whether nothing but photos was read.
    has_only_photos: bool,
    /// Sample rate of the space in Hz if textures get estimated positions in it.
    space_rate_hz: Option<f64>,
}

/// File of a batch.
pub struct File {
    /// Unique id.
    pub id: u64,
    /// File name without the folder.
    pub name: String,
    /// Detected content.
    pub content: Content,
}

/// Content of a file.
pub enum Content {
    /// Recording.
    Recording(Box<RecordingState>),
    /// Textures that already are models.
    Textures {
        /// Textures in the file.
        entries: Vec<TextureEntry>,
        /// Warnings about the file, in sentences.
        warnings: Vec<String>,
        /// Texture and node that are shown.
        shown: ShownModel,
    },
    /// File that supports the other files, and how.
    Helper(&'static str),
    /// File that cannot be used, and why.
    Failed(String),
}

/// Status of a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum State {
    /// Being read or fitted.
    Working,
    /// Ready to be added to the library.
    Ready,
    /// Waiting for an answer.
    Question,
    /// Ready to be added to the library; missing information was guessed from the numbers.
    Guessed,
    /// Not usable.
    Failed,
    /// Supports other files.
    Helper,
}

impl Batch {
    /// Batch without files.
    pub fn new(ctx: &egui::Context) -> Self {
        Self {
            files: Vec::new(),
            drafts: Vec::new(),
            set_aside: Vec::new(),
            worker: Worker::new(ctx.clone()),
            are_one: false,
            last_id: 0,
            photos: Vec::new(),
            has_only_photos: false,
            space_rate_hz: None,
        }
    }

    /// Reads more files in the background.
    pub fn load(&mut self, sources: Vec<Source>) {
        self.worker.ask(Request::Load(sources));
    }

    /// Files in the order in which they were read.
    pub fn files(&self) -> &[File] {
        &self.files
    }

    /// Mutable file with this id.
    pub fn file_mut(&mut self, id: u64) -> Option<&mut File> {
        self.files.iter_mut().find(|file| file.id == id)
    }

    /// Texture that a file becomes part of.
    pub fn draft_of(&self, file: u64) -> Option<&Draft> {
        self.drafts.iter().find(|draft| draft.files.contains(&file))
    }

    /// Same as [`Batch::draft_of`], but mutable.
    pub fn draft_of_mut(&mut self, file: u64) -> Option<&mut Draft> {
        self.drafts.iter_mut().find(|draft| draft.files.contains(&file))
    }

    /// Whether something is being read or fitted.
    pub fn is_working(&self) -> bool {
        self.worker.n_pending() > 0
    }

    /// Whether the worker has stopped for good.
    pub fn is_broken(&self) -> bool {
        self.worker.is_gone()
    }

    /// Takes over the results of the worker.
    pub fn collect(&mut self) {
        while let Some(message) = self.worker.next() {
            match message {
                Message::Loaded(loaded) => self.take_loaded(loaded),
                Message::Read { file, generation, outcome } => self.take_read(file, generation, outcome),
                Message::Fitted { draft, generation, outcome } => {
                    let draft = self.drafts.iter_mut().find(|d| d.id == draft && d.generation == generation);
                    if let Some(draft) = draft {
                        draft.segment = 0;
                        draft.fit = outcome.map_or_else(FitState::Failed, FitState::Done);
                        let id = draft.id;
                        self.lower_rate(id);
                    }
                }
                Message::Done => {}
            }
        }
    }

    fn next_id(&mut self) -> u64 {
        self.last_id += 1;
        self.last_id
    }

    /// Photos that were read since the last call.
    pub(super) fn take_photos(&mut self) -> Vec<Source> {
        std::mem::take(&mut self.photos)
    }

    /// Whether all files were photos, and all are read.
    pub(super) fn has_only_photos(&self) -> bool {
        self.has_only_photos && !self.is_working()
    }

    /// Lets textures get estimated positions in a space with this sample rate in Hz, or not (`None`). Only a texture at
    /// this rate or below has a position, so an automatic rate goes no higher. Textures with an automatic rate are fitted
    /// again if that changes.
    pub(super) fn place_in(&mut self, space_rate_hz: Option<f64>) {
        if self.space_rate_hz == space_rate_hz {
            return;
        }
        self.space_rate_hz = space_rate_hz;
        for index in 0..self.drafts.len() {
            if self.drafts[index].is_lowered {
                self.fit(index);
            } else {
                self.lower_rate(self.drafts[index].id);
            }
        }
    }

    /// Whether textures get estimated positions.
    pub(super) fn are_placed(&self) -> bool {
        self.space_rate_hz.is_some()
    }

    fn take_loaded(&mut self, loaded: Loaded) {
        let id = self.next_id();
        let Loaded { name, content } = loaded;
        let mut is_recording = false;
        let content = match content {
            LoadedContent::Photo(source) => {
                self.photos.push(source);
                self.has_only_photos = self.files.is_empty();
                return;
            }
            LoadedContent::Failed(reason) => Content::Failed(reason),
            LoadedContent::Helper { note } => Content::Helper(note),
            LoadedContent::Textures { entries, warnings } => {
                Content::Textures { entries, warnings, shown: ShownModel::default() }
            }
            LoadedContent::Recording { input, map, outcome } => {
                is_recording = true;
                Content::Recording(Box::new(RecordingState::new(input, *map, outcome)))
            }
        };
        self.files.push(File { id, name: name.clone(), content });
        self.has_only_photos = false;
        if !is_recording {
            return;
        }
        if let Some(draft) = self.drafts.first_mut().filter(|_| self.are_one) {
            draft.files.push(id);
        } else {
            let draft = self.next_id();
            self.drafts.push(Draft::new(draft, name_from_file(&name), vec![id]));
        }
        self.fit_with(id);
    }

    fn take_read(&mut self, id: u64, generation: u64, outcome: ReadOutcome) {
        let Some(Content::Recording(state)) = self.file_mut(id).map(|file| &mut file.content) else { return };
        if state.generation != generation {
            return;
        }
        if state.take(outcome) {
            self.read(id);
        } else {
            self.fit_with(id);
        }
    }

    /// Reads a recording again with its present answers.
    fn read(&mut self, id: u64) {
        let Some(Content::Recording(state)) = self.file_mut(id).map(|file| &mut file.content) else { return };
        let (input, map) = (state.input.clone(), Box::new(state.map.clone()));
        let request = Request::Read { file: id, generation: state.generation, input, map };
        self.worker.ask(request);
    }

    /// Answers a question about a recording; with `for_all`, also about all others with the same question.
    pub fn answer(&mut self, id: u64, question: &Question, answer: &str, for_all: bool) {
        let mut changed = Vec::new();
        for file in &mut self.files {
            let Content::Recording(state) = &mut file.content else { continue };
            let is_meant = file.id == id || for_all && state.asks(question);
            if is_meant && state.answer(question, answer) {
                changed.push(file.id);
            }
        }
        for id in changed {
            self.read(id);
        }
    }

    /// Number of recordings with this question.
    pub fn n_asking(&self, question: &Question) -> usize {
        let asks = |file: &&File| matches!(&file.content, Content::Recording(state) if state.asks(question));
        self.files.iter().filter(asks).count()
    }

    /// Whether all recordings belong to one texture.
    pub fn are_one(&self) -> bool {
        self.are_one
    }

    /// Number of recordings.
    pub fn n_recordings(&self) -> usize {
        self.files.iter().filter(|file| matches!(file.content, Content::Recording(_))).count()
    }

    /// Makes one texture of all recordings, or one of each. Names and tags typed for the same files are kept.
    pub fn set_are_one(&mut self, are_one: bool) {
        self.are_one = are_one;
        let recordings: Vec<(u64, String)> = self
            .files
            .iter()
            .filter(|file| matches!(file.content, Content::Recording(_)))
            .map(|file| (file.id, name_from_file(&file.name)))
            .collect();
        let old = std::mem::take(&mut self.drafts);
        let like = old.first().map(|draft| draft.options.clone());
        let before = std::mem::replace(&mut self.set_aside, old);
        let groups: Vec<(Vec<u64>, String)> = match recordings.first() {
            Some((_, name)) if are_one => vec![(recordings.iter().map(|r| r.0).collect(), name.clone())],
            _ => recordings.into_iter().map(|(id, name)| (vec![id], name)).collect(),
        };
        for (files, name) in groups {
            let id = self.next_id();
            let mut draft = Draft::new(id, name, files);
            if let Some(before) = before.iter().find(|before| are_one || before.files == draft.files) {
                draft.name.clone_from(&before.name);
                draft.tags.clone_from(&before.tags);
            }
            if let Some(options) = &like {
                draft.options = options.clone();
            }
            self.drafts.push(draft);
        }
        for draft in 0..self.drafts.len() {
            self.fit(draft);
        }
    }

    /// Removes a file from the batch.
    pub fn remove(&mut self, id: u64) {
        self.files.retain(|file| file.id != id);
        let index = self.drafts.iter().position(|draft| draft.files.contains(&id));
        for draft in &mut self.drafts {
            draft.files.retain(|file| *file != id);
        }
        if let Some(index) = index {
            self.fit(index);
        }
        self.drafts.retain(|draft| !draft.files.is_empty());
    }

    /// Status of a file.
    pub fn state(&self, file: &File) -> State {
        match &file.content {
            Content::Failed(_) => State::Failed,
            Content::Helper(_) => State::Helper,
            Content::Textures { .. } => State::Ready,
            Content::Recording(state) if state.is_reading => State::Working,
            Content::Recording(state) if !state.wrong.is_empty() => State::Question,
            Content::Recording(state) => {
                match (&state.outcome.recording, self.draft_of(file.id).map(|d| &d.fit)) {
                    (None, _) => State::Question,
                    (Some(Err(_)), _) | (_, Some(FitState::Failed(_))) => State::Failed,
                    (_, Some(FitState::Done(_))) if state.is_guessed() => State::Guessed,
                    (_, Some(FitState::Done(_))) => State::Ready,
                    _ => State::Working,
                }
            }
        }
    }

    /// Number of textures that are ready to be added to the library.
    pub fn n_ready(&self) -> usize {
        let of_files = self.files.iter().map(|file| match &file.content {
            Content::Textures { entries, .. } => entries.len(),
            _ => 0,
        });
        of_files.sum::<usize>() + self.drafts.iter().filter(|draft| draft.fitted().is_some()).count()
    }

    /// Whether a recording has been fitted.
    pub fn has_recordings(&self) -> bool {
        self.drafts.iter().any(|draft| draft.fitted().is_some())
    }
}
