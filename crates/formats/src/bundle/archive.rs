//! The ZIP archive of a bundle: plain, with the same bytes for the same files, and read with a bound.

use std::io::{Cursor, Read as _, Write as _};

use zip::result::{ZipError, ZipResult};
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, DateTime, System, ZipArchive, ZipWriter};

use crate::parser_words::plain;

/// Length of the record at the end of an archive without a comment, in bytes.
const END_BYTES: usize = 22;
/// Bytes that the files may have for each byte of the archive. Tables of numbers compress to a fifth, silence to a thousandth.
const RATIO: u64 = 200;
/// Bytes that the files may have anyway.
const FREE_BYTES: u64 = 16 << 20;
/// The same for the list of the files.
const LIST_RATIO: u64 = 10;
const FREE_LIST_BYTES: u64 = 4 << 20;

/// The largest list of the files of an archive, in bytes. Most of an entry is a hash, which does not compress.
pub(super) fn list_at_most(archive_bytes: usize) -> u64 {
    LIST_RATIO.saturating_mul(archive_bytes as u64).saturating_add(FREE_LIST_BYTES)
}

/// The largest sum of the lengths of the files of an archive, in bytes.
pub(super) fn at_most(archive_bytes: usize) -> u64 {
    RATIO.saturating_mul(archive_bytes as u64).saturating_add(FREE_BYTES)
}

/// Returns the archive of files with these paths. Nothing in it depends on the clock, the system or the user.
///
/// # Errors
/// Two files have the same path, or the archive is too large.
pub(super) fn pack<'a>(
    files: impl Iterator<Item = (&'a str, &'a [u8])>,
    compresses: bool,
) -> ZipResult<Vec<u8>> {
    let method = if compresses { CompressionMethod::Deflated } else { CompressionMethod::Stored };
    let options = SimpleFileOptions::default()
        .compression_method(method)
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644)
        .system(System::Unix);
    let mut writer = ZipWriter::new(Cursor::new(Vec::new()));
    for (path, bytes) in files {
        writer.start_file(path, options)?;
        writer.write_all(bytes)?;
    }
    Ok(writer.finish()?.into_inner())
}

/// Returns whether an archive ends like those of [`pack`]: with a record without a comment, which the list of the files precedes.
/// The reader looks for further records otherwise, and reserves as much memory as those claim to need.
pub(super) fn has_plain_end(bytes: &[u8]) -> bool {
    let Some(at) = bytes.len().checked_sub(END_BYTES) else { return false };
    let (before, end) = bytes.split_at(at);
    let short = |at: usize| u16::from_le_bytes([end[at], end[at + 1]]);
    let long = |at: usize| u32::from_le_bytes([end[at], end[at + 1], end[at + 2], end[at + 3]]);
    let (n_files, list_bytes, list_at) = (short(10), long(12), long(16));
    let is_one_disk = short(4) == 0 && short(6) == 0 && short(8) == n_files;
    // These values refer to a record of larger archives.
    let is_plain = n_files != u16::MAX && list_bytes != u32::MAX && list_at != u32::MAX;
    let has_list = before.get(list_at as usize..).is_some_and(|list| list.starts_with(b"PK\x01\x02"));
    end.starts_with(b"PK\x05\x06")
        && is_one_disk
        && is_plain
        && n_files > 0
        && has_list
        && short(20) == 0
        && u64::from(list_at) + u64::from(list_bytes) == before.len() as u64
}

/// Returns the content of the file with this index, of at most `most` bytes.
///
/// # Errors
/// What is wrong, as the end of a sentence about the file.
pub(super) fn entry_bytes(
    archive: &mut ZipArchive<Cursor<&[u8]>>,
    index: usize,
    most: u64,
) -> Result<Vec<u8>, String> {
    let damaged = |text: String| format!("is damaged: {text}");
    let entry = archive.by_index(index).map_err(|error| damaged(reason(&error)))?;
    if !entry.is_file() {
        return Err("is a link or a folder".to_owned());
    }
    let n_bytes = entry.size();
    if n_bytes > most {
        return Err(format!("has more than {most} bytes"));
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(n_bytes as usize).map_err(|_| "does not fit the memory".to_owned())?;
    // One byte more than stated shows that it is longer.
    let read = entry.take(n_bytes + 1).read_to_end(&mut bytes);
    read.map_err(|error| damaged(plain(&error.to_string())))?;
    if bytes.len() as u64 != n_bytes {
        return Err(damaged(format!("it has not the {n_bytes} bytes that the archive states")));
    }
    Ok(bytes)
}

/// What the reader of archives says.
pub(super) fn reason(error: &ZipError) -> String {
    plain(&error.to_string())
}
