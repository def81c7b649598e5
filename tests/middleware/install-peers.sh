#!/usr/bin/env bash
# Installs the programs of other middlewares that tests use as peers: ZeroC Ice 3.7 with IceStorm.
# In: the Python of the project's .venv.
# Debian packages need root or sudo; otherwise the script prints the missing packages, and their
# tests are skipped (in CI, where the variable CI is set, the script fails).
set -euo pipefail
python=$1

# file that the package provides : Debian package
debian=(
  "/usr/bin/slice2py:zeroc-ice-compilers"
  "/usr/bin/icebox:zeroc-icebox"
  "/usr/lib/python3/dist-packages/Ice/__init__.py:python3-zeroc-ice"
  "/usr/share/ice/slice/Ice/Identity.ice:zeroc-ice-slice"
  "/usr/include/Ice/Ice.h:libzeroc-ice-dev"
  "/usr/bin/g++:g++"
)
missing=()
for entry in "${debian[@]}"; do
  [ -e "${entry%%:*}" ] || missing+=("${entry#*:}")
done
# Its library has the version of Ice in its name.
compgen -G "/usr/lib/*/libIceStormService.so*" > /dev/null || missing+=(libzeroc-icestorm3.7)

if [ ${#missing[@]} -gt 0 ]; then
  if [ "$(id -u)" = 0 ]; then
    root=(env DEBIAN_FRONTEND=noninteractive)
  elif sudo -n true 2> /dev/null; then
    root=(sudo -n env DEBIAN_FRONTEND=noninteractive)
  else
    root=()
    echo "not installed, as this needs root: ${missing[*]}" >&2
    echo "please run: sudo apt-get install --no-install-recommends ${missing[*]}" >&2
  fi
  if [ ${#root[@]} -gt 0 ]; then
    apt=("${root[@]}" apt-get -qq -o DPkg::Lock::Timeout=300)
    "${apt[@]}" update
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}" > /dev/null
  fi
fi

# Debian's package belongs to the system's Python: link only Ice into .venv, if the versions agree.
"$python" -m robocomp_dsl.runtime.middleware.ice.link_debian \
  || "$python" -m pip install -q --disable-pip-version-check 'zeroc-ice<3.8' \
  || { echo "ZeroC Ice could not be installed: its tests are skipped" >&2; [ -z "${CI:-}" ]; }
