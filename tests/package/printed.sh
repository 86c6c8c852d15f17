# SPDX-License-Identifier: MIT
# Sourced by the tests of pages: what a page runs, and whether what it shows is what was printed.

# page_parts PAGE DIR: DIR/commands, what a reader does from top to bottom, and DIR/shown/LINE, what the page says
# that the block of commands at LINE prints. Commands and Python are run, and print into /printed/LINE; a TOML block
# is saved under the name of the file in the comment above it. An output stands right below its commands.
page_parts() {
    mkdir -p "$2/shown"
    awk -v dir="$2" '
        /^<!-- .* -->$/ { file = $2; sub(/.*\//, "", file); sub(/;$/, "", file); next }
        /^```/ && kind == "" {
            kind = $0 == "```" ? "output" : substr($0, 4)
            at = NR
            if (kind == "sh") print "{"
            if (kind == "python") print "python3 - >/printed/" at " <<\"END_OF_BLOCK\""
            if (kind == "toml") print "cat >" file " <<\"END_OF_BLOCK\""
            if (kind == "output" && ran) printf "" >(dir "/shown/" ran)
            next
        }
        /^```/ {
            if (kind == "sh") print "} >/printed/" at
            if (kind == "python" || kind == "toml") print "END_OF_BLOCK"
            ran = kind == "sh" || kind == "python" ? at : 0
            kind = ""
            next
        }
        kind == "output" { if (ran) print >>(dir "/shown/" ran); next }
        kind == "sh" && /^scripts\/check/ { next } # which calls this test
        kind == "sh" || kind == "python" || kind == "toml" { print; next }
        /./ { ran = 0; file = "" }
    ' "$1" >"$2/commands"
}

# as_shown SHOWN PRINTED: whether the file PRINTED is what SHOWN says, line by line; in SHOWN, "..." within a line
# stands for anything in it, a line of it for any lines. No output has "\\E" in it.
as_shown() {
    local pattern
    pattern=$(sed -e 's/^\.\.\.$/\\E(.*\\n)*?\\Q/; t' \
        -e 's/\.\.\./\\E.*\\Q/g' -e 's/$/\\E\\n\\Q/' "$1" | tr -d '\n')
    grep -qzP "\A\Q$pattern\E\z" "$2"
}
