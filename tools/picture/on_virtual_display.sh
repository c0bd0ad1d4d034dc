#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a command on a virtual X display and exits with its exit code. (xvfb-run of Debian 12
# sometimes exits with 5 instead.)
set -euo pipefail

if (($# == 0)); then
  echo "Usage: on_virtual_display.sh COMMAND [ARGUMENT...]" >&2
  exit 1
fi
if ! command -v Xvfb >/dev/null; then
  echo "on_virtual_display.sh: Xvfb is missing; tools/install_packages.sh installs it" >&2
  exit 1
fi

# Xvfb chooses a free display, and writes its number when it is ready. Without -noreset, it starts anew
# when its last client leaves, and the next connection of the same program may fail.
coproc server { exec Xvfb -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp -noreset 2>/dev/null; }
server_id=$!
# Waits for the end of the server, which would else remove the socket of the next one that takes its
# number.
trap 'kill "$server_id" 2>/dev/null || true; wait "$server_id" 2>/dev/null || true' EXIT
if ! read -r -t 60 display <&"${server[0]}"; then
  echo "on_virtual_display.sh: Xvfb did not start" >&2
  exit 1
fi
DISPLAY=:$display "$@"
