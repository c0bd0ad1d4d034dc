# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# shellcheck shell=bash
# Completes the command lines of the tools in bash. What options there are, and what they take, is
# asked of the tool itself: of its --help.

# Prints what an option takes: "choice" and the words to choose from, "file", "folder", "value" or,
# for an option that takes nothing, "none". $1: text of --help; $2: name of the option
_pcl_floater_takes () {
  awk -v option="$2" '
    function answer (text) { print text; answered = 1; exit }
    /^  -/ {
      if (is_it) answer ("value")
      is_it = 0
      is_list = 0
      count = split ($1, names, ",")
      for (i = 1; i <= count; ++i)
        if (names[i] == option) is_it = 1
      if (!is_it) next
      # A single space stands before what it takes.
      if ($0 !~ /^  -[^ ]* [^ ]/) answer ("none")
      if ($2 == "FILE") answer ("file")
      if ($2 == "FOLDER") answer ("folder")
    }
    is_it && is_list { gsub (/,/, ""); $1 = $1; answer ("choice " $0) }
    is_it && /:$/ { is_list = 1 }
    END { if (!answered && is_it) print "value" }' <<<"$1"
}

_pcl_floater () {
  local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} help takes words
  COMPREPLY=()
  # bash takes the sign in --option=value for a word of its own.
  if [[ $word == '=' ]]; then
    word=
  elif [[ $previous == '=' ]]; then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  help=$("$1" --help 2>/dev/null) || return 0

  [[ $previous != -* ]] || takes=$(_pcl_floater_takes "$help" "$previous")
  case "${takes-}" in
    choice\ *) mapfile -t COMPREPLY < <(compgen -W "${takes#choice }" -- "$word"); return 0 ;;
    file) compopt -o default 2>/dev/null || true; return 0 ;;
    folder) compopt -o dirnames 2>/dev/null || true; return 0 ;;
    value) return 0 ;;
  esac

  if [[ $word == -* ]]; then
    words=$(awk '/^  -/ { gsub (/,/, " ", $1); print $1 }' <<<"$help")
    mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
    return 0
  fi
  # The first argument of pcl_floater_generate is a surface.
  if ((COMP_CWORD == 1)); then
    words=$(awk '/^  [a-z]+ TEXT:\{/ { sub (/^[^{]*\{/, ""); sub (/\}.*/, ""); gsub (/,/, " "); print }' <<<"$help")
    if [[ -n $words ]]; then
      mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
      return 0
    fi
  fi
  compopt -o default 2>/dev/null || true
}

complete -F _pcl_floater pcl_floater_reconstruct pcl_floater_distributed pcl_floater_generate \
  pcl_floater_picture
