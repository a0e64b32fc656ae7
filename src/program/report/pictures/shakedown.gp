# The largest pressure for elastic behaviour under repeated rolling, over the traction.
# $table: the limit of full sliding; limit, own: of this case, p_0/k (NaN: k is not given), at its traction.
set lmargin at screen 0.12 + right
set rmargin at screen 0.965
set bmargin at screen 0.14
set tmargin at screen 0.92
set grid linecolor rgb '#dddddd' linewidth 0.6
set xlabel 'traction  |Q|/P'
set ylabel 'p_0 / k' offset 1 + aside,0
set xrange [0:traction_to]
set yrange [0:limit_to]
if (titled) set label 1 title at screen 0.54, 0.955 center
set key right top samplen 2 font key_font
own_part = own == own ? ", '+' using (traction):(own) every ::0::0 with points pointtype 2 pointsize 2 linewidth 2 linecolor rgb '#111111' title 'p_0 of this case'" : ''
plot $table using 'traction':'limit' with lines linecolor rgb '#1f4e79' linewidth 2.4 title 'limit, full sliding (Johnson)', \
     '+' using (traction):(limit) every ::0::0 with points pointtype 7 pointsize 1.6 linecolor rgb '#c0392b' title 'limit of this case' @own_part
