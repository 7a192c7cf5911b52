//! Records of finished jobs of a batch, and the file that marks the folder of a batch.
//!
//! A job with a record need not be done again if its inputs are still the same, and its files are still those that were written.

use serde::{Deserialize, Serialize};

use crate::layout;

/// Value of the `format` field of a record.
pub const FORMAT: &str = "shagreen-batch-record";
/// Value of the `format` field of the file that marks the folder of a batch.
pub const FOLDER_FORMAT: &str = "shagreen-batch-folder";
/// Version of both.
pub const VERSION: &str = "1.0";

/// A finished job.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct BatchRecordV1 {
    /// [`FORMAT`].
    pub format: String,
    /// [`VERSION`].
    pub version: String,
    /// SHA-256 of everything that the files depend on, in hexadecimal digits.
    pub inputs: String,
    /// Files that were written.
    pub files: Vec<RecordedFileV1>,
    /// Terms of use of the texture.
    pub licence: String,
    /// Names of textures that must not be redistributed and from which the files were made.
    pub restricted: Vec<String>,
    /// Properties of the texture that the format cannot hold.
    pub lost: Vec<String>,
    /// Sentences for the user.
    pub warnings: Vec<String>,
}

/// A file of a finished job.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct RecordedFileV1 {
    /// Path from the folder of the batch, with slashes.
    pub path: String,
    /// Length in bytes.
    pub bytes: u64,
    /// SHA-256 in hexadecimal digits.
    pub sha256: String,
}

#[derive(Serialize, Deserialize)]
struct FolderV1 {
    format: String,
    version: String,
    name: String,
}

impl BatchRecordV1 {
    /// Returns the bytes of the file.
    pub fn to_bytes(&self) -> Vec<u8> {
        layout::to_bytes(self, 2)
    }

    /// Reads a record; `None` if the bytes are none of this version. The job is then done again.
    pub fn read(bytes: &[u8]) -> Option<Self> {
        let record: Self = serde_json::from_slice(bytes).ok()?; // A damaged record counts as none.
        (record.format == FORMAT && record.version == VERSION).then_some(record)
    }
}

/// Returns the bytes of the file that marks the folder of the batch with this name.
pub fn batch_folder_mark(name: &str) -> Vec<u8> {
    let mark =
        FolderV1 { format: FOLDER_FORMAT.to_owned(), version: VERSION.to_owned(), name: name.to_owned() };
    layout::to_bytes(&mark, 1)
}

/// Returns whether bytes mark the folder of a batch.
pub fn is_batch_folder_mark(bytes: &[u8]) -> bool {
    serde_json::from_slice::<FolderV1>(bytes).is_ok_and(|mark| mark.format == FOLDER_FORMAT)
}

#[cfg(test)]
mod tests {
    use super::{BatchRecordV1, FORMAT, RecordedFileV1, VERSION, batch_folder_mark, is_batch_folder_mark};

    #[test]
    fn a_record_comes_back_and_other_files_are_none() {
        let record = BatchRecordV1 {
            format: FORMAT.to_owned(),
            version: VERSION.to_owned(),
            inputs: "ab".to_owned(),
            files: vec![RecordedFileV1 {
                path: "wav/cork.wav".to_owned(),
                bytes: 3,
                sha256: "cd".to_owned(),
            }],
            licence: "CC0-1.0".to_owned(),
            restricted: Vec::new(),
            lost: vec!["the friction coefficient".to_owned()],
            warnings: Vec::new(),
        };
        let bytes = record.to_bytes();
        assert_eq!(BatchRecordV1::read(&bytes), Some(record.clone()));
        assert_eq!(BatchRecordV1::read(&bytes[..bytes.len() / 2]), None);
        let newer = BatchRecordV1 { version: "2.0".to_owned(), ..record };
        assert_eq!(BatchRecordV1::read(&newer.to_bytes()), None);
        assert!(is_batch_folder_mark(&batch_folder_mark("All")));
        assert!(!is_batch_folder_mark(&bytes) && !is_batch_folder_mark(b"notes"));
    }
}
