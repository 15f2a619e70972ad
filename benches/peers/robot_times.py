"""How long a robot takes to compile and to evaluate: `python robot_times.py [NAME…]`, NAME a part of a path as in robots.py.

Of each file a source is written by `--example robot -- --write`, put into a crate of its own below target/peers, and
compiled for speed and for the machine at hand. Compilation is processor time of that crate alone, in seconds; evaluations
are the least of many rounds over 64 random states, in nanoseconds, one thread.
"""

import os
import re
import resource
import subprocess
import sys

from robots import GRAVITY, READER, ROOT, Robot, called, files

NAMES = ["ur5_robot", "kuka_iiwa/model.urdf", "xarm7", "go2", "anymal_c", "g1_29dof_rev", "talos_full_v2.urdf"]
FOLDER = ROOT / "target/peers/robots"

MANIFEST = f"""[package]
name = "robot"
edition = "2024"
[dependencies]
gauss-runtime = {{ path = "{ROOT / 'gauss-runtime'}" }}
nalgebra = "0.35"
[profile.release]
codegen-units = 1
[workspace]
"""

MAIN = """mod robot;
use std::hint::black_box;
use std::time::Instant;

use gauss_runtime::prelude::*;

/// Numbers between -1 and 1.
fn random<V: VectorSpace<f64>>(seed: &mut u64) -> V {
    let mut v = V::zero();
    for i in 0..V::DIM {
        *seed = seed.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        v.set_component(i, (*seed >> 11) as f64 / (1_u64 << 52) as f64 - 1.0);
    }
    v
}

/// The least time of a call over many rounds, ns.
fn least(mut call: impl FnMut(usize)) -> f64 {
    let round = |call: &mut dyn FnMut(usize)| {
        let start = Instant::now();
        (0..64).for_each(|k| call(k));
        start.elapsed().as_secs_f64() * 1e9 / 64.0
    };
    (0..3000).map(|_| round(&mut call)).fold(f64::INFINITY, f64::min)
}

fn time<K: GaussSystem<Scalar = f64, Input: VectorSpace<f64>>>(kernel: &K, start: K::Configuration) {
    let mut seed = 7;
    let states: Vec<_> = (0..64)
        .map(|_| {
            let q = start.retract(&random(&mut seed));
            (q, random::<K::Speeds>(&mut seed), random::<K::Speeds>(&mut seed), random::<K::Input>(&mut seed))
        })
        .collect();
    let forward = least(|k| {
        let (q, z, _, input) = black_box(&states[k]);
        black_box(kernel.acceleration(0.0, q, z, input));
    });
    let inverse = least(|k| {
        let (q, z, rates, input) = black_box(&states[k]);
        black_box(kernel.gauss_residual(0.0, q, z, rates, input));
    });
    println!("{forward} {inverse}");
}

fn main() {
    time(&robot::NAME.kernel().unwrap(), robot::NAMEState::default().q());
}
"""


def build():
    """Seconds of processor time."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    environment = os.environ | {"RUSTFLAGS": "-C target-cpu=native"}
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=FOLDER, env=environment, check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def measure(file):
    robot = Robot(file)
    source = FOLDER / "src/robot.rs"
    clauses = [f"gravity={GRAVITY}", "joint_friction=none", "limits=none", "limit=5000000"]
    clauses += [f"base={'floating' if robot.floating else 'fixed'}"]
    subprocess.run([READER, file, *clauses, "--write", source], check=True, stdout=subprocess.DEVNULL)
    name = re.search(r"pub struct (\w+);", source.read_text())[1]
    (FOLDER / "src/main.rs").write_text(MAIN.replace("NAME", name))
    seconds = build()
    run = subprocess.run([FOLDER / "target/release/robot"], check=True, capture_output=True, text=True)
    forward, inverse = map(float, run.stdout.split())
    print(f"| {called(file)} | {len(source.read_text().splitlines()):,} | {seconds:.1f} | {forward:,.0f} | {inverse:,.0f} |", flush=True)


def main():
    (FOLDER / "src").mkdir(parents=True, exist_ok=True)
    (FOLDER / "Cargo.toml").write_text(MANIFEST)
    # What it depends on is compiled first, and not counted.
    (FOLDER / "src/main.rs").write_text("fn main() {}\n")
    build()
    print("| robot | lines of the source | compilation, s | forward, ns | inverse, ns |\n|---|---|---|---|---|")
    for file in files(sys.argv[1:] or NAMES):
        measure(file)


if __name__ == "__main__":
    main()
