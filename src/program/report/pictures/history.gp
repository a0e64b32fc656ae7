# Three panels of a history: column k + 1 of $drawn with the half-width of its band in column k + 4.
# $table: the history as it is printed.
top(k) = number('0.9 0.634 0.368', k) + up
height = titled ? 0.235 : 0.215 # larger tics need more between them
set multiplot
set lmargin at screen 0.14 + right
set rmargin at screen 0.965
set grid linecolor rgb '#dddddd' linewidth 0.6
set key at screen 0.965, 0.924 + up right samplen 2.2 font key_font
set xrange [x_from:x_to]
if (x_step > 0) set xtics x_step
line = few ? 'linespoints' : 'lines'
band_style = 'filledcurves fillstyle transparent solid 0.3 noborder'
do for [k=1:3] {
    set format x (k < 3 ? '' : '%g')
    if (k == 3) { set xlabel x_label offset 0,0.3 }
    if (titled && k == 1) {
        set label 1 title at screen 0.54, 0.978 center
        set label 9 bodies at screen 0.54, 0.944 center textcolor rgb '#444444'
    }
    set tmargin at screen top(k)
    set bmargin at screen top(k) - height
    set yrange [value(sprintf('from%d', k)):value(sprintf('to%d', k))]
    set ytics value(sprintf('step%d', k))
    set label 2 value(sprintf('label%d', k)) at screen 0.03, top(k) - height / 2 center rotate
    c = value(sprintf('colour%d', k))
    banded = value(sprintf('band%d', k)) # 2: named in the key
    if (banded == 2) {
        plot $drawn using 1:(column(k+1)-column(k+4)):(column(k+1)+column(k+4)) with @band_style linecolor rgb c title band_title, \
             $drawn using 1:k+1 with @line linecolor rgb c linewidth 1.8 pointtype 7 pointsize 0.8 notitle
    }
    if (banded == 1) {
        plot $drawn using 1:(column(k+1)-column(k+4)):(column(k+1)+column(k+4)) with @band_style linecolor rgb c notitle, \
             $drawn using 1:k+1 with @line linecolor rgb c linewidth 1.8 pointtype 7 pointsize 0.8 notitle
    }
    if (banded == 3) { # of both bodies
        plot $drawn using 1:k+1 with lines linecolor rgb c linewidth 1.8 title 'A', \
             $drawn using 1:k+4 with lines linecolor rgb c linewidth 1.8 dashtype 12 title 'B'
    }
    if (banded == 0) {
        plot $drawn using 1:k+1 with @line linecolor rgb c linewidth 1.8 pointtype 7 pointsize 0.8 notitle
    }
    unset label
}
unset multiplot
