# Performance profiles: solver k is column k + 1 of $table.
if (titled) set label 1 title at screen 0.5, 0.955 center
set grid linecolor rgb '#dddddd' linewidth 0.6
set logscale x
set xrange [1:1000]
set yrange [0:1.05]
set tmargin at screen 0.9 + up
set xlabel x_label
set ylabel 'share of problems solved' offset 1 + aside,0
set key outside right samplen 2 font small_font
plot for [k=1:n] $table using 1:k+1 with steps linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 1.8 title columnheader
