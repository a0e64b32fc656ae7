/* Whatever the program says in words is true of the state as solved: each sentence has a case
 * that must say it and a near one that must not. */
#include "cli_run.h"
#include "rollbem/api.h"
#include "rolling/rolling.h"

#include <gsl/gsl_math.h>

#define STEEL "--similar --support halfplane --gap parabola --young 210000 --poisson 0.3 "
#define CARTER STEEL "--radius 100 --half-width 1 --mu 0.3 --contact-elements 24 "
#define ROLLS CARTER "--formulation steady "
#define FRETS CARTER "--formulation static "
#define PLANE "--support halfplane --gap parabola --young 210000 --poisson 0.3 --radius 100 "
#define ROLL "--formulation steady --creep 0 --contact-elements 40 "
#define LAYER                                                                                      \
    "--support halfplane --gap parabola --young 8 --poisson 0.48 --radius 60 --mu 0.3 "            \
    "--load 2 --formulation steady --force 0 --contact-elements 24 "
#define SOFT                                                                                       \
    "--support halfplane --gap parabola --young 1e8 --poisson 0.3 --radius 100 --load 10 "         \
    "--mu 0.3 --contact-elements 40 "
#define ROOF                                                                                       \
    "--similar --support halfplane --young 210000 --poisson 0.3 --radius 100 --mu 0 "              \
    "--gap roof.txt "
#define SPEEDS                                                                                     \
    "curve --over speed --support halfplane --young 10 --poisson 0.3 --load 0.1 --mu 0.1 "         \
    "--relaxation-time 0.01 --relaxation-ratio 1 --from 1 --to 100 --points 2 "
#define PASSES CARTER "--formulation transient --creep-ratio 0.3 --distance 0.1 "
#define FALLS                                                                                      \
    ROLLS "--creep-ratio 0.5 --friction-law exponential --mu-fall 0.2 --speed 1000 --slip-scale "

#define HALF                                                                                       \
    "--support halfplane --gap parabola --young 210000 --radius 100 --load 100 "                   \
    "--contact-elements 24 "
#define RELAXES                                                                                    \
    "--support halfplane --gap parabola --young 10 --poisson 0.5 --radius 1000 --half-width 1 "    \
    "--mu 0 --formulation transient --creep 0 --relaxation-time 1 --relaxation-ratio 1 "           \
    "--speed 1 --contact-elements 24 "
#define GIVES                                                                                      \
    STEEL "--radius 300 --half-width 6 --mu 0.3 --formulation transient --creep 1e-5 "             \
          "--interlayer-tangential 1 --contact-elements 24 "
#define SLIDES CARTER "--formulation transient --creep-ratio 2 "
#define SWINGS "--formulation transient --history swings.txt --contact-elements 24"
#define CRACKED                                                                                    \
    "crack " CARTER "--formulation static --crack-length 0.5 --crack-angle 60 "                    \
    "--crack-elements 8 "
#define PUSHED                                                                                     \
    STEEL "--radius 100 --half-width 1 --mu 0.2 --friction-law exponential --mu-fall 0.1 "         \
          "--formulation static --contact-elements "
#define UNLIKE                                                                                     \
    "--support halfplane --gap parabola --radius 67.55 --young 43582 --poisson 0.357 "             \
    "--young-b 16374 --poisson-b 0.04 --mu 0.134 --formulation static --contact-elements "
#define HISTORY STEEL "--radius 100 --formulation static --contact-elements 24 --history light.txt "
#define CAPPED CARTER "--contact-elements 60 --mu 100 --yield-stress 100 "
#define FALLING                                                                                    \
    CARTER "--friction-law exponential --mu-fall 0.2 --slip-scale 1 --speed 1000 "                 \
           "--formulation steady "
#define PLACES STEEL "--radius 100 --load 1000 --contact-elements 24 --friction-law places.txt "

/* `says` prints the words to standard error, and `silent` is solved without them.  Of notes
 * `name` is that of rb_rolling_note_name; others are named here. */
typedef struct {
    const char *name, *words, *says, *silent;
} sentence;

