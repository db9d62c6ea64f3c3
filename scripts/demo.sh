#!/bin/bash
# From nothing to two pictures: installs what is missing, builds the program, runs the coupled consolidation and
# the soil-only run beside it, draws both against the reference, then a tsunami over a caisson on a rubble mound on
# sand, and says where the pictures are.
#   scripts/demo.sh [--again]      --again: run even where the results are up to date
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

again=${1:-}
program=build/release/bin/mudlark

up_to_date() {  # CASE FOLDER: done, and newer than the program and the case
  local summary=$2/summary.json
  [[ $again != --again && -f $summary && $summary -nt $program && $summary -nt $1 ]] &&
    grep -q '"status": *"done"' "$summary"
}

run_case() {  # FOLDER/NAME [OPTION ...]
  local case=cases/$1.toml folder=results/${1##*/}
  if up_to_date "$case" "$folder"; then
    echo "$folder is up to date (--again runs it once more)"
  else
    echo "Running $case into $folder"
    "$program" run "$case" -o "$folder" "${@:2}"
  fi
}

scripts/install_packages.sh
scripts/build.sh mudlark
# Each run takes one core: the soil-only one quietly in the background, the coupled one with its progress.
run_case consolidation/mpm --quiet &
soil_only=$!
trap 'kill "$soil_only" 2> /dev/null || true' EXIT
run_case consolidation/coupled
wait "$soil_only"
trap - EXIT
"$program" plot results/coupled
run_case tsunami_breakwater/coarse
"$program" plot results/coarse
echo
# A number beyond its tolerance is said by the comparison and makes this script fail, but there is a picture.
code=0
/usr/bin/python3 cases/consolidation/compare.py results/mpm results/coupled --picture results/coupled/settlement.png || code=$?
echo
echo "The paper's case: $PWD/results/coupled/settlement.png"
echo "Tsunami over a breakwater, water and soil as one: $PWD/results/coarse/plots/state.png"
exit "$code"
