# The deformed bar; below, the reactions of its lower edge over the stretches of equal state.
# $mesh, $edge: positions; $table: x, normal and tangential / mu per length; $zones: from, to, zone, nodes.
zone(i, k) = number($zones[i], k)
is_wide(i) = zone(i, 2) - zone(i, 1) > 0.1 * length
set multiplot
set lmargin at screen (slide ? 0.125 : 0.1 + 1.6 * right)
set rmargin at screen (titled ? 0.975 : 0.95)
set xrange [0:1.005 * length]
set tmargin at screen 0.86
set bmargin at screen 0.60
if (titled) set label 1 '{/:Bold Bar pressed onto an obstacle and pushed from the right} (Kanno, example 3.2)' at screen 0.535, 0.955 center
if (titled) set label 2 sprintf('deformed mesh, displacements × %g;  end of the bar: %.4f mm, %+.4f mm', magnify, end_x, end_y) at screen 0.535, 0.90 center textcolor rgb '#444444'
if (!titled) set xtics 100; set label 2 sprintf('displacements × %g', magnify) at screen 0.58, 0.9 center textcolor rgb '#444444'
set yrange [-0.2 * height:1.55 * height]
set ytics 0, 0.5 * height
set format x ''
set ylabel 'y [mm]' offset aside,0
set object rectangle from graph 0, graph 0 to graph 1, first 0 fillcolor rgb '#cfcfcf' fillstyle solid noborder behind
plot $mesh using 'x':'y' with lines linecolor rgb '#6f9fc8' linewidth 0.35 notitle, \
     $edge using 'x':'y' with lines linecolor rgb '#1f4e79' linewidth 1.2 notitle
unset label
unset object
set tmargin at screen 0.55
set bmargin at screen 0.13
set format x '%g'
set xlabel 'x [mm]' offset 0,0.3
set ylabel 'reaction [N/mm]' offset aside,0
set yrange [0:*]
set ytics autofreq
set offsets 0, 0, graph 0.2, 0
set key at graph 0.06, graph 0.46 left Left reverse samplen 1.5
do for [i=2:|$zones|] {
    set object rectangle from first zone(i, 1), graph 0 to first zone(i, 2), graph 1 fillcolor rgb pale(int(zone(i, 3))) fillstyle solid noborder behind
    state = sprintf('{/*0.85 %s: %d}', word('separated stick slip', int(zone(i, 3)) + 1), int(zone(i, 4)))
    if (is_wide(i)) { set label state at first 0.5 * (zone(i, 1) + zone(i, 2)), graph 0.93 center textcolor rgb '#555555' front }
    if (!is_wide(i)) { set label state at first 0.5 * (zone(i, 1) + zone(i, 2)), graph 0.97 right rotate by 90 textcolor rgb '#555555' front }
}
plot $table using 'x':'normal' with points pointtype 5 pointsize 0.9 linecolor rgb '#1f4e79' title 'normal', \
     $table using 'x':'tangential' with points pointtype 9 pointsize 1.0 linecolor rgb '#c0392b' title 'tangential / μ'.(titled ? ', to the right' : '')
unset multiplot
