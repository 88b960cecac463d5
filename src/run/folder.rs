//! The folder of a run, and the list of the files that lahar wrote into it.
//!
//! A file is on the list before it is there, so that the next run into the folder knows what it may remove, whatever ended
//! this one.

use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use super::checkpoint::FILE as CHECKPOINT;
use super::error::RunError;
use crate::output::{OutputError, atomic};

/// The list.
const LIST: &str = "lahar_files.txt";
/// Its first line.
const HEAD: &str = "# Files that lahar wrote here. The next run into this folder removes them.\n";
/// Folder of the plots.
pub(super) const PLOTS: &str = "plots";

/// A flush waits for everybody's files on that disk: not more often than this.
const BETWEEN_FLUSHES: Duration = Duration::from_secs(1);

/// Files of fixed names, but for the list.
const FIXED: [&str; 11] = [
    CHECKPOINT,
    "scene.json",
    "plan.json",
    "summary.json",
    "series.csv",
    "run.pvd",
    "surface.pvd",
    "grains.pvd",
    "spheres.pvd",
    "contacts.pvd",
    "walls.pvd",
];
/// Beginnings of the names of numbered files.
const NUMBERED: [&str; 9] =
    ["fields_", "surface_", "profile_", "section_", "depth_", "grains_", "spheres_", "contacts_", "walls_"];

/// The folder of a run.
pub(super) struct Folder {
    path: PathBuf,
    list: Mutex<List>,
}

struct List {
    names: BTreeSet<String>,
    /// Locked as long as the run lasts.
    file: File,
    /// When files were flushed to the disk.
    flushed: Instant,
}

impl Folder {
    /// Makes the folder, with one for plots in it, and removes the files of an earlier run.
    ///
    /// # Arguments
    /// `keep`: refuses a folder with an earlier run instead. `mine`: a file that is to stay whatever its name.
    /// # Returns
    /// The folder and how many files were removed.
    /// # Errors
    /// The folder cannot be made; another run writes into it; it holds an earlier run that is to be kept, or files that
    /// look like those of a run and are on no list.
    pub fn claim(path: &Path, keep: bool, mine: Option<&Path>) -> Result<(Self, usize), RunError> {
        let plots = path.join(PLOTS);
        fs::create_dir_all(&plots).map_err(|source| RunError::Folder { path: plots, source })?;
        let failed = |source| RunError::Folder { path: path.join(LIST), source };
        let (mut file, text) = locked_list(path)?;
        let listed = listed(&text);
        let old: Vec<&String> = listed.iter().filter(|name| path.join(name).is_file()).collect();
        if let (true, Some(first)) = (keep, old.first()) {
            return Err(RunError::Kept { path: path.to_path_buf(), first: (*first).clone() });
        }
        if let Some(name) = stranger(path, &listed, mine).map_err(failed)? {
            return Err(RunError::Stranger { path: path.to_path_buf(), name });
        }
        for name in &old {
            let path = path.join(name);
            fs::remove_file(&path).map_err(|source| RunError::Folder { path, source })?;
        }
        remove_temporary(path)?;
        file.set_len(0).and_then(|()| file.write_all(HEAD.as_bytes())).map_err(failed)?;
        let removed = old.len();
        let list = Mutex::new(List { names: BTreeSet::new(), file, flushed: Instant::now() });
        Ok((Self { path: path.to_path_buf(), list }, removed))
    }

    /// The folder of a run that goes on, as it is.
    ///
    /// # Errors
    /// Another run writes into it; its list is not one.
    pub fn reopen(path: &Path) -> Result<Self, RunError> {
        let (file, text) = locked_list(path)?;
        remove_temporary(path)?;
        let list = Mutex::new(List { names: listed(&text), file, flushed: Instant::now() });
        Ok(Self { path: path.to_path_buf(), list })
    }

    /// Ends the list of a run that is over: its files in order, and no checkpoint.
    ///
    /// # Errors
    /// I/O.
    pub(crate) fn close(&self) -> Result<(), OutputError> {
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        if list.names.remove(CHECKPOINT) {
            let path = self.path.join(CHECKPOINT);
            fs::remove_file(&path).or_else(|source| match source.kind() {
                io::ErrorKind::NotFound => Ok(()),
                _ => Err(OutputError::Io { path, doing: "remove", source }),
            })?;
        }
        let names = list.names.iter().fold(HEAD.to_owned(), |text, name| text + name + "\n");
        atomic::write(&self.path.join(LIST), names.as_bytes())
    }

    /// The path of a file that is about to be written, which is put on the list.
    ///
    /// # Errors
    /// The list cannot be written.
    pub(crate) fn file(&self, name: &str) -> Result<PathBuf, OutputError> {
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        if !list.names.contains(name) {
            let failed = |source| OutputError::Io { path: self.path.join(LIST), doing: "write", source };
            list.file.write_all(format!("{name}\n").as_bytes()).map_err(failed)?;
            list.names.insert(name.to_owned());
        }
        Ok(self.path.join(name))
    }

    /// Whether a path is that of the file `name` of the folder, which nobody has written yet.
    pub(crate) fn holds(&self, path: &Path, name: &str) -> bool {
        let found = path.canonicalize();
        found.is_ok_and(|found| self.path.join(name).canonicalize().is_ok_and(|own| own == found))
    }

    /// As [`Self::file`], of a plot.
    ///
    /// # Errors
    /// As [`Self::file`].
    pub(crate) fn plot(&self, name: &str) -> Result<PathBuf, OutputError> {
        self.file(&format!("{PLOTS}/{name}"))
    }

