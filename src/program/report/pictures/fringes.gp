# Photoelastic fringes below the surface: between crossed polarisers light passes as sin^2 of pi times the
# order.  $table: the points of the grid, NaN outside the body; $zones: where the bodies touch.
# contrast: less than 1 where fringes are as narrow as the cells.
beside = surface_above ? 1.018 : -0.018
eval set_field
set palette gray
set cbrange [0:1]
unset colorbox
set lmargin at screen 0.11 + 1.5 * right
set rmargin at screen 0.97
set bmargin at screen 0.17
set tmargin at screen surface_above ? 0.855 : 0.87
set xlabel x_label offset 0,0.2
set ylabel y_label offset aside,0
set size ratio aspect
set xtics x_step
set ytics y_step
# a longer line in smaller letters
if (titled) set label 1 sprintf('{/*%.3g %s}', strlen(title) > 102 ? 102.0 / strlen(title) : 1, title) at screen 0.5, 0.975 center
if (titled) set label 9 bodies at screen 0.5, 0.939 center textcolor rgb '#444444'
if (titled && contact ne '') set label 4 '{/*0.8 '.contact.'}' at screen 0.5, 0.025 center textcolor rgb '#444444'
set label 2 sprintf((filled ? 'dark' : 'lines').' where σ_1 − σ_2 is a multiple of %.4g %s', fringe, stress_name) at screen 0.5, 0.9 center textcolor rgb '#444444'
field(value) = sprintf("$table using (column('x_'.mm) / x_unit):(column('y_'.mm) / y_unit):(%s)", value)
difference = "2 * column('max_shear_'.MPa) / stress_unit"
set contour base
set cntrparam levels incremental fringe, fringe, last_fringe
brightness = "0.5 - 0.5 * column('contrast') * cos(2 * pi * ".difference." / fringe)"
eval 'splot '.(filled ? field(brightness).' with pm3d nocontour' : field(difference).' '.contour_lines.'0.8').(whole ? border_of_wheel : '')
