/* The shakedown map: the largest pressure for elastic behaviour under repeated
 * rolling. */
#include "report/internal.h"

#include "rollbem/closed_forms.h"

#include <math.h>

static void write_script(FILE *out, rb_report_canvas canvas, const void *context)
{
    enum { POINTS = 60 };
    const rb_report_stress *s = context;
    const double traction = fabs(s->s->tangential_load / s->s->normal_load);
    const double most = fmax(0.6, 1.2 * traction);
    const double own = s->s->max_pressure / s->yield_shear;
    const double limit = s->s->max_pressure / s->shakedown->shear_yield;

    fputs("$limit << EOD\n", out);
    for (int k = 0; k <= POINTS; k++)
        fprintf(out, "%.9g %.9g\n", most * k / POINTS,
                rb_closed_shakedown_limit(most * k / POINTS));
    fprintf(out, "EOD\n$case << EOD\n%.9g %.9g\nEOD\n", traction, limit);
    if (isfinite(own))
        fprintf(out, "$own << EOD\n%.9g %.9g\nEOD\n", traction, own);
    const rb_report_place place = rb_report_place_of(canvas);
    const rb_report_unit stress = rb_report_axis_unit(s->s->units, "MPa", s->s->max_pressure);
    rb_report_room(out, 0.12 + place.right, 0.965, 0.14, 0.92);
    fputs(RB_REPORT_GRID "set xlabel 'traction  |Q|/P'\nset ylabel 'p_0 / k' offset 1,0\n", out);
    fprintf(out, "set xrange [0:%.9g]\nset yrange [0:%.9g]\n", most,
            fmax(5.0, isfinite(own) ? 1.1 * own : 0.0));
    if (place.titled)
        fprintf(out,
                "set label 1 '{/:Bold Shakedown}   p_0 = %.5g %s,  p_0 ≤ %.4g k shakes down' "
                "at screen 0.54, 0.955 center\n",
                s->s->max_pressure / stress.size, stress.name, limit);
    fprintf(out, "set key right top samplen 2 font ',%.3g'\n", rb_report_key_font(canvas));
    fputs("plot $limit using 1:2 with lines linecolor rgb '#1f4e79' linewidth 2.4 title "
          "'limit, full sliding (Johnson)', $case using 1:2 with points pointtype 7 "
          "pointsize 1.6 linecolor rgb '#c0392b' title 'limit of this case'",
          out);
    if (isfinite(own))
        fputs(", $own using 1:2 with points pointtype 2 pointsize 2 linewidth 2 linecolor "
              "rgb '#111111' title 'p_0 of this case'",
              out);
    fputs("\n", out);
}

rb_status rb_report_shakedown_map(FILE *out, rb_report_canvas canvas, const rb_report_stress *s,
                                  rb_message *why)
{
    if (!s->shakedown || !(s->s->normal_load > 0.0))
        return rb_fail(why, RB_EINVAL, "no contact to draw");
    return rb_report_draw(out, canvas, RB_REPORT_FOUR_THIRDS, write_script, s, why);
}
