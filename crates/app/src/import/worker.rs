//! The thread that reads files and fits textures, so that the window never waits.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, TryRecvError, channel};

use shagreen_core::fit::{FitOptions, Fitted, fit};
use shagreen_core::recording::Recording;
use shagreen_formats::hatt::read_hatt;
use shagreen_formats::library::{TextureEntry, id_from_name, name_from_file, read_library};
use shagreen_formats::recording::{ColumnMap, Question, RecordingFileError, read_recording};
use shagreen_formats::wav::sidecar_names;

use crate::import::source::{Source, without_folders};
use crate::import::trace::Trace;
use crate::strings::import as strings;

/// What the worker is asked for.
pub(super) enum Request {
    /// Read these files, each as what it is.
    Load(Vec<Source>),
    /// Read a recording again, with more known about it.
    Read { file: u64, generation: u64, input: RecordingInput, map: Box<ColumnMap> },
    /// Fit a texture.
    Fit { draft: u64, generation: u64, recordings: Vec<Arc<Drawn>>, options: FitOptions },
}

/// What the worker has done.
pub(super) enum Message {
    /// A file was read, whatever came of it.
    Loaded(Loaded),
    /// A recording was read again.
    Read { file: u64, generation: u64, outcome: ReadOutcome },
    /// A texture was fitted, or could not be.
    Fitted { draft: u64, generation: u64, outcome: Result<Arc<Fitted>, String> },
    /// A request is done with.
    Done,
}

/// A file that was read.
pub(super) struct Loaded {
    pub(super) name: String,
    pub(super) content: LoadedContent,
}

/// What a file turned out to be.
pub(super) enum LoadedContent {
    /// A recording, with what was known of its columns.
    Recording { input: RecordingInput, map: Box<ColumnMap>, outcome: ReadOutcome },
    /// Textures, with what was odd about them.
    Textures { entries: Vec<TextureEntry>, warnings: Vec<String> },
    /// Something that serves the other files.
    Helper { note: &'static str },
    /// Nothing that can be used, and why.
    Failed(String),
}

/// The bytes of a recording and of the file beside it.
#[derive(Clone)]
pub(super) struct RecordingInput {
    name: String,
    bytes: Arc<[u8]>,
    sidecar: Option<Arc<[u8]>>,
}

/// What came of reading a recording.
#[derive(Clone, Debug)]
pub struct ReadOutcome {
    /// What the file does not say.
    pub questions: Vec<Question>,
    /// What is not as it should be, in sentences.
    pub warnings: Vec<String>,
    /// The recording, or why there is none; `None` while a question stands in the way.
    pub recording: Option<Result<Arc<Drawn>, String>>,
}

/// A recording, and how it is drawn.
#[derive(Clone, Debug)]
pub struct Drawn {
    /// The recording.
    pub recording: Recording,
    /// How it is drawn.
    pub trace: Trace,
}

/// The way to the thread and back.
pub(super) struct Worker {
    requests: Sender<Request>,
    messages: Receiver<Message>,
    n_pending: usize,
    is_gone: bool,
}

impl Worker {
    /// Starts the thread, which ends when the worker is dropped; `ctx` is asked to repaint when something is done.
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

    /// The next thing that is done.
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

    /// How many requests are not done yet.
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

/// The oldest request, once there is one; `waiting` then holds all that came after it, which may make it stale. `None`
/// when nobody asks any more.
fn next_request(waiting: &mut VecDeque<Request>, inbox: &Receiver<Request>) -> Option<Request> {
    waiting.extend(inbox.try_iter());
    if waiting.is_empty() {
        // An error is the end of the other side: there is nothing to say to anybody.
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

    /// Does it; false when nobody listens any more.
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

/// Reads files, maps first, since they say what the columns of the others are.
fn load(sources: Vec<Source>, outbox: &Sender<Message>) -> bool {
    let (maps, others): (Vec<Source>, Vec<Source>) =
        without_folders(sources).into_iter().partition(|source| source.ending() == "toml");
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
        let content =
            source.bytes().map_or_else(LoadedContent::Failed, |bytes| load_one(source, bytes, &others, &map));
        outbox.send(Message::Loaded(Loaded { name: source.name(), content })).is_ok()
    })
}

fn load_one(source: &Source, bytes: Vec<u8>, all: &[Source], map: &ColumnMap) -> LoadedContent {
    match source.ending().as_str() {
        "json" if is_sidecar(source, all) => LoadedContent::Helper { note: strings::IS_SIDECAR },
        "json" => match read_library(&bytes) {
            Ok(library) => {
                let mut entries = library.value.textures.clone();
                for entry in &mut entries {
                    // Terms and origin of the library are those of a texture that has none of its own.
                    entry.license = library.value.license_of(entry).to_owned();
                    if entry.origin.is_empty() {
                        entry.origin.clone_from(&library.value.origin);
                    }
                }
                LoadedContent::Textures { entries, warnings: library.warnings }
            }
            Err(error) => LoadedContent::Failed(error.to_string()),
        },
        "xml" => match read_hatt(&bytes) {
            Ok(texture) => {
                let mut entry = texture.value.into_entry(String::new());
                if entry.name.is_empty() {
                    entry.name = name_from_file(&source.name());
                }
                entry.id = id_from_name(&entry.name);
                LoadedContent::Textures { entries: vec![entry], warnings: texture.warnings }
            }
            Err(error) => LoadedContent::Failed(error.to_string()),
        },
        _ => {
            let sidecar = sidecar_of(source, all);
            let input = RecordingInput { name: source.name(), bytes: bytes.into(), sidecar };
            let outcome = read(&input, map);
            LoadedContent::Recording { input, map: Box::new(map.clone()), outcome }
        }
    }
}

/// Whether a JSON file lies beside a WAV file of the same name that is imported too.
fn is_sidecar(json: &Source, all: &[Source]) -> bool {
    all.iter().any(|other| other.ending() == "wav" && sidecar_names(&other.name()).contains(&json.name()))
}

/// The units beside a WAV file: imported with it, or in the same folder.
pub(crate) fn sidecar_of(source: &Source, all: &[Source]) -> Option<Arc<[u8]>> {
    if source.ending() != "wav" {
        return None;
    }
    let names = sidecar_names(&source.name());
    if let Some(beside) = all.iter().find(|other| names.contains(&other.name())) {
        // One that cannot be read is listed as failed itself.
        return beside.bytes().ok().map(Into::into);
    }
    // Most WAV files have none: then the reader asks.
    names.iter().find_map(|name| std::fs::read(source.path().with_file_name(name)).ok()).map(Into::into)
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
            ReadOutcome { questions: file.questions, warnings, recording: Some(recording) }
        }
        Err(RecordingFileError::NeedsAnswers(needs)) => {
            // Where something else is wrong, no answer helps.
            let recording = (!needs.faults.is_empty()).then(|| Err(sentences(needs.faults.iter())));
            ReadOutcome { questions: needs.questions, warnings: needs.warnings, recording }
        }
        Err(error) => ReadOutcome {
            questions: Vec::new(),
            warnings: Vec::new(),
            recording: Some(Err(error.to_string())),
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

    use crate::import::draft::Draft;

    fn fit(draft: u64, generation: u64) -> Request {
        let options = Draft::new(draft, String::new(), vec![]).options;
        Request::Fit { draft, generation, recordings: Vec::new(), options }
    }

    /// What came while another request was carried out counts too.
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