static const sentence notes[] = {
    {"wide-arc", "The contact spans 21.1 degrees of the journal",
     STEEL "--radius 100 --radius-b -101 --load 3000 --mu 0.3 " ROLL,
     STEEL "--radius 100 --radius-b -101 --load 500 --mu 0.3 " ROLL},
    {"wide-arc", "The contact spans 25.9 degrees of body A",
     PLANE "--mu 0 --approach 2.5 --interlayer-normal 0.1",
     PLANE "--mu 0 --approach 0.3 --interlayer-normal 0.1"},
    {"strains", "The strains are far beyond linear elasticity", "--mu 0.3 --contact-elements 20",
     STEEL "--radius 100 --half-width 1 --mu 0.3"},
    {"strains", "The strains are large for linear elasticity",
     STEEL "--radius 100 --half-width 11 --mu 0.3", STEEL "--radius 100 --half-width 9 --mu 0.3"},
    /* what gives way is a third body, and no strain of the bodies */
    {"strains", "The strains are large", PLANE "--mu 0 --approach 2.5",
     PLANE "--mu 0 --approach 2.5 --interlayer-normal 0.1"},
    {"strains", "far beyond linear elasticity (bulk strain = 0.43)",
     STEEL "--radius 100 --load 100 --mu 0.3 --bulk-stress 1e5",
     STEEL "--radius 100 --load 100 --mu 0.3 --bulk-stress 1e4"},
    {"large-tilt",
     "The tilt of 0.2 is not a small angle: expect errors of the order of its square, 0.04",
     STEEL "--radius 100 --load 100 --mu 0.3 --tilt 0.2",
     STEEL "--radius 100 --load 100 --mu 0.3 --tilt 0.09"},
    {"thin-and-strained", "is compressed by 10 % of its thickness",
     LAYER "--layer-thickness 0.5 --load 20", LAYER "--layer-thickness 0.5"},
    {"flat-layer",
     "rolls freely at a creepage that is higher by about 0.00055 (much friction) to 0.0015 "
     "(little)",
     LAYER "--layer-thickness 1.2", LAYER "--layer-thickness 0.5"},
    {"flat-layer",
     "The layer of B is computed as flat at thickness/R = 0.02. A round cover rolls "
     "freely at a creepage that is lower by about",
     LAYER "--young-b 8 --poisson-b 0.48 --radius-b 60 --layer-thickness-b 1.2",
     LAYER "--support hub --cover-thickness 1.2"},
    {"near-datum", "other solutions exist for the same shift",
     FRETS "--datum 0.1 --datum-b 0.1 --shift 0.001", FRETS "--shift 0.001"},
    {"near-datum", "The approach is negative", FRETS "--datum 0.1 --datum-b 0.1 --force 1",
     FRETS "--datum 1 --datum-b 1 --force 1"},
    {"base-pulls", "the smooth base pulls at its layer",
     "--support halfplane --gap parabola --young 1000 --poisson 0.3 --radius 50 --mu 0 --load 1 "
     "--layer-thickness 0.3 --layer-base smooth",
     "--support halfplane --gap parabola --young 1000 --poisson 0.3 --radius 50 --mu 0 --load 1 "
     "--layer-thickness 200 --layer-base smooth"},
    {"short-memory", "the bodies relax so much that under the given approach",
     "--support halfplane --gap parabola --young 1 --poisson 0.4 --radius 50 --mu 0 "
     "--approach 0.5 --relaxation-time 0.5 --relaxation-ratio 10 --formulation transient "
     "--speed 1 --creep 0 --contact-elements 16 --distance 0.5",
     "--support halfplane --gap parabola --young 1 --poisson 0.4 --radius 50 --mu 0 "
     "--approach 0.5 --relaxation-time 100 --relaxation-ratio 10 --formulation transient "
     "--speed 1 --creep 0 --contact-elements 16 --distance 0.5"},
    {"pressed-corners", "The worn table has corners in the contact",
     FRETS "--mu 0 --mesh uniform --worn corners.txt",
     FRETS "--mu 0 --mesh uniform --worn flat.txt"},
    {"pressed-corners", "The gap has corners in the contact, where the pressure is infinite",
     ROOF "--load 100", ROOF "--load 100 --gap parabola.txt"},
    {"punch-corners", "p0 is the mean of the last element",
     ROOF "--load 10 --mesh punch --gap flat.txt",
     ROOF "--load 10 --mesh punch --gap parabola.txt"},
    {"coarse-elements", "give 340 --contact-elements for 60",
     FRETS "--mu 0 --mesh uniform --worn saw.txt --contact-elements 60",
     FRETS "--mu 0 --mesh uniform --worn saw.txt --contact-elements 250"},
    {"gap-corners", "The table of --gap has 1 corner, at x = 0 mm: the slope", ROOF "--load 100",
     ROOF "--load 100 --gap parabola.txt"},
    {"irregularity-corners",
     "The table of --irregularity has 3 corners, at x = 0.5, 0.6 and 0.9 mm",
     PASSES "--irregularity step.txt", PASSES "--irregularity bump.txt"},
    {"gap-rows",
     "The table of --gap has 4 rows, too few around 2 of them to tell corners from curves",
     ROOF "--load 100 --gap chamfer.txt", ROOF "--load 100"},
    {"irregularity-rows", "The table of --irregularity has 11 rows, too few around 1 of them",
     PASSES "--irregularity step.txt", PASSES "--irregularity bump.txt"},
    /* from hardly any contact to one of 150 elements within a row */
    {"row-of-steps", "Row 2 of the history is not certain: twice the steps still change",
     STEEL "--radius 100 --mu 0.5 --formulation static --contact-elements 200 --history sudden.txt",
     STEEL
     "--radius 100 --mu 0.5 --formulation static --contact-elements 40 --history gradual.txt"},
    {"jumps",
     "In row 3 of the history the contact jumps to full sliding, at shift 0.006 mm, "
     "force -194.9 N/mm",
     PUSHED "40 --memory 5e-5 --history pushed.txt",
     PUSHED "40 --memory 3e-3 --history pushed.txt"},
    {"not-unique-row",
     "In step 1 nothing is held, and elements slide towards both sides: its shift",
     "--support halfplane --mu 0.01 --contact-elements 20 --history drawn.txt",
     "--support halfplane --mu 0.01 --contact-elements 19 --history drawn.txt"},
    {"not-unique-row",
     "In step 1 nothing is held, and elements slide towards both sides: its shift",
     "--support halfplane --mu 0.01 --yield-stress 1 --contact-elements 20 --history little.txt",
     "--support halfplane --mu 0.01 --yield-stress 1 --hardening 100 --contact-elements 20 "
     "--history little.txt"},
    /* in one of the steps that a row takes: its end holds an element */
    {"not-unique-row",
     "In step 1 nothing is held, and elements slide towards both sides: its shift",
     UNLIKE "24 --load 1.71844 --history pulled.txt",
     UNLIKE "25 --load 1.71844 --history pulled.txt"},
    {"stick-edge", "The pressure is singular at the edge of what sticks and does not wear",
     "wear " STEEL "--radius 100 --mu 0.5 --load 100 --force-ratio 0.6 --cycles 1e6 "
     "--wear-coefficient 1e-8 --wear-steps 2 --quarter 2 --contact-elements 40",
     "wear " STEEL "--radius 100 --mu 0.5 --load 100 --shift 0.3 --cycles 1e3 "
     "--wear-coefficient 1e-8 --wear-steps 2 --quarter 2 --contact-elements 40"},
    {"coarse-fall",
     "Friction falls over 0.1 mm of the surface behind the edge of stick, and the elements are "
     "longer, 0.17 mm: give 34 --contact-elements",
     PUSHED "20 --memory 5e-5 --shift 0.003", PUSHED "34 --memory 5e-5 --shift 0.003"},
    {"static-creepage", "In a static case --creep does not change the tractions",
     FRETS "--creep 0.001", FRETS "--shift 0.001"},
    {"no-creepage", "the wheel rolls at creepage 0", ROLLS, ROLLS "--force 0"},
    {"strip-of-ellipse", "The strip through the middle of the ellipse has its half-width",
     STEEL "--radius 100 --mu 0 --wheel-load 1000 --transverse-radius 50",
     STEEL "--radius 100 --mu 0 --load 100"},
    {"slope-of-strips", "At small creepage strips give 18 % less creep force than the ellipse",
     STEEL "--radius 100 --mu 0.3 --creep 0 --wheel-load 1000 --transverse-radius 100 " ROLL,
     STEEL "--radius 100 --mu 0.3 --creep 0 --wheel-load 1000 --transverse-radius 9000 " ROLL},
    {"strained-creepage", "the bulk stresses shift every creepage by 0.000433",
     STEEL "--radius 100 --load 100 --mu 0.3 --creep 0 --bulk-stress 100 " ROLL,
     STEEL "--radius 100 --load 100 --mu 0.3 --creep 0 " ROLL},
    {"strained-creepage", "the bulk stresses shift every creepage by 0.000433",
     STEEL "--radius 100 --load 100 --mu 0.3 --creep 0 --bulk-stress 100 --formulation transient "
           "--distance 1",
     STEEL
     "--radius 100 --load 100 --mu 0.3 --creep 0 --bulk-stress 100 --bulk-stress-b 100 " ROLL},
    {"slips-both-ways", "The contact slips in both directions",
     STEEL "--radius 100 --max-pressure 1000 --mu 0.5 --force-ratio 0.6 --bulk-stress-b 1250",
     STEEL "--radius 100 --max-pressure 1000 --mu 0.5 --force-ratio 0.6 --bulk-stress-b 500"},
    {"percent",
     "xi = 0.1 is far beyond full sliding, which begins at 0.00296. If the creepage is "
     "meant in per cent, write --creep 0.1%",
     ROLLS "--creep 0.1", ROLLS "--creep 0.05"},
    {"percent", "begins at -0.00296.", ROLLS "--creep -0.1", ROLLS "--creep-ratio 30"},
    /* the third body holds most of the contact */
    {"percent", "far beyond full sliding", ROLLS "--creep 0.1",
     SOFT "--interlayer-normal 0.2 --interlayer-tangential 0.4 --formulation steady --creep 0.01"},
    {"percent", "far beyond full sliding", ROLLS "--creep 0.1",
     ROLLS "--creep 0.1 --yield-stress 1"},
    {"radians", "The arc is 1.5 degrees. If it is meant in radians, write --arc 1.5rad",
     "--mu 0 --approach 0.01 --arc 1.5 --contact-elements 20",
     "--mu 0 --approach 0.01 --arc 2 --contact-elements 20"},
    {"other-units",
     "p0 = 8.94e+08 MPa is more than diamond bears, 1e+05 MPa. If the numbers are in m, N/m and Pa",
     "--similar --support halfplane --gap parabola --young 2.1e11 --poisson 0.3 --radius 0.46 "
     "--load 1e7 --mu 0",
     "--similar --support halfplane --gap parabola --young 2.1e11 --poisson 0.3 --radius 0.46 "
     "--load 1e7 --mu 0 --units si"},
    {"other-units", "The load presses a stiff body flat (a = 0.6 R). If the numbers are in m, N/m",
     "--support halfplane --gap parabola --young 2.1e5 --poisson 0.3 --radius 0.46 --load 3e4 "
     "--mu 0",
     "--support halfplane --gap parabola --young 2.1e5 --poisson 0.3 --radius 0.46 --load 1e4 "
     "--mu 0"},
    {"not-unique", "The whole contact slides: the creepage is not unique", ROLLS "--force-ratio 1",
     ROLLS "--force-ratio 0.99"},
    {"not-unique", "slide towards both sides: the shift is not unique",
     "--support halfplane --load 100 --mu .01 --force 0 --contact-elements 40",
     "--support halfplane --load 100 --mu .01 --force-ratio 1 --contact-elements 40"},
    {"not-unique", "slide towards both sides: the shift is not unique",
     "--support halfplane --load 100 --mu .01 --force 0 --yield-stress 1 --contact-elements 40",
     "--support halfplane --load 100 --mu .01 --force 0 --yield-stress 1 --hardening 100 "
     "--contact-elements 40"},
    {"not-unique", "The whole contact slides", ROLLS "--force-ratio -1",
     ROLLS "--force 40 --yield-stress 10 --hardening 1e5"},
    {"steep-fall", "other solutions may exist", FALLS "0.1", FALLS "100"},
    {"angle-of-arc", "depends on the angle of the wheel",
     "--mu 0.1 --approach 0.01 --formulation steady --creep 0 --contact-elements 20",
     "--mu 0.1 --approach 0.01 --shift 0.001 --contact-elements 20"},
    {"angle-of-arc", "depends on the angle of the wheel",
     STEEL "--support-b arc --radius-b 60 --half-width 1 --mu 0.3 " ROLL,
     STEEL "--support-b hub --radius-b 60 --half-width 1 --mu 0.3 " ROLL},
    {"yields", "The interface yields", ROLLS "--creep-ratio 0.5 --yield-stress 10",
     ROLLS "--creep-ratio 0.5 --yield-stress 1000"},
    {"equal-elements", "Elements could not be fitted to the contact edges",
     ROLLS "--creep 0 --mesh aligned --contact-elements 12 --slip-operator upstream --zone 1.85",
     ROLLS "--creep 0 --mesh aligned --contact-elements 12"},
    /* a flat punch, and where the pressure falls to zero */
    {"uncertain-edge", "The pressure ends abruptly at the edge x = -",
     PLANE "--mu 0 --gap punch.txt --load 1000",
     PLANE "--mu 0 --gap round.txt --load 1000 --contact-elements 40"},
    {"uncertain-edge", "Only 3 elements carry the contact that begins at x = -",
     CARTER "--mesh uniform --contact-elements 9 --zone 3", CARTER},
    {"uncertain-edge", "edge", PLANE "--mu 0 --gap punch.txt --load 1000",
     SOFT "--interlayer-normal 0.2 --interlayer-tangential 0.4 --formulation steady --creep 0.01"},
    {"negative-power",
     "is below zero: it is smaller than its error on these elements; take more "
     "of them or --mesh aligned",
     "--support halfplane --layer-thickness 2 --young-b 2e5 --interlayer-normal 2e-6 "
     "--interlayer-tangential 1e-6 --half-width 1 --contact-elements 24 --formulation steady "
     "--creep 0 --mesh uniform",
     "--support halfplane --layer-thickness 2 --young-b 2e5 --interlayer-normal 2e-6 "
     "--interlayer-tangential 1e-6 --half-width 1 --contact-elements 24 --formulation steady "
     "--creep 0 --mesh aligned"},
    {"short-slip", "which the force drives, is shorter than an element",
     ROLLS "--force-ratio 0.0011 --mesh uniform", ROLLS "--force-ratio 0.0009 --mesh uniform"},
    {"slip-violations", "the slip computed afterwards points along the friction",
     FRETS "--force-ratio -0.5 --creep 0.001", FRETS "--force-ratio -0.5"},
};

