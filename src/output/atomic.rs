//! Files that appear whole or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

use super::OutputError;

/// Temporary files begin and end so.
const TEMPORARY: &str = ".lahar-";
const PART: &str = ".part";

/// Distinguishes temporary files written at the same time by one process.
static COUNTER: AtomicU64 = AtomicU64::new(0);

/// Writes `bytes` to `path`: into a temporary file of the same folder, which is then renamed. A reader sees the old file or
/// the new one, never a part, even when the program is killed. Missing folders are made. Against a failure of the machine
/// `sync` the folder when all files that belong together are there.
///
/// # Errors
/// [`OutputError::Io`] naming the path; the temporary file is removed.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    write_with(path, |file| file.write_all(bytes))
}

/// Writes a file whole or not at all whose content is too large to be held in one piece: `content` sends it bit by bit.
///
/// # Errors
/// As [`write()`].
pub(crate) fn write_with(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_file(path, content, cfg!(not(target_os = "linux")))
}

/// As [`write_with`], and the new file is on the disk before the old one is replaced, even when the machine fails.
///
/// # Errors
/// As [`write()`].
pub(crate) fn write_to_disk(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), OutputError> {
    write_file(path, content, true)
}

fn write_file(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    flushed: bool,
) -> Result<(), OutputError> {
    let io = |doing| {
        let path = path.to_path_buf();
        move |source| OutputError::Io { path, doing, source }
    };
    if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(io("create the folder of"))?;
    }
    let temporary = temporary_name(path);
    let outcome = write_and_rename(&temporary, path, content, flushed);
    if outcome.is_err() {
        // The first error is the one worth reporting; a leftover file is only untidy.
        let _ = fs::remove_file(&temporary);
    }
    outcome.map_err(io("write"))
}

/// Flushes what was written into a folder to the disk, all of it at once; a flush per file takes about 10 ms each.
///
/// # Errors
/// The disk failed.
#[cfg(target_os = "linux")]
pub(crate) fn sync(folder: &Path) -> io::Result<()> {
    Ok(rustix::fs::syncfs(File::open(folder)?)?)
}

/// Nothing is left to be flushed: elsewhere than on Linux every file is flushed by itself.
#[cfg(not(target_os = "linux"))]
pub(crate) fn sync(_: &Path) -> io::Result<()> {
    Ok(())
}

/// A name that does not get longer with that of the file, whose own may be as long as the system allows.
fn temporary_name(path: &Path) -> PathBuf {
    let count = COUNTER.fetch_add(1, Ordering::Relaxed);
    path.with_file_name(format!("{TEMPORARY}{}-{count}{PART}", std::process::id()))
}

/// Whether a name is one of those that a killed program leaves behind.
pub(crate) fn is_temporary(name: &str) -> bool {
    name.starts_with(TEMPORARY) && name.ends_with(PART)
}

fn write_and_rename(
    temporary: &Path,
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    flushed: bool,
) -> io::Result<()> {
    let mut buffered = BufWriter::new(File::create(temporary)?);
    content(&mut buffered)?;
    let file = buffered.into_inner().map_err(io::IntoInnerError::into_error)?;
    if flushed {
        file.sync_all()?;
    }
    drop(file);
    fs::rename(temporary, path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn replaces_whole_file_and_leaves_nothing_else() {
        let folder = std::env::temp_dir().join(format!("lahar-atomic-{}", std::process::id()));
        let path = folder.join("a/b.txt");
        write(&path, b"first, and longer").unwrap();
        write(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(fs::read_dir(path.parent().unwrap()).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }

    #[test]
    fn failure_names_the_path_and_leaves_no_part() {
        let folder = std::env::temp_dir().join(format!("lahar-atomic-bad-{}", std::process::id()));
        let path = folder.join("is_a_folder");
        fs::create_dir_all(path.join("x")).unwrap();
        let error = write(&path, b"data").unwrap_err();
        assert!(error.to_string().contains("is_a_folder"), "{error}");
        // Nor does content that fails half-way.
        let half = |file: &mut dyn Write| {
            file.write_all(&[0; 100_000])?;
            Err(io::Error::other("enough"))
        };
        let error = write_with(&folder.join("half"), half).unwrap_err();
        assert!(error.to_string().contains("enough"), "{error}");
        assert_eq!(fs::read_dir(&folder).unwrap().count(), 1);
        fs::remove_dir_all(&folder).unwrap();
    }
}
