# One result of a study over an option that varies, a curve for each value of another.
# $table: x, y, value and its band; curve k has the rows word(first, k) to word(last, k) and the name nameK.
row(list, k) = int(word(list, k))
text(name, k) = value(sprintf('%s%d', name, k))
n = words(first)
set lmargin
set bmargin at screen 0.14 + up
set tmargin at screen 0.9 + up
set grid linecolor rgb '#dddddd' linewidth 0.6
set zeroaxis linecolor rgb grey linewidth 0.6
set offsets 0,0,graph 0.05,graph (v_from < 0 ? 0.05 : 0)
if (titled) set label 1 title at screen 0.5, 0.972 center
if (titled && bodies ne '') set label 9 bodies at screen 0.5, 0.935 center textcolor rgb '#444444'
set xlabel x_label
set ylabel v_label offset aside,0
set xrange [x_from:x_to]
if (x_format ne '') set format x x_format
if (v_format ne '') set format y v_format
if (words) { set xrange [x_from - 0.5:x_to + 0.5]; set xtics (word1 0); do for [k=2:words] { set xtics add (text('word', k) k - 1) } }
if (!words && x_step > 0) set xtics x_step
if (!words && x_step == 0) set logscale x
if (flat) set yrange [v_from:v_to]
set key outside right center samplen 2 font key_font title y_name.(y_unit eq '' ? '' : "\n[".y_unit."]").(tex ? "\n" : '')
if (y_name eq '') unset key
rows(k) = sprintf('every ::%d::%d', row(first, k), row(last, k))
line(k) = apart ? 'points' : row(last, k) - row(first, k) < 24 ? 'linespoints' : 'lines'
X = "$table using (column('x') / x_unit)"
draw = 'plot '
do for [k=1:n * banded] {
    draw = draw.sprintf("%s:((column('value') - column('band')) / v_unit):((column('value') + column('band')) / v_unit) %s with filledcurves linecolor rgb colour(%d) fillstyle transparent solid 0.3 noborder notitle, ", X, rows(k), k - 1)
}
do for [k=1:n] {
    draw = draw.sprintf("%s:(column('value') / v_unit) %s with %s linecolor rgb colour(%d) dashtype dashes(%d) pointtype 7 pointsize 0.7 linewidth 2.2 title name%d, ", X, rows(k), line(k), k - 1, k - 1, k)
}
eval draw[1:strlen(draw) - 2]
