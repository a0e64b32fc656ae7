/* The papers that a run rests on, as docs/theory.md 9 has them. */
#include "program/report/report.h"

/* What a run is, as far as papers care. */
enum {
    ALWAYS = 1,
    STATIC = 2,
    ROLLS = 4,
    CARTER = 8,      /* rolls, and Carter's law holds */
    DISSIMILAR = 16, /* rolls, and the bodies differ */
    WHEEL = 32,
    HALFPLANE = 64,
    LEMKE = 128,
    PRESSED = 256 /* at rest in increments */
};

static const struct {
    int number; /* in docs/theory.md 9 */
    int when;
    const char *text;
} papers[] = {
    {1, STATIC,
     "K. Addi, S. Adly, D. Goeleven, M. Thera, A nonsymmetric linear complementarity problem to "
     "solve a quasistatic rolling frictional contact problem, J. Nonlinear Convex Anal. 7 (2006) "
     "315-324."},
    {2, HALFPLANE, "K. L. Johnson, Contact Mechanics, Cambridge University Press, 1985."},
    {3, ALWAYS,
     "B. M. Kwak, S. S. Lee, A complementarity problem formulation for two-dimensional frictional "
     "contact problems, Computers & Structures 28 (1988) 469-480. A. Klarbring, G. Bjorkman, A "
     "mathematical programming approach to contact problems with friction and varying contact "
     "surface, Computers & Structures 30 (1988) 1185-1198."},
    {4, LEMKE,
     "R. W. Cottle, J.-S. Pang, R. E. Stone, The Linear Complementarity Problem, Academic Press, "
     "1992."},
    {5, LEMKE,
     "C. E. Lemke, Bimatrix equilibrium points and mathematical programming, Management Science 11 "
     "(1965) 681-689."},
    {7, CARTER,
     "F. W. Carter, On the action of a locomotive driving wheel, Proc. R. Soc. London A 112 (1926) "
     "151-157."},
    {10, DISSIMILAR,
     "R. H. Bentall, K. L. Johnson, Slip in the rolling contact of two dissimilar elastic rollers, "
     "Int. J. Mech. Sci. 9 (1967) 389-404."},
    {11, ROLLS,
     "J. J. Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, Kluwer, 1990: transient "
     "and steady rolling, CONTACT."},
    {12, WHEEL,
     "C. A. Brebbia, J. Dominguez, Boundary Elements: An Introductory Course, Computational "
     "Mechanics Publications and McGraw-Hill, 1989: Kelvin's solution, Somigliana's identity, "
     "constant elements."},
    {13, ALWAYS,
     "W. Thomson (Lord Kelvin), Note on the integration of the equations of equilibrium of an "
     "elastic solid, Cambridge and Dublin Math. J. 3 (1848) 87-89. A. Flamant, Sur la repartition "
     "des pressions dans un solide rectangulaire charge transversalement, C. R. Acad. Sci. Paris "
     "114 (1892) 1465-1468."},
    {14, PRESSED,
     "D. A. Spence, The Hertz contact problem with finite friction, J. Elasticity 5 (1975) "
     "297-319."},
};

void rb_report_citations(FILE *out, const rb_rolling_case *rc, const rb_rolling_solution *s)
{
    const int is_static = rc->formulation == RB_STATIC;
    const int plane_a = rb_rolling_body_can(&rc->a, RB_BODY_FLAT);
    const int plane_b = rb_rolling_body_can(&rc->b, RB_BODY_FLAT);
    int kind = ALWAYS;
    kind |= is_static ? STATIC : ROLLS;
    if (!is_static)
        kind |= rb_rolling_carter_holds(rc) ? CARTER : DISSIMILAR;
    kind |= plane_a ? HALFPLANE : WHEEL;
    if (rc->elastic_b)
        kind |= plane_b ? HALFPLANE : WHEEL;
    if (s && s->solver == RB_SOLVER_LEMKE)
        kind |= LEMKE;
    if (is_static && rc->increments > 1)
        kind |= PRESSED;
    fputs("This run rests on (numbers of docs/theory.md 9):\n", out);
    for (size_t k = 0; k < sizeof papers / sizeof *papers; k++)
        if (papers[k].when & kind)
            fprintf(out, "[%d] %s\n", papers[k].number, papers[k].text);
    fprintf(out, "rollbem %s itself: CITATION.cff\n", RB_VERSION);
}