/* Studies say what each of their rows would say, once, and of how many rows it is true. */
static const sentence studies[] = {
    {"static-creepage", "use --formulation steady to roll. (all 3 cases)\n",
     "sweep " FRETS "--vary-1 'creep-ratio 0.1 0.2 0.3'", "sweep " FRETS "--vary-1 'mu 0.1 0.2'"},
    {"percent", "write --creep 0.1%. (case 2 and 1 other of 3)\n",
     "sweep " ROLLS "--vary-1 'creep 0.001 0.1 0.2'", "sweep " ROLLS "--vary-1 'creep 0 0.001'"},
    {"strains", "expect errors of that order. (case 3 of 3)\n",
     "sweep " STEEL "--radius 100 --vary-1 'half-width 1 2 11'",
     "sweep " STEEL "--radius 100 --vary-1 'half-width 1 2 3'"},
    {"strains", "expect errors of that order. (all 4 points)\n",
     "curve " STEEL "--radius 100 --half-width 11 --mu 0.1,0.2 --points 2 --contact-elements 20",
     "curve " CARTER "--points 2"},
    /* of the first point, not of the last */
    {"short-slip", "take more of them. (point 1 of 3)\n",
     "curve " CARTER "--from 0.001 --to 1 --points 3", "curve " CARTER "--points 3"},
    {"Body B is rigid",
     "Body B is rigid for the contact: K are the limits of a body that is much "
     "stiffer than A. (all 2 cases)\n",
     "sweep " PLANE "--half-width 1 --mu 0 --contact-elements 20 --crack-elements 4 "
     "--vary-1 'crack-length 0.5 1'",
     "sweep " CARTER "--mu 0 --crack-elements 4 --vary-1 'crack-length 0.5 1'"},
    /* E and nu are given in each case, or in none */
    {"material", "nu = 0.1 is that of the built-in example; give both (all 2 cases)\n",
     "sweep " HALF "--vary-1 'mu 0.1 0.2'", "sweep " HALF "--vary-1 'poisson 0.2 0.3'"},
    {"material", "nu = 0.1 is that of the built-in example; give both\n",
     HALF "--base-young 1e6 --layer-thickness 1 --poisson 0.3",
     HALF "--base-young 1e6 --layer-thickness 1 --poisson 0.3 --base-poisson 0.3"},
    /* of steps, to the end of the way: what relaxes, what gives way, what goes to and fro */
    {"steady", "; steady from step ", RELAXES "--distance 16", RELAXES "--distance 6"},
    {"steady", "; steady from step ", GIVES "--distance 5", GIVES "--distance 2"},
    {"steady", "; steady from step ", SLIDES "--distance 6",
     STEEL "--radius 300 --half-width 6 --mu 50 " SWINGS},
    {"steady", "; steady from step ", SLIDES "--distance 6",
     SLIDES "--distance 6 --irregularity waves.txt"},
    /* the crack's mouth, wherever it lies */
    {"mouth", "The first position is 1 half-widths from the mouth, where the load already acts",
     CRACKED "--crack-mouth -3 --from -4", CRACKED "--crack-mouth 3 --from -4"},
    {"mouth", "half-widths from the mouth", CRACKED "--crack-mouth 3 --from -2.9",
     CRACKED "--crack-mouth 3"},
    /* of the curve: where a third body yields nothing slides */
    {"resistance", "largest resistance to rolling M/(P R) = 0.", SPEEDS "--gap parabola",
     SPEEDS "--load 0.001 --gap roof.txt"}, /* which has no radius */
    {"full sliding", "full sliding begins between", "curve " CARTER "--points 3",
     "curve " CARTER "--mu 100 --yield-stress 10 --over creep --to 0.1 --points 3"},
    {"full sliding",
     "nothing sticks from a creepage between xi = 0 and 0.05 on: up to 100 % of the "
     "interface yields",
     "curve " CARTER "--mu 100 --yield-stress 10 --over creep --to 0.1 --points 3",
     "curve " CARTER "--yield-stress 1e4 --points 3"},
};

