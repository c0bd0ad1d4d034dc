# SPDX-FileCopyrightText: 2026 The pcl_floater authors
# SPDX-License-Identifier: GPL-3.0-or-later
# Makes a man page of what a tool prints for --help.
#   awk -v name=TOOL -v summary=TEXT -v example='COMMAND|COMMAND...' -v version=VERSION
#       -v column=WIDTH -f man_page.awk HELP_TEXT
# column: width of the column of names in that text

function escaped (text) {
  gsub (/\\/, "\\e", text)
  gsub (/-/, "\\-", text)
  if (text ~ /^[.']/)
    text = "\\&" text
  return text
}

# The names of an option in bold, what they take in italics, the default in parentheses.
function headline (text,    names, count, i, rest, place, result) {
  place = index (text, " ")
  rest = place ? substr (text, place + 1) : ""
  if (place)
    text = substr (text, 1, place - 1)
  count = split (text, names, ",")
  result = ""
  for (i = 1; i <= count; ++i)
    result = result (i > 1 ? ", " : "") "\\fB" escaped (names[i]) "\\fR"
  place = index (rest, " (")
  if (place)
    return result " \\fI" escaped (substr (rest, 1, place - 1)) "\\fR" escaped (substr (rest, place))
  return rest ? result " \\fI" escaped (rest) "\\fR" : result
}

function is_within_brackets (text) {
  return gsub (/[[({]/, "", text) != gsub (/[])}]/, "", text)
}

function verbatim (line) {
  sub (/^  /, "", line)
  print escaped (line)
}

function close_verbatim () {
  if (section == "Examples")
    print ".fi\n.RE"
}

function print_example (    commands, count, i) {
  print ".SH EXAMPLES\n.RS\n.nf"
  count = split (example, commands, "|")
  for (i = 1; i <= count; ++i)
    print escaped (commands[i])
  example_printed = 1
}

BEGIN {
  print ".\\\" SPDX" "-FileCopyrightText: 2026 The pcl_floater authors"
  print ".\\\" SPDX" "-License-Identifier: GPL-3.0-or-later"
  printf ".TH %s 1 \"\" \"pcl_floater %s\" \"User Commands\"\n", toupper (name), version
  printf ".SH NAME\n%s \\- %s\n", name, escaped (summary)
  section = "Description"
}

section == "Description" && /^Usage: / {
  sub (/^Usage: /, "")
  printf ".SH SYNOPSIS\n\\fB%s\\fR\n", name
  sub (/^[^ ]+/, "")
  print escaped (substr ($0, 2))
  print ".SH DESCRIPTION"
  for (i = 1; i <= described; ++i)
    print description[i] == "" ? ".PP" : escaped (description[i])
  print ".SH OPTIONS"
  section = "Options"
  next
}

section == "Description" {
  description[++described] = $0
  next
}

/^[A-Z][A-Za-z ]*:$/ {
  close_verbatim ()
  section = substr ($0, 1, length ($0) - 1)
  if (section == "Examples") {
    print_example ()
    print ""
  }
  else if (section == "Notes")
    print ".SH NOTES"
  else if (section == "Exit codes")
    print ".SH EXIT STATUS"
  else if (section == "Positionals")
    print ".SS Arguments"
  else
    print ".SS " section
  next
}

/^ *$/ { next }

section == "Examples" { verbatim ($0); next }

section == "Notes" { sub (/^ +/, ""); print escaped ($0); next }

section == "Exit codes" {
  code = $1
  sub (/^ *[0-9]+ +/, "")
  printf ".TP\n\\fB%s\\fR\n%s\n", code, escaped ($0)
  next
}

# A name, and its text on this line or below. The text starts in a fixed column; a name that reaches
# into it stands alone, and may have its default in parentheses there.
/^  [^ ]/ {
  text = substr ($0, column + 1)
  if (length ($0) <= column || substr ($0, column, 1) != " " || text ~ /^\(.*\)$/ ||
      is_within_brackets (substr ($0, 1, column))) {
    head = substr ($0, 3)
    text = ""
  }
  else {
    head = substr ($0, 3, column - 3)
    sub (/ +$/, "", head)
  }
  sub (/ +$/, "", head)
  print ".TP\n" headline (head)
  if (text != "")
    print escaped (text)
  next
}

{ sub (/^ +/, ""); print escaped ($0) }

END {
  close_verbatim ()
  if (!example_printed) {
    print_example ()
    print ".fi\n.RE"
  }
  print ".SH SEE ALSO"
  separator = ""
  count = split ("pcl_floater_generate pcl_floater_picture pcl_floater_reconstruct", tools, " ")
  for (i = 1; i <= count; ++i)
    if (tools[i] != name) {
      printf "%s\\fB%s\\fR(1)", separator, tools[i]
      separator = ",\n"
    }
  print ""
}
