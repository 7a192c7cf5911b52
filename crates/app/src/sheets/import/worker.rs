//! Background thread that reads files and fits textures, so that the window stays responsive.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use shagreen_core::recording::Recording;
use shagreen_core::recording::fit::{FitOptions, Fitted, fit};
use shagreen_formats::clip::ClipKind;
use shagreen_formats::imported::Imported;
use shagreen_formats::library::TextureEntry;
use shagreen_formats::picture::photo_pixels;
use shagreen_formats::project::EXTENSION;
use shagreen_formats::recording::directional::StrokeFolder;
use shagreen_formats::recording::{ColumnMap, Question, RecordingFileError, read_recording};
use shagreen_formats::wav::sidecar_names;
use shagreen_studio::import::{MAP_ENDING, format_of_ending, is_importable};

use crate::sheets::import::directional_folder::{FolderTexture, strokes_in, textures};
use crate::sheets::import::trace::Trace;
use crate::sheets::is_photo;
use crate::state::source::{Source, sidecar_of, without_folders};
use crate::strings::import as strings;

/// Request to the worker.
pub(super) enum Request {
    /// Reads these files, each as the type that is detected.
    Load(Vec<Source>),
    /// Reads a recording again, with more information about it.
    Read {
        file: u64,
        generation: u64,
        input: RecordingInput,
        map: Box<ColumnMap>,
    },
    Fit {
        draft: u64,
        generation: u64,
        recordings: Vec<Arc<Drawn>>,
        options: FitOptions,
    },
}

/// Message from the worker.
pub(super) enum Message {
    /// A file was read, with or without success.
    Loaded(Loaded),
    /// A recording was read again.
    Read { file: u64, generation: u64, outcome: ReadOutcome },
    /// A texture was fitted, or the fit failed.
    Fitted { draft: u64, generation: u64, outcome: Result<Arc<Fitted>, String> },
    /// A request is finished.
    Done,
}

pub(super) struct Loaded {
    pub(super) name: String,
    pub(super) content: LoadedContent,
}

/// Detected content of a file.
pub(super) enum LoadedContent {
    /// Recording, with the column map that was used.
    Recording { input: RecordingInput, map: Box<ColumnMap>, outcome: ReadOutcome },
    /// Textures, with warnings about the file.
    Textures { entries: Vec<TextureEntry>, warnings: Vec<String> },
    /// File that supports the other files.
    Helper { note: &'static str },
    /// Photo, which becomes a prompt.
    Photo(Source),
    /// File that cannot be used, and why.
    Failed(String),
}

/// Bytes of a recording and of its sidecar file.
#[derive(Clone)]
pub(super) struct RecordingInput {
    name: String,
    bytes: Arc<[u8]>,
    sidecar: Option<Arc<[u8]>>,
}

impl RecordingInput {
    pub(super) fn new(name: String, bytes: Vec<u8>, sidecar: Option<Arc<[u8]>>) -> Self {
        Self { name, bytes: bytes.into(), sidecar }
    }

    /// Whether the file is a WAV file or a haptic clip, which have no columns.
    pub(super) fn lacks_columns(&self) -> bool {
        self.bytes.starts_with(b"RIFF") || ClipKind::of(&self.name, &self.bytes).is_some()
    }
}

/// Result of reading a recording.
#[derive(Clone, Debug)]
pub struct ReadOutcome {
    /// Information that the file does not contain.
    pub questions: Vec<Question>,
    /// Warnings, in sentences.
    pub warnings: Vec<String>,
    /// Recording, or why there is none; `None` while an open question prevents reading it.
    pub recording: Option<Result<Arc<Drawn>, String>>,
    /// Why the column map does not fit the file, if it does not.
    pub misfit: Option<String>,
}

/// Recording, and its reduction for drawing.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// Complete recording.
    pub recording: Recording,
    /// Recording reduced for drawing.
    pub trace: Trace,
}

/// Connection to the worker thread.
pub(super) struct Worker {
    requests: Sender<Request>,
    messages: Receiver<Message>,
    n_pending: usize,
    is_gone: bool,
}

impl Worker {
    /// Starts the thread, which ends when the connection is dropped. After every request `ctx` is asked to repaint.
    pub(super) fn new(ctx: egui::Context) -> Self {
        let (requests, inbox) = channel();
        let (outbox, messages) = channel();
        std::thread::spawn(move || serve(&inbox, &outbox, &ctx));
        Self { requests, messages, n_pending: 0, is_gone: false }
    }

    pub(super) fn ask(&mut self, request: Request) {
        match self.requests.send(request) {
            Ok(()) => self.n_pending += 1,
            Err(_) => self.is_gone = true,
        }
    }

