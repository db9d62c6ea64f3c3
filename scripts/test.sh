#!/bin/bash
# Installs what is missing, builds everything and runs every test. The last lines are CTest's summary.
#   scripts/test.sh [--warnings-as-errors]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/install_packages.sh
scripts/build.sh "$@"
# Tests on several ranks count as two processors, so that two of them never share two cores.
ctest --preset release --no-tests=error --timeout 600 --parallel "$(nproc)"
