# Pressure, friction and its bounds over the zones, with slip and temperature below.
# $drawn: the columns of $table that are drawn, with the ends of the contact; $zones: from, to, zone,
# and how its name stands (0 not, 1 level, 2 upright); $names: the bodies at their temperatures; bound_title: ''
# without friction.
set datafile missing '?'
heat = has('temperature_K')
top(k) = up + number(heat ? '0.83 0.45 0.275' : '0.83 0.36', k)
bottom(k) = up + number(heat ? '0.48 0.305 0.115' : '0.40 0.115', k)
zone(i, k) = number($zones[i], k)
level(z) = word('separated stick slip+→ ←+slip yield+→ ←+yield contact', z + 1)
name(z, how) = how == 2 ? word('separated stick slip slip yield yield contact', z + 1) : level(z)[1:strstrt(level(z).'+', '+') - 1].(strstrt(level(z), '+') ? ' '.level(z)[strstrt(level(z), '+') + 1:*] : '')
draw_zones = 'do for [i=2:|$zones|] { set object rectangle from first zone(i, 1), graph 0 to first zone(i, 2), graph 1 fillcolor rgb pale(int(zone(i, 3))) fillstyle solid noborder behind }'
open_panel = "set tmargin at screen top(k); set bmargin at screen bottom(k); set format x (k == lowest ? '%g' : ''); if (k == lowest) set xlabel x_label offset 0,0.3"
lowest = heat ? 3 : 2
set multiplot
set lmargin at screen 0.12 + right
set rmargin at screen 0.965
set xrange [x_from:x_to]
if (titled) set label 1 title at screen 0.53, 0.977 center
if (titled) set label 2 results at screen 0.53, 0.909 center textcolor rgb '#444444'
if (titled) set label 9 bodies at screen 0.53, 0.943 center textcolor rgb '#444444'
set yrange [p_from:p_to]
k = 1
eval open_panel
set label 3 p_label at screen 0.028, 0.5 * (top(k) + bottom(k)) center rotate
set key at screen 0.53, 0.866 + up + (titled ? 0 : 0.02) center horizontal maxrows 1 samplen 1.2 width (is_carter && titled ? -2 : 0) font key_font
eval draw_zones
do for [i=2:|$zones|] {
    how = int(zone(i, 4))
    said = sprintf('{/*0.85 %s}', name(int(zone(i, 3)), how))
    x_of = 0.5 * (zone(i, 1) + zone(i, 2))
    if (how == 1) { set label said at first x_of, graph 0.95 center textcolor rgb '#555555' front }
    if (how == 2) { set label said at first x_of, graph 0.97 right rotate by 90 textcolor rgb '#555555' front }
}
line = few ? 'histeps' : 'lines'
carter_part = is_carter ? ", $carter using 1:3 with points pointtype 6 pointsize 1.7 * marker linecolor rgb '#111111' linewidth 1.2 notitle, $carter using 1:2 with points pointtype 6 pointsize 1.7 * marker linecolor rgb '#111111' linewidth 1.2 title 'Hertz, Carter'" : ''
plot 0 with lines linecolor rgb grey linewidth 0.6 notitle, \
     $drawn using 'x':'bound' with @line dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 0.9 title bound_title, \
     $drawn using 'x':(-column('bound')) with @line dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 0.9 notitle, \
     $drawn using 'x':'p' with @line linecolor rgb '#1f4e79' linewidth 1.8 title 'pressure p', \
     $drawn using 'x':(bound_title eq '' ? NaN : column('q')) with @line linecolor rgb '#c0392b' linewidth 2.2 title (bound_title eq '' ? '' : 'friction q') @carter_part
unset label
unset key
unset object
k = 2
eval open_panel
set yrange [slip_from:slip_to]
set ytics slip_step
set label 3 slip_label at screen 0.028, 0.5 * (top(k) + bottom(k)) center rotate
eval draw_zones
line = few ? 'linespoints pointtype 7' : 'lines'
plot 0 with lines linecolor rgb grey linewidth 0.6, $drawn using 'x':(column('slip')) with @line linecolor rgb '#6c3483' linewidth 1.8
if (!heat) exit
unset label
unset object
k = 3
eval open_panel
set yrange [heat_from:heat_to]
set ytics heat_step
set label 3 heat_label at screen 0.028, 0.5 * (top(k) + bottom(k)) center rotate
eval draw_zones
do for [i=2:|$names|] {
    at_left = int(word($names[i], 4))
    if (at_left) { set label word($names[i], 1) at first number($names[i], 2), first number($names[i], 3) left offset 0.5,0 front }
    if (!at_left) { set label word($names[i], 1) at first number($names[i], 2), first number($names[i], 3) right offset -0.5,0 front }
}
plot $drawn using 'x':'temperature_b' with lines dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 1.2, \
     $drawn using 'x':'temperature' with lines linecolor rgb '#b9770e' linewidth 1.8
