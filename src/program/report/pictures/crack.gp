# K over the position of the contact; below, the zones of the faces along the crack.
# $K: the positions of the last pass; $zones: a box for each run of nodes in one zone; $table: all
# positions as they are printed.
set multiplot
if (titled) set label 1 title at screen 0.54, 0.972 center
set lmargin at screen 0.14 + right
set rmargin at screen (!wet ? 0.965 : titled ? 0.89 : 0.83)
set tmargin at screen 0.88 + up
set bmargin at screen 0.48
set grid linecolor rgb '#dddddd' linewidth 0.6
set format x ''
set xrange [x_from:x_to]
set offsets 0,0,graph 0.08,graph 0.08
set zeroaxis linecolor rgb grey linewidth 0.6
set key at screen 0.965, 0.925 + 1.4 * up right horizontal maxrows 1 samplen 2 font key_font
set label 2 K_label at screen 0.03, 0.68 center rotate
if (wet) set y2tics; set y2label fluid_label offset -0.5,0; set ytics nomirror; set y2range [0:fluid_to]
wet_part = wet ? ", $K using 'x':'fluid' axes x1y2 with lines linecolor rgb '#117864' dashtype (3,3) linewidth 1.6 title 'fluid'" : ''
plot $K using 'x':'K_I' with lines linecolor rgb '#c0392b' linewidth 2.4 title 'K_{I}', \
     $K using 'x':'K_II' with lines linecolor rgb '#1f4e79' dashtype (10,3) linewidth 2.4 title 'K_{II}' @wet_part
unset label 1
unset label 2
unset y2tics
unset y2label
unset key
set ytics nomirror
set tmargin at screen 0.44
set bmargin at screen 0.16 + up
set format x '%g'
set xlabel x_label offset 0,0.3
set offsets 0,0,0,0
set yrange [*:*] reverse
set autoscale yfix
set ytics along_step
set label 2 (titled ? 'along the crack / a' : '{/*0.85 along the crack / a}') at screen 0.03, 0.3 + 0.5 * up center rotate
do for [k=1:zone_names] {
    set label k + 2 value(sprintf('zone%d', k)) at screen value(sprintf('zone_x%d', k)), value(sprintf('zone_y%d', k)) left textcolor rgb zone_ink(value(sprintf('zone_of%d', k))) font key_font
}
plot $zones using 1:2:3:4:(on_face($5)) with boxxyerror fillstyle solid noborder linecolor rgb variable notitle
unset multiplot
