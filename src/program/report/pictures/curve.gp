# Creep curves of several coefficients of friction, with their bands and Carter's law, and the
# temperatures below; or the resistance to rolling over the speed.
# Curve k has the rows word(first, k) to word(last, k) of $table; up to word(rising, k) x rises.
set lmargin at screen 0.13 + right
set rmargin at screen 0.965
set bmargin at screen (heat ? 0.39 : 0.14) + up
set tmargin at screen 0.9 + up
set grid linecolor rgb '#dddddd' linewidth 0.6
set zeroaxis linecolor rgb grey linewidth 0.6
set offsets 0,0,graph 0.05,0
if (key_above == 1) set key left top Left reverse samplen 2.2 font key_font
if (key_above == 2) set key right top samplen 2.2 font key_font
if (!key_above) set key right bottom samplen 2.2 font key_font
set xrange [x_from:x_to]
if (above_0) set yrange [0:*]
if (titled) set label 1 title at screen 0.54, 0.972 center
if (titled) set label 9 bodies at screen 0.54, 0.935 center textcolor rgb '#444444'
if (logarithmic) set logscale x
set ylabel y_label offset (logarithmic ? 0 : 1) + aside,0
if (heat) set multiplot; set format x ''
if (!heat) set xlabel x_label; set format x x_format
n = words(first)
row(list, k) = int(word(list, k))
falling(k) = row(rising, k) < row(last, k) ? row(rising, k) + 1 : row(last, k)
X(k) = column(x_name) / x_unit
Y(k, name) = tidy(column(name)) * number(y_scale, k)
W(k) = abs(Y(k, band))
line = few ? 'linespoints pointtype 7 pointsize 0.7' : 'lines'
s(k, t) = (1 - t) * number(s_first, k) + t * number(s_last, k)
carter(s) = sgn(s) * (abs(s) < 1 ? abs(s) * (2 - abs(s)) : 1)
set samples 26 # the first one is taken for a heading
band_style = 'filledcurves fillstyle transparent solid 0.3 noborder'
has_band = band ne ''
# entries that there need not be: an empty loop would leave a line of the key
band_key = has_band ? "keyentry with ".band_style."  linecolor rgb colour(0) title band_title," : ''
back_key = back ? ", keyentry with lines linecolor rgb colour(n) dashtype (2,3) linewidth 2.2 title 'on the way back'" : ''
carter_key = is_carter ? ", keyentry with points pointtype 6 pointsize 1.7 * marker linecolor rgb '#111111' linewidth 1.1 title 'Carter'" : ''
plot for [k=1:n * has_band] $table using (X(k)):(Y(k, y_name) - W(k)):(Y(k, y_name) + W(k)) every ::row(first, k)::row(rising, k) \
         with @band_style linecolor rgb colour(k - 1) notitle, \
     for [k=1:n] $table using (X(k)):(Y(k, y_name)) every ::row(first, k)::row(rising, k) \
         with @line linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 2.6 notitle, \
     for [k=1:n * back * has_band] $table using (X(k)):(Y(k, y_name) - W(k)):(Y(k, y_name) + W(k)) every ::falling(k)::row(last, k) \
         with @band_style linecolor rgb colour(n + k - 1) notitle, \
     for [k=1:n * back] $table using (X(k)):(Y(k, y_name)) every ::falling(k)::row(last, k) \
         with lines linecolor rgb colour(n + k - 1) dashtype (2,3) linewidth 2.2 notitle, \
     for [k=1:n * is_carter] [t=-1.0 / 24:1] '+' using (number(x_first, k) + t * (number(x_last, k) - number(x_first, k))):(carter(s(k, t)) * number(carter_scale, k)) \
         with points pointtype 6 pointsize 1.7 * marker linecolor rgb '#111111' linewidth 1.1 notitle, \
     @band_key \
     for [k=1:n] keyentry with @line linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 2.6 title sprintf("%s%g", mu_title, number(mu, k)) @back_key @carter_key
if (!heat) exit
unset label
unset key
set tmargin at screen 0.345 + up
set bmargin at screen 0.14 + up
set xlabel x_label
set format x x_format
set ylabel 'hottest  [K]' offset 1 + aside,0
set offsets 0,0,graph 0.08,graph 0.08
set yrange [*:*]
if (heat_step > 0) set ytics heat_step
plot for [k=1:n] $table using (X(k)):'max_temperature_K' every ::row(first, k)::row(last, k) \
         with @line linecolor rgb colour(k - 1) dashtype dashes(k - 1) linewidth 2.6
unset multiplot
