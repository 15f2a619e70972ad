//! FMUs of a few scenes: their files, runs in programs of C, and what is refused.

mod bad_input;
mod files;
mod runs;
mod scenes;
