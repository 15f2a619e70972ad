#!/usr/bin/env bash
# Makes what other generators and simulators compute for the scenes, for `cargo bench -p gauss-benches --features peers`:
#   casadi_by_hand, symforce_by_hand     from accelerations that a person derived and arranged (equations.py, the same as our code by hand)
#   casadi_energies                      from energies and momentum balances that CasADi differentiates (energies.py)
#   sympy_kane, sympy_lagrange           derived by SymPy from bodies and loads, shared by cse
#   pinocchio_casadi                     Pinocchio's articulated-body algorithm over CasADi's symbols
#   pinocchio, mujoco, mujoco_minimal    simulators
# Python packages in target/peers/venv, generated C in target/peers/c, shared libraries in target/peers/lib.
#
# Needs python3 (3.11 or so) with venv, g++ and, better, clang as well; installs nothing outside of target/. `--arm`: SymPy's seven-joint arm too, which
# takes minutes. A peer that cannot be made on this machine is left out, and named.
set -euo pipefail
cd "$(dirname "$0")"
target=$(cd ../.. && pwd)/target/peers
mkdir -p "$target/c" "$target/lib"

command -v python3 >/dev/null || { echo "python3 is needed" >&2; exit 1; }
compilers=()
for name in gcc clang clang-{20..14}; do
    # One of each kind.
    case " ${compilers[*]-} " in *" ${name%%-*}"*) continue ;; esac
    if command -v "$name" >/dev/null; then compilers+=("$name"); fi
done
[ ${#compilers[@]} -gt 0 ] || { echo "a C compiler is needed: gcc, clang or both" >&2; exit 1; }
[ ${#compilers[@]} -gt 1 ] || echo "only ${compilers[*]} here; with gcc and clang the faster code of each peer is quoted" >&2

[ -x "$target/venv/bin/python" ] || python3 -m venv "$target/venv"
python="$target/venv/bin/python"
"$python" -m pip install --quiet --requirement requirements.txt
site=$("$python" -c 'import sysconfig; print(sysconfig.get_paths()["purelib"])')

# What users who care pass: contraction, no errno, the processor at hand; the order of sums is kept.
flags=(-O3 -march=native -fno-math-errno -ffp-contract=fast -DNDEBUG -shared -fPIC -I"$target/c")
missing=()
rm -f "$target"/lib/*.so

# attempt NAME COMMAND…: goes on without the peer if the command fails.
attempt() {
    local name=$1
    shift
    if ! "$@" >"$target/$name.log" 2>&1; then missing+=("$name (see target/peers/$name.log)"); return 1; fi
}

# generated PEER: compiles target/peers/c/PEER.c by every compiler.
generated() {
    for compiler in "${compilers[@]}"; do
        attempt "$1" "$compiler" "${flags[@]}" "$target/c/$1.c" -o "$target/lib/$1.${compiler%%-*}.so" -lm || true
    done
}

echo "generating"
attempt casadi "$python" with_casadi.py "$target/c" && generated casadi_by_hand && generated casadi_energies
attempt symforce "$python" with_symforce.py "$target/c" && generated symforce_by_hand
attempt sympy "$python" with_sympy.py "$target/c" "$@" && generated sympy_kane && generated sympy_lagrange
"$python" rigid_bodies.py "$target/c"

echo "compiling simulators"
for compiler in "${compilers[@]}"; do
    for variant in "mujoco" "mujoco_minimal -DMINIMAL"; do
        read -r name define <<<"$variant"
        attempt "$name" "$compiler" "${flags[@]}" ${define:-} -I"$site/mujoco/include" mujoco_peer.c -o "$target/lib/$name.${compiler%%-*}.so" \
            "$site"/mujoco/libmujoco.so.* -Wl,-rpath,"$site/mujoco" || true
    done
done
# Boost's lists must hold all kinds of joints, its calls all arguments of inverse dynamics.
headers=(-std=c++17 -DBOOST_MPL_LIMIT_LIST_SIZE=30 -DBOOST_FUSION_INVOKE_MAX_ARITY=10 -DBOOST_MPL_CFG_NO_PREPROCESSED_HEADERS
    -isystem "$site/cmeel.prefix/include" -isystem "$site/cmeel.prefix/include/eigen3")
for compiler in "${compilers[@]}"; do
    cxx=${compiler/gcc/g++}
    cxx=${cxx/clang/clang++}
    attempt pinocchio "$cxx" "${flags[@]}" "${headers[@]}" pinocchio_peer.cpp -o "$target/lib/pinocchio.${compiler%%-*}.so" || true
done
cxx=${compilers[0]/gcc/g++}
cxx=${cxx/clang/clang++}
attempt pinocchio_casadi "$cxx" -O1 -DNDEBUG -I"$target/c" "${headers[@]}" -isystem "$site/casadi/include" pinocchio_casadi.cpp \
    -o "$target/pinocchio_casadi" -L"$site/casadi" -lcasadi -Wl,-rpath,"$site/casadi" &&
    attempt pinocchio_casadi "$target/pinocchio_casadi" "$target/c" &&
    attempt pinocchio_casadi "$python" with_casadi.py "$target/c" --saved && generated pinocchio_casadi

echo "made: $(cd "$target/lib" && ls | tr '\n' ' ')"
for name in "${missing[@]-}"; do [ -z "$name" ] || echo "left out: $name" >&2; done
