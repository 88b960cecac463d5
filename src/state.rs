//! States as bytes, for checkpoints. One function per type both writes and reads, so that the two cannot differ; and
//! [`state!`](crate::state) names every field of a struct, kept or not, so that a new field does not compile until somebody has
//! decided.
//!
//! Numbers are little-endian with all their bits. What follows from the set-up is not kept: a run is started anew, and its state
//! put in place.

use std::collections::{BTreeMap, VecDeque};
use std::io::{self, Read, Write};

/// Why a state could not be written or read.
#[derive(Debug, thiserror::Error)]
pub enum StateError {
    /// The operating system refused.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// The bytes are not those of such a state.
    #[error("{0}")]
    Malformed(&'static str),
    /// The solver does not keep its state.
    #[error("this solver cannot be continued")]
    Unsupported,
}

/// Where a state goes to or comes from.
pub struct Tape<'a> {
    way: Way<'a>,
    /// Bytes that are left to be read; a list of more entries is refused before there is room made for it.
    left: u64,
}

enum Way<'a> {
    Write(&'a mut dyn Write),
    Read(&'a mut dyn Read),
}

impl<'a> Tape<'a> {
    /// To be written.
    pub fn to(out: &'a mut dyn Write) -> Self {
        Self { way: Way::Write(out), left: 0 }
    }

    /// To be read; `length`: bytes that there are.
    pub fn from(input: &'a mut dyn Read, length: u64) -> Self {
        Self { way: Way::Read(input), left: length }
    }

    /// Whether states are read.
    #[must_use]
    pub fn reads(&self) -> bool {
        matches!(self.way, Way::Read(_))
    }

    /// Bytes as they are.
    ///
    /// # Errors
    /// I/O, or too few bytes.
    pub fn bytes(&mut self, bytes: &mut [u8]) -> Result<(), StateError> {
        match &mut self.way {
            Way::Write(out) => out.write_all(bytes)?,
            Way::Read(input) => {
                let left = self.left.checked_sub(bytes.len() as u64);
                self.left = left.ok_or(StateError::Malformed("it ends too early"))?;
                input.read_exact(bytes)?;
            }
        }
        Ok(())
    }

    /// Length of a list of entries of at least a byte each.
    ///
    /// # Errors
    /// As [`Self::bytes`].
    pub fn length(&mut self, length: usize) -> Result<usize, StateError> {
        let mut found = length as u64;
        found.state(self)?;
        if self.reads() && found > self.left {
            return Err(StateError::Malformed("it ends too early"));
        }
        Ok(found as usize)
    }

    /// Nothing is left to be read.
    ///
    /// # Errors
    /// Something is.
    pub fn ends(&self) -> Result<(), StateError> {
        if self.left == 0 { Ok(()) } else { Err(StateError::Malformed("it is longer than it should be")) }
    }

    /// A number that follows from the set-up, and must be the same.
    ///
    /// # Errors
    /// It is not; as [`Self::bytes`].
    pub fn same(&mut self, number: usize) -> Result<(), StateError> {
        let mut found = number as u64;
        found.state(self)?;
        if found == number as u64 { Ok(()) } else { Err(StateError::Malformed("it is of another set-up")) }
    }
}

/// Something whose state can be written and read.
pub trait State {
    /// Writes it to the tape, or reads it from there.
    ///
    /// # Errors
    /// I/O; bytes that are not those of such a state.
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError>;
}

/// Implements [`State`](crate::state::State) for a struct: the fields that are kept, in the order of the file, and after `but`
/// those that are not.
macro_rules! state {
    ($type:ident $(<$($of:ident),*>)?: $($kept:ident)* $(; but $($other:ident)*)?) => {
        impl $(<$($of),*>)? crate::state::State for $type $(<$($of),*>)? {
            fn state(&mut self, tape: &mut crate::state::Tape<'_>) -> Result<(), crate::state::StateError> {
                let Self { $($kept,)* $($($other: _,)*)? } = self;
                $($kept.state(tape)?;)*
                Ok(())
            }
        }
    };
}
pub(crate) use state;

macro_rules! numbers {
    ($($type:ty)*) => {$(
        impl State for $type {
            #[inline]
            fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
                let mut bytes = self.to_le_bytes();
                tape.bytes(&mut bytes)?;
                *self = Self::from_le_bytes(bytes);
                Ok(())
            }
        }
    )*};
}
numbers!(u8 u16 u32 u64 i64 i128 f32 f64);

impl State for usize {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut wide = *self as u64;
        wide.state(tape)?;
        *self = Self::try_from(wide).map_err(|_| StateError::Malformed("a number is too large"))?;
        Ok(())
    }
}

impl State for bool {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut byte = u8::from(*self);
        byte.state(tape)?;
        *self = byte != 0;
        Ok(())
    }
}

