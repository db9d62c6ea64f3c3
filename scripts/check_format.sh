#!/bin/bash
# Fails when a C++ file is not as clang-format 14 writes it. To repair: scripts/check_format.sh --fix
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

action=(--dry-run --Werror)
[[ ${1:-} == --fix ]] && action=(-i)
git ls-files -z -- '*.cpp' '*.hpp' | xargs -0 -r clang-format-14 "${action[@]}"
