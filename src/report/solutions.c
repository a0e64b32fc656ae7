/* Solutions of one case that differ (rb_rolling_find_solutions). */
#include "report/internal.h"

#include <jansson.h>

json_t *rb_report_json_solutions(const rb_rolling_solutions *all)
{
    json_t *list = json_array();
    for (int k = 0; k < all->n; k++) {
        json_t *one = json_object();
        rb_report_json_set(&one, "summary", rb_report_json_summary(&all->solution[k]));
        rb_report_json_set(&one, "table", rb_report_json_table(&all->solution[k]));
        rb_report_json_append(&list, one);
    }
    return list;
}

void rb_report_solutions(FILE *out, const rb_rolling_solutions *all)
{
    fprintf(out, "%d solution%s from %d starts, %d of which did not converge\n", all->n,
            all->n == 1 ? "" : "s that differ", all->starts, all->failed);
    for (int k = 0; k < all->n; k++) {
        const rb_rolling_solution *s = &all->solution[k];
        fprintf(out,
                "  %-3d Q/(mu P) = %.6g, %d stick, %d slip, stick %.5g ... %.5g %s, "
                "residual %.2g\n",
                k + 1, s->force_ratio, s->stick, s->slipping, s->stick_from, s->stick_to,
                rb_unit_name(s->units, "mm"), s->residual);
    }
}
