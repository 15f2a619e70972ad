//! What a derive adds to `cargo build`:
//! `cargo run --release -p gauss-benches --example compile_time [-- ROUNDS [STRUCTURE…]]`.
//!
//! Programs are written to `target/compile_time`, each with one structure, and built with Cargo's own profiles `dev`
//! and `release`. A program without the derive has the same struct and calls nothing of it; with the derive it makes a
//! kernel and calls `acceleration`, with `linearize` that too, with `taylor` it runs a trajectory by power series
//! instead, which compiles that integrator as well. Dependencies are compiled before anything is timed, and nothing is
//! kept from build to build but them. Quoted is the median over the rounds, in which all programs of a structure take
//! turns, of the difference to the program without the derive in the same round, with the range of the middle half. The
//! trees, which take long, are built where they are asked for by name.

#[path = "../../gauss-codegen/examples/structures/mod.rs"]
mod structures;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use gauss_benches::measure::Spread;

/// A structure: its name, its source with further clauses, a value of it, a configuration and the number of speeds.
struct Structure {
    name: &'static str,
    source: fn(&str) -> String,
    value: &'static str,
    configuration: &'static str,
    speeds: usize,
}

const STRUCTURES: [Structure; 6] = [
    Structure {
        name: "free_body",
        source: structures::free_body,
        value: "FreeBody { mass: 2.0, inertia: Vector3::new(1.0, 2.0, 2.5) }",
        configuration: "Isometry3::<f64>::identity()",
        speeds: 6,
    },
    Structure {
        name: "torpedo",
        source: structures::torpedo,
        value: "Torpedo { mass: 30.0, center: Vector3::new(0.0, 0.0, 0.02), inertia: Vector3::new(0.2, 3.5, 3.5), \
                added: Matrix6::identity(), gravity: Vector3::new(0.0, 0.0, 9.81), displaced: 31.0, drag: Matrix6::identity(), \
                tail: Vector3::new(-0.6, 0.0, 0.0), lift: -9.0 }",
        configuration: "Isometry3::<f64>::identity()",
        speeds: 6,
    },
    Structure {
        name: "top",
        source: structures::top,
        value: "Top { mass: 1.0, center: Vector3::new(0.0, 0.0, 0.5), inertia: Vector3::new(1.0, 1.2, 0.3), g: 9.81 }",
        configuration: "Vector3::new(0.1, 0.5, 0.2)",
        speeds: 3,
    },
    Structure {
        name: "arm",
        source: structures::arm,
        value: "{ let b = RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() }; \
                Arm { b0: b, b1: b, b2: b, b3: b, b4: b, b5: b, b6: b, g: 9.81 } }",
        configuration: "SVector::<f64, 7>::repeat(0.3)",
        speeds: 7,
    },
    Structure {
        name: "walker",
        source: structures::walker,
        value: "{ let b = RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() }; \
                Walker { trunk: b, b0: b, b1: b, b2: b, b3: b, b4: b, b5: b, b6: b, b7: b, b8: b, b9: b, b10: b, b11: b, \
                g: 9.81 } }",
        configuration: "(Isometry3::<f64>::identity(), SVector::<f64, 12>::repeat(0.3))",
        speeds: 18,
    },
    Structure {
        name: "humanoid",
        source: structures::humanoid,
        value: "{ let b = RigidBody { mass: 1.0, center_of_mass: Vector3::zeros(), inertia: Matrix3::identity() }; \
                Humanoid { trunk: b, b0: b, b1: b, b2: b, b3: b, b4: b, b5: b, b6: b, b7: b, b8: b, b9: b, b10: b, b11: b, b12: b, \
                b13: b, b14: b, b15: b, b16: b, b17: b, b18: b, b19: b, b20: b, b21: b, b22: b, b23: b, b24: b, b25: b, b26: b, \
                b27: b, b28: b, b29: b, g: 9.81 } }",
        configuration: "(Isometry3::<f64>::identity(), SVector::<f64, 30>::repeat(0.3))",
        speeds: 36,
    },
];

/// What is built without being asked for.
const SHORT: [&str; 4] = ["free_body", "torpedo", "top", "arm"];

const USES: [(&str, &str); 4] = [
    ("without", ""),
    ("plain", "black_box(kernel.acceleration(0.0, &q, &z, &()));"),
    ("linearize", "black_box(kernel.acceleration(0.0, &q, &z, &())); black_box(kernel.linearize(0.0, &q, &z, &()));"),
    ("taylor", "black_box(Simulation::new(&kernel).taylor(1e-9, 1e-9).run_to_end(q, z, 0.0..1.0)).ok();"),
];

const PROFILES: [&str; 2] = ["dev", "release"];

