/* What several notes ask, and how they write their sentence. */
#include "rolling/notes/note.h"
#include "rolling/case/internal.h"
#include "rolling/solve/solution.h"
#include "rolling/solve/zone.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

int rb_rolling_write_note(char *text, const char *format, ...)
{
    va_list args;
    void *before = rb_locale_begin();
    va_start(args, format);
    vsnprintf(text, RB_ROLLING_NOTE_LENGTH, format, args);
    va_end(args);
    rb_locale_end(before);
    return 1;
}

double rb_rolling_widest_patch(const rb_rolling_solution *s)
{
    double widest = s->patches > 0 ? 0.0 : s->half_width;

    for (int k = 0; k < s->patches; k++)
        widest = fmax(widest, 0.5 * (s->patch[k].to - s->patch[k].from));
    return widest;
}

int rb_rolling_creepage_is_given(const rb_rolling_case *rc)
{
    return !isnan(rc->creep) || !isnan(rc->creep_ratio);
}
