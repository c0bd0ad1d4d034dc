#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs missing packages, builds the tools, and makes the tables and figures of TW 385 again: see tw385.py.
set -euo pipefail
folder=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bash "$folder/../../tools/install_packages.sh" --benchmarks
exec "$folder/tw385.py" "$@"
