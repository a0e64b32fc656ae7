# What the scripts of tests/journeys have in common; they begin with `. tests/journey.sh`, from the top
# of the checkout.  One installed tree, $B/journeys/installed, serves all of them; each works in a
# folder of its own.  Pictures go to $pictures, where they stay to be looked at.  In the suite
# (ROLLBEM_TEST_TURN) one in $parts of them.
. tests/in_turn.sh
if ! in_turn "$(ls tests/journeys | grep -n -x "$(basename "$0")" | cut -d: -f1)" "${parts:-4}"; then
    echo "[  SKIPPED ] $(basename "$0"): its turn comes every fourth day"
    exit 0
fi
B=$(cd "${B:-build}" && pwd)
root=$PWD installed=$B/journeys/installed pictures=$B/journeys
mkdir -p "$pictures"
if nm -D "$B/librollbem.so" | grep -q __asan_init; then
    echo "[  SKIPPED ] $(basename "$0"): the library is built with sanitizers"
    exit 0
fi
folder=$(mktemp -d) || exit 1
trap 'rm -rf "$folder"' EXIT
(
    flock 9
    [ "$installed/bin/rollbem" -nt "$B/rollbem" ] ||
        make --no-print-directory -s B="$B" MPI= PREFIX="$installed" install >"$folder/install" 2>&1
) 9>"$pictures/lock" || { cat "$folder/install"; echo "[  FAILED  ] make install"; exit 1; }
PATH=$installed/bin:$PATH
export LD_LIBRARY_PATH=$installed/lib PKG_CONFIG_PATH=$installed/lib/pkgconfig
failed=0 said=''
cd "$folder" || exit 1

# A line of shell as the person types it: shown, run, and what it prints shown too, standard error
# last; both are in $said.  try CODE LINE wants another exit code than 0.
run() { try 0 "$1"; }
try() {
    printf '$ %s\n' "$2"
    sh -c "$2" >out 2>err
    got=$?
    said=$(cat out err)
    printf '%s\n' "$said" | cut -c 1-160 | head -40
    [ $got -eq "$1" ] || miss "$2: exit code $got, not $1"
}
miss() {
    echo "[  FAILED  ] $1"
    failed=1
}
# sees WORDS...: all of them stand in what has just been printed
sees() {
    for words in "$@"; do
        case $said in *"$words"*) ;; *) miss "'$words' is not to be seen" ;; esac
    done
}
# close VALUE WANTED TOLERANCE NAME: relative to what is wanted
close() {
    awk -v x="$1" -v y="$2" -v t="$3" 'BEGIN { d = x - y; exit !(x != "" && (d < 0 ? -d : d) <= t * (y < 0 ? -y : y)) }' ||
        miss "$4: $1, not $2"
}
# number FILE NAME: of a result in JSON
number() { sed -n "s/^ *\"$2\": \\([^,]*\\),*\$/\\1/p" "$1" | head -1; }
# column FILE NAME ROW: an entry of a table; ROW last: the last one
column() {
    grep -v '^#' "$1" | awk -F '\t' -v name="$2" -v row="$3" '
        NR == 1 { for (k = 1; k <= NF; k++) if ($k == name) c = k; next }
        c && (row == "last" || NR == row + 1) { value = $c } END { print value }'
}
# drawn FILE...: whole pictures, kept below $pictures under the name of the journey
drawn() {
    for file in "$@"; do
        [ "$(wc -c <"$file")" -gt 5000 ] && cp "$file" "$pictures/$(basename "$0")-$(basename "$file")" || miss "$file is no picture"
    done
}
arrived() {
    [ $failed -eq 0 ] && echo "[       OK ] $(basename "$0")"
    exit $failed
}
