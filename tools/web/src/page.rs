//! The page: everything in one file.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde::Serialize;

use crate::scene::{Show, Slider};
use crate::scenes::{ALL, Entry};

/// Options of Cargo for kernels that are small.
pub const SMALL: [&str; 3] =
    ["--release", "--config=profile.release.lto='fat'", "--config=profile.release.panic='abort'"];

const TEMPLATE: &str = include_str!("live.html");
const STYLES: [&str; 2] = [include_str!("../../../crates/gauss-playback/src/page.css"), include_str!("live.css")];
/// Those of `gauss-playback`, and what runs instead of its player.
const SCRIPTS: [&str; 5] = [
    include_str!("../../../crates/gauss-playback/src/solids.js"),
    include_str!("../../../crates/gauss-playback/src/stage.js"),
    include_str!("../../../crates/gauss-playback/src/curves.js"),
    include_str!("../../../crates/gauss-playback/src/camera.js"),
    include_str!("live.js"),
];

#[derive(Serialize)]
struct Data {
    scenes: Vec<Written>,
    /// The module of WebAssembly, in base 64.
    kernels: String,
}

/// A scene as the scripts read it.
#[derive(Serialize)]
struct Written {
    #[serde(flatten)]
    show: Show,
    sliders: &'static [Slider],
    /// The struct that the kernel is derived from.
    code: String,
    equations: &'static str,
    operations: u32,
}

/// The structs of a source file that derive a kernel, the first one of them, as it is written there.
#[must_use]
pub fn derived_struct(source: &str) -> String {
    let lines = source.lines().skip_while(|line| !line.contains("GaussDynamics)]"));
    let mut text = String::new();
    for line in lines {
        text.push_str(line);
        text.push('\n');
        if line == "}" {
            break;
        }
    }
    text
}

fn written(scene: &Entry) -> Written {
    Written {
        show: (scene.show)(),
        sliders: scene.sliders,
        code: derived_struct(scene.source),
        equations: scene.equations,
        operations: scene.operations,
    }
}

/// The page with these kernels, a module of WebAssembly.
#[must_use]
pub fn html(kernels: &[u8]) -> String {
    let data = Data { scenes: ALL.iter().map(written).collect(), kernels: BASE64_STANDARD.encode(kernels) };
    // No `<` in a script, which could end it; JSON has it in strings alone, where it may be escaped.
    let data = serde_json::to_string(&data).expect("numbers and strings").replace('<', "\\u003c");
    // The data last: what they hold is not searched for marks.
    TEMPLATE.replace("{{style}}", &STYLES.concat()).replace("{{scripts}}", &SCRIPTS.concat()).replace("{{data}}", &data)
}