/* Bounds in refusals, exit code 64, are those of the case as it is meshed: what they name is
 * solved. */
static const sentence bounds[] = {
    {"largest force", "carries at most mu P = 271.868 N/mm\n", ROLLS "--force 271.87",
     ROLLS "--force 271.868"},
    {"largest force", "carries at most mu P = 299.707 N/mm at this approach",
     STEEL
     "--radius 100 --mu 0.3 --contact-elements 24 --formulation steady --approach 0.03 --force 310",
     STEEL "--radius 100 --mu 0.3 --contact-elements 24 --formulation steady --approach 0.03 "
           "--force 299.707"},
    {"largest force", "the interface yields, and carries at most 199.941 N/mm",
     CAPPED "--formulation steady --force -201", CAPPED "--formulation steady --force -199.941"},
    {"largest force", "the interface yields, and carries at most",
     CAPPED "--formulation steady --force -200.1 --mesh aligned",
     CAPPED "--formulation steady --force -199 --mesh aligned"},
    {"largest force", "carries at most 199.333 N/mm", CAPPED "--force -201",
     CAPPED "--force -199.333"},
    {"largest force", "with this friction law the largest is", FALLING "--force 400",
     FALLING "--force 297.294"},
    {"softening", "expected 458100 MPa/mm at most on elements of 0.0433 mm; shorter ones",
     CAPPED "--hardening -3e6", CAPPED "--hardening -458100"},
    /* mu is 0.5 beside the contact, and 0.1 under most of it */
    {"largest force", "carries at most mu P = ", PLACES "--force 400", PLACES "--force 200"},
};

