# The commands one types every day; `.ci/run` runs them all.

# Tests of everything.
test:
    cargo test --workspace

# The example that the README begins with.
example:
    cargo run --release -p gauss-first

# Kernels in the integrators of other crates.
adapters:
    cargo test -p gauss-tests --test runs adapters::
    cargo run --release -p gauss-comparisons --example other_integrators

# Formatting and lints, as CI has them.
lint:
    cargo fmt --all --check
    cargo clippy --workspace --all-targets -- -D warnings

# Review snapshots that changed: read each before accepting it.
snapshots:
    cargo insta review

# Writes the table of operations anew: what each method of each scene costs. Read the difference before it is committed.
operations:
    UPDATE_OPERATIONS=1 cargo test -p gauss-codegen --test operations

# Nanoseconds of every chart and of systems, free and chained: once before a change with `--write old.csv`, once after it
# with `--against old.csv`.
times *options:
    cargo run --release -p gauss-benches --example gate_times -- {{options}}

# Mutations of scenes, chosen by what they reach: needs a nightly compiler and `cargo install cargo-fuzz`.
fuzz:
    mkdir -p tools/fuzz/corpus
    cargo +nightly fuzz run --fuzz-dir tools/fuzz -s none derive tools/fuzz/corpus tools/fuzz/seeds -- -max_len=8192 -timeout=60 -rss_limit_mb=2048

# Changed scenes, expressions and files of robots by the million, each in a process that may die; faults are told as they come.
mutants count="1000000" first="0":
    MUTATIONS={{count}} FIRST={{first}} nice -n 19 cargo test --release --target-dir target/mutants \
        -p gauss-codegen --features urdf,mjcf --test mutations no_input_is_too_much -- --nocapture

# The energy of runs with contacts that are drawn at random, between samples, beyond those of the tests.
throws count="1000" first="80":
    THROWS={{count}} FIRST={{first}} nice -n 19 cargo test --workspace --test laws accounted -- --nocapture

# Features of the published crates, in a clone: `cargo install --locked cargo-hack` once.
features:
    rm -rf target/features && git clone --quiet . target/features
    cd target/features && export RUSTFLAGS="-D warnings" CARGO_TARGET_DIR="$PWD/target" && \
    cargo hack check -p gauss-codegen -p gauss-derive -p gauss-tables --feature-powerset --no-dev-deps && \
    cargo hack check -p gauss-runtime --feature-powerset --depth 2 --no-dev-deps --at-least-one-of std,libm \
        --exclude-features default --group-features urdf,mjcf && \
    cargo hack check -p gauss-adapters --feature-powerset --depth 2 --no-dev-deps --at-least-one-of std,libm \
        --exclude-features default --group-features glam030,glam031,glam032,glam033 \
        --group-features ode_solvers,differential-equations,diffsol

# The guide as pages: `cargo install mdbook mdbook-katex` once.
guide:
    mdbook build guide

# What CI leaves out because of what it depends on: Arrow and Parquet, Bevy, Rerun.
neighbours:
    cargo test -p gauss-tables --features parquet
    cargo test --manifest-path examples/bevy/Cargo.toml --target-dir target/neighbours
    cargo test --manifest-path crates/gauss-rerun/Cargo.toml --target-dir target/neighbours

# Wheels of the Python package for Linux, cross-compiled: `pip install maturin ziglang` and, once,
# `rustup target add aarch64-unknown-linux-gnu`.
wheels:
    for target in x86_64 aarch64; do maturin build --release --locked --zig --target $target-unknown-linux-gnu \
        --manylinux 2014 --manifest-path crates/gauss-py/Cargo.toml --out target/wheels || exit 1; done

# The front page, with kernels that run in it, in `target/gauss`: `rustup target add wasm32-unknown-unknown` once.
page:
    cargo run -p gauss-web

# The site, one static folder (`target/site`): guide, reference, examples with pages that play, scenes that run in it.
# `cargo install mdbook mdbook-katex` and `rustup target add wasm32-unknown-unknown` once.
site:
    cargo run -p gauss-web --bin gauss-site

# How long a derive takes with an unoptimised macro.
expansion:
    cargo run --profile unoptimised --example expansion_time
    cargo run --profile unoptimised --example chains

# Speed against error, to be run on a quiet machine: as it is compiled by default, and for this processor.
speed:
    cargo run --release --example speed_vs_error -- --to target/gauss/plain
    RUSTFLAGS="-C target-cpu=native" cargo run --release --target-dir target/native --example speed_vs_error -- --to target/gauss/native
    cp target/gauss/plain/speed_vs_error.svg target/gauss/plain/speed_vs_error.png docs/

# All that CI does.
ci:
    bash .ci/run
