#!/usr/bin/env bash
# The table of python_calls.py: builds examples/python for the processor at hand, in an environment of its own
# (target/peers/python), with those of the other libraries that can be installed; then measures on one thread.
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
CARGO_TARGET_DIR=${CARGO_TARGET_DIR:-$work} RUSTFLAGS="-C target-cpu=native" \
    "${pip[@]}" install --no-build-isolation --no-deps --force-reinstall ./examples/python
RAYON_NUM_THREADS=1 OMP_NUM_THREADS=1 python benches/peers/python_calls.py
