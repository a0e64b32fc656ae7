# Pressure and worn depth after some of the steps.
# $profiles: x, pressure, depth; profile k has the rows word(first, k) to word(last, k).  $table: the
# steps as they are printed.
row(list, k) = int(word(list, k))
n = words(first)
set multiplot
set lmargin at screen 0.14 + right
set rmargin at screen 0.965
set grid linecolor rgb '#dddddd' linewidth 0.6
set format x ''
set xrange [x_from:x_to]
set key at screen 0.965, 0.91 + 1.6 * up right horizontal maxrows 1 samplen 1.5 font key_font
set label 2 way.':' at screen 0.14 - right, 0.897 + up left
if (titled) set label 1 title at screen 0.54, 0.955 center
set tmargin at screen 0.87
set bmargin at screen 0.54
set yrange [0:*]
set label 3 p_label at screen 0.03, 0.705 center rotate
plot for [k=1:n] $profiles using 'x':'p' every ::row(first, k)::row(last, k) \
         with lines linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 1.8 title value(sprintf('name%d', k))
unset label
unset key
set tmargin at screen 0.50
set bmargin at screen 0.13
set format x '%g'
set yrange [*:*]
set offsets 0,0,0,graph 0.05
set label 3 depth_label at screen 0.03, 0.315 center rotate
set xlabel x_label offset 0,0.3
plot for [k=1:n] $profiles using 'x':'depth' every ::row(first, k)::row(last, k) \
         with lines linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 1.8
unset multiplot
