#!/bin/bash
# Installs the Debian packages of packages.txt that are not there yet. With all of them there it does
# nothing and needs no network. As root, or as an ordinary user with sudo; without, it says what to ask for.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
  echo "This script needs Debian 12 (it found no apt-get). On another system install the counterparts of" >&2
  echo "the packages in packages.txt by hand, then build with: cmake --preset release && cmake --build --preset release" >&2
  exit 1
fi

missing=()
while read -r package; do
  [[ -z $package || $package == \#* ]] && continue
  status=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null || true)
  [[ $status == installed ]] || missing+=("$package")
done < packages.txt
[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  # sudo may ask for the password only where somebody can answer.
  if command -v sudo > /dev/null && { [[ -t 0 ]] || sudo -n true 2> /dev/null; }; then
    as_root=(sudo)
  else
    echo "${#missing[@]} Debian packages are missing, and this user cannot install them (no root, no sudo)." >&2
    echo "Ask whoever runs this machine to install them:" >&2
    echo "  apt-get install --no-install-recommends ${missing[*]}" >&2
    exit 1
  fi
fi

echo "Installing ${#missing[@]} Debian packages: ${missing[*]}"
apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=600)
"${apt[@]}" update
# No `Dpkg::Use-Pty`: plain lines in a log.
"${apt[@]}" install -y --no-install-recommends -o Dpkg::Use-Pty=0 "${missing[@]}"
