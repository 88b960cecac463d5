//! A problem and where it is.

use std::fmt;

/// A problem and where it is: file (without folder) and JSON path.
#[derive(Clone, Debug, PartialEq)]
pub struct Located<P> {
    /// File name.
    pub file: String,
    /// JSON path such as `fluid.rheology.bingham.yield_stress_pa`; empty for the file as a whole.
    pub path: String,
    /// What is wrong; boxed, so that results stay small.
    pub problem: Box<P>,
}

impl<P> Located<P> {
    /// A problem at a place.
    pub fn new(file: &str, path: impl Into<String>, problem: P) -> Self {
        Self { file: file.to_owned(), path: path.into(), problem: Box::new(problem) }
    }
}

impl<P: fmt::Display> fmt::Display for Located<P> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.path.is_empty() {
            write!(f, "{}: {}", self.file, self.problem)
        } else {
            write!(f, "{}: `{}`: {}", self.file, self.path, self.problem)
        }
    }
}

impl<P: std::error::Error> std::error::Error for Located<P> {}
