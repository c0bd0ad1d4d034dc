#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Checks that the man page and the completion of a tool know all that its --help has, and that
# completion.bash offers what an option takes.
set -euo pipefail

if (($# < 2 || $# > 3)); then
  echo "Usage: check_documentation.sh completion.bash TOOL [MAN_PAGE]" >&2
  exit 1
fi
tool=$2
name=$(basename "$tool")
page=${3-}

failures=0
fail () {
  echo "$name: $*" >&2
  failures=$((failures + 1))
}

# shellcheck source=tools/completion.bash
source "$1"
help=$("$tool" --help)
# In place of the tool, which starts too slowly to be asked for each option.
stand_in=$(mktemp -d)
trap 'rm -rf "$stand_in"' EXIT
printf '%s\n' "$help" >"$stand_in/help"
printf '#!/bin/sh\nexec cat "%s/help"\n' "$stand_in" >"$stand_in/$name"
chmod +x "$stand_in/$name"
# Leaves in COMPREPLY what bash would offer for the last of the words of a command line.
offer () {
  COMP_WORDS=("$stand_in/$name" "$@")
  COMP_CWORD=$#
  _pcl_floater "$stand_in/$name"
}
offers () {
  local expected=$1
  shift
  offer "$@"
  [[ ${COMPREPLY[*]} == "$expected" ]] || fail "after '$*', not '$expected' is offered, but '${COMPREPLY[*]}'"
}

complete -p "$name" >/dev/null 2>&1 || fail "bash does not complete it"

mapfile -t options < <(sed -n 's/^  \(-[^ ]*\).*/\1/p' <<<"$help" | tr ',' '\n')
((${#options[@]} >= 3)) || fail "--help has no options"
for option in "${options[@]}"; do
  offer "$option"
  [[ " ${COMPREPLY[*]} " == *" $option "* ]] || fail "$option is not completed"
  if [[ -n $page ]]; then
    grep -qF -e "\\fB${option//-/\\-}\\fR" "$page" || fail "$option is not in the man page"
  fi
done

if [[ -n $page ]]; then
  # All words of --help are in the man page, whatever their order on the lines.
  missing=$(comm -23 <(tr -s ' ,:' '\n' <<<"$help" | sort -u) \
    <(sed 's/\\f[BIR]//g; s/\\-/-/g; s/\\e/\\/g; s/\\&//g' "$page" | tr -s ' ,:' '\n' | sort -u) |
    grep -vxE '|Usage|Positionals|Examples|Notes|Exit|codes' | tr '\n' ' ' || true)
  [[ -z $missing ]] || fail "words of --help that are not in the man page: $missing"
  for section in NAME SYNOPSIS DESCRIPTION OPTIONS EXAMPLES 'SEE ALSO'; do
    grep -qx ".SH $section" "$page" || fail "the man page has no section $section"
  done
fi

case "$name" in
  pcl_floater_reconstruct)
    offers 'auto close-all keep-largest keep-count by-size' --holes ''
    offers 'keep-largest keep-count' --holes keep
    offers 'keep-largest keep-count' --holes = keep
    offers 'on off' --flips =
    offers '' --threads ''
    offers '' --report ''
    offers '--max-memory --max-edge --max-edge-ratio --max-iterations' --strict --max
    ;;
  pcl_floater_generate)
    offers 'torus' to
    offers '--seed' torus a.pcd --se
    ;;
esac
((failures == 0))