enum {
    NOTES = sizeof notes / sizeof *notes,
    STUDIES = sizeof studies / sizeof *studies,
    BOUNDS = sizeof bounds / sizeof *bounds
};

static int write_gaps(void)
{
    FILE *punch = NOT_NULL(fopen("punch.txt", "w")), *round = NOT_NULL(fopen("round.txt", "w"));
    for (int k = -100; k <= 100; k++) {
        const double x = 0.05 * k, beyond = fmax(fabs(x) - 2.0, 0.0);
        fprintf(punch, "%g %g\n", x, 10.0 * beyond);
        fprintf(round, "%g %g\n", x, x * x / 200.0);
    }
    fclose(punch);
    fclose(round);
    write_file("corners.txt", "-0.2 0\n-0.1 1e-4\n0 0\n0.1 1e-4\n0.2 0\n");
    FILE *saw = NOT_NULL(fopen("saw.txt", "w"));
    for (int k = -80; k <= 80; k++)
        fprintf(saw, "%g %g\n", 0.01 * k, k % 4 ? 1e-4 : 0.0);
    fclose(saw);
    write_file("roof.txt", "-2 .002\n-1.5 .0015\n-1 .001\n-.5 .0005\n0 0\n.5 .0005\n1 .001\n"
                           "1.5 .0015\n2 .002\n");
    write_file("parabola.txt", "-2 .02\n-1.5 .01125\n-1 .005\n-.5 .00125\n0 0\n.5 .00125\n1 .005\n"
                               "1.5 .01125\n2 .02\n");
    write_file("step.txt",
               "0 0\n.1 0\n.2 0\n.3 0\n.4 0\n.5 0\n.6 .001\n.7 .001\n.8 .001\n.9 .001\n1 0\n");
    write_file("bump.txt",
               "0 0\n.25 .0001464\n.5 .0005\n.75 .0008536\n1 .001\n1.25 .0008536\n1.5 .0005\n"
               "1.75 .0001464\n2 0\n");
    write_file("chamfer.txt", "-4 .6\n-1 0\n1 0\n4 .6\n");
    write_file("places.txt", "-10 0.1\n0 0.1\n0.5 0.5\n10 0.5\n");
    write_file("drawn.txt", "load force_ratio\n300 0\n600 0\n600 0.9\n");
    write_file("little.txt", "load force_ratio\n300 0\n600 0\n600 0.1\n");
    write_file("pulled.txt", "force\n0.0268382\n-0.0623\n");
    write_file("light.txt", "load force_ratio\n0.05 0.2\n0.1 0.2\n300 0.5\n300 -0.5\n");
    write_file("sudden.txt", "load force\n0.01 0\n100 15\n");
    write_file("gradual.txt", "load force\n50 0\n100 15\n");
    FILE *swings = NOT_NULL(fopen("swings.txt", "w")), *waves = NOT_NULL(fopen("waves.txt", "w"));
    fprintf(swings, "distance creep\n");
    for (int k = 0; k <= 100; k++)
        fprintf(swings, "%g %g\n", 0.1 * k, 1e-3 * sin(0.05 * M_PI * k));
    for (int k = 0; k <= 200; k++) /* from beside the contact until behind the way's end */
        fprintf(waves, "%g %g\n", 1.3 + 0.1 * k,
                5e-4 * fmin(1.0, 0.1 * fmin(k, 200 - k)) * sin(M_PI * k / 10.0));
    fclose(swings);
    fclose(waves);
    write_file("pushed.txt", "shift\n0\n0.002\n0.01\n");
    write_file("flat.txt", "-0.2 0\n-0.1 1e-9\n0 0\n0.1 1e-9\n0.2 0\n");
    return 0;
}

