#!/bin/sh
# Table and picture of docs/cookbook.md, by the program alone:
#     docs/finite-wheel/run.sh build/rollbem
set -eu
rollbem=${1:-build/rollbem}
here=$(dirname "$0")

# Scalars of one wheel, R = 50 mm, s = 0.4, mu = 0.3: ...support and material options
solve() {
    "$rollbem" --formulation steady --creep-ratio 0.4 --mu 0.3 --gap exact --mesh fitted \
        --contact-elements 100 --json --quiet "$@"
}

value() { printf '%s\n' "$json" | sed -n "/\"summary\"/,/^ }/s/^ *\"$1\": \([^,]*\),*\$/\1/p"; }

row() { # name of the material, hub ratio or arc, a/R, options
    material=$1 wheel=$2 ratio=$3
    shift 3
    case $wheel in arc) support="--support arc" ;; *) support="--support hub --hub-ratio $wheel" ;; esac
    half_width=$(awk "BEGIN { print 50 * $ratio }")
    # shellcheck disable=SC2086
    json=$(solve $support --half-width "$half_width" "$@")
    echo "$material $wheel $ratio $(value half_width) $(value max_pressure) $(value normal_load)" \
        "$(value approach) $(value free_creepage) $(value force_ratio)" \
        "$(value stick_from) $(value stick_to)"
}

rows() { # material, values of a/R, options
    material=$1 ratios=$2
    shift 2
    for wheel in arc 0.3 0.5 0.7 0.8 0.9; do
        for ratio in $ratios; do
            row "$material" "$wheel" "$ratio" "$@"
        done
    done
}

{
    rows rubber "1e-4 1e-3 0.01 0.02 0.05 0.1" --poisson 0.5
    rows steel "1e-4 1e-3 0.01 0.02 0.05 0.1" --poisson 0.3 --similar
} | awk '
    BEGIN { OFS = "\t"
            print "# material", "wheel", "a_H/R", "a/a_H", "p0/p0_H", "delta/delta_H", "k",
                  "xi0/(a_H/R)^2", "Q/(mu P)", "stick/2a" }
    {
        a = 50 * $3; p0 = 2 * $6 / (atan2(0, -1) * a)
        compliance = a * a / (4 * 50)          # P/(pi E*) by Hertz
        if ($1 == "steel") wheel = 0.5; else wheel = 1   # the half of it that is in the wheel
        plane = $1 == "steel" ? compliance / 2 * (2 * log(4 * 50 / a) - 1) : 0
        delta_H = wheel * compliance * (2 * log(4 * 50 / a) - 1)
        delta = $7 - plane
        k = (delta - delta_H) / (wheel * compliance)
        printf "%s\t%s\t%s\t%.4f\t%.4f\t%.4f\t%.3f\t%.3f\t%.4f\t%.3f\n", $1, $2, $3, $4 / a, $5 / p0,
               delta / delta_H, k, $8 / $3 ^ 2, $9, ($11 - $10) / (2 * $4)
    }' > "$here/table.tsv"

gnuplot -e "folder = '$here'" "$here/picture.gp"
