#!/bin/sh
# The rows of the measured tables of docs/library.md, by the program alone:
#     docs/rolling/measure.sh build/rollbem [supports|meshes|signs|balance|normals|paper|small ...]
set -eu
rollbem=${1:-build/rollbem}
[ $# -gt 0 ] && shift
[ $# -gt 0 ] || set -- supports meshes signs balance normals paper small
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

solve() { "$rollbem" --quiet --gap exact "$@"; }
summary() { # names...: their values, in one line, from the JSON on standard input
    awk -v names="$*" '
        /"summary"/ { on = 1 }
        on { gsub(/[",:]/, " "); if (!($1 in v)) v[$1] = $2 }
        /^ }/ { on = 0 }
        END { n = split(names, name, " "); for (i = 1; i <= n; i++) printf "%s ", v[name[i]]; print "" }'
}
half_width() { awk "BEGIN { print 50 * $1 }"; }

# Numbers as the page writes them: 3.1e-2, not 3.1e-02.
short() { sed 's/e-0*\([0-9]\)/e-\1/g; s/e+0*\([0-9]\)/e\1/g'; }

# Root mean square difference of p and q between two tables, per contact element.
difference() {
    paste "$1" "$2" | awk -F '\t' '
        $1 !~ /^[-0-9]/ { next }
        { p += ($4 - $14)^2; q += ($5 - $15)^2; if ($14 > p0) p0 = $14; n += $14 > 0 }
        END { printf "%.3e %.3e ", sqrt(p / n) / p0, sqrt(q / n) / (0.3 * p0) }'
}

differences() { # a/R, options: of hub and half-plane, arc and half-plane, hub and arc
    a=$(half_width "$1")
    zone=$(awk "BEGIN { print 1.3 * $a }")
    shift
    for support in halfplane hub arc; do
        [ $support = halfplane ] && own=$(echo "$*" | sed 's/--outer-elements [0-9]*//') || own=$*
        # shellcheck disable=SC2086
        solve --formulation steady --creep-ratio 0.4 --half-width "$a" --zone "$zone" \
            --support $support --mesh uniform --header=bare $own > "$scratch/$support"
    done
    difference "$scratch/hub" "$scratch/halfplane"
    difference "$scratch/arc" "$scratch/halfplane"
    difference "$scratch/hub" "$scratch/arc"
}

supports() { # nu = 1/2 on a rigid plane
    for ratio in 0.1 0.01 1e-3 1e-4 1e-5 1e-6; do
        differences $ratio --poisson 0.5 --contact-elements 104 |
            awk -v r=$ratio '{ printf "| %s | %.1e | %.1e | %.1e | %.1e | %.1e | %.1e |\n", r, $1, $2, $3, $4, $5, $6 }'
    done
}

meshes() { # similar bodies of nu = 0.3
    for fine in 1 2 4; do
        differences 1e-5 --poisson 0.3 --similar --contact-elements $((52 * fine)) --outer-elements $((100 * fine)) |
            awk -v r="$((52 * fine)) + $((100 * fine))" '{ printf "| %s | %.1e | %.1e | %.0e | %.0e |\n", r, $1, $2, $5, $6 }'
    done
}

signs() {
    for support in arc hub; do
        for ratio in 0.1 0.01 1e-3 1e-4; do
            for f in -0.64 0.64; do
                solve --formulation steady --poisson 0.5 --support $support --mesh fitted --json \
                    --contact-elements 100 --half-width "$(half_width $ratio)" --force-ratio $f |
                    summary creepage approach
            done | awk -v name="| $support | $ratio" '
                { sum += $1; delta = $2 / 50 } END { printf "%s | %.2e | %.2e | %.3f |\n", name, delta, sum, sum / delta }'
        done
    done
}

balance() { # a steel wheel, the example of Addi with 52 outer elements for 60
    for fine in 1 2 4 8; do
        for support in arc hub; do
            solve --formulation steady --poisson 0.3 --half-width 1 --creep-ratio 0.4 --support $support --mesh uniform \
                --contact-elements $((30 * fine)) --outer-elements $((60 * fine)) --json | summary support_balance
            solve --support $support --contact-elements $((30 * fine)) --outer-elements $((52 * fine)) --json |
                summary support_balance
        done | tr '\n' ' ' |
            awk -v r="$((30 * fine)) + $((60 * fine))" '{ printf "| %s | %.1e | %.1e | %.1e | %.1e |\n", r, $1, $2, $3, $4 }'
    done
}

normals() {
    for ratio in 1e-3 0.02; do
        for support in arc hub; do
            for normals in obstacle surface; do
                solve --formulation steady --poisson 0.5 --mu 0.4 --support $support --normals $normals --mesh uniform \
                    --contact-elements 100 --half-width "$(half_width $ratio)" --creep-ratio 0.4 --json |
                    summary approach force_ratio free_creepage
            done | tr '\n' ' ' |
                awk -v r="| $ratio | $support" '{ printf "%s | %.2e | %.3f | %.2e | %.3f | %.2e |\n", r, $1 / 50, $2, $3, $5, $6 }'
        done
    done
}

paper() {
    for support in arc hub; do
        for mu in 0.1 0.3; do
            for normals in obstacle surface; do
                solve --support $support --mu $mu --creep 0.1 --normals $normals --contact-elements 240 --json |
                    summary contact_from contact_to stick_from stick_to normal_load tangential_load slip_violations |
                    awk -v r="| $support | $mu | $normals" '
                        { stick = $4 > $3 ? sprintf("%.3f ... %.3f", $3 / 50, $4 / 50) : "none"
                          printf "%s | %.3f ... %.3f | %s | %.3e | %.2e | %d |\n", r, $1 / 50, $2 / 50, stick, $5, $6, $7 }'
            done
        done
    done
}

small() { # a/R = 1e-8, fitted, 100 across
    for support in arc hub; do
        solve --formulation steady --poisson 0.5 --support $support --mesh fitted --contact-elements 100 \
            --half-width 5e-7 --creep-ratio 0.4 --json | summary force_ratio half_width max_pressure normal_load |
            awk -v s=$support '{ printf "| %s | %.5f | %.5f | %.5f |\n", s, $1, $2 / 5e-7, $3 * atan2(0, -1) * 5e-7 / (2 * $4) }'
    done
}

for section; do "$section"; done | short
