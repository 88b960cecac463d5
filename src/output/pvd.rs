//! The list of snapshots that ParaView opens as one animation (`.pvd`).

use std::fmt::Write as _;
use std::path::Path;

use super::{OutputError, atomic, xml_escape};
use crate::state::state;

/// Snapshots in the order of time.
#[derive(Clone, Debug, Default)]
pub(crate) struct Collection {
    entries: Vec<(f64, String)>,
}

state!(Collection: entries);

impl Collection {
    /// Adds a snapshot; `file` is relative to the folder of the collection.
    pub fn push(&mut self, time_s: f64, file: &str) {
        self.entries.push((time_s, file.to_owned()));
    }

    /// The file's text.
    #[must_use]
    pub(crate) fn to_xml(&self) -> String {
        let mut out = String::from(
            "<?xml version=\"1.0\"?>\n\
             <VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n<Collection>\n",
        );
        for (time, file) in &self.entries {
            let file = xml_escape(file);
            let _ = writeln!(out, "<DataSet timestep=\"{time}\" part=\"0\" file=\"{file}\"/>");
        }
        out.push_str("</Collection>\n</VTKFile>\n");
        out
    }

    /// Writes the file.
    ///
    /// # Errors
    /// I/O.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        atomic::write(path, self.to_xml().as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_every_snapshot_with_its_time() {
        let mut collection = Collection::default();
        collection.push(0.0, "fields_0.vti");
        collection.push(0.25, "a&b.vti");
        let xml = collection.to_xml();
        assert!(xml.contains(r#"<DataSet timestep="0.25" part="0" file="a&amp;b.vti"/>"#), "{xml}");
        assert_eq!(xml.matches("<DataSet ").count(), 2);
    }
}
