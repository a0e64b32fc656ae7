#!/bin/sh
# The measured tables of docs/rolling.md, by the program alone:
#     docs/rolling/measure.sh build/rollbem
set -eu
rollbem=${1:-build/rollbem}
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

# Root mean square difference of p and q between two tables, per contact element.
difference() {
    paste "$1" "$2" | awk -F '\t' '
        $1 !~ /^[-0-9]/ { next }
        { p += ($4 - $14)^2; q += ($5 - $15)^2; if ($14 > p0) p0 = $14; n += $14 > 0 }
        END { printf "%.2e %.2e", sqrt(p / n) / p0, sqrt(q / n) / (0.3 * p0) }'
}

supports() { # options
    for ratio in 0.1 0.01 1e-3 1e-4 1e-5 1e-6; do
        a=$(half_width "$ratio")
        zone=$(awk "BEGIN { print 1.3 * $a }")
        for support in halfplane hub arc; do
            solve --formulation steady --creep-ratio 0.4 --half-width "$a" --zone "$zone" \
                --support $support --mesh uniform --header=bare "$@" > "$scratch/$support"
        done
        printf '%s  hub - halfplane: %s  arc - halfplane: %s  hub - arc: %s\n' "$ratio" \
            "$(difference "$scratch/hub" "$scratch/halfplane")" \
            "$(difference "$scratch/arc" "$scratch/halfplane")" \
            "$(difference "$scratch/hub" "$scratch/arc")"
    done
}

echo "## supports, nu = 1/2 on a rigid plane, 104 elements: a/R, rms of p/p0 and of q/(mu p0)"
supports --poisson 0.5 --contact-elements 104

echo "## supports, similar bodies of nu = 0.3, the mesh doubled twice, a/R = 1e-5"
for fine in 1 2 4; do
    supports --poisson 0.3 --similar --contact-elements $((52 * fine)) --outer-elements $((100 * fine)) |
        grep '^1e-5' | sed "s/^1e-5/$((52 * fine)) + $((100 * fine))/"
done

echo "## the two signs: support, a/R, delta/R, xi(-Q) + xi(+Q), the same per delta/R"
for support in arc hub; do
    for ratio in 0.1 0.01 1e-3 1e-4; do
        for f in -0.64 0.64; do
            solve --formulation steady --poisson 0.5 --support $support --mesh fitted --json \
                --contact-elements 100 --half-width "$(half_width $ratio)" --force-ratio $f |
                summary creepage approach
        done | awk -v name="$support $ratio" '
            { sum += $1; delta = $2 / 50 } END { printf "%s  %.3e  %.3e  %.3f\n", name, delta, sum, sum / delta }'
    done
done

echo "## support_balance: case, support, contact + outer elements, balance; Addi: 52 outer ones for 60"
for support in arc hub; do
    for fine in 1 2 4 8; do
        printf '%s %s + %s  steel %s Addi %s\n' $support $((30 * fine)) $((60 * fine)) \
            "$(solve --formulation steady --poisson 0.3 --half-width 1 --creep-ratio 0.4 --support $support --mesh uniform \
                --contact-elements $((30 * fine)) --outer-elements $((60 * fine)) --json | summary support_balance)" \
            "$(solve --support $support --contact-elements $((30 * fine)) --outer-elements $((52 * fine)) --json |
                summary support_balance)"
    done
done

echo "## normals, mu = 0.4: a/R, support, normals, Q/(mu P), free creepage, delta/R"
for ratio in 1e-3 0.02; do
    for support in arc hub; do
        for normals in obstacle surface; do
            printf '%s %s %s ' $ratio $support $normals
            solve --formulation steady --poisson 0.5 --mu 0.4 --support $support --normals $normals --mesh uniform \
                --contact-elements 100 --half-width "$(half_width $ratio)" --creep-ratio 0.4 --json |
                summary force_ratio free_creepage approach |
                awk '{ printf "%.4f  %.3e  %.3e\n", $1, $2, $3 / 50 }'
        done
    done
done

echo "## the paper's case: support, mu, normals, contact/R, stick/R, P, Q, violations"
for support in arc hub; do
    for mu in 0.1 0.3; do
        for normals in obstacle surface; do
            printf '%s %s %s ' $support $mu $normals
            solve --support $support --mu $mu --creep 0.1 --normals $normals --contact-elements 240 --json |
                summary contact_from contact_to stick_from stick_to normal_load tangential_load slip_violations |
                awk '{ printf "%.3f ... %.3f  %.3f ... %.3f  %.4g  %.4g  %d\n", $1/50, $2/50, $3/50, $4/50, $5, $6, $7 }'
        done
    done
done

echo "## a/R = 1e-8, fitted, 100 across: support, Q/(mu P), half-width/a, p0/Hertz"
for support in arc hub; do
    solve --formulation steady --poisson 0.5 --support $support --mesh fitted --contact-elements 100 \
        --half-width 5e-7 --creep-ratio 0.4 --json | summary force_ratio half_width max_pressure normal_load |
        awk -v s=$support '{ printf "%s  %.5f  %.5f  %.5f\n", s, $1, $2 / 5e-7, $3 * atan2(0, -1) * 5e-7 / (2 * $4) }'
done
