# What all pictures share.  Blocks of data have a line of headings; columns are read by their names.
set datafile columnheaders
has(name) = strstrt(sprintf("\t%s\t", $table[1]), sprintf("\t%s\t", name)) > 0
colour(k) = word('#1f4e79 #c0392b #b9770e #6c3483 #117864 #5d6d7e #7b241c #2e86c1', k % 8 + 1)
set dashtype 12 (9,4)
set dashtype 13 (3,3)
set dashtype 14 (9,3,3,3)
set dashtype 15 (14,3)
set dashtype 16 (6,2,2,2,2,2)
dashes(k) = k % 6 == 0 ? 1 : 11 + k % 6
tex = GPVAL_TERM eq 'tikz'
aside = tex ? -2.5 : 0 # letters to the left: gnuplot does not know how wide TeX sets the numbers at the tics
grey = '#999999'
# gnuplot reads no number such as 2e+06, which has an exponent and no point
numeric(text) = strstrt(text, 'e') == 0 || strstrt(text, '.') > 0 ? real(text) \
    : real(text[1:strstrt(text, 'e') - 1].'.0'.text[strstrt(text, 'e'):*])
number(list, k) = numeric(word(list, k))
# without rounding errors, which would be a range of their own
tidy(x) = numeric(sprintf('%.9g', x))
# zones of contact: separated, stick, slip to the left and to the right, yield likewise, frictionless
strong(zone) = word('#9a9a9a #2c7a57 #c4501b #8a3fa0 #8c6a00 #b0305c #3d5a80', zone + 1)
pale(zone) = word('#f3f3f3 #d9ebe2 #fae3d6 #ecdff1 #f3ecd0 #f6dde6 #e0e7ef', zone + 1)
# of a crack: where it is open pale, beside the strong colours of faces that touch
on_face(zone) = int('0x'.(zone == 0 ? pale(0) : strong(int(zone)))[2:*])
zone_ink(zone) = zone == 0 ? '#666666' : strong(zone)
# fields: colours that are grey from dark to light in print, and numbers at their contours
set palette defined (0 '#440154', 0.15 '#46327e', 0.3 '#365c8d', 0.45 '#277f8e', 0.6 '#1fa187', 0.75 '#4ac16d', 0.9 '#a0da39', 1 '#fde725')
set style textbox opaque noborder fillcolor rgb '#ffffff' margins 0.6,0.6
set cntrlabel onecolor
filled = !tex # TeX has no memory for the cells of a fine grid: it draws the contours alone
contour_lines = "with lines nosurface linecolor rgb '".(filled ? '#ffffff' : '#365c8d')."' linewidth "
contour_numbers = "using 'x':'y':'level':(sprintf('%g', column('level'))) nocontour with labels boxed font"
# below the surface, with a line outside it where the bodies touch: thick where they slip
set_field = "set view map; set tics scale 0.6; unset key; set pm3d map corners2color mean; set xrange [x_from:x_to]; set yrange [y_from:y_to]; part(k, i) = number($zones[i], k); \
    do for [i=2:|$zones|] { set arrow from part(1, i), graph beside to part(2, i), graph beside nohead linewidth (part(3, i) == 1 ? 2 : 6) linecolor rgb strong(int(part(3, i))) front }"
# the first and the last circle of the grid around a whole wheel
border_of_wheel = ", for [circle in '0 '.(circles - 1)] $table every :::int(circle)::int(circle) using (column('x_'.mm) / x_unit):(column('y_'.mm) / y_unit):(0) with lines nocontour linecolor rgb '#444444' linewidth 1"
