//! Which backend runs what.

use super::fast::Fast;
use super::layout::Layout;
use super::plain::Plain;
use super::run::{Backend, Run, StartError};
use crate::setup::{Precision, Setup};

/// The fast backend, and the plain one for what only that has ([`only_plain`]): the bits are the same. Single
/// precision is only in the fast one; together with what only the plain one has it is refused by name.
#[derive(Clone, Copy, Debug, Default)]
pub struct Best;

impl Backend for Best {
    fn name(&self) -> &'static str {
        "fast"
    }

    fn layout(&self) -> Layout {
        Layout::Blocks
    }

    fn start(&self, setup: &Setup) -> Result<Box<dyn Run>, StartError> {
        match only_plain(setup) {
            None => Fast::default().start(setup),
            Some(feature) if setup.precision != Precision::Double => {
                Err(StartError::Together { precision: setup.precision.name(), feature })
            }
            Some(_) => Plain.start(setup),
        }
    }
}

/// What a setup asks for that only the plain backend has, if anything.
#[must_use]
pub fn only_plain(setup: &Setup) -> Option<&'static str> {
    setup.stress_source.then_some("the experimental source in the third moments")
}