impl State for String {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut bytes = std::mem::take(self).into_bytes();
        let length = tape.length(bytes.len())?;
        bytes.resize(length, 0);
        tape.bytes(&mut bytes)?;
        *self = Self::from_utf8(bytes).map_err(|_| StateError::Malformed("a text is not one"))?;
        Ok(())
    }
}

impl<T: State, const N: usize> State for [T; N] {
    #[inline]
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.iter_mut().try_for_each(|entry| entry.state(tape))
    }
}

impl<A: State, B: State> State for (A, B) {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.0.state(tape)?;
        self.1.state(tape)
    }
}

impl<A: State, B: State, C: State> State for (A, B, C) {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.0.state(tape)?;
        self.1.state(tape)?;
        self.2.state(tape)
    }
}

impl<T: State + Default> State for Vec<T> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let length = tape.length(self.len())?;
        if tape.reads() {
            self.clear();
            self.resize_with(length, T::default);
        }
        self.iter_mut().try_for_each(|entry| entry.state(tape))
    }
}

impl<T: State + Default> State for VecDeque<T> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let length = tape.length(self.len())?;
        if tape.reads() {
            self.clear();
            self.resize_with(length, T::default);
        }
        self.iter_mut().try_for_each(|entry| entry.state(tape))
    }
}

impl<T: State + Default> State for Option<T> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut there = self.is_some();
        there.state(tape)?;
        if !there {
            *self = None;
            return Ok(());
        }
        self.get_or_insert_with(T::default).state(tape)
    }
}

impl<K: State + Default + Ord + Clone, V: State + Default> State for BTreeMap<K, V> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut entries: Vec<(K, V)> = std::mem::take(self).into_iter().collect();
        entries.state(tape)?;
        *self = entries.into_iter().collect();
        Ok(())
    }
}

impl State for nalgebra::Vector3<f64> {
    #[inline]
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        self.iter_mut().try_for_each(|x| x.state(tape))
    }
}

impl State for nalgebra::UnitQuaternion<f64> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        let mut coordinates: [f64; 4] = self.coords.into();
        coordinates.state(tape)?;
        let [i, j, k, w] = coordinates;
        // The bits are those of a unit quaternion already; normalising again could change them.
        *self = Self::new_unchecked(nalgebra::Quaternion::new(w, i, j, k));
        Ok(())
    }
}

/// A part that is there or not by the set-up.
///
/// # Errors
/// Those of the part.
pub(crate) fn part<T: State>(part: &mut Option<T>, tape: &mut Tape<'_>) -> Result<(), StateError> {
    part.as_mut().map_or(Ok(()), |part| part.state(tape))
}

/// Lists whose length follows from the set-up.
///
/// # Errors
/// The length is another one; those of the entries.
pub(crate) fn fixed<T: State>(list: &mut [T], tape: &mut Tape<'_>) -> Result<(), StateError> {
    tape.same(list.len())?;
    list.iter_mut().try_for_each(|entry| entry.state(tape))
}

impl<T: State + ?Sized> State for Box<T> {
    fn state(&mut self, tape: &mut Tape<'_>) -> Result<(), StateError> {
        (**self).state(tape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Clone, Debug, Default, PartialEq)]
    struct Sample {
        numbers: Vec<f64>,
        map: BTreeMap<u32, f64>,
        maybe: Option<(u8, bool)>,
        text: String,
        left_out: u32,
    }
    state!(Sample: numbers map maybe text; but left_out);

    fn sample() -> Sample {
        Sample {
            numbers: vec![-0.0, f64::INFINITY, 5e-324, f64::from_bits(0x7ff8_dead_beef_0001)],
            map: BTreeMap::from([(7, 0.5), (9, -1.0)]),
            maybe: Some((3, true)),
            text: "yield".to_owned(),
            left_out: 1,
        }
    }

    fn written() -> Vec<u8> {
        let mut bytes = Vec::new();
        sample().state(&mut Tape::to(&mut bytes)).unwrap();
        bytes
    }

    #[test]
    fn exact_bits_come_back_and_what_is_left_out_stays() {
        let bytes = written();
        let mut back = Sample { left_out: 5, numbers: vec![1.0], ..Sample::default() };
        back.state(&mut Tape::from(&mut bytes.as_slice(), bytes.len() as u64)).unwrap();
        let bits = |sample: &Sample| sample.numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&back), bits(&sample()));
        back.numbers = Vec::new();
        assert_eq!(back, Sample { numbers: Vec::new(), left_out: 5, ..sample() });
    }

    #[test]
    fn short_or_absurd_bytes_are_refused() {
        let bytes = written();
        for length in 0..bytes.len() {
            let part = &bytes[..length];
            assert!(
                Sample::default().state(&mut Tape::from(&mut &*part, length as u64)).is_err(),
                "{length}"
            );
        }
        // A list of 2⁶⁴ − 1 entries.
        let absurd = [0xff; 40];
        assert!(Sample::default().state(&mut Tape::from(&mut absurd.as_slice(), 40)).is_err());
    }
}
