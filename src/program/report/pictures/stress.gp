# Contours of the in-plane shear and of von Mises below the surface, in a column of print below each other.
# $table: the points of the grid, NaN outside the body; $zones: where the bodies touch, zone by zone;
# $numbers1, $numbers2: the numbers at the contours.  of(k, NAME): what panel k has.
beside = surface_above ? 1.018 : -0.018
eval set_field
set contour base
if (!filled) unset colorbox
set multiplot
of(k, name) = value(sprintf('%s%d', name, k))
top(k) = of(k, 'middle') + of(k, 'height') / 2
show_x = "set xlabel x_label offset 0,0.2"
show_y = "set label 5 y_label at screen of(k, 'left') - (titled ? 0.073 : 0.145), of(k, 'middle') center rotate"
shown(k) = column((k == 1 ? 'max_shear_' : 'von_mises_').MPa) / stress_unit
field(k) = sprintf("using (column('x_'.mm) / x_unit):(column('y_'.mm) / y_unit):(shown(%d))", k)
if (titled) set label 1 title at screen 0.5, top(1) + 0.18 center
if (titled) set label 9 bodies at screen 0.5, top(1) + 0.12 center textcolor rgb '#444444'
if (titled && contact ne '') set label 4 '{/*0.8 '.contact.'}' at screen 0.5, 0.025 center textcolor rgb '#444444'
do for [k=1:2] {
    if (titled || k == 2) { eval show_x }
    if (k == 1 || !titled) { eval show_y } else { unset label 5 }
    set lmargin at screen of(k, 'left')
    set rmargin at screen of(k, 'left') + of(k, 'width')
    set bmargin at screen top(k) - of(k, 'height')
    set tmargin at screen top(k)
    set xtics of(k, 'x_step')
    set ytics of(k, 'y_step')
    set cbtics of(k, 'scale_step')
    if (filled) { set colorbox user origin of(k, 'left') + of(k, 'width') + 0.012, top(k) - of(k, 'height') size 0.013, of(k, 'height') }
    # the value of the maximum stands in the title, where it covers no contour's
    set label 2 (k == 1 ? 'in-plane shear' : 'von Mises').stress_axis.',  largest '.of(k, 'largest_text').' at +' at screen of(k, 'left') + of(k, 'width') / 2, top(k) + (titled ? 0.05 : 0.03) center
    set label 3 '' at first of(k, 'largest_x'), first of(k, 'largest_y') point pointtype 1 pointsize 1.6 linewidth 1.6 linecolor rgb '#111111' front
    set cbrange [0:of(k, 'level_step') * ceil(of(k, 'last') / of(k, 'level_step'))]
    set cntrparam levels incremental of(k, 'level_step'), of(k, 'level_step'), of(k, 'last')
    eval 'splot '.(filled ? '$table '.field(k).' with pm3d nocontour, ' : '').'$table '.field(k).' '.contour_lines.'0.6, '.sprintf('$numbers%d ', k).contour_numbers.' number_font'.(whole ? border_of_wheel : '')
    unset label 1
    unset label 4
    unset label 9
}
unset multiplot
