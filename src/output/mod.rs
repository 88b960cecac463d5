//! What a run leaves behind: fields for ParaView, time series, pictures, a summary.
//!
//! Every file is written whole or not at all ([`atomic`]), but for the time series of a run, which grows row by row.

use std::path::PathBuf;

pub mod atomic;
pub mod csv;
pub(crate) mod discs;
pub mod isosurface;
pub mod number;
pub(crate) mod picture;
pub mod plot;
pub mod progress;
pub(crate) mod pvd;
pub mod svg;
pub mod table;
pub mod terminal;
#[cfg(test)]
mod tests;
mod ticks;
pub mod vti;
pub mod vtp;

/// Why an output could not be produced.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The operating system refused.
    #[error("cannot {doing} {}: {source}", path.display())]
    Io {
        /// File or folder.
        path: PathBuf,
        /// What was tried: `create`, `write`, `rename`, …
        doing: &'static str,
        /// Its reason.
        source: std::io::Error,
    },
    /// An array or a row does not have the length its container asks for.
    #[error("`{what}` has {found} entries; {expected} are needed")]
    Length {
        /// The array or row.
        what: String,
        /// Entries it has.
        found: usize,
        /// Entries that are needed.
        expected: usize,
    },
    /// A file that should be read back is not what it claims to be.
    #[error("{} line {line}: {problem}", path.display())]
    Malformed {
        /// File.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// What is wrong with it.
        problem: String,
    },
    /// JSON could not be written or read.
    #[error("{}: {source}", path.display())]
    Json {
        /// File.
        path: PathBuf,
        /// Place and reason.
        source: serde_json::Error,
    },
    /// The drawing library refused.
    #[error("figure `{title}`: {detail}")]
    Draw {
        /// Title of the figure.
        title: String,
        /// What the library said.
        detail: String,
    },
}

/// Text made safe for XML content and attribute values.
pub(crate) fn xml_escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // Other control characters are not allowed in XML at all.
            c if c.is_control() && c != '\n' && c != '\t' => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