static void check_sentences(int n, const sentence *all, int code)
{
    int wrong = 0;
    for (int k = 0; k < n; k++)
        for (int says = 1; says >= 0; says--) {
            if (!is_in_turn(k, 4))
                continue;
            const char *arguments = says ? all[k].says : all[k].silent;
            const int got = rollbem(arguments);
            if (got == (says ? code : 0) && (strstr(err, all[k].words) != NULL) == says)
                continue;
            print_error("%s: %s '%s'\nrollbem %s\nexit %d: %s\n", all[k].name,
                        says ? "does not say" : "says", all[k].words, arguments, got, err);
            wrong++;
        }
    assert_int_equal(wrong, 0);
}

TEST(each_note_is_said_where_it_is_true_alone)
{
    write_gaps();
    check_sentences(NOTES, notes, 0);
}

TEST(studies_say_what_their_rows_would_say)
{
    check_sentences(STUDIES, studies, 0);
    /* in the table before the first such row, also where the study continues from there */
    const char *const study =
        "sweep " ROLLS "--vary-1 'creep 0.001 0.1 0.2' --output t.tsv --quiet --jobs 1";
    char whole[sizeof out], cut[200];
    assert_int_equal(rollbem(study), 0);
    slurp("t.tsv", whole, sizeof whole);
    const char *note = NOT_NULL(strstr(whole, "\n# note, case 2, percent: xi = 0.1 is far"));
    assert_int_equal(strncmp(strchr(note + 1, '\n'), "\n2\t", 3), 0);
    for (int lines = 6; lines <= 9; lines++) { /* up to case 1, the note, case 2, case 3 */
        snprintf(cut, sizeof cut, "head -n %d t.tsv >c.tsv; mv c.tsv t.tsv", lines);
        assert_int_equal(shell(cut), 0);
        assert_int_equal(rollbem(study), 0);
        slurp("t.tsv", out, sizeof out);
        assert_string_equal(out, whole);
    }
    held_json *root = run_json("sweep " FRETS "--vary-1 'creep-ratio 0.1 0.2' --format json");
    assert_int_equal(json_array_size(json_object_get(root, "notes")), 1);
    held_json *half = run_json("sweep " HALF "--vary-1 'mu 0.1 0.2' --format json");
    const json_t *said = json_object_get(half, "notes");
    const size_t last = json_array_size(said);
    assert_true(last > 0);
    assert_non_null(
        strstr(json_string_value(json_array_get(said, last - 1)), "--young without --poisson"));
}

