//! One analytic solution per file.