    /// Next message of the worker.
    pub(super) fn next(&mut self) -> Option<Message> {
        match self.messages.try_recv() {
            Ok(Message::Done) => {
                self.n_pending -= 1;
                self.next()
            }
            Ok(message) => Some(message),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                (self.is_gone, self.n_pending) = (true, 0);
                None
            }
        }
    }

    /// Number of requests that are not finished yet.
    pub(super) fn n_pending(&self) -> usize {
        self.n_pending
    }

    /// Whether the thread has ended by itself.
    pub(super) fn is_gone(&self) -> bool {
        self.is_gone
    }
}

fn serve(inbox: &Receiver<Request>, outbox: &Sender<Message>, ctx: &egui::Context) {
    let mut waiting = VecDeque::new();
    while let Some(request) = next_request(&mut waiting, inbox) {
        let is_stale = waiting.iter().any(|later| request.is_replaced_by(later));
        let mut is_heard = is_stale || request.carry_out(outbox);
        is_heard &= outbox.send(Message::Done).is_ok();
        if !is_heard {
            return;
        }
        ctx.request_repaint();
    }
}

/// Oldest request; waits until there is one. `waiting` then holds all later requests, which may make it stale. `None`
/// once the other side is gone.
fn next_request(waiting: &mut VecDeque<Request>, inbox: &Receiver<Request>) -> Option<Request> {
    waiting.extend(inbox.try_iter());
    if waiting.is_empty() {
        // An error means that the other side is gone and needs no reply.
        waiting.push_back(inbox.recv().ok()?);
        waiting.extend(inbox.try_iter());
    }
    waiting.pop_front()
}

impl Request {
    fn is_replaced_by(&self, later: &Self) -> bool {
        match (self, later) {
            (Self::Read { file: a, .. }, Self::Read { file: b, .. })
            | (Self::Fit { draft: a, .. }, Self::Fit { draft: b, .. }) => a == b,
            _ => false,
        }
    }

    /// Executes the request; false if nobody receives the result any more.
    fn carry_out(&self, outbox: &Sender<Message>) -> bool {
        match self {
            Self::Load(sources) => load(sources.clone(), outbox),
            Self::Read { file, generation, input, map } => {
                let outcome = read(input, map);
                outbox.send(Message::Read { file: *file, generation: *generation, outcome }).is_ok()
            }
            Self::Fit { draft, generation, recordings, options } => {
                let recordings: Vec<Recording> = recordings.iter().map(|d| d.recording.clone()).collect();
                let outcome = fit(&recordings, options).map(Arc::new).map_err(|error| error.to_string());
                outbox.send(Message::Fitted { draft: *draft, generation: *generation, outcome }).is_ok()
            }
        }
    }
}

/// Reads files: photos first, then column maps, since they describe the columns of the other files.
fn load(sources: Vec<Source>, outbox: &Sender<Message>) -> bool {
    let mut files = Vec::new();
    for source in sources {
        let Some(found) = strokes_in(&source) else {
            files.push(source);
            continue;
        };
        files.extend(found.files);
        let is_heard = match found.strokes {
            Ok(strokes) => load_strokes(strokes, outbox),
            Err(reason) => {
                let content = LoadedContent::Failed(reason);
                outbox.send(Message::Loaded(Loaded { name: source.name(), content })).is_ok()
            }
        };
        if !is_heard {
            return false;
        }
    }
    let (photos, files): (Vec<Source>, Vec<Source>) =
        without_folders(files).into_iter().partition(|source| is_photo(source.path()));
    for source in photos {
        let name = source.name();
        let checked = source.bytes().and_then(|bytes| photo_pixels(&bytes).map_err(|e| e.to_string()));
        let content = checked.map_or_else(LoadedContent::Failed, |_| LoadedContent::Photo(source));
        if outbox.send(Message::Loaded(Loaded { name, content })).is_err() {
            return false;
        }
    }
    let (maps, others): (Vec<Source>, Vec<Source>) =
        files.into_iter().partition(|source| source.ending() == MAP_ENDING);
    let mut map = ColumnMap::default();
    for source in maps {
        let content = match source.bytes().and_then(|bytes| read_map(&bytes)) {
            Ok(read) => {
                map = read;
                LoadedContent::Helper { note: strings::IS_MAP }
            }
            Err(reason) => LoadedContent::Failed(reason),
        };
        if outbox.send(Message::Loaded(Loaded { name: source.name(), content })).is_err() {
            return false;
        }
    }
    others.iter().all(|source| {
        let content = if source.path().is_dir() {
            LoadedContent::Failed(strings::NOTHING_IN_FOLDER.to_owned())
        } else {
            source.bytes().map_or_else(LoadedContent::Failed, |bytes| load_one(source, bytes, &others, &map))
        };
        outbox.send(Message::Loaded(Loaded { name: source.name(), content })).is_ok()
    })
}

