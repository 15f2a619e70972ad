//! The front page: scenes that run in a browser, with sliders for their parameters. Their kernels are derived as
//! anywhere else, by `#[derive(GaussDynamics)]`, and compiled to WebAssembly; nothing is computed by the scripts
//! around them.
//!
//! `cargo run -p gauss-web [-- FILE]` compiles the kernels and writes the page, one file without network, by default
//! `target/gauss/gauss.html`. It needs `rustup target add wasm32-unknown-unknown`.
//!
//! | module | holds |
//! |---|---|
//! | [`scene`] | what a scene is: sliders, kernel, start, what is seen of it |
//! | [`scenes`] | the scenes, one file each |
//! | [`live`] | a motion that goes on: its parameters may change while it runs |
//! | [`exports`] | the functions that the browser calls |
//! | [`page`], [`build`] | the page, and the kernels in it |
//! | [`site`] | the front page of the site, of which `gauss-site` builds all |
//! | [`links`] | what of the site leads nowhere |

pub mod build;
pub mod exports;
pub mod links;
pub mod live;
pub mod page;
pub mod scene;
pub mod scenes;
pub mod site;
