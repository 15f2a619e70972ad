//! Pages that play a motion: what they hold, of contacts too, and in a browser where there is one.

mod browser;
mod contact;
mod page;