/* Each note on standard error stands in a # line of the table and in JSON's list too. */
TEST(notes_go_through_every_door)
{
    static const char *const commands[] = {
        HALF,
        HALF "--derivatives approach",
        "curve " HALF "--mu 0.1,0.3 --points 3",
        "stress " HALF,
        "wear " HALF "--mu 0.1 --wear-coefficient 1e-9 --slide 1 --wear-steps 1",
        "crack " HALF "--mu 0 --crack-length 0.5 --crack-elements 4",
    };
    static const char note[] = "rollbem: note: ";
    char said[sizeof err], line[400];

    for (size_t k = 0; k < sizeof commands / sizeof *commands; k++) {
        if (!is_in_turn((int)k, 3))
            continue;
        held_json *root = run_json(commands[k]);
        const json_t *list = json_object_get(root, "notes");
        size_t notes_said = 0;
        assert_int_equal(rollbem(commands[k]), 0);
        assert_non_null(strstr(err, "--young without --poisson"));
        snprintf(said, sizeof said, "%s", err);
        for (const char *at = strstr(said, note); at; at = strstr(at + 1, note), notes_said++) {
            const char *text = at + strlen(note);
            snprintf(line, sizeof line, "# note: %.*s\n", (int)strcspn(text, "\n"), text);
            if (!strstr(out, line))
                fail_msg("rollbem %s: the table lacks '%s'", commands[k], line);
        }
        assert_int_equal(json_array_size(list), notes_said);
    }
}