/// Fits the textures of a folder of strokes in several directions.
fn load_strokes(found: StrokeFolder, outbox: &Sender<Message>) -> bool {
    textures(found).all(|FolderTexture { name, made }| {
        let content = match made {
            Ok((entry, warnings)) => LoadedContent::Textures { entries: vec![entry], warnings },
            Err(reason) => LoadedContent::Failed(reason),
        };
        outbox.send(Message::Loaded(Loaded { name, content })).is_ok()
    })
}

fn load_one(source: &Source, bytes: Vec<u8>, all: &[Source], map: &ColumnMap) -> LoadedContent {
    let ending = source.ending();
    if ending == EXTENSION {
        return LoadedContent::Failed(strings::IS_PROJECT.to_owned());
    }
    if ending == "json" && is_sidecar(source, all) {
        return LoadedContent::Helper { note: strings::IS_SIDECAR };
    }
    let is_clip = ClipKind::of(&source.name(), &bytes).is_some();
    if let Some(format) = format_of_ending(&ending).filter(|_| !is_clip) {
        return match format.read(&source.name(), &bytes) {
            Ok(Imported { value: entries, warnings }) => LoadedContent::Textures { entries, warnings },
            Err(reason) => LoadedContent::Failed(reason),
        };
    }
    let input = RecordingInput::new(source.name(), bytes, sidecar_of(source, all));
    let outcome = read(&input, map);
    match &outcome.recording {
        Some(Err(reason)) if !is_importable(&ending) => LoadedContent::Failed(strings::no_kind(reason)),
        _ => LoadedContent::Recording { input, map: Box::new(map.clone()), outcome },
    }
}

/// Whether a JSON file is the sidecar of a WAV file of the same name that is imported too.
fn is_sidecar(json: &Source, all: &[Source]) -> bool {
    all.iter().any(|other| other.ending() == "wav" && sidecar_names(&other.name()).contains(&json.name()))
}

fn read(input: &RecordingInput, map: &ColumnMap) -> ReadOutcome {
    match read_recording(&input.name, &input.bytes, input.sidecar.as_deref(), map) {
        Ok(file) => {
            let mut warnings = file.warnings;
            let recording = match Recording::from_raw(file.raw) {
                Ok((recording, findings)) => {
                    warnings.extend(findings.iter().map(ToString::to_string));
                    let trace = Trace::new(&recording);
                    Ok(Arc::new(Drawn { recording, trace }))
                }
                Err(error) => {
                    warnings.extend(error.findings.iter().map(ToString::to_string));
                    Err(sentences(error.faults.iter()))
                }
            };
            ReadOutcome { questions: file.questions, warnings, recording: Some(recording), misfit: None }
        }
        Err(RecordingFileError::NeedsAnswers(needs)) => {
            // If the file has other faults, an answer does not help.
            let recording = (!needs.faults.is_empty()).then(|| Err(sentences(needs.faults.iter())));
            ReadOutcome { questions: needs.questions, warnings: needs.warnings, recording, misfit: None }
        }
        Err(error) => ReadOutcome {
            questions: Vec::new(),
            warnings: Vec::new(),
            recording: Some(Err(error.to_string())),
            misfit: if let RecordingFileError::Map { problem } = error { Some(problem) } else { None },
        },
    }
}

fn sentences(parts: impl Iterator<Item = impl ToString>) -> String {
    parts.map(|part| part.to_string()).collect::<Vec<_>>().join("; ")
}

fn read_map(bytes: &[u8]) -> Result<ColumnMap, String> {
    shagreen_formats::map_toml::read_map(bytes).map_err(|error| error.to_string())
}

#[cfg(test)]
mod tests {
    use super::{Request, next_request};
    use std::collections::VecDeque;
    use std::sync::mpsc::channel;

    use crate::sheets::import::draft::Draft;

    fn fit(draft: u64, generation: u64) -> Request {
        let options = Draft::new(draft, String::new(), vec![]).options;
        Request::Fit { draft, generation, recordings: Vec::new(), options }
    }

    /// Requests that arrive while another one is executed count too.
    #[test]
    fn a_later_request_for_the_same_texture_makes_those_that_wait_stale() {
        let (sender, inbox) = channel();
        let mut waiting = VecDeque::new();
        let is_stale = |r: &Request, waiting: &VecDeque<Request>| waiting.iter().any(|l| r.is_replaced_by(l));
        sender.send(fit(1, 1)).unwrap();
        sender.send(fit(2, 1)).unwrap();
        let first = next_request(&mut waiting, &inbox).unwrap();
        assert!(!is_stale(&first, &waiting), "the other is of another texture");
        sender.send(fit(2, 2)).unwrap();
        let second = next_request(&mut waiting, &inbox).unwrap();
        assert!(is_stale(&second, &waiting));
        drop(sender);
        let third = next_request(&mut waiting, &inbox).unwrap();
        assert!(matches!(third, Request::Fit { draft: 2, generation: 2, .. }));
        assert!(next_request(&mut waiting, &inbox).is_none(), "nobody asks any more");
    }
}
