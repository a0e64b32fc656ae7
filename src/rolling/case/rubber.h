/* Young's modulus of rubber by its hardness [MPa].  A hardness is a force at rest on a blunt
 * point that sinks in deep, and published relations differ by factors of 1.5 to 2: Gent (Rubber
 * Chem. Technol. 31 (1958) 896), BS 903 (part A26), Qi, Joyce and Boyce (Rubber Chem. Technol. 76
 * (2003) 419); for P&J's ball (ASTM D531) ISO 48's law of depths, and Hertz's of small ones. */
#ifndef ROLLBEM_RUBBER_H
#define ROLLBEM_RUBBER_H

#include "base/base.h"

typedef struct {
    const char *name;
    double (*young)(double hardness);
} rb_rubber_relation;

typedef struct {
    const char *name;       /* what a reading is followed by: 60 ShoreA */
    double lowest, highest; /* readings outside mean nothing */
    int relations;
    rb_rubber_relation relation[3];
} rb_rubber_scale;

/* The first relation of each is what a hardness means; as the value of an option that of ShoreA. */
enum { RB_RUBBER_SHORE_A, RB_RUBBER_PJ, RB_RUBBER_SCALES };
extern const rb_rubber_scale rb_rubber_scales[RB_RUBBER_SCALES];

/* The least and the largest modulus by the relations of a scale. */
void rb_rubber_band(const rb_rubber_scale *scale, double hardness, double *least, double *largest);

/* The hardness in ShoreA that has this modulus by the first relation. */
double rb_rubber_shore(double young);

/* 1: text is a hardness, "60ShoreA", "60 shore A"; *shore is its reading, or NAN with what is
 * expected in why.  bare: "60A" and "60" are one as well. */
int rb_rubber_read(const char *text, int bare, double *shore, rb_message *why);

#endif
