/* What a case is solved for, and which options mean nothing to that. */
#include "rolling/case/internal.h"
#include "rolling/case/words.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char steady_only[] = "a curve needs steady rolling, and so does a fit",
                  no_steps[] = "a design takes cases of one step without error bars";

enum {
    CURVE = 1 << RB_CASE_CURVE,
    SPEEDS = 1 << RB_CASE_SPEEDS,
    STRESS = 1 << RB_CASE_STRESS,
    WEAR = 1 << RB_CASE_WEAR,
    CRACK = 1 << RB_CASE_CRACK,
    STUDY = 1 << RB_CASE_STUDY,
    DESIGN = 1 << RB_CASE_DESIGN
};

#define KINDS_OF_WEAR "wear is of sliding, fretting or steady rolling"
#define VARIES "a curve varies it from --from to --to, a fit takes it from its data"
#define HEAT                                                                                       \
    " mu-heat conductivity heat-capacity temperature conductivity-b heat-capacity-b "              \
    "temperature-b "

/* Options that no case of these purposes takes. */
static const struct {
    int purposes;
    const char *options, *reason; /* options: a blank before and behind each */
} never_taken[] = {
    {CURVE, " shift creep creep-ratio force force-ratio free-axle history ", VARIES},
    {SPEEDS, " speed ", VARIES},
    {CURVE | SPEEDS, " history distance steps irregularity increments time-step ", steady_only},
    {CURVE | SPEEDS, " accuracy ",
     "only for single cases; a curve has --error, and a fit has intervals"},
    {STRESS, " accuracy ", "stress has error bars (--error), but no refinement"},
    {CRACK, " accuracy ", "a crack has error bars (--error), but no refinement"},
    {STUDY, " accuracy ", "a study has error bars (--error), but no refinement"},
    {CURVE | SPEEDS | STRESS | WEAR | CRACK | DESIGN, " fretting cycle ",
     "only of a single case with --history, as `rollbem --history FILE --fretting`, or of a study"},
    {WEAR, " accuracy ", "wear has error bars (--error), but no refinement"},
    {WEAR, " history ", "the cycles have their own"},
    {WEAR, " increments ", "the cycles have their own, --quarter"},
    {WEAR, " distance ", KINDS_OF_WEAR},
    {WEAR, " steps ", KINDS_OF_WEAR "; see --wear-steps"},
    {WEAR, " irregularity ", KINDS_OF_WEAR},
    {WEAR, " time-step relaxation-time relaxation-ratio relaxation-time-b relaxation-ratio-b ",
     "wear is of elastic bodies only"},
    {WEAR, " yield-stress hardening ", "wear has no third body that yields"},
    {WEAR, HEAT, "wear has no temperatures"},
    {DESIGN, " error accuracy history distance steps irregularity increments time-step ",
     no_steps}};

enum { NEVER_TAKEN = sizeof never_taken / sizeof *never_taken };

int rb_case_has_steps(const rb_resolved_case *resolved)
{
    return resolved->program.n > 0 || rb_rolling_has_steps(&resolved->rc);
}

int rb_case_takes(rb_case_purpose purpose, const char *option)
{
    char word[80];
    snprintf(word, sizeof word, " %s ", option);
    for (size_t k = 0; k < NEVER_TAKEN; k++)
        if (never_taken[k].purposes >> purpose & 1 && strstr(never_taken[k].options, word))
            return 0;
    return 1;
}

int rb_case_is_of_tractions(const char *option)
{
    static const char *const kept[] = {
        "layers",    "layers-b",        "young",        "poisson",           "support",
        "similar",   "layer-thickness", "base-young",   "base-poisson",      "young-b",
        "poisson-b", "support-b",       "base-young-b", "base-poisson-b",    "plane",
        "units",     "radius",          "radius-b",     "layer-thickness-b", "gap"};
    for (size_t k = 0; k < sizeof kept / sizeof *kept; k++)
        if (strcmp(option, kept[k]) == 0)
            return 1;
    return 0;
}

rb_status rb_case_check_never_taken(const rb_case *c, rb_message *why)
{
    for (size_t k = 0; k < NEVER_TAKEN; k++)
        for (const char *at = never_taken[k].options + 1;
             *at && never_taken[k].purposes >> c->purpose & 1; at = strchr(at, ' ') + 1) {
            char name[40];
            snprintf(name, sizeof name, "%.*s", (int)strcspn(at, " "), at);
            const rb_status s = rb_case_refuse_given(c, name, never_taken[k].reason, why);
            if (s != RB_OK)
                return s;
        }
    return RB_OK;
}

/* Values that mean nothing to what the case is solved for. */
rb_status rb_case_check_purpose(const rb_case *c, rb_message *why)
{
    const int curve = (CURVE | SPEEDS) >> c->purpose & 1;
    const rb_rolling_formulation formulation = c->resolved.rc.formulation;
    const rb_numbers *mus = &c->resolved.mus;
    /* 0,3 is read as 0 and 3. */
    char one_mu[120] = "expected one number; a curve takes several";
    if (mus->n == 2 && mus->value[0] == floor(mus->value[0]) &&
        mus->value[1] == floor(mus->value[1]))
        snprintf(one_mu, sizeof one_mu,
                 "expected one number, with a decimal point, got %g and %g; a curve takes several",
                 mus->value[0], mus->value[1]);
    const rb_case_rule rules[] = {
        {curve && formulation != RB_STEADY, "formulation", steady_only},
        {c->purpose == RB_CASE_STUDY && formulation == RB_TRANSIENT, "formulation",
         "a study needs static or steady cases"},
        {c->purpose == RB_CASE_STUDY && !c->resolved.rc.fretting, "history",
         "a study has one only with --fretting"},
        {c->purpose == RB_CASE_WEAR && formulation == RB_TRANSIENT, "formulation", KINDS_OF_WEAR},
        {c->purpose == RB_CASE_WEAR, "period", "wear is that of one contact alone"},
        {c->resolved.rc.gap == RB_GAP_WAVE, "radius",
         "that of a wave's crest follows from --period and --amplitude"},
        {c->purpose == RB_CASE_DESIGN && formulation == RB_TRANSIENT, "formulation", no_steps},
        {!curve && mus->n > 1, "mu", one_mu},
        {rb_rolling_slides_on_base(&c->resolved.rc), "history",
         "not on a smooth base: nothing holds the layer from step to step"},
        {rb_case_has_steps(&c->resolved), "accuracy",
         "only for static and steady cases without steps"}};

    return rb_case_refuse_by(c, sizeof rules / sizeof *rules, rules, why);
}
