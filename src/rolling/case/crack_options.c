/* The options of a crack, which a case takes as a second set. */
#include "rolling/case/words.h"

#include <math.h>
#include <stddef.h>

#define PLACE(member) offsetof(rb_case_crack, member)
#define OR_LENGTH(name) .lengths = PLACE(in_mm), .length_bit = RB_CRACK_##name

static const rb_choice fluids[] = {{"none", RB_CRACK_DRY},
                                   {"trapped", RB_CRACK_TRAPPED},
                                   {"pressure", RB_CRACK_PRESSURE},
                                   {NULL, 0}};

static const rb_choice closings[] = {{"position", 0}, {"located", 1}, {NULL, 0}};
static const rb_choice ranges[] = {
    {"mixed", RB_CRACK_MIXED}, {"mode-II", RB_CRACK_MODE_II}, {NULL, 0}};
static const rb_choice directions[] = {{"coplanar", 0}, {"tension", 1}, {NULL, 0}};

const rb_option rb_case_crack_options[] = {
    RB_GROUP_LINE("crack",
                  "Crack in B; lengths in half-widths of the contact, or with a unit: 0.05mm"),
    RB_NUMBER_LINE("crack-length", PLACE(length), "a", RB_ABOVE(0), "along the crack",
                   OR_LENGTH(LENGTH)),
    RB_NUMBER_LINE("crack-angle", PLACE(angle), "degrees", RB_ANY,
                   "to the surface; below 90 the tip points to +x, where A rolls"),
    RB_NUMBER_LINE("crack-mouth", PLACE(mouth), "a", RB_ANY, "x of its mouth, or of its upper end",
                   OR_LENGTH(MOUTH)),
    RB_NUMBER_LINE("crack-depth", PLACE(depth), "a", RB_FROM(0),
                   "of its upper end below the surface; 0: it has a mouth", OR_LENGTH(DEPTH)),
    RB_NUMBER_LINE("crack-friction", PLACE(friction), "-", RB_FROM(0),
                   "coefficient of friction between its faces"),
    RB_INTEGER_LINE("crack-elements", PLACE(elements), RB_FROM_TO(4, 2000),
                    "along the crack, graded towards both ends"),
    RB_NUMBER_LINE("from", PLACE(from), "a", RB_ANY,
                   "first position of the contact; of a static history the only one",
                   .unset = "6 a before the mouth; of a static history 0", OR_LENGTH(FROM)),
    RB_NUMBER_LINE("to", PLACE(to), "a", RB_ANY,
                   "last position; --steps says in how many equal steps; unless given, steps "
                   "follow the length of the crack and crowd where K is largest",
                   .unset = "6 a behind the mouth; of a transient as far as it rolls",
                   OR_LENGTH(TO)),
    RB_INTEGER_LINE("passes", PLACE(passes), RB_FROM_TO(1, 1000),
                    "the same load passes again; results are those of the last pass"),
    RB_CHOICE_LINE("fluid", PLACE(fluid), fluids,
                   "in the crack: none, trapped where its mouth closes "
                   "(incompressible), or the pressure of the contact at its mouth"),
    RB_CHOICE_LINE("closing", PLACE(locate_closing), closings,
                   "trapped fluid: its volume is that of the last position with an open "
                   "mouth (Bower), or that of the place between two positions where the "
                   "mouth closes"),
    RB_NUMBER_LINE("remote-stress", PLACE(remote_stress), "MPa", RB_ANY,
                   "uniform stress in B along the surface, tension > 0; low,high: a cycle "
                   "without contact",
                   .list = PLACE(remote_stresses)),
    RB_FLAG_LINE("unloaded", PLACE(unloaded), "that stress alone, without a contact"),
    RB_FLAG_LINE("coupled", PLACE(coupled),
                 "frictionless contact that depends on the crack: both are solved together"),
    RB_NUMBER_LINE("paris", PLACE(paris), "-", RB_ABOVE(0),
                   "C,m: the crack grows by da/dN = C dK^m a pass, in the units of length "
                   "and K",
                   .unset = "it does not grow", .list = PLACE(paris_law)),
    RB_CHOICE_LINE("paris-range", PLACE(paris_range), ranges,
                   "dK of that law: (dK_I^4 + 8 dK_II^4)^(1/4) (Tanaka), or dK_II"),
    RB_NUMBER_LINE("threshold", PLACE(threshold), "MPa.mm^0.5", RB_FROM(0),
                   "dK below which it rests"),
    RB_CHOICE_LINE("growth", PLACE(tension), directions,
                   "straight ahead, or perpendicular to the largest tension ahead of the "
                   "tip over a pass (Erdogan and Sih)"),
    RB_NUMBER_LINE("grow-to", PLACE(grow_to), "a", RB_ABOVE(0), "length where it ends",
                   .unset = "twice the length", OR_LENGTH(GROW_TO)),
    RB_INTEGER_LINE("grow-steps", PLACE(grow_steps), RB_FROM_TO(1, 60),
                    "increments of that growth"),
};
const int rb_case_crack_options_n = sizeof rb_case_crack_options / sizeof rb_case_crack_options[0];

_Static_assert(sizeof rb_case_crack_options / sizeof rb_case_crack_options[0] <=
                   CASE_CRACK_OPTIONS_MAX,
               "given");

rb_option_set rb_case_crack_set(rb_case *c)
{
    if (!c->crack.is_taken)
        c->crack.words = c->crack.resolved = rb_case_crack_defaults();
    c->crack.is_taken = 1;
    return (rb_option_set){rb_case_crack_options, rb_case_crack_options_n, &c->crack.words,
                           c->crack.given, c->crack.plain};
}

const rb_case_crack *rb_case_crack_of(const rb_case *c)
{
    return c->crack.is_taken && c->purpose == RB_CASE_CRACK ? &c->crack.resolved : NULL;
}

rb_case_crack rb_case_crack_defaults(void)
{
    return (rb_case_crack){.length = 1.0,
                           .angle = 30.0,
                           .friction = 0.1,
                           .elements = 40,
                           .from = NAN,
                           .to = NAN,
                           .passes = 1,
                           .paris = NAN,
                           .grow_to = NAN,
                           .grow_steps = 10};
}
