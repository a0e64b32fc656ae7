# A history frame by frame: pressure, friction and its bounds over the zones, and below them the force.
# $drawn: the tractions, `rows` rows of each frame; $zones: frame, from, to, zone; $steps: the force of
# all steps, $frames: of those that are drawn; titleK: of frame K.  $table: the history as it is printed.
zone(i, k) = number($zones[i], k)
of(k) = sprintf('every ::%d::%d', (k - 1) * rows, k * rows - 1)
bound_line = "with lines dashtype (6,4) linecolor rgb '#7a7a7a' linewidth 0.9"
bounds(k) = bounded ? sprintf("$drawn %s using 'x':'bound' %s title '±μp', $drawn %s using 'x':(-column('bound')) %s notitle, ", of(k), bound_line, of(k), bound_line) : ''
named(zone, name) = sprintf(", keyentry with boxes fillstyle solid noborder fillcolor rgb '%s' title '%s'", pale(zone), name)
zones_key = has_friction ? named(1, 'stick').named(2, 'slip →').named(3, '← slip') : ''
last = 2
do for [k=1:frames] {
    set multiplot
    set lmargin at screen 0.12 + right
    set rmargin at screen 0.965
    if (titled) { set label 1 value(sprintf('title%d', k)) at screen 0.53, 0.965 center }
    if (titled) { set label 9 bodies at screen 0.53, 0.925 center textcolor rgb '#444444' }
    set tmargin at screen 0.825 + up
    set bmargin at screen 0.42 + up
    set label 3 p_label at screen 0.028, 0.62 + up center rotate
    set xrange [x_from:x_to]
    set yrange [p_from:p_to]
    set ytics autofreq
    set xtics x_step
    set xlabel x_label offset 0,0.3
    set key at screen 0.53, 0.868 + (titled ? 0 : 0.06) center horizontal maxrows 1 samplen 1.5 font key_font
    first_zone = last
    do for [i=first_zone:|$zones|] {
        if (zone(i, 1) == k) { last = i; set object rectangle from first zone(i, 2), graph 0 to first zone(i, 3), graph 1 fillcolor rgb pale(int(zone(i, 4))) fillstyle solid noborder behind }
    }
    eval "plot 0 with lines linecolor rgb grey linewidth 0.6 notitle, ".bounds(k)."$drawn ".of(k)." using 'x':'p' with lines linecolor rgb '#1f4e79' linewidth 1.8 title 'pressure p', $drawn ".of(k)." using 'x':'q' with lines linecolor rgb '#c0392b' linewidth 2.2 title 'friction q'".zones_key
    unset object
    unset label
    unset key
    set tmargin at screen 0.31 + up
    set bmargin at screen 0.115 + up
    set label 3 force_label at screen 0.028, 0.21 + up center rotate
    set xrange [*:*]
    set yrange [force_from:force_to]
    set ytics force_step
    if (place_step > 0) { set xtics place_step } else { set xtics autofreq }
    set xlabel step_label offset 0,0.3
    plot $steps using 'x':'force' with lines linecolor rgb grey linewidth 1.4, \
         $frames every ::k-1::k-1 using 'x':'force' with points pointtype 7 pointsize 1.4 * marker linecolor rgb '#c0392b'
    unset label
    unset multiplot
}
