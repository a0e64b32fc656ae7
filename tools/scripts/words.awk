# What `rollbem help WORD` searches beside the tables: the rows of docs/glossary.md and the
# questions of docs/faq.md as entries of a C table, in plain words.
function plain(s) {
    while (match(s, /\[[^]]*\]\([^)]*\)/)) {
        link = substr(s, RSTART, RLENGTH)
        sub(/^\[/, "", link); sub(/\]\(.*/, "", link)
        s = substr(s, 1, RSTART - 1) link substr(s, RSTART + RLENGTH)
    }
    gsub(/`/, "", s); gsub(/\\\|/, "|", s)
    gsub(/\\/, "\\\\", s); gsub(/"/, "\\\"", s)
    gsub(/^ +| +$/, "", s)
    return s
}
function entry(kind, name, text) {
    printf "{%s, \"%s\",\n \"%s\"},\n", kind, plain(name), plain(text)
}
function finish() {
    if (question != "")
        entry("QUESTION", question, answer)
    question = ""
}
FILENAME ~ /glossary/ && /^## Symbols/ { symbols = 1 }
FILENAME ~ /glossary/ && !symbols && /^\| / && !/^\| word / {
    split($0, cell, / \| |^\| | \|$/)
    entry("WORD", cell[2], cell[3])
    next
}
FILENAME ~ /faq/ && /^\*\*/ {
    finish()
    end = index(substr($0, 3), "**")
    question = substr($0, 3, end - 1); answer = substr($0, end + 4)
    next
}
FILENAME ~ /faq/ && question != "" && /^$/ { finish(); next }
FILENAME ~ /faq/ && question != "" { answer = answer " " $0 }
END { finish() }
