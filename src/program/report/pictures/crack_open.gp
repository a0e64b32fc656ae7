# The faces of the crack at one position of the contact, displaced and magnified.
# $face0, $face1: the faces, with the colour of the zone where they touch; $way, $tips: of a crack
# that grows; $table: all positions as they are printed.
if (titled) set label 1 title at screen 0.54, 0.972 center
if (titled) set label 2 K_there at screen 0.54, 0.935 center
if (!titled) set label 9 faces at graph 0.03, 0.06 font key_font front
do for [k=1:zone_names] {
    set label k + 2 value(sprintf('zone%d', k)) at screen value(sprintf('zone_x%d', k)), value(sprintf('zone_y%d', k)) left textcolor rgb zone_ink(value(sprintf('zone_of%d', k))) font key_font
}
set size ratio -1
set lmargin at screen left
set rmargin at screen 0.965
set bmargin at screen 0.21 + up
set tmargin at screen 0.21 + high + up
set xrange [x_from:x_to]
set yrange [bottom:y_to]
set xlabel 'x / a'
set ylabel 'y / a' offset aside,0
set xtics step
set ytics step
set key inside right top horizontal maxrows 1 samplen 2 font key_font
set object 1 rectangle from graph 0, first bottom to graph 1, first 0 fillcolor rgb '#eeeeee' fillstyle solid noborder behind
set object 2 rectangle from contact_from, 0 to contact_to, contact_high fillcolor rgb '#bbbbbb' fillstyle solid noborder
grown = grows ? ", $way using 1:2 with lines linecolor rgb '#555555' linewidth 1.2 notitle, $tips using 1:2 with points pointtype 6 pointsize 1.2 linecolor rgb '#555555' title 'grown'" : ''
# the dashed face above, or a closed crack would have one; the zones on both
plot 0 with lines linecolor rgb '#333333' linewidth 1.5 notitle, \
     $face0 using 1:2 with filledcurves closed linecolor rgb '#ffffff' notitle, \
     $face1 using 1:2 with filledcurves closed linecolor rgb '#ffffff' notitle @grown , \
     $face1 using 1:2 with lines linecolor rgb '#111111' linewidth 2 dashtype solid title face1_name, \
     $face0 using 1:2 with lines linecolor rgb '#8aa4bd' linewidth 2 dashtype (6,6) title face0_name, \
     $face0 using ($4 > 0 ? $1 : NaN):2:(on_face($3)) with points pointtype 7 pointsize 1 linecolor rgb variable notitle, \
     $face1 using ($4 > 0 ? $1 : NaN):2:(on_face($3)) with points pointtype 7 pointsize 1 linecolor rgb variable notitle
