//! Tests of pictures and plots: what is drawn is read back, and lies where its numbers say.

mod discs;
mod picture;
mod plot;
mod read;
