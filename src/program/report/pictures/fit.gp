# Measured points of the tests of a fit, and the fitted curve of each with its band.
# Test k has the rows word(first, k) to word(last, k) of $points; joined: the tests of several points,
# single: those of one.  $table: the points as they are printed.
set lmargin at screen 0.13 + right
set rmargin at screen 0.965
set bmargin at screen 0.14 + up
set tmargin at screen 0.9 + up
set grid linecolor rgb '#dddddd' linewidth 0.6
set zeroaxis linecolor rgb grey linewidth 0.6
set xrange [*<0:0<*]
set yrange [*<0:0<*]
set offsets graph (drives ? 0.03 : 0),graph 0.03,graph 0.05,graph (pushes ? 0.05 : 0)
if (brakes) set key right bottom samplen 2.2 font key_font
if (!brakes) set key left top Left reverse samplen 2.2 font key_font
if (titled) set label 1 title at screen 0.54, 0.972 center
if (titled) set label 9 numbers at screen 0.54, 0.935 center textcolor rgb '#444444'
set xlabel x_label
set ylabel y_label offset 1 + aside,0
row(list, k) = int(word(list, k))
# of an empty loop, which is looked at nevertheless, the first test
J(j) = words(joined) ? row(joined, j) : 1
S(j) = words(single) ? row(single, j) : 1
style(k) = named ? k - 1 : 0
# shapes that differ without their colours
marker_of(k) = row('6 4 8 12 10 1 2 3', style(k) + 1)
n = words(first)
common = named ? '#444444' : colour(0)
measured = 'pointsize 1.4 linewidth 1.4'
alone = 'pointtype 7 pointsize 0.5' # nothing that it could be joined to
band_style = 'filledcurves fillstyle transparent solid 0.3 noborder'
fitted_style = words(single) ? 'linespoints '.alone : 'lines'
# entries that there need not be: an empty loop would leave a line of the key
named_key = named ? "for [k=1:n] keyentry with linespoints pointtype marker_of(k) @measured linecolor rgb colour(k - 1) dashtype dashes(k - 1) title value(sprintf('name%d', k))," : ''
band_key = banded ? ", keyentry with @band_style linecolor rgb common title band_title" : ''
plot for [j=1:words(joined) * banded] $points using 'x':(column('fitted') - column('band')):(column('fitted') + column('band')) every ::row(first, J(j))::row(last, J(j)) \
         with @band_style linecolor rgb colour(style(J(j))) notitle, \
     for [j=1:words(single) * banded] $points using 'x':'fitted':'band' every ::row(first, S(j))::row(last, S(j)) \
         with yerrorbars @alone linecolor rgb colour(style(S(j))) notitle, \
     for [j=1:words(joined)] $points using 'x':'fitted' every ::row(first, J(j))::row(last, J(j)) \
         with lines linecolor rgb colour(style(J(j))) dashtype dashes(style(J(j))) linewidth 2.2 notitle, \
     for [j=1:words(single)] $points using 'x':'fitted' every ::row(first, S(j))::row(last, S(j)) \
         with points @alone linecolor rgb colour(style(S(j))) linewidth 2.2 notitle, \
     for [k=1:n] $points using 'x':'measured' every ::row(first, k)::row(last, k) \
         with points pointtype marker_of(k) @measured linecolor rgb colour(style(k)) notitle, \
     @named_key \
     keyentry with points pointtype marker_of(1) @measured linecolor rgb common title 'measured', \
     keyentry with @fitted_style linecolor rgb common linewidth 2.2 title 'fitted' @band_key
