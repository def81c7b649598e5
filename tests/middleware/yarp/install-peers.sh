#!/usr/bin/env bash
# Installs YARP 3.5 from PyPI, as the peer of tests: it needs Python 3.9 on x86-64 Linux.
# In: the folder for its virtual environment. Without Python 3.9 its tests are skipped by name.
set -euo pipefail
folder=$1

[ -x "$folder/bin/yarpserver" ] && exit 0
for python in python3.9 "$HOME"/.pyenv/versions/3.9.*/bin/python /usr/bin/python3.9; do
  if "$python" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info[:2] != (3, 9))' 2> /dev/null; then
    "$python" -m venv "$folder"
    "$folder/bin/pip" install -q --disable-pip-version-check 'yarp-middleware==3.5.0' && exit 0
    rm -rf "$folder"
  fi
done
echo "YARP could not be installed, as there is no Python 3.9: its tests are skipped" >&2
