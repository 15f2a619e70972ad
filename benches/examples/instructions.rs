//! Counts the machine instructions of every kernel that is timed, and compares them with the table of this folder.
//!
//! `cargo run -p gauss-benches --example instructions [-- [--write] [--cargo OPTIONS]]`; the options are for the build
//! that is counted. Kernels are straight lines, so what the compiler writes is what runs, up to the branch for angles
//! whose sine is left to the library. Needs a compiler and nothing else: no profiler, no library. Counts hold for one
//! compiler and one kind of processor (x86-64-v3), whatever the machine; those of another compiler are shown, not
//! compared.

use std::collections::BTreeMap;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Growth of a count that is an error.
const ALLOWED: f64 = 0.02;

type Counts = BTreeMap<String, usize>;

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let table = folder.join("instructions.csv");
    let (compiler, platform) = compiler()?;
    let counts = counts(&fs::read_to_string(assembly(folder, &platform)?)?);
    if counts.is_empty() {
        return Err("the compiler's output has none of the kernels".into());
    }
    if std::env::args().any(|argument| argument == "--write") {
        let lines = counts.iter().map(|(name, count)| format!("{name},{count}\n"));
        gauss_files::write(&table, format!("{compiler}\n{}", lines.collect::<String>()))?;
        return Ok(());
    }
    let known = fs::read_to_string(&table)?;
    let (counted_by, known) = known.split_once('\n').unwrap_or_default();
    let known: BTreeMap<&str, usize> =
        known.lines().filter_map(|line| line.split_once(',')).filter_map(|(k, n)| Some((k, n.parse().ok()?))).collect();
    let mut grown = Vec::new();
    for (name, &count) in &counts {
        let before = known.get(name.as_str()).copied();
        println!("{name:24} {count:6} instructions, in the table {}", before.map_or("none".into(), |n| n.to_string()));
        if before.is_none_or(|before| count as f64 > before as f64 * (1.0 + ALLOWED)) {
            grown.push(name.as_str());
        }
    }
    if counted_by != compiler {
        println!("The table is that of {counted_by}; this is {compiler}: not compared.");
    } else if !grown.is_empty() {
        let grown = grown.join(", ");
        return Err(
            format!("more instructions than in the table: {grown}; if that is meant, run it with --write").into()
        );
    }
    Ok(())
}

/// The version of the compiler that Cargo uses, and the platform it runs on.
fn compiler() -> Result<(String, String), Box<dyn Error>> {
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let said = String::from_utf8(Command::new(rustc).arg("-vV").output()?.stdout)?;
    let host = said.lines().find_map(|line| line.strip_prefix("host: ")).ok_or("a compiler without a host")?;
    Ok((said.lines().next().unwrap_or_default().to_owned(), host.to_owned()))
}

/// The packages whose code is counted.
const PACKAGES: [&str; 4] = ["gauss-benches", "gauss-runtime", "nalgebra", "simba"];

/// How they are compiled. All others, and the macro, stay as they are for tests.
const PROFILE: [&str; 4] = ["opt-level=3", "codegen-units=1", "debug-assertions=false", "overflow-checks=false"];

/// Has the library compiled to assembly, and finds the file. With a platform that is named, flags are not for macros,
/// so that these are there already.
fn assembly(folder: &Path, platform: &str) -> Result<PathBuf, Box<dyn Error>> {
    let target = folder.join("../target");
    let setting = |package| PROFILE.map(|setting| format!("profile.dev.package.{package}.{setting}"));
    let status = Command::new(env!("CARGO"))
        .args(["rustc", "--quiet", "--lib", "--target-dir"])
        .arg(&target)
        // One kind of processor everywhere.
        .args(["--target", platform, "--config"])
        .arg(format!("target.{platform}.rustflags=[\"-Ctarget-cpu=x86-64-v3\"]"))
        .args(PACKAGES.into_iter().flat_map(setting).flat_map(|setting| ["--config".into(), setting]))
        .args(std::env::args().skip_while(|argument| argument != "--cargo").skip(1))
        .args(["--", "--emit", "asm"])
        .current_dir(folder)
        .status()?;
    if !status.success() {
        return Err("the kernels do not compile".into());
    }
    let files = fs::read_dir(target.join(platform).join("debug/deps"))?
        .filter_map(|entry| entry.ok().map(|entry| entry.path()));
    let ours = |path: &PathBuf| {
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        name.starts_with("gauss_benches-") && name.ends_with(".s")
    };
    let modified = |path: &PathBuf| path.metadata().and_then(|data| data.modified()).ok();
    files.filter(ours).max_by_key(modified).ok_or("the compiler left no assembly".into())
}

/// Instructions of the entries, with those of functions of this crate that they call, once for each call.
fn counts(assembly: &str) -> Counts {
    let mut functions: BTreeMap<&str, (usize, Vec<&str>)> = BTreeMap::new();
    let mut current = "";
    for line in assembly.lines() {
        if !line.starts_with(['\t', ' ', '.', '#']) && line.ends_with(':') {
            current = line.trim_end_matches(':');
            functions.insert(current, (0, Vec::new()));
        } else if let (Some(instruction), Some((count, calls))) = (line.strip_prefix('\t'), functions.get_mut(current))
        {
            if instruction.starts_with(['.', '#']) {
                continue;
            }
            *count += 1;
            let (operation, operand) = instruction.split_once('\t').unwrap_or((instruction, ""));
            if matches!(operation, "call" | "callq" | "jmp") && !operand.starts_with('.') {
                calls.push(operand);
            }
        }
    }
    let total = |name: &str| -> usize {
        let Some((count, calls)) = functions.get(name) else { return 0 };
        let called = calls.iter().filter_map(|call| functions.get(call)).map(|(count, _)| count);
        count + called.sum::<usize>()
    };
    let entry = |symbol: &&str| {
        let name = symbol.split_once("7entries")?.1.trim_start_matches(|c: char| c.is_ascii_digit());
        // What the compiler appends to tell instances apart.
        let name = name.split_once("17h").map_or(name, |(name, _)| name);
        name.starts_with('s').then(|| name.to_owned())
    };
    functions.keys().filter_map(|symbol| Some((entry(symbol)?, total(symbol)))).collect()
}
