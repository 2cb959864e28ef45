#!/bin/sh
# Make the environment that the peers run in, apart from viscofric's own: benchmarks/rheology/.peers (about 1 GB).
# Usage: benchmarks/rheology/make_peers.sh [PYTHON]    (Python 3.11 by default)
set -eu
cd "$(dirname "$0")"
"${1:-python3.11}" -m venv --clear .peers
.peers/bin/python -m pip install --quiet --no-deps --requirement requirements-peers.txt
echo "made $(pwd)/.peers"
