#!/bin/bash
# Configures the release preset and builds it, with as many jobs as cores and memory allow.
#   scripts/build.sh [--warnings-as-errors] [TARGET ...]        (default: everything)
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

warnings_as_errors=OFF
targets=()
for argument in "$@"; do
  case $argument in
    --warnings-as-errors) warnings_as_errors=ON ;;
    -*) echo "build.sh: unknown option $argument (known: --warnings-as-errors)" >&2; exit 1 ;;
    *) targets+=("$argument") ;;
  esac
done

# Templates over both dimensions need about 1.5 GB per compiler at worst.
memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
jobs=$(( memory_kb / 1500000 ))
cores=$(nproc)
(( jobs > cores )) && jobs=$cores
(( jobs < 1 )) && jobs=1

cmake --preset release -DMUDLARK_WARNINGS_AS_ERRORS=$warnings_as_errors
cmake --build --preset release --parallel "$jobs" ${targets[@]:+--target "${targets[@]}"}
