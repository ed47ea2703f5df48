#!/usr/bin/env bash
# Installs what is missing, builds, and runs all tests. --sanitize: with address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")"
preset=release
case "${1:-}" in
    "") ;;
    --sanitize) preset=debug ;;
    *) echo "error: command line: unknown option $1: use --sanitize or nothing" >&2; exit 2 ;;
esac
step="start"
trap 'echo "test: FAILED while: $step" >&2' ERR

say() { step="$1"; printf '\n== %s\n' "$1"; }

say "installing packages"
.ci/install-packages --tests

say "building ($preset)"
cmake --preset "$preset" -DSTAIRSTEP_TESTS=ON >build.log 2>&1 || { cat build.log >&2; rm -f build.log; false; }
rm -f build.log
cmake --build --preset "$preset"

say "testing ($preset)"
started=$SECONDS
ctest --preset "$preset" --parallel "$(nproc)"
printf '\ntest: all passed in %d s (%s)\n' $((SECONDS - started)) "$preset"
