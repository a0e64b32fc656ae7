# The deformed front of the wall; beside it, or below in a column of print, forces and contacts over time.
# $mesh, $edge: positions; $table: a row for each time step.
side(k, list) = number(list, k + 1)
open_panel(k) = sprintf('set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g; set tmargin at screen %g', \
    side(k, titled ? '0.08 0.655 0.655' : '0.18 0.18 0.18'), side(k, titled ? '0.54 0.965 0.965' : '0.93 0.93 0.93'), \
    side(k, titled ? '0.14 0.53 0.14' : '0.5 0.27 0.09'), side(k, titled ? '0.85 0.87 0.485' : '0.93 0.41 0.245'))
set multiplot
if (titled) set label 1 sprintf('{/:Bold Wall of 12 blocks, pressed with %g kN and sheared}', compression) at screen 0.5, 0.955 center
set label 2 sprintf('displacements × %s, drift %s%.3g mm', magnify, titled ? 'of the upper support ' : '', drift) at screen (titled ? 0.31 : 0.5), (titled ? 0.885 : 0.955) center textcolor rgb '#444444'
eval open_panel(0)
set size ratio -1
set xrange [-0.1 * width:1.35 * width]
set yrange [-0.05 * height:1.08 * height]
set xlabel 'x [m]' offset 0,0.3
set ylabel 'z [m]' offset 1.5 + aside,0
set xtics 0, 0.1
set ytics 0, 0.1
set object rectangle from -0.1 * width, -0.05 * height to 1.35 * width, 0 fillcolor rgb '#bdbdbd' fillstyle solid noborder behind
plot $mesh using 'x':'z' with lines linecolor rgb '#d9a679' linewidth 0.4 notitle, \
     $edge using 'x':'z' with lines linecolor rgb '#7b3f00' linewidth 1.3 notitle
unset label
unset object
set size noratio
set xrange [0:*]
set yrange [0:*]
set xtics autofreq
set ytics autofreq
unset xlabel
set format x ''
if (!titled) set xtics 0.2; set ytics 10
eval open_panel(1)
set ylabel 'force [kN]' offset -0.7 + aside,0
set key bottom right Left reverse samplen 2
plot $table using 'time':'compression' with lines linewidth 2 linecolor rgb '#1f4e79' title 'compression', \
     $table using 'time':'shear' with lines linewidth 2 linecolor rgb '#c0392b' dashtype 12 title 'shear'
if (!titled) set ytics points_step
eval open_panel(2)
set ylabel 'contact points' offset (titled ? -0.7 : 0.5) + aside,0
set format x '%g'
set xlabel 'time [s]' offset 0,0.3
set key center left Left reverse
plot $table using 'time':'stick' with lines linewidth 2 linecolor rgb strong(1) title 'stick', \
     $table using 'time':'slip' with lines linewidth 2 linecolor rgb strong(2) dashtype 12 title 'slip', \
     $table using 'time':'separated' with lines linewidth 2 linecolor rgb strong(0) dashtype 13 title 'separated'
unset multiplot
