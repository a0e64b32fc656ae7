# Storage and loss modulus over the frequency: $table, and those of the series, $fitted.
set lmargin at screen 0.14 + right
set rmargin at screen 0.965
set bmargin at screen 0.14 + up
set tmargin at screen 0.9 + up
if (titled) set label 1 title at screen 0.54, 0.955 center
set grid linecolor rgb '#dddddd' linewidth 0.6
set logscale xy
set format x '10^{%L}'
set format y '%g'
set xlabel 'angular frequency  [rad/s]'
set ylabel y_label offset 1 + aside,0
set key left top Left reverse samplen 2.2 font key_font
plot $fitted using 'omega':'storage' with lines linecolor rgb colour(0) linewidth 2.2 title "E', series", \
     $table using 'omega':'storage' with points pointtype 6 pointsize 1.2 linewidth 1.4 linecolor rgb colour(0) title "E', measured", \
     $fitted using 'omega':'loss' with lines linecolor rgb colour(1) dashtype dashes(1) linewidth 2.2 title "E'', series", \
     $table using 'omega':'loss' with points pointtype 4 pointsize 1.2 linewidth 1.4 linecolor rgb colour(1) title "E'', measured"
