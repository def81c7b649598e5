#!/usr/bin/env bash
# Installs YARP 3.5 from PyPI, as the peer of tests: it needs Python 3.9 on x86-64 Linux.
# In: the folder for its virtual environment. Without Python 3.9 its tests are skipped by name.
# With a C++ compiler it also builds `thrift_peer`, from code that YARP's yarpidl_thrift generates.
set -euo pipefail
folder=$1
sources=$(dirname "$0")/thrift_peer

install_yarp() {
  [ -x "$folder/bin/yarpserver" ] && return
  for python in python3.9 "$HOME"/.pyenv/versions/3.9.*/bin/python /usr/bin/python3.9; do
    if "$python" -c 'import sys, venv, ensurepip; sys.exit(sys.version_info[:2] != (3, 9))' 2> /dev/null; then
      "$python" -m venv "$folder"
      "$folder/bin/pip" install -q --disable-pip-version-check 'yarp-middleware==3.5.0' && return
      rm -rf "$folder"
    fi
  done
  echo "YARP could not be installed, as there is no Python 3.9: its tests are skipped" >&2
  exit 0
}

build_thrift_peer() {
  local packages=$folder/lib/python3.9/site-packages peer=$folder/bin/demo_peer code
  [ "$peer" -nt "$sources/demo.thrift" ] && [ "$peer" -nt "$sources/demo_peer.cpp" ] && return
  if ! command -v g++ > /dev/null; then
    echo "the Thrift peer of YARP could not be built, as there is no g++: its tests are skipped" >&2
    return
  fi
  code=$(mktemp -d)
  "$packages/yarp/bin/yarpidl_thrift" --gen yarp --out "$code" "$sources/demo.thrift"
  g++ -std=c++14 -w -I"$code" -I"$packages/yarp/include" "$sources/demo_peer.cpp" "$code"/demo/*.cpp \
    -o "$peer" -L"$packages/yarp/lib" -lYARP_os -lYARP_init -lYARP_os -lYARP_priv_hmac \
    "$packages"/yarp_middleware.libs/libACE-*.so -Wl,-rpath,"$(realpath "$packages/yarp_middleware.libs")" \
    -lpthread -ldl -lrt
  rm -rf "$code"
}

install_yarp
build_thrift_peer