/* So does a note on a step before the last, of which the table has nothing: in the history's table,
 * too; the certificate finds it in the states again.  Snapshots say what is true of theirs. */
TEST(notes_on_earlier_steps_go_through_every_door)
{
    static const char said[] = "note: Only 2 elements carry the contact that begins at x = -0.0623";
    char line[300];

    write_gaps();
    assert_int_equal(rollbem(HISTORY "--history-table h.tsv --snapshots s"), 0);
    const char *on_error = NOT_NULL(strstr(err, said)), *end = strchr(on_error, '\n');
    snprintf(line, sizeof line, "%.*s", (int)(end - on_error), on_error);
    assert_non_null(strstr(line, "(step 1 and 1 other of 4)"));
    assert_non_null(strstr(out, line));
    slurp("h.tsv", out, sizeof out);
    assert_non_null(strstr(out, line));
    held_json *root = run_json(HISTORY "--states");
    const json_t *list = json_object_get(root, "notes");
    assert_int_equal(json_array_size(list), 1);
    assert_string_equal(json_string_value(json_array_get(list, 0)), line + strlen("note: "));
    write_file("r.json", out);
    assert_int_equal(rollbem("check r.json"), 0);
    assert_int_equal(shell("sed 's/(step 1 and 1 other/(step 1 and 2 others/' r.json >w.json"), 0);
    assert_int_equal(rollbem("check w.json"), 1);
    assert_non_null(strstr(out, "violated: notes"));
    for (int step = 1; step <= 4; step++) {
        snprintf(line, sizeof line, "s/step_%06d.tsv", step);
        slurp(line, out, sizeof out);
        assert_int_equal(strstr(out, said) != NULL, step < 3);
    }
    rb_api *a = rb_api_create();
    assert_int_equal(rb_api_set(a, "similar", "yes"), RB_OK);
    assert_int_equal(rb_api_set(a, "support", "halfplane"), RB_OK);
    assert_int_equal(rb_api_set(a, "history", "light.txt"), RB_OK);
    assert_int_equal(rb_api_solve(a), RB_OK);
    assert_non_null(strstr(NOT_NULL(rb_api_note(a, 0, line, sizeof line)), " 1 other of 4)"));
    assert_null(rb_api_note(a, 1, line, sizeof line));
    rb_api_free(a);
    assert_int_equal(rollbem("wear " STEEL "--radius 100 --load 0.05 --mu 0.3 --zone 0.3 "
                             "--contact-elements 24 --slide 1e5 --wear-coefficient 1e-8 "
                             "--wear-steps 3 --snapshots w"),
                     0);
    slurp("w/step_000000.tsv", out, sizeof out);
    assert_non_null(strstr(out, "# note: Only 2 elements carry the contact"));
    slurp("w/step_000003.tsv", out, sizeof out);
    assert_non_null(strstr(out, "# note: The edge at x = -0.2125 mm is uncertain"));
}

TEST(each_bound_is_that_of_the_mesh)
{
    check_sentences(BOUNDS, bounds, 64);
}

TEST(each_note_has_its_two_cases)
{
    for (int k = 0; rb_rolling_note_name(k); k++) {
        int rows = 0;
        for (int j = 0; j < NOTES; j++)
            rows += strcmp(notes[j].name, rb_rolling_note_name(k)) == 0;
        if (rows == 0)
            fail_msg("%s has no case in tests/test_sentences.c", rb_rolling_note_name(k));
    }
}

RUN_TESTS(enter_folder, leave_folder)