fn program(structure: &Structure, usage: &str, calls: &str) -> String {
    let clauses = match usage {
        "linearize" => ", linearize",
        "taylor" => ", taylor",
        _ => "",
    };
    let source = (structure.source)(clauses);
    let Structure { value, configuration, speeds, .. } = structure;
    let head = "#![allow(dead_code, unused_imports)]\nuse std::hint::black_box;\nuse gauss_runtime::prelude::*;\n";
    let state = format!("let (q, z) = black_box(({configuration}, SVector::<f64, {speeds}>::repeat(0.1)));");
    if usage == "without" {
        // From `#[gauss(` to its end there is one bracket that closes at the start of the struct.
        let plain = source.split_once(" struct ").map_or("", |(_, rest)| rest);
        let fields = without_attributes(plain);
        return format!("{head}struct {fields}\nfn main() {{ black_box({value}); {state} black_box((q, z)); }}\n");
    }
    format!(
        "{head}#[derive(GaussDynamics)]\n{source}\nfn main() {{ let kernel = {value}.kernel().expect(\"a system\"); {state} {calls} }}\n"
    )
}

/// The fields of a struct without the attributes of roles, which only the derive knows.
fn without_attributes(text: &str) -> String {
    let mut parts = text.split("#[gauss(");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |text, part| text + part.split_once(")] ").map_or("", |(_, rest)| rest))
}

fn write(folder: &Path) -> Result<(), Box<dyn Error>> {
    fs::create_dir_all(folder.join("src/bin"))?;
    let runtime = Path::new(env!("CARGO_MANIFEST_DIR")).join("../gauss-runtime").canonicalize()?;
    let manifest = format!(
        "[package]\nname = \"compile-time\"\nversion = \"0.0.0\"\nedition = \"2024\"\npublish = false\n\n[workspace]\n\n\
         [dependencies]\ngauss-runtime = {{ path = {runtime:?} }}\n"
    );
    fs::write(folder.join("Cargo.toml"), manifest)?;
    // The same versions as here, where they are known.
    let lock = Path::new(env!("CARGO_MANIFEST_DIR")).join("../Cargo.lock");
    if lock.exists() {
        fs::copy(lock, folder.join("Cargo.lock"))?;
    }
    for structure in &STRUCTURES {
        for (usage, calls) in USES {
            let file = folder.join(format!("src/bin/{}_{usage}.rs", structure.name));
            fs::write(file, program(structure, usage, calls))?;
        }
    }
    Ok(())
}

/// Seconds of `cargo build` of one program.
fn build(folder: &Path, program: &str, profile: &str) -> Result<f64, Box<dyn Error>> {
    let file: PathBuf = folder.join(format!("src/bin/{program}.rs"));
    // A later time of change is all that makes Cargo build it again.
    fs::write(&file, fs::read_to_string(&file)?)?;
    let begun = Instant::now();
    let status = Command::new(env!("CARGO"))
        .args(["build", "--quiet", "--bin", program, "--profile", profile, "--target-dir", "target"])
        .current_dir(folder)
        .env("CARGO_INCREMENTAL", "0")
        .env_remove("RUSTFLAGS")
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .env_remove("CARGO_TARGET_DIR")
        .status()?;
    let seconds = begun.elapsed().as_secs_f64();
    if status.success() { Ok(seconds) } else { Err(format!("{program} does not compile").into()) }
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let rounds: usize = arguments.next().map_or(Ok(5), |rounds| rounds.parse())?;
    let wanted: Vec<String> = arguments.collect();
    let is_wanted = |structure: &&Structure| {
        let name = structure.name;
        if wanted.is_empty() { SHORT.contains(&name) } else { wanted.iter().any(|wanted| wanted == name) }
    };
    let chosen: Vec<&Structure> = STRUCTURES.iter().filter(is_wanted).collect();
    let folder = gauss_files::output_folder().with_file_name("compile_time");
    write(&folder)?;
    for profile in PROFILES {
        for structure in &chosen {
            for (usage, _) in USES {
                build(&folder, &format!("{}_{usage}", structure.name), profile)?;
            }
        }
    }
    println!(
        "seconds of `cargo build` without the derive, and what it adds: median of {rounds} rounds (middle half)\n"
    );
    println!("| structure | profile | without | plain | linearize | taylor |\n|---|---|---|---|---|---|");
    for structure in &chosen {
        for profile in PROFILES {
            let mut seconds: [Vec<f64>; USES.len()] = Default::default();
            for _ in 0..rounds {
                for (k, (usage, _)) in USES.into_iter().enumerate() {
                    seconds[k].push(build(&folder, &format!("{}_{usage}", structure.name), profile)?);
                }
            }
            let without = Spread::of(seconds[0].clone()).median;
            let added = (1..USES.len()).map(|k| {
                let differences = seconds[k].iter().zip(&seconds[0]).map(|(with, without)| with - without).collect();
                let Spread { lower, median, upper, .. } = Spread::of(differences);
                format!("{median:+.2} ({lower:.2} – {upper:.2})")
            });
            let added: Vec<String> = added.collect();
            println!("| {} | {profile} | {without:.2} | {} |", structure.name.replace('_', " "), added.join(" | "));
        }
    }
    Ok(())
}
