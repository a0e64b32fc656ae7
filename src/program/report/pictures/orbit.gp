# K_II over K_I while the contact passes, coloured by its position.
if (titled) set label 1 title at screen 0.54, 0.972 center
set lmargin at screen 0.14 + right
set rmargin at screen (titled ? 0.86 : 0.79)
set bmargin at screen 0.14 + up
set tmargin at screen 0.92 + up
set grid linecolor rgb '#dddddd' linewidth 0.6
set zeroaxis linecolor rgb grey linewidth 0.6
set offsets graph 0.06,graph 0.06,graph 0.06,graph 0.06
set xlabel x_label
set ylabel y_label offset aside,0
set cblabel position offset 1,0
unset key
set palette defined (0 '#440154', 0.15 '#46327e', 0.3 '#365c8d', 0.45 '#277f8e', 0.6 '#1fa187', 0.75 '#4ac16d', 0.9 '#a0da39', 1 '#fde725')
plot $K using 'K_I':'K_II':'x' with lines palette linewidth 2.2, $K using 'K_I':'K_II':'x' with points palette pointtype 7 pointsize 0.6
