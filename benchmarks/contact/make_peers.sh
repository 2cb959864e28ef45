#!/bin/sh
# Make the environment that the peers run in, apart from viscofric's own: benchmarks/contact/.peers (about 0.5 GB).
# Usage: benchmarks/contact/make_peers.sh [PYTHON [FOLDER]]    (Python 3.11 and .peers by default)
set -eu
here="$(cd "$(dirname "$0")" && pwd)"
folder="${2:-$here/.peers}"
"${1:-python3.11}" -m venv --clear "$folder"
"$folder/bin/python" -m pip install --quiet --no-deps --requirement "$here/requirements-peers.txt"
echo "made $folder"
