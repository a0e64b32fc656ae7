/* Young's modulus of rubber by its hardness [MPa].  A hardness is a force at rest on a blunt
 * point that sinks in deep, and published relations differ by factors of 1.5 to 2: Gent (Rubber
 * Chem. Technol. 31 (1958) 896), BS 903 (part A26), Qi, Joyce and Boyce (Rubber Chem. Technol. 76
 * (2003) 419). */
#ifndef ROLLBEM_RUBBER_H
#define ROLLBEM_RUBBER_H

#include "base/base.h"

enum { RB_RUBBER_RELATIONS = 3 };

typedef struct {
    const char *name;
    double (*young)(double shore);
} rb_rubber_relation;

/* The first one is what a hardness means as the value of an option. */
extern const rb_rubber_relation rb_rubber_relations[RB_RUBBER_RELATIONS];

/* Outside of these they mean nothing [Shore A]. */
#define RB_RUBBER_SOFTEST 20.0
#define RB_RUBBER_HARDEST 90.0

/* The largest of them over the least. */
double rb_rubber_band(double shore);

/* The hardness that has this modulus by the first relation. */
double rb_rubber_shore(double young);

/* 1: text is a hardness, "60ShoreA", "60 shore A"; *young is its modulus, or NAN with what is
 * expected in why. */
int rb_rubber_read(const char *text, double *young, rb_message *why);

#endif
