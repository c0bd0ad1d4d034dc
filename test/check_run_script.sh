#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Runs a copy of run.sh with programs that only note how they are called. A build folder may have
# been configured without tests before: run.sh has to ask for them.
set -euo pipefail

script=$1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
mkdir "$folder/bin" "$folder/test"
cp "$script" "$folder/test/run.sh"
for program in cmake ctest; do
  printf '#!/bin/sh\necho "%s $*" >> "%s/calls"\n' "$program" "$folder" >"$folder/bin/$program"
  chmod +x "$folder/bin/$program"
done
PATH=$folder/bin:$PATH bash "$folder/test/run.sh" --no-install -j 2 dev >/dev/null

expect () {
  if ! grep -qxF -e "$1" "$folder/calls"; then
    printf 'run.sh did not call: %s\nIt called:\n' "$1" >&2
    cat "$folder/calls" >&2
    exit 1
  fi
}
expect 'cmake --preset dev -DBUILD_TESTING=ON'
expect 'cmake --build --preset dev --parallel 2'
expect 'ctest --test-dir build/dev --parallel 2 --output-on-failure --no-tests=error --output-junit run.xml'
