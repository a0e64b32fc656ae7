# A quarter of the truss from above, a panel for each increment and one for the sum of all; at last the
# quarter from the side, at rest and at the end.  Four panels in a row, two in a column of print.
# $bars, $before, $after: ends of the bars; $table: panel, position, displacement as it is drawn, whether
# it moves; scales, stick, slip: of panel k the entry k + 1.
row = titled ? 4 : 2
wide = (titled ? 0.93 : 0.95) / row
tall = titled ? 0.42 : 0.223
left(k) = (titled ? 0.055 : 0.1) + wide * (k % row)
top(k) = (titled ? 0.925 : 0.99) - tall * (k / row)
open_panel(k) = sprintf('set lmargin at screen %.4f; set rmargin at screen %.4f; set tmargin at screen %.4f; set bmargin at screen %.4f', \
    left(k), left(k) + (titled ? 0.82 : 0.78) * wide, top(k) - (titled ? 0.085 : 0.05), top(k) - tall + (titled ? 0.065 : 0.052))
of(k, moves, name) = column('panel') == k && column('moves') == moves ? column(name) : NaN
set multiplot
if (titled) set label 1 '{/:Bold Truss on an obstacle: increments of the contact nodes} (Kanno, example 3.1; '.layout.')' at screen 0.5, 0.955 center
set xrange [0:width + 1.1 * spacing]
set yrange [0:height + 1.1 * spacing]
set xtics 0, 4
set ytics 0, 4
above = 'A quarter of the truss from above, x, y ≥ 0 from its centre [m].'
red = '{/:Bold Red}: slip, its displacement times the factor in parentheses.'
blue = '{/:Bold Blue}: stick'
total = '(total: no displacement).  Counts are of the whole truss.'
aside = 'From the side: grey at rest, blue after the last increment.'
array lines[4] = ['', '', '', '']
if (titled) lines[1] = above.'  '.red.'  '.blue; lines[2] = total.'  '.aside
if (!titled) lines[1] = above; lines[2] = red; lines[3] = blue.' '.total; lines[4] = aside
do for [k=1:(titled ? 2 : 4)] {
    set label 9 + k sprintf('{/*%g %s}', titled ? 0.75 : 0.65, lines[k]) at screen 0.055, (titled ? 0.052 : 0.08) - (titled ? 0.028 : 0.02) * (k - 1)
}
do for [k=0:steps] {
    eval open_panel(k)
    set title sprintf('{/:Bold %s%d}  (×%g)', k < steps ? 'm = ' : 'total, m = ', k < steps ? k + 1 : k, number(scales, k + 1)) offset 0,0.1
    if (k < steps) { set label 3 sprintf('{/*0.8 stick %s, slip %s}', word(stick, k + 1), word(slip, k + 1)) at graph 0.5, graph 1.06 center textcolor rgb '#555555' }
    plot $bars using 'x':'y' with lines linecolor rgb '#c8ccd0' linewidth 0.7 notitle, \
         $table using (of(k, 0, 'x')):'y' with points pointtype 6 pointsize 1.1 linecolor rgb '#1f4e79' notitle, \
         $table using (of(k, 1, 'x')):'y' with points pointtype 7 pointsize 0.5 linecolor rgb '#c0392b' notitle, \
         $table using (of(k, 1, 'x')):'y':'dx':'dy' with vectors head size screen 0.007,20 filled linecolor rgb '#c0392b' linewidth 1.3 notitle
    unset label # drawn over and over they grow fat
}
eval open_panel(steps + 1)
# over the panel, not over the plot, which is narrow where the truss is tall
unset title
set label 4 sprintf('{/:Bold from the side}  (×%g)', number(scales, steps + 1)) \
    at screen left(steps + 1) + 0.41 * wide, top(steps + 1) - (titled ? 0.031 : 0.012) center
set autoscale
set size ratio -1
unset tics
unset border
plot $before using 'x':'y' with lines linecolor rgb '#b4bac0' linewidth 0.6 notitle, \
     $after using 'x':'y' with lines linecolor rgb '#1f4e79' linewidth 0.7 notitle
unset multiplot
