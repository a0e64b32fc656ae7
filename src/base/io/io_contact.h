/* Input files of CONTACT (module 3).  rollbem/case.h converts them to cases.  As in
 * CONTACT, values that a case does not read keep those of the case before. */
#ifndef ROLLBEM_IO_CONTACT_H
#define ROLLBEM_IO_CONTACT_H

#include "base/base.h"

/* The control digits by their letters; digits without an effect here are not stored. */
typedef struct {
    int P, B, T, N, F, S;
    int V, L, D, C, M, Z, E;
    int H, G, X, R;
} rb_io_contact_digits;

typedef struct {
    int line;   /* of MODULE */
    int module; /* the other fields are read for module 3 only */
    rb_io_contact_digits digit;
    double normal;                 /* FN [N], N = 1; PEN [mm], N = 0 */
    double tangential, side;       /* CKSI or FX, CETA or FY */
    double spin;                   /* CPHI */
    int law;                       /* digit L of the last case that set it */
    double fstat, fkin;            /* friction coefficients at rest and, for the laws L >= 2, at
                                      large slip velocity */
    double fall[2], slip_scale[2]; /* of L = 2, 3, 4: FLIN1, SABSH1 and so on [mm/s] */
    double memory, memory_slip;    /* MEMDST [mm], MEM_S0 [mm/s] */
    double start;                  /* INISLP: slip is looked for from below (> 0), from above (< 0),
                                      from that of the case before (0) */
    double chi;                    /* degrees */
    double dq, velocity;           /* DQ [mm], VELOC [mm/s] */
    double poisson[2], shear[2];   /* POISS, GG [MPa] */
    double ratio[2], time[2];      /* FG, TC [s]; M = 1 */
    double layer_shear, layer;     /* GG3 [MPa], LAYTHK [mm]; M = 4, as the next two */
    double yield, hardening;       /* TAU_C0 [MPa], K_TAU [MPa/mm] */
    int potential;                 /* IPOTCN */
    int mx, my;
    double from, dx, dy;   /* x where the first element begins, DX, DY [mm] */
    double hertz[3];       /* IPOTCN < 0: its three numbers behind MX and MY */
    int base, plan;        /* IBASE, IPLAN */
    double b[6];           /* IBASE = 1 */
    double centre, radius; /* XM, RX1; IBASE = 2 */
    char unread[200];      /* why the case could not be read; "": it was.  Its other members then
                              have no meaning. */
} rb_io_contact_case;

/* All cases up to module 0 or the end.  A case that cannot be read, or that takes over values
 * of one, says so in `unread`; the others are read.  Owned by the caller (free); RB_ENOENT,
 * RB_EFORMAT with file and line where no case can be read, RB_ENOMEM. */
rb_status rb_io_contact_read(const char *path, int *n, rb_io_contact_case **cases, rb_message *why);

#endif
