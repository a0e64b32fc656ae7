# One result of a study over two options that vary, with contours.
# $table: x, y, value, rows of one y apart; $numbers: the numbers at the contours, unless all are one (flat).
set view map
set pm3d map corners2color mean
if (filled) set pm3d interpolate between_x,between_y
unset key
set lmargin at screen left
set rmargin at screen left + width
set bmargin at screen bottom
set tmargin at screen bottom + height
if (titled) set label 1 title at screen 0.5, 0.972 center
if (titled && bodies ne '') set label 9 bodies at screen 0.5, 0.935 center textcolor rgb '#444444'
set xlabel x_label
set ylabel y_label offset aside,0
set label 2 v_label at screen 0.968, bottom + height / 2 center rotate
set xrange [x_from:x_to]
set yrange [y_from:y_to]
if (x_step > 0) set xtics x_step; else set logscale x
if (y_step > 0) set ytics y_step; else set logscale y
if (x_format ne '') set format x x_format
if (y_format ne '') set format y y_format
if (v_format ne '') set format cb v_format
if (filled || flat) { set colorbox user origin left + width + 0.02, bottom size 0.022, height } else { unset colorbox }
set cbrange [v_from:v_to]
field = "using (column('x') / x_unit):(column('y') / y_unit):(column('value') / v_unit)"
if (flat) { eval "splot $table ".field." with pm3d"; exit }
set cbtics level_step
set contour base
set cntrparam levels incremental level_first, level_step, level_last
eval "splot ".(filled ? "$table ".field." with pm3d nocontour, " : '')."$table ".field." ".contour_lines."0.8, $numbers ".contour_numbers." key_font"
