//! On what the figures were taken.

use std::env::consts::{ARCH, OS};
use std::fs;
use std::process::Command;
use std::thread::available_parallelism;

/// A machine and a compiler.
#[derive(Clone, Debug)]
pub struct Machine {
    /// As the system calls it.
    pub processor: String,
    /// How many the program may use; one is used.
    pub cores: usize,
    /// Of the compiler on the path, which is the one that Cargo calls unless it is told otherwise.
    pub compiler: String,
    /// Architecture and system.
    pub target: String,
    /// For which vector instructions this program was compiled.
    pub instructions: String,
    /// With or without optimisation.
    pub build: &'static str,
    /// Processes that wanted to run in the last minutes, where the system says it.
    pub load: String,
}

impl Machine {
    /// This one.
    #[must_use]
    pub fn here() -> Self {
        let unknown = || "unknown".to_owned();
        let processors = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let model = processors.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
        let version = Command::new("rustc").arg("--version").output().ok();
        let version = version.and_then(|output| String::from_utf8(output.stdout).ok());
        let instructions: Vec<&str> = [
            ("AVX2", cfg!(target_feature = "avx2")),
            ("AVX-512", cfg!(target_feature = "avx512f")),
            ("FMA", cfg!(target_feature = "fma")),
        ]
        .into_iter()
        .filter_map(|(name, on)| on.then_some(name))
        .collect();
        let instructions = if instructions.is_empty() { format!("any {ARCH}") } else { instructions.join(", ") };
        let build = if cfg!(debug_assertions) { "with debug assertions: times mean little" } else { "release" };
        Self {
            processor: model.map_or_else(unknown, |(_, name)| name.to_owned()),
            cores: available_parallelism().map_or(1, Into::into),
            compiler: version.map_or_else(unknown, |text| text.trim().to_owned()),
            target: format!("{ARCH}, {OS}"),
            instructions,
            build,
            load: fs::read_to_string("/proc/loadavg")
                .map_or_else(|_| unknown(), |text| text.split(' ').take(3).collect::<Vec<_>>().join(", ")),
        }
    }
}
