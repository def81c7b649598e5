#!/usr/bin/env bash
# Installs VS Code's server into build/vscode-host, once for each version that package.json names.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
host=$here/../../../../build/vscode-host
ready=$host/ready-$(cat "$here"/* | cksum | cut -d' ' -f1)
[ ! -e "$ready" ] || exit 0

npm_install() { npm install --ignore-scripts --no-audit --no-fund --loglevel=error "$@"; }

rm -rf "$host"
mkdir -p "$host"
cp "$here/package.json" "$host"
cd "$host"
npm_install
cd node_modules/code-server/lib/vscode
# It pins one package to a place that only its makers reach; package.json has its versions too.
rm -f npm-shrinkwrap.json
npm_install --omit=dev
# Terminals are the only native part that the tests need.
cd node_modules/node-pty
node_home=$(dirname "$(dirname "$(readlink -f "$(command -v node)")")")
headers=()
[ ! -d "$node_home/include/node" ] || headers=(--nodedir "$node_home")
npx --yes node-gyp rebuild --silent "${headers[@]}" > /dev/null
touch "$ready"