    /// Flushes everything to the disk after an output, unless that was done a moment ago; `last`: in any case.
    ///
    /// # Errors
    /// The disk failed.
    pub(crate) fn sync(&self, last: bool) -> Result<(), OutputError> {
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        if !last && list.flushed.elapsed() < BETWEEN_FLUSHES {
            return Ok(());
        }
        list.flushed = Instant::now();
        let failed = |source| OutputError::Io { path: self.path.clone(), doing: "flush", source };
        atomic::sync(&self.path).map_err(failed)
    }
}

/// The list of a folder, locked, and what is on it.
fn locked_list(path: &Path) -> Result<(File, String), RunError> {
    let failed = |source| RunError::Folder { path: path.join(LIST), source };
    let open = File::options().read(true).append(true).create(true).open(path.join(LIST));
    let file = open.map_err(failed)?;
    // Where files cannot be locked, nobody watches.
    if let Err(TryLockError::WouldBlock) = file.try_lock() {
        return Err(RunError::InUse { path: path.to_path_buf() });
    }
    let text = fs::read_to_string(path.join(LIST)).map_err(failed)?;
    if !text.starts_with(HEAD) && !HEAD.starts_with(&text) {
        return Err(RunError::Stranger { path: path.to_path_buf(), name: LIST.to_owned() });
    }
    Ok((file, text))
}

/// Names on a list. A line that names nothing in the folder or among its plots was written by somebody else.
fn listed(text: &str) -> BTreeSet<String> {
    let inside = |name: &&str| {
        let parts: Vec<Component<'_>> = Path::new(name).components().collect();
        match parts.as_slice() {
            [Component::Normal(_)] => true,
            [Component::Normal(folder), Component::Normal(_)] => *folder == PLOTS,
            _ => false,
        }
    };
    // A last line without its end may be a part of a name.
    let whole = text.split_inclusive('\n').filter_map(|line| line.strip_suffix('\n'));
    whole.filter(|line| !line.starts_with('#')).filter(inside).map(str::to_owned).collect()
}

/// A file that looks like one of a run, is on no list, and is not `mine`.
fn stranger(folder: &Path, listed: &BTreeSet<String>, mine: Option<&Path>) -> io::Result<Option<String>> {
    let mine = mine.and_then(|path| path.canonicalize().ok());
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let entry = entry?;
        let name = entry.file_name().to_string_lossy().into_owned();
        let is_mine = || mine.is_some() && entry.path().canonicalize().ok() == mine;
        if looks_like_output(&name) && !listed.contains(&name) && !is_mine() {
            found.push(name);
        }
    }
    Ok(found.into_iter().min())
}

/// Whether lahar gives such names.
fn looks_like_output(name: &str) -> bool {
    let Some((stem, "vti" | "vtp" | "csv")) = name.rsplit_once('.') else { return FIXED.contains(&name) };
    let number = stem
        .rsplit_once('_')
        .is_some_and(|(_, digits)| digits.len() >= 6 && digits.bytes().all(|digit| digit.is_ascii_digit()));
    FIXED.contains(&name) || (number && NUMBERED.iter().any(|start| stem.starts_with(start)))
}

/// Removes what a killed run had not finished to write, from its folder and that of its plots.
fn remove_temporary(path: &Path) -> Result<(), RunError> {
    for folder in [path.to_path_buf(), path.join(PLOTS)] {
        remove_temporary_of(&folder).map_err(|source| RunError::Folder { path: folder, source })?;
    }
    Ok(())
}

fn remove_temporary_of(folder: &Path) -> io::Result<()> {
    let entries = match fs::read_dir(folder) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(()),
        entries => entries?,
    };
    for entry in entries {
        let entry = entry?;
        if atomic::is_temporary(&entry.file_name().to_string_lossy()) {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_names_files_of_the_folder_only() {
        let text = "# head\nseries.csv\nplots/speed.svg\n../a\n/etc/b\nplots/../../c\nother/d\nplots/x/e\n\nfields_00";
        assert_eq!(Vec::from_iter(listed(text)), ["plots/speed.svg", "series.csv"]);
    }

    /// A run that was killed while it wrote a plot left the plot's temporary file behind for ever.
    #[test]
    fn what_a_killed_run_left_is_removed_when_it_goes_on() {
        let path = std::env::temp_dir().join(format!("lahar-reopened-{}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        drop(Folder::claim(&path, false, None).expect("a folder"));
        let left = [path.join(".lahar-1-2.part"), path.join(PLOTS).join(".lahar-1-3.part")];
        left.iter().for_each(|file| fs::write(file, "half").expect("a file"));
        drop(Folder::reopen(&path).expect("the same folder"));
        assert!(left.iter().all(|file| !file.exists()));
        fs::remove_dir_all(path.join(PLOTS)).expect("no plots");
        drop(Folder::reopen(&path).expect("still a folder"));
        fs::remove_dir_all(&path).expect("cleaned up");
    }

    #[test]
    fn what_looks_like_a_file_of_a_run() {
        for name in ["fields_000107.vti", "section_a-b_000001.csv", "run.pvd", "walls_1000000.vtp"] {
            assert!(looks_like_output(name), "{name}");
        }
        for name in
            ["fields.vti", "notes.csv", "mesh_000001.vtp", "depth_x.csv", "grains_final_a.csv", "a.json"]
        {
            assert!(!looks_like_output(name), "{name}");
        }
    }
}
