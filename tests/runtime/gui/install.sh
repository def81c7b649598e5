#!/usr/bin/env bash
# Installs the libraries that Qt loads, and an X server in memory with a program that clicks.
# Debian packages need root or sudo; otherwise the script prints the missing packages, and the
# tests are skipped (in CI, where the variable CI is set, the script fails).
set -euo pipefail

library=$(dirname "$(ldconfig -p | awk '$1 == "libc.so.6" {print $NF; exit}')")
# file that the package provides : Debian package
debian=(
  "$library/libEGL.so.1:libegl1"
  "$library/libGL.so.1:libgl1"
  "$library/libxkbcommon.so.0:libxkbcommon0"
  "$library/libdbus-1.so.3:libdbus-1-3"
  "$library/libfontconfig.so.1:libfontconfig1"
  "$library/libglib-2.0.so.0:libglib2.0-0"
  "$library/libxcb-cursor.so.0:libxcb-cursor0"
  "$library/libxcb-icccm.so.4:libxcb-icccm4"
  "$library/libxcb-keysyms.so.1:libxcb-keysyms1"
  "$library/libxcb-shape.so.0:libxcb-shape0"
  "$library/libxkbcommon-x11.so.0:libxkbcommon-x11-0"
  "/usr/bin/Xvfb:xvfb"
  "/usr/bin/xdotool:xdotool"
)
missing=()
for entry in "${debian[@]}"; do
  [ -e "${entry%%:*}" ] || [ -e "/usr${entry%%:*}" ] || missing+=("${entry#*:}")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "$(id -u)" = 0 ]; then
  root=(env DEBIAN_FRONTEND=noninteractive)
elif sudo -n true 2> /dev/null; then
  root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
else
  echo "not installed, as this needs root: ${missing[*]}" >&2
  echo "please run: sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  [ -z "${CI:-}" ]
  exit
fi
apt=("${root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300)
"${apt[@]}" update
"${apt[@]}" install -y --no-install-recommends "${missing[@]}" > /dev/null
