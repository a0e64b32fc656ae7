# Reads table.tsv, writes picture.svg; called by run.sh.
set terminal svg size 900,640 font 'Helvetica,13' background 'white'
set output folder . '/picture.svg'
table = folder . '/table.tsv'
set datafile separator tab
set logscale x
set xrange [8e-5:0.13]
set format x '%g'
set xlabel 'a/R  (Hertz)'
set grid ytics lc rgb '#dddddd'
set border 3
set tics nomirror out
set key top left samplen 1.5
wheels = 'arc 0.3 0.5 0.7 0.8 0.9'
colour(i) = word('#777777 #1f4e79 #2e8b57 #d9822b #b22222 #6a3d9a', i)
label(i) = i == 1 ? 'arc' : 'hub ' . word(wheels, i)
pick(i, column) = strcol(1) eq 'rubber' && strcol(2) eq word(wheels, i) ? column : NaN
set multiplot layout 2, 2 title 'Wheels of ν = 1/2 on a rigid plane, Hertz half-width a, against the half-plane'
set title 'largest pressure / Hertz'
plot for [i=1:6] table using 3:(pick(i, $5)) with linespoints pt 7 ps 0.5 lw 2 lc rgb colour(i) title label(i)
unset key
set title 'approach / half-cylinder compression'
plot for [i=1:6] table using 3:(pick(i, $6)) with linespoints pt 7 ps 0.5 lw 2 lc rgb colour(i) notitle
set title 'free-rolling creepage / (a/R)²'
plot for [i=1:6] table using 3:(pick(i, $8)) with linespoints pt 7 ps 0.5 lw 2 lc rgb colour(i) notitle
set title '-Q/(μP) at ξR/(μa) = 0.4;  dashed: Carter'
plot 0.64 with lines dt 2 lc rgb 'black' notitle, \
     for [i=1:6] table using 3:(pick(i, -$9)) with linespoints pt 7 ps 0.5 lw 2 lc rgb colour(i) notitle
unset multiplot
