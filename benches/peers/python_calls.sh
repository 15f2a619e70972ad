#!/usr/bin/env bash
# The tables of python_calls.py: builds examples/python and a package of a Panda for the processor at hand, in an
# environment of its own (target/peers/python), with those of the other libraries that can be installed; then measures on
# one thread.
set -euo pipefail
cd "$(dirname "$0")/../.."
work=$PWD/target/peers/python
[ -x "$work/venv/bin/python" ] || python3 -m venv "$work/venv"
pip=("$work/venv/bin/pip" --quiet --disable-pip-version-check)
"${pip[@]}" install 'maturin>=1.7,<2' numpy
for package in pin casadi heyoka mujoco; do
    "${pip[@]}" install "$package" || echo "$package cannot be installed: left out" >&2
done
export PATH=$work/venv/bin:$PATH VIRTUAL_ENV=$work/venv
export CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$work} RUSTFLAGS="-C target-cpu=native"
# Seven joints: the fingers of the hand are fixed.
rm -rf "$work/panda"
sed 's/type="prismatic"/type="fixed"/' tests/robots/panda.urdf >"$work/panda.urdf"
cargo run --quiet --release -p cargo-gauss -- gauss create --python "$work/panda" --robot "$work/panda.urdf" --gauss "$PWD"
"${pip[@]}" install --no-build-isolation --no-deps --force-reinstall ./examples/python "$work/panda"
RAYON_NUM_THREADS=1 OMP_NUM_THREADS=1 python benches/peers/python_calls.py
