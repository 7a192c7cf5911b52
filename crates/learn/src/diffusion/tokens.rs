//! CLIP tokenization (byte-pair encoding) with the `tokenizers` library.

use serde::Deserialize;
use serde_json::{Value, json};
use tokenizers::Tokenizer;

use super::{DiffusionError, Files, Part};

const BEGIN: &str = "<|startoftext|>";
const END: &str = "<|endoftext|>";

/// Regular expression that splits text before merging, as in the published CLIP tokenizer.
const PIECES: &str = r"'s|'t|'re|'ve|'m|'ll|'d|[\p{L}]+|[\p{N}]|[^\s\p{L}\p{N}]+";

/// CLIP tokenizer: text to token ids.
#[derive(Debug)]
pub(super) struct Tokens {
    tokenizer: Tokenizer,
    begin: u32,
    end: u32,
    padding: u32,
    length: usize,
}

#[derive(Debug, Default, Deserialize)]
struct Settings {
    #[serde(default)]
    pad_token: Option<Value>,
}

impl Tokens {
    pub(super) fn read(files: &Files, length: usize, n_words: usize) -> Result<Self, DiffusionError> {
        let vocabulary: serde_json::Map<String, Value> = files.json(Part::Vocabulary)?;
        let damaged = |part: Part, reason: String| DiffusionError::Damaged { part, reason };
        let merges = std::str::from_utf8(files.get(Part::Merges)?)
            .map_err(|error| damaged(Part::Merges, error.to_string()))?;
        let merges: Vec<&str> =
            merges.lines().filter(|line| !line.starts_with("#version") && !line.trim().is_empty()).collect();
        let number = |word: &str| {
            let number = vocabulary.get(word).and_then(Value::as_u64).and_then(|n| u32::try_from(n).ok());
            number
                .filter(|n| (*n as usize) < n_words)
                .ok_or_else(|| damaged(Part::Vocabulary, format!("token \"{word}\" is missing")))
        };
        let (begin, end) = (number(BEGIN)?, number(END)?);
        if let Some((word, _)) =
            vocabulary.iter().find(|(_, n)| n.as_u64().is_none_or(|n| n >= n_words as u64))
        {
            let reason = format!("token \"{word}\" has an id outside the text encoder's vocabulary");
            return Err(damaged(Part::Vocabulary, reason));
        }
        let settings: Settings = match files.get(Part::TokenizerSettings) {
            Ok(_) => files.json(Part::TokenizerSettings)?,
            Err(_) => Settings::default(),
        };
        let padding = match &settings.pad_token {
            Some(Value::String(word)) => number(word)?,
            Some(Value::Object(token)) => {
                number(token.get("content").and_then(Value::as_str).unwrap_or(END))?
            }
            _ => end,
        };
        let description = json!({
            "version": "1.0",
            "truncation": null,
            "padding": null,
            "added_tokens": [],
            "normalizer": {"type": "Sequence", "normalizers": [
                {"type": "NFC"},
                {"type": "Replace", "pattern": {"Regex": r"\s+"}, "content": " "},
                {"type": "Lowercase"},
            ]},
            "pre_tokenizer": {"type": "Sequence", "pretokenizers": [
                {"type": "Split", "pattern": {"Regex": PIECES}, "behavior": "Removed", "invert": true},
                {"type": "ByteLevel", "add_prefix_space": false, "trim_offsets": true, "use_regex": false},
            ]},
            "post_processor": null,
            "decoder": null,
            "model": {
                "type": "BPE", "dropout": null, "unk_token": END, "continuing_subword_prefix": "",
                "end_of_word_suffix": "</w>", "fuse_unk": false, "vocab": vocabulary, "merges": merges,
            },
        });
        let tokenizer = Tokenizer::from_bytes(description.to_string())
            .map_err(|error| damaged(Part::Merges, error.to_string()))?;
        Ok(Self { tokenizer, begin, end, padding, length })
    }

    /// Returns the number of token ids per text.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    /// Returns the token ids of a text, truncated or padded to [`Self::length`].
    pub(super) fn ids(&self, text: &str) -> Result<Vec<u32>, DiffusionError> {
        let encoding = self
            .tokenizer
            .encode(text, false)
            .map_err(|error| DiffusionError::Damaged { part: Part::Vocabulary, reason: error.to_string() })?;
        let mut ids = vec![self.begin];
        ids.extend(encoding.get_ids().iter().take(self.length - 2));
        ids.push(self.end);
        ids.resize(self.length, self.padding);
        Ok(ids)
    }
}
