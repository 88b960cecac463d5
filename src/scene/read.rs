//! Bytes of a file to text.

use std::fs::{FileType, Metadata};
use std::path::Path;

use super::{SceneError, SceneProblem};

/// What something is that is no regular file; `None` for one that is.
#[must_use]
pub(crate) fn other_than_file(metadata: &Metadata) -> Option<&'static str> {
    let kind = metadata.file_type();
    if kind.is_file() {
        None
    } else if kind.is_dir() {
        Some("folder")
    } else {
        Some(special(kind))
    }
}

#[cfg(unix)]
fn special(kind: FileType) -> &'static str {
    use std::os::unix::fs::FileTypeExt;
    if kind.is_fifo() {
        "pipe"
    } else if kind.is_socket() {
        "socket"
    } else {
        "device"
    }
}

#[cfg(not(unix))]
fn special(_: FileType) -> &'static str {
    "device"
}

/// Text and name of a scene file.
///
/// # Errors
/// It cannot be read, is no regular file, or is no UTF-8. A missing file is named as it was asked for, folder and all.
pub(super) fn text_of(path: &Path) -> Result<(String, String), SceneError> {
    let file =
        path.file_name().map_or_else(|| "scene".to_owned(), |name| name.to_string_lossy().into_owned());
    let whole = || path.display().to_string();
    // Asked before it is opened: opening a pipe waits for a writer, and a device may have no end.
    let metadata = std::fs::metadata(path)
        .map_err(|error| SceneError::new(&whole(), "", SceneProblem::Unreadable { kind: error.kind() }))?;
    if let Some(kind) = other_than_file(&metadata) {
        return Err(SceneError::new(&whole(), "", SceneProblem::NotAFile { kind }));
    }
    let bytes = std::fs::read(path)
        .map_err(|error| SceneError::new(&whole(), "", SceneProblem::Unreadable { kind: error.kind() }))?;
    match text(bytes) {
        Ok(text) => Ok((text, file)),
        Err(problem) => Err(SceneError::new(&file, "", problem)),
    }
}

/// UTF-8 text; a byte-order mark, which some editors put before it, is taken off.
fn text(bytes: Vec<u8>) -> Result<String, SceneProblem> {
    let encoding = |found, line| SceneProblem::Encoding { found, line };
    match bytes.as_slice() {
        [0xFF, 0xFE, 0, 0, ..] | [0, 0, 0xFE, 0xFF, ..] => return Err(encoding("is UTF-32", 1)),
        // JSON begins with ASCII, so that one byte of the first two is 0.
        [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] | [0, 1..=255, ..] | [1..=255, 0, ..] => {
            return Err(encoding("is UTF-16", 1));
        }
        [0x1F, 0x8B, ..] => return Err(encoding("is compressed by gzip", 1)),
        _ => {}
    }
    let start = if bytes.starts_with(&[0xEF, 0xBB, 0xBF]) { 3 } else { 0 };
    match std::str::from_utf8(&bytes[start..]) {
        Ok(text) => Ok(text.to_owned()),
        Err(error) => {
            let good = &bytes[start..start + error.valid_up_to()];
            let line = 1 + good.iter().filter(|&&byte| byte == b'\n').count();
            Err(encoding("is not UTF-8", line))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_and_encodings() {
        assert_eq!(text(b"\xEF\xBB\xBF{}".to_vec()).as_deref(), Ok("{}"));
        assert_eq!(text(b"{\n}".to_vec()).as_deref(), Ok("{\n}"));
        assert_eq!(text(Vec::new()).as_deref(), Ok(""));
        let found = |bytes: &[u8]| match text(bytes.to_vec()) {
            Err(SceneProblem::Encoding { found, line }) => (found, line),
            other => panic!("{other:?}"),
        };
        assert_eq!(found(b"\xFF\xFE{\0}\0"), ("is UTF-16", 1));
        assert_eq!(found(b"\xFE\xFF\0{\0}"), ("is UTF-16", 1));
        assert_eq!(found(b"{\0\n\0}\0"), ("is UTF-16", 1));
        assert_eq!(found(b"\xFF\xFE\0\0{\0\0\0"), ("is UTF-32", 1));
        assert_eq!(found(b"\x1F\x8B\x08"), ("is compressed by gzip", 1));
        assert_eq!(found(b"{\"title\": \"r\"},\n\"H\xF6he\""), ("is not UTF-8", 2));
    }
}
