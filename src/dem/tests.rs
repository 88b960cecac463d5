//! Tests of whole runs. Prefixes say where truth comes from.

mod books;
mod collisions;
mod hard;
mod help;
mod parity;
mod rotation;
mod sliding;
mod stability;
