#!/bin/bash
# Runs every case that has a comparison, and writes figures and findings to docs/validation/.
#   scripts/validate.sh [CASE ...]      CASE: a folder of cases/ (default: all with a compare.py)
# A comparison that misses its tolerance is written down as a miss and makes this script fail at the end.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
scripts/build.sh mudlark
program=build/release/bin/mudlark
mkdir -p docs/validation

names=("$@")
[[ $# -eq 0 ]] && for compare in cases/*/compare.py; do names+=("$(basename "$(dirname "$compare")")"); done

misses=()
for name in "${names[@]}"; do
  results=results/validation/$name
  finding=docs/validation/$name.md
  runs=()
  if grep -q '"--run"' "cases/$name/compare.py"; then
    runs=(--run "$program")  # it knows which variants of its case to run
  else
    for case in cases/"$name"/*.toml; do
      echo "Running $case"
      "$program" run "$case" -o "$results/$(basename "$case" .toml)"
    done
  fi
  code=0
  numbers=$(/usr/bin/python3 "cases/$name/compare.py" "${runs[@]}" --results "$results" \
    --picture "docs/validation/$name.png") || code=$?
  verdict="within its tolerances"
  if [[ $code -ne 0 ]]; then verdict="**MISSES its tolerances**"; misses+=("$name"); fi
  {
    echo "# Validation: $name"
    echo
    echo "$("$program" --version | head -n 1): $verdict. The case and its sources: [cases/$name](../../cases/$name/README.md)."
    echo
    [[ -f docs/validation/$name.png ]] && echo "![$name]($name.png)" && echo
    echo '```text'
    echo "$numbers"
    echo '```'
  } > "$finding"
  echo "$numbers"
done

table=$(cat docs/validation/README.md 2> /dev/null || true)
{
  echo "# Validation"
  echo
  echo "Comparisons with theory and experiments, written by \`scripts/validate.sh\`. A miss stands here as a miss. What follows a semicolon was added by hand; the script keeps it."
  echo
  echo "| Case | Finding |"
  echo "|---|---|"
  for finding in docs/validation/*.md; do
    name=$(basename "$finding" .md)
    [[ $name == README ]] && continue
    verdict="within its tolerances"
    grep -q 'MISSES' "$finding" && verdict="**misses**, see there"
    note=$(sed -n "s/^| \[$name\].*\(;[^|;]*\) |\$/\1/p" <<< "$table")
    echo "| [$name]($name.md) | $verdict$note |"
  done
} > docs/validation/README.md

echo
echo "docs/validation/README.md: ${#names[@]} cases, ${#misses[@]} outside their tolerances${misses[*]:+ (${misses[*]})}"
[[ ${#misses[@]} -eq 0 ]]
