#!/usr/bin/env bash
# Installs the programs of simulated hosts: OpenSSH's server, systemd, ip and tc, dbus, a C compiler.
# Debian packages need root or sudo; otherwise the script prints the missing packages, and the
# tests are skipped (in CI, where the variable CI is set, the script fails).
set -euo pipefail

# file that the package provides : Debian package
debian=(
  "/usr/sbin/sshd:openssh-server"
  "/usr/bin/ssh:openssh-client"
  "/lib/systemd/systemd:systemd"
  "/sbin/ip:iproute2"
  "/usr/bin/dbus-daemon:dbus"
  "/usr/bin/cc:gcc"
  "/usr/include/stdlib.h:libc6-dev"
  "/usr/bin/unshare:util-linux"
  "/usr/bin/pgrep:procps"
)
missing=()
for entry in "${debian[@]}"; do
  [ -e "${entry%%:*}" ] || missing+=("${entry#*:}")
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
