/* Units: the table against the definitions, and every command in every system: the same
 * numbers, converted. */
#include "cli_run.h"
#include "rolling/case/case.h"
#include "base/io/io.h"
#include "base/units.h"

/* ---- The table --------------------------------------------------------------------- */

static double read_unit(const char *text, const char *unit)
{
    double value = NAN;
    int plain = 1;
    assert_int_equal(rb_unit_read(text, unit, &value, &plain, &message), RB_OK);
    assert_int_equal(plain, 0);
    return value;
}

TEST(units_are_as_defined)
{
    static const struct {
        const char *text, *unit;
        double wanted;
    } all[] = {{"210GPa", "MPa", 210000.0},
               {"2.1e11 Pa", "MPa", 210000.0},
               {"0.0465m", "mm", 46.5},
               {"18in", "mm", 457.2},
               {"1ft", "mm", 304.8},
               {"3mil", "mm", 0.0762},
               {"100kN/m", "N/mm", 100.0},
               {"1lbf/in", "N/mm", 0.17512683524647636},
               {"1ksi", "MPa", 6.894757293168361},
               {"1lbf", "N", 4.4482216152605},
               {"36km/h", "mm/s", 10000.0},
               {"60mph", "mm/s", 26822.4},
               {"2um/MPa", "mm/MPa", 0.002},
               {"3e-15m/Pa", "mm/MPa", 3e-6},
               {"1e-9in/psi", "mm/MPa", 3.6839585383473144e-06},
               {"1e-16 1/Pa", "1/MPa", 1e-10},
               {"1 1/psi", "1/MPa", 145.03773773020923},
               {"5ms", "s", 0.005},
               {"0.1%", "-", 0.001},
               {"3.14159265358979323846rad", "degrees", 180.0},
               /* of the trades */
               {"1N/m2", "MPa", 1e-6},
               {"2GN/m2", "MPa", 2000.0},
               {"30Mpsi", "MPa", 206842.71879505088},
               {"30Msi", "MPa", 206842.71879505088},
               {"1kgf/mm2", "MPa", 9.80665},
               {"1bar", "MPa", 0.1},
               {"1kip/in", "N/mm", 175.12683524647636},
               {"1lb/in", "N/mm", 0.17512683524647636},
               {"5N/cm", "N/mm", 0.5},
               {"1kgf/mm", "N/mm", 9.80665},
               {"100kN/12mm", "N/mm", 1e5 / 12.0},
               {"22480 lbf / 0.5in", "N/mm", 22480.0 * 4.4482216152605 / 12.7},
               {"60m/min", "mm/s", 1000.0},
               {"100ft/min", "mm/s", 508.0},
               {"1e-3mm3/Nm", "1/MPa", 1e-6},
               {"1 mm3/(N m)", "1/MPa", 1e-3},
               {"1mm3/N/m", "1/MPa", 1e-3},
               {"1 mm^3/(N·m)", "1/MPa", 1e-3},
               {"1mm3/N m", "1/MPa", 1e-3},
               {"1mm3/J", "1/MPa", 1e-3},
               {"1e-15 m2/N", "1/MPa", 1e-9},
               {"1e-15 m3/(N m)", "1/MPa", 1e-9},
               {"1cm3/(N m)", "1/MPa", 1.0},
               {"1um3/J", "1/MPa", 1e-12},
               {"1um3/(N mm)", "1/MPa", 1e-9},
               {"1/GPa", "1/MPa", 1e-3},
               {"1e-10/MPa", "1/MPa", 1e-10},
               {"1e-10 1/MPa", "1/MPa", 1e-10},
               {"1in2/lbf", "1/MPa", 145.03773773020923},
               {"2mm2/N", "1/MPa", 2.0},
               {"0.002km", "mm", 2000.0},
               {"3thou", "mm", 0.0762},
               {"3 microns", "mm", 0.003},
               {"1.5 millimetres", "mm", 1.5},
               {"8inches", "mm", 203.2},
               {"1ksi√in", "MPa.mm^0.5", 34.748482334414788},
               {"1MPa√m", "MPa.mm^0.5", 31.622776601683793},
               {"1 MPa m^(1/2)", "MPa.mm^0.5", 31.622776601683793},
               {"1MPa*sqrt(m)", "MPa.mm^0.5", 31.622776601683793},
               {"1 MPa m1/2", "MPa.mm^0.5", 31.622776601683793},
               {"1 N mm^-3/2", "MPa.mm^0.5", 1.0},
               {"2mm/m", "-", 2e-3},
               {"5‰", "-", 5e-3},
               {"3 per cent", "-", 0.03},
               {"50 N s^-1 K^-1", "W/(m K)", 50.0},
               {"2 N m/mm", "N", 2000.0},
               {"12 h", "s", 43200.0}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        CHECK_REL(read_unit(all[k].text, all[k].unit), all[k].wanted, 1e-15, "%s", all[k].text);
}

/* What the table does not know stays as it is: ratios, and units of a kind of their own. */
TEST(units_of_no_kind_are_their_own)
{
    double value = 0.0;
    int plain;
    CHECK_ABS(rb_unit_stored(RB_UNITS_SI, "furlong", 2.5), 2.5, 0.0, "stored");
    CHECK_ABS(rb_unit_shown(RB_UNITS_SI, "furlong", 2.5), 2.5, 0.0, "shown");
    CHECK_OK(rb_unit_read("2.5 furlong", "furlong", &value, &plain, NULL));
    CHECK_ABS(value, 2.5, 0.0, "read");
    assert_int_equal(plain, 0);
    /* seventeen digits stay */
    CHECK_ABS(read_unit("0.30000000000000004m", "mm"), 300.00000000000004, 0.0, "of m");
    CHECK_ABS(rb_unit_shown(RB_UNITS_SI, "mm", 300.00000000000006), 0.30000000000000006, 0.0,
              "in m");
    CHECK_STATUS(rb_unit_read("2.5 -", "-", &value, &plain, NULL), RB_EINVAL);
    CHECK_STATUS(rb_unit_read("2.5 furlong", "mm", &value, &plain, NULL), RB_EINVAL);
}

/* The point moves: no digit is lost where a unit is a power of ten of another. */
TEST(powers_of_ten_are_exact)
{
    char text[40];
    for (int k = 1; k < 2000; k++) {
        const double mm = k * 0.0137;
        snprintf(text, sizeof text, "%.15g", mm);
        const double typed = strtod(text, NULL);
        snprintf(text, sizeof text, "%.15ge-3m", typed);
        CHECK_ABS(read_unit(text, "mm"), typed, 0.0, "%s", text);
        CHECK_ABS(rb_unit_stored(RB_UNITS_SI, "mm", rb_unit_shown(RB_UNITS_SI, "mm", typed)), typed,
                  0.0, "there and back");
        const double x = rb_unit_shown(RB_UNITS_INCH, "MPa", mm);
        CHECK_REL(rb_unit_stored(RB_UNITS_INCH, "MPa", x), mm, 1e-15, "psi and back");
    }
    assert_true(isnan(rb_unit_shown(RB_UNITS_SI, "mm", NAN)));
    CHECK_ABS(rb_unit_shown(RB_UNITS_SI, "degrees", 30.0), 30.0, 0.0, "degrees");
    CHECK_ABS(rb_unit_shown(RB_UNITS_SI, NULL, 0.3), 0.3, 0.0, "without a unit");
    CHECK_ABS(rb_unit_stored(RB_UNITS_INCH, NULL, 0.3), 0.3, 0.0, "without a unit");
}

/* ---- Results ----------------------------------------------------------------------- */

/* The unit that a column of a table in mm, N, MPa ends with; "": none that is converted. */
static const char *unit_of(const char *column)
{
    static const char *const units[] = {"mm", "mm2", "MPa", "N/mm", "N", "mm/s", "mm/MPa"};
    const char *end = strrchr(column, '_');
    for (size_t k = 0; end && k < sizeof units / sizeof *units; k++)
        if (strcmp(end + 1, units[k]) == 0)
            return units[k];
    return "";
}

/* Every column of b is that of a in the other system, name and numbers. */
static void compare_tables(const char *a_path, const char *b_path, rb_units system)
{
    OWNED(rb_io_table) a, b;
    if (rb_io_table_read(a_path, &a, &message) != RB_OK ||
        rb_io_table_read(b_path, &b, &message) != RB_OK)
        fail_msg("%s", message.text);
    assert_int_equal(a.columns, b.columns);
    assert_int_equal(a.rows, b.rows);
    int converted = 0;
    for (int j = 0; j < a.columns; j++) {
        const char *unit = unit_of(a.name[j]);
        const size_t stem = strlen(a.name[j]) - strlen(unit);
        assert_int_equal(strncmp(a.name[j], b.name[j], stem), 0);
        assert_string_equal(b.name[j] + stem, rb_unit_name(system, unit));
        for (int i = 0; i < a.rows; i++) {
            const double x = a.x[i + j * a.rows], y = b.x[i + j * b.rows];
            const double wanted = rb_unit_shown(system, unit, x);
            CHECK_ABS(y, wanted, 0.0, "%s, row %d", a.name[j], i + 1);
        }
        converted += *unit != '\0';
    }
    assert_true(converted > 0);
}

TEST(every_command_converts_the_same_numbers)
{
    /* $R1 ...: lengths, stresses, loads and a compliance, once as plain numbers of each
     * system */
    static const struct {
        const char *command, *table;
    } all[] = {{"$R --radius $R1 --young $E1 --approach $A1 --contact-elements 24", "out"},
               {"$R --radius $R1 --young $E1 --load $P1 --support halfplane --similar "
                "--formulation "
                "steady --creep-ratio .4 --interlayer-normal $C1 --interlayer-tangential $C1",
                "out"},
               {"$R --radius $R1 --young $E1 --load $P1 --support halfplane --similar "
                "--formulation steady --creep-ratio .4 --zone $Z1 --mesh uniform",
                "out"},
               {"$R --radius $R1 --young $E1 --load $P1 --support halfplane --similar "
                "--formulation transient --creep-ratio .4 --distance 1 --contact-elements 30 "
                "--error --history-table h.tsv && cat h.tsv",
                "out"},
               {"$R curve --radius $R1 --young $E1 --load $P1 --support halfplane --similar "
                "--points 3 --error",
                "out"},
               {"$R stress --radius $R1 --young $E1 --load $P1 --support halfplane --similar "
                "--depth $Z1 --grid 4x3",
                "out"},
               {"$R sweep --radius $R1 --young $E1 --support halfplane --similar --load $P1 "
                "--vary-1 'mu .1 .3'",
                "out"},
               {"$R wear --radius $R1 --young $E1 --support halfplane --similar --load $P1 "
                "--shift "
                "$D1 --cycles 1e5 --wear-coefficient $K1 --wear-steps 2 --contact-elements 30",
                "out"}};
    static const char *const values[] = {
        "R1=46.5; E1=205000; A1=2.5; P1=712; Z1=1.25; C1=2e-6; D1=0.002; K1=1e-9",
        "R1=0.0465; E1=205e9; A1=0.0025; P1=712e3; Z1=0.00125; C1=2e-15; D1=2e-6; K1=1e-15"};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        for (int u = 0; u < 2; u++) {
            const char *quiet = strstr(all[k].command, "&&");
            const int n = quiet ? (int)(quiet - all[k].command) : 800;
            assert_int_equal(shellf("%s; %.*s --quiet --units %s > t%d %s%s", values[u], n,
                                    all[k].command, u ? "si" : "mm", u,
                                    quiet ? "&& cp h.tsv t" : "", quiet ? (u ? "1" : "0") : ""),
                             0);
            assert_int_equal(shell("sed -i s/NaN/0/g t?"), 0);
        }
        compare_tables("t0", "t1", RB_UNITS_SI);
    }
}

/* A value's own unit: the same case to the last digit. */
TEST(values_say_their_own_units)
{
    const char *same = "--support halfplane --similar --formulation steady --quiet --header=bare";
    char line[600];
    snprintf(line, sizeof line,
             "\"$R\" %s --radius 457.2 --young 210000 --load 100 --creep 0.001 >a && "
             "\"$R\" %s --radius 18in --young 210GPa --load 100kN/m --creep 0.1%% >b && "
             "cmp a b && printf '[body-a]\\nradius = 18 in\\nyoung = 210 GPa\\n"
             "[normal]\\nload = 100 kN/m\\n[tangential]\\ncreep = 0.1 %%%%\\n' >c.ini && "
             "\"$R\" %s c.ini >c && cmp a c",
             same, same, same);
    assert_int_equal(shell(line), 0);
}

TEST(files_take_units)
{
    write_file("a.txt", "shift load\n0 100\n0.001 120\n");
    write_file("b.txt", "shift_um load_kN/m\n0 100\n1 120\n");
    write_file("c.txt", "shift load\n0 100e3\n1e-6 120e3\n");
    write_file("gap.txt", "x gap\n-1 .01\n-.5 .0025\n0 0\n.5 .0025\n1 .01\n");
    write_file("gap2.txt", "x_mm gap_um\n-1 10\n-.5 2.5\n0 0\n.5 2.5\n1 10\n");
    write_file("points.txt", "0 0.0005\n");
    write_file("points2.txt", "x_mm y_um\n0 500\n");
    write_file("worn.txt", "-.2 0\n-.1 .0008\n0 .001\n.1 .0008\n.2 0\n");
    write_file("worn.ini", "load = 100\nworn = worn.txt\nsupport = halfplane\n");
    write_file("points.ini", "load = 100\nsupport = halfplane\n[stress]\n"
                             "points = points3.txt\n");
    write_file("points3.txt", "0 0.5\n");
    write_file("points4.txt", "Depth [µm];x / mm\n500,0;0,0\n");
    write_file("worn2.txt", "\"x [mm]\",\"depth (um)\"\n-.2,0\n-.1,.8\n0,1\n.1,.8\n.2,0\n");
    write_file("mu.txt", "-.2 .2\n0 .3\n.2 .2\n");
    write_file("mu2.txt", "friction coefficient (%);x (um)\n20;-200\n30;0\n20;200\n");
    write_file("flat.txt", "-.3 0\n0 .001\n.3 0\n");
    write_file("flat2.txt", "x_um,gap_nm\n-300,0\n0,1000\n300,0\n");
    write_file("ways.txt", "distance,force\n0,0\n0.2,10\n");
    write_file("ways2.txt", "Distance (a);Tangential force [kN/m]\n0;0\n0,2;10,0\n");
    assert_int_equal(
        shell("S='--support halfplane --similar --quiet --header=bare'; \"$R\" $S --history a.txt "
              ">a && \"$R\" $S --history b.txt >b && cmp a b && \"$R\" $S --units si "
              "--history c.txt --json >c && \"$R\" $S --gap gap.txt --load 10 >d && \"$R\" $S "
              "--gap gap2.txt --load 10 >e && cmp d e"),
        0);
    /* tables of points and of worn depths too; those that a case file names are in its
     * units, whatever is shown */
    assert_int_equal(shell("S='--support halfplane --load 100 --quiet --header=bare'; "
                           "\"$R\" stress $S --points points3.txt >p && "
                           "\"$R\" stress $S --points points2.txt >q && cmp p q && "
                           "\"$R\" stress $S --points points4.txt >q && cmp p q && "
                           "\"$R\" $S --worn worn.txt >p && "
                           "\"$R\" $S --worn worn2.txt --units mm >q && cmp p q && "
                           "\"$R\" $S --friction-law mu.txt >p && "
                           "\"$R\" $S --friction-law mu2.txt >q && cmp p q && "
                           "T='--formulation transient --similar --contact-elements 20'; "
                           "\"$R\" $S $T --distance .2 --force 9 --irregularity flat.txt >p && "
                           "\"$R\" $S $T --distance .2 --force 9 --irregularity flat2.txt >q && "
                           "cmp p q && \"$R\" $S $T --history ways.txt >p && "
                           "\"$R\" $S $T --history ways2.txt >q && cmp p q && "
                           "\"$R\" stress points.ini --units si --quiet --header=bare >r && "
                           "\"$R\" stress points.ini --units si --points points2.txt --quiet "
                           "--header=bare >s && cmp r s && grep -q '0.0005' r"),
                     0);
    json_t *root = json_load_file("c", 0, NULL);
    assert_string_equal(
        json_string_value(json_object_get(json_object_get(root, "units"), "length")), "m");
    CHECK_REL(number_in(json_object_get(root, "summary"), "normal_load"), 120e3, 1e-9,
              "load in N/m");
    CHECK_REL(number_in(json_object_get(root, "inputs"), "radius"), 0.05, 1e-15, "radius");
    json_decref(root);
    root = run_json("stress --support halfplane --similar --load 500kN/m --units si "
                    "--points points.txt");
    CHECK_REL(entry(json_object_get(root, "points"), "y_m", 0), 0.0005, 1e-15, "y");
    CHECK_ABS(entry(json_object_get(root, "points"), "max_shear_Pa", 0), 1.1e8, 0.2e8,
              "a shear in Pa");
    json_decref(root);
    double p0[2];
    for (int j = 0; j < 2; j++) {
        root = run_json(j ? "worn.ini --units si" : "worn.ini");
        p0[j] = number_in(json_object_get(root, "summary"), "max_pressure");
        json_decref(root);
    }
    CHECK_REL(p0[1], 1e6 * p0[0], 1e-9, "p0 over the same worn depths");
}

/* Numbers of a command's own options, which a case file gives, are in the file's units. */
TEST(studies_and_curves_of_files_have_the_units_of_the_file)
{
    write_file("study.ini", "units = inch\nsupport = halfplane\n[sweep]\n"
                            "vary-1 = load 1000 2000\n");
    write_file("loads.txt", "load\n1000\n2000\n");
    write_file("cases.ini", "units = inch\nsupport = halfplane\n[sweep]\n"
                            "cases = loads.txt\n");
    write_file("speeds.ini", "units = inch\nsupport = halfplane\nload = 100\n"
                             "relaxation-time = 0.01\nrelaxation-ratio = 1\n[curve]\n"
                             "over = speed\nfrom = 1\nto = 10\npoints = 2\n");
    assert_int_equal(shell("for f in study cases; do \"$R\" sweep $f.ini --units mm "
                           "--quiet --header=bare; done"),
                     0);
    const char *line = out;
    for (int k = 0; k < 2; k++) {
        double load, status, P;
        line = NOT_NULL(strstr(line, "\n1\t"));
        assert_int_equal(sscanf(line, " 1 %lf %lf %lf", &load, &status, &P), 3);
        /* 1000 lbf/in */
        CHECK_REL(load, 1000.0 * 4.4482216152605 / 25.4, 1e-14, "load varied");
        CHECK_REL(P, load, 1e-9, "load solved");
        line++;
    }
    assert_int_equal(shell("for u in mm inch; do \"$R\" curve speeds.ini --units $u --free-axle "
                           "--quiet --header=bare | cut -f3,4; done | sort -u | wc -l"),
                     0);
    assert_int_equal(atoi(out), 3); /* names, two points */
    write_file("wear.ini", "units = si\nsupport = halfplane\nload = 1e5\n[wear]\n"
                           "slide = 1000\nwear-coefficient = 1e-16\nwear-steps = 2\n");
    assert_int_equal(shell("W='--units mm --quiet --header=bare'; \"$R\" wear wear.ini $W >a && "
                           "\"$R\" wear --support halfplane --load 100 --slide 1e6 --wear-steps 2 "
                           "--wear-coefficient 1e-10 $W >b && cmp a b"),
                     0);
}

/* --from and --to are values of what --over names. */
/* The way slid and the work per way have no unit in their columns' names; what is worn
 * off goes on in any system; every snapshot and picture is in that of the run. */
TEST(wear_speaks_every_system)
{
    static const rb_units system[] = {RB_UNITS_SI, RB_UNITS_INCH};
    static const char *const name[] = {"si", "inch"};
    held_json *mm = run_json("wear --similar --support halfplane --gap parabola --load "
                             "200N/mm --slide 1e6mm --wear-coefficient 1e-10 --wear-steps 2 "
                             "--contact-elements 40 --profile mm.txt");
    for (int k = 0; k < 2; k++) {
        char line[600];
        snprintf(line, sizeof line,
                 "wear --similar --support halfplane --gap parabola --load 200N/mm --slide 1e6mm "
                 "--wear-coefficient '1e-10 1/MPa' --wear-steps 2 --contact-elements 40 --units %s "
                 "--profile p%d.txt --snapshots s%d --plot w%d.png",
                 name[k], k, k, k);
        held_json *other = run_json(line);
        const char *const column[][2] = {
            {"way", "mm"}, {"worn", "mm2"}, {"work", "N/mm"}, {"max_pressure", "MPa"}};
        /* to a unit in the last place: i386 rounds once more when it stores a number */
        for (int j = 0; j < 4; j++)
            for (size_t i = 0; i < 3; i++) {
                const json_t *a = json_object_get(json_object_get(mm, "wear"), column[j][0]);
                const json_t *b = json_object_get(json_object_get(other, "wear"), column[j][0]);
                CHECK_REL(
                    json_number_value(json_array_get(b, i)),
                    rb_unit_shown(system[k], column[j][1], json_number_value(json_array_get(a, i))),
                    2.3e-16, "%s in %s", column[j][0], name[k]);
            }
        json_t *inputs = json_object_get(other, "inputs");
        CHECK_REL(number_in(inputs, "slide"), rb_unit_shown(system[k], "mm", 1e6), 1e-15, "slide");
        CHECK_REL(number_in(inputs, "wear-coefficient"), rb_unit_shown(system[k], "1/MPa", 1e-10),
                  1e-15, "K");
        /* the same scar from either file */
        assert_int_equal(shellf("test -s w%d.png && head -1 s%d/step_000002.tsv | grep -q p_%s", k,
                                k, rb_unit_name(system[k], "MPa")),
                         0);
        double p0[2];
        for (int m = 0; m < 2; m++) {
            snprintf(line, sizeof line,
                     "--similar --support halfplane --gap parabola "
                     "--load 200 --contact-elements 40 --worn %s%c.txt",
                     m ? "p" : "m", m ? '0' + k : 'm');
            held_json *worn = run_json(line);
            p0[m] = number_in(json_object_get(worn, "summary"), "max_pressure");
        }
        CHECK_REL(p0[1], p0[0], 1e-9, "p0 under the scar, %s", name[k]);
    }
}

/* Every number of a list is varied beside the others, which are in the units of the case. */
TEST(derivatives_by_numbers_of_lists_are_converted)
{
#define FALLS                                                                                      \
    "--support halfplane --similar --formulation steady --contact-elements 20 "                    \
    "--mesh uniform --friction-law exponential --mu-fall 0.1 --derivatives=tangential_load "
    held_json *mm = run_json(FALLS "--load 100 --creep 0.002 --speed 1000 --slip-scale 2 "
                                   "--memory 1e-3,3"),
              *si =
                  run_json(FALLS "--units si --load 1e5 --creep 0.002 --speed 1 --slip-scale 2e-3 "
                                 "--memory 1e-6,3e-3 --radius 0.05 --young 94500e6");
    static const char *const names[] = {"slip-scale", "memory", "memory-2", "radius"};
    const json_t *a = json_object_get(json_object_get(mm, "derivatives"), "tangential_load"),
                 *b = json_object_get(json_object_get(si, "derivatives"), "tangential_load");
    for (int k = 0; k < 4; k++) {
        assert_true(fabs(number_in(a, names[k])) > 1e-9);
        CHECK_REL(number_in(b, names[k]), 1e6 * number_in(a, names[k]), 1e-6, "%s", names[k]);
    }
}

TEST(ends_of_a_curve_may_have_units)
{
#define RELAXES                                                                                    \
    "curve --similar --support halfplane --load 100 --contact-elements 20 "                        \
    "--relaxation-time .1 --relaxation-ratio 1 --points 2 --over speed "
    json_t *root = run_json(RELAXES "--from 10mm/s --to 3.6km/h");
    json_t *curve = json_object_get(root, "curve");
    CHECK_REL(entry(curve, "speed", 0), 10.0, 1e-12, "10mm/s");
    CHECK_REL(entry(curve, "speed", 1), 1000.0, 1e-12, "3.6km/h");
    json_decref(root);
    root = run_json(RELAXES "--units si --from 1000mm/s --to 2");
    curve = json_object_get(root, "curve");
    CHECK_REL(entry(curve, "speed", 0), 1.0, 1e-12, "1000mm/s in m/s");
    CHECK_REL(entry(curve, "speed", 1), 2.0, 1e-12, "2 m/s");
    CHECK_REL(number_in(json_object_get(root, "inputs"), "from"), 1.0, 1e-12, "input");
    json_decref(root);
    root = run_json("curve --similar --support halfplane --load 100 --points 2 --from 5% "
                    "--to 0.5 --contact-elements 20");
    CHECK_REL(entry(json_object_get(root, "curve"), "creep_ratio", 0), 0.05, 1e-9, "5%");
    json_decref(root);
    check_refused("curve --from 1mm/s", 64, "--from: expected a number without a unit");
    check_refused("curve --to x", 64, "--to: expected a number, got 'x'");
    write_file("ends.ini", "support = halfplane\n[curve]\nfrom = a\n");
    check_refused("curve ends.ini", 65, "ends.ini:3: from: expected a number, got 'a'");
}

TEST(case_files_have_their_own_units)
{
    static const char body[] = "radius = %s\nyoung = %s\nsupport = halfplane\n"
                               "load = %s\n[units]\nunits = %s\n";
    char text[300];
    snprintf(text, sizeof text, body, "46.5", "205000", "712", "mm");
    write_file("mm.ini", text);
    snprintf(text, sizeof text, body, "0.0465", "205e9", "712e3", "si");
    write_file("si.ini", text);
    assert_int_equal(
        shell("for f in mm si; do for u in mm si inch; do \"$R\" $f.ini --units $u --quiet "
              "--header=bare >$f.$u || exit 1; done; \"$R\" $f.ini --quiet --header=bare "
              ">$f.own; done; cmp mm.mm si.mm && cmp mm.si si.si && cmp mm.inch si.inch && "
              "cmp mm.own mm.mm && cmp si.own si.si && grep -q x_in mm.inch"),
        0);
    assert_int_equal(shell("\"$R\" mm.ini --units si --approach 1e-5 --header=bare --quiet >a; "
                           "\"$R\" mm.ini --approach 0.01 --units mm --header=bare --quiet "
                           ">b; head -2 a | tail -1 | cut -f10; test $(wc -l <a) = $(wc -l <b)"),
                     0);
    json_t *root = run_json("--example rail --creep-ratio 0.4 --units inch");
    CHECK_REL(number_in(json_object_get(root, "inputs"), "radius"), 460.0 / 25.4, 1e-12,
              "the wheel stays one of 460 mm");
    json_decref(root);
    root = run_json("--example rail --creep-ratio 0.4 --friction-law exponential "
                    "--mu-fall 0.1,0.2 --slip-scale 50,3 --units si --speed 1");
    const json_t *scales = json_object_get(json_object_get(root, "inputs"), "slip-scale");
    for (size_t k = 0; k < 2; k++)
        CHECK_REL(json_real_value(json_array_get(scales, k)), k ? 3.0 : 50.0, 1e-15,
                  "number %d of a list", (int)k);
    json_decref(root);
}

TEST(what_people_see_says_the_units)
{
    assert_int_equal(rollbem("--support halfplane --similar --load 100kN/m --units inch"), 0);
    assert_non_null(strstr(err, " lbf/in, Q = "));
    assert_non_null(strstr(err, " psi, approach "));
    assert_null(strstr(err, " mm"));
    assert_int_equal(shell("! grep -E 'MPa|mm' out"), 0);
    assert_int_equal(rollbem("--support halfplane --similar --load 100kN/m --units si --quiet "
                             "--plot p.svg"),
                     0);
    assert_int_equal(shell("grep -q 'N/m' p.svg && ! grep -q 'N/mm' p.svg"), 0);
}

/* No table takes a column in silence. */
TEST(headings_of_every_table_are_read_or_refused)
{
    static const struct {
        const char *options, *good, *bad;
    } all[] = {
        {"--load 10 --gap t.txt", "x_mm,gap_um", "x,gap_furlong"},
        {"--load 10 --gap t.txt", "X [mm],Gap [um]", "x,height"},
        {"--load 10 --worn t.txt", "x_mm,worn depth (um)", "x,depth_MPa"},
        {"--load 10 --friction-law t.txt", "x_mm,mu_%", "x,my"},
        {"--load 10 --friction-law t.txt", "x/mm,mu", "x_s,mu"},
        {"stress --load 10 --points t.txt", "x_mm,y_um", "x,y_K"},
        {"--formulation transient --distance .1 --load 10 --contact-elements 20 --irregularity "
         "t.txt",
         "x_mm,gap_um", "x,bump"},
        {"--formulation static --contact-elements 20 --history t.txt", "shift_um,load_N/m",
         "shift,lood"},
        {"--formulation static --contact-elements 20 --history t.txt", "Shift [um],Load [kN/m]",
         "shift,load_N"},
        {"sweep --contact-elements 20 --cases t.txt", "shift_nm,load_kN/m", "shift,load [N]"},
        {"sweep --contact-elements 20 --cases t.txt", "shift [um],Load / kN/m", "shift,radios"},
        {"fit t.txt --fit mu --load 10 --contact-elements 20", "creep_%,Q [N/mm]", "creep,Q [N]"},
        {"fit t.txt --fit mu --load 10 --contact-elements 20", "Creepage (%),Q/P", "creep,R"}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) {
        const int fits = strncmp(all[k].options, "fit", 3) == 0;
        for (int bad = 0; bad < 2; bad++) {
            char text[200], line[300], heading[60];
            const char *names = bad ? all[k].bad : all[k].good;
            snprintf(text, sizeof text,
                     fits ? "%s\n0.01,-0.1\n0.02,-0.2\n0.03,-0.25\n"
                          : "%s\n-0.4,0.4\n-0.1,0.1\n0,0.05\n0.1,0.1\n0.4,0.4\n",
                     names);
            if (strstr(all[k].options, "irregularity") || strstr(all[k].options, "worn"))
                snprintf(text, sizeof text, "%s\n-0.4,0\n0,0.001\n0.4,0\n", names);
            if (strstr(all[k].options, "points"))
                snprintf(text, sizeof text, "%s\n0,0.1\n", names);
            if (strstr(all[k].options, "history") || strstr(all[k].options, "cases"))
                snprintf(text, sizeof text, "%s\n0,10\n0.1,20\n", names);
            write_file("t.txt", text);
            snprintf(line, sizeof line, "%s --similar --support halfplane --quiet", all[k].options);
            snprintf(heading, sizeof heading, "%s", strrchr(names, ',') + 1);
            if (strstr(names, "x_s"))
                strcpy(heading, "x_s");
            if (bad)
                check_refused(line, 65, heading);
            else if (rollbem(line) > 1)
                fail_msg("%s: %s", names, err);
        }
    }
}

TEST(wrong_units_are_named)
{
    check_refused("--young 210GPA", 64, "did you mean 'GPa'?");
    check_refused("--young 5mm", 64, "expected a number in one of MPa, Pa,");
    check_refused("--mu 3mm", 64, "a number without a unit");
    check_refused("--units cgs", 64, "mm, si or inch");
    write_file("u.ini", "radius = 5 lightyears\n");
    check_refused("u.ini", 65, "u.ini:1: radius: expected a number in one of mm,");
    /* one who speaks of metres is answered in metres */
    check_refused("--units si --support hub --radius 0.05 --cover-thickness 0.06", 64,
                  "less than the radius, 0.05 m, got 0.06 m");
    check_refused("--units si --support halfplane --load 1e5 --formulation steady --force 9e4", 64,
                  "--force: Q = 90000 N/m: friction carries at most mu P = 30000 N/m");
    /* the same where only the solution tells what is carried */
    check_refused(
        "--units si --support halfplane --approach 1e-5 --formulation steady --force 9e6", 64,
        "--force: Q = 9e+06 N/m: friction carries at most mu P = 79219.3 N/m at this approach");
    check_refused("--units si --support halfplane --load 1e5 --formulation steady "
                  "--force 25000 --yield-stress 1e6",
                  64,
                  "--force: Q = 25000 N/m: the interface yields, and carries at most 516.443 N/m");
}

/* Whatever a refusal lists is read, and is of the quantity. */
TEST(listed_units_are_read)
{
    static const char *const kinds[] = {"mm",         "mm2",     "MPa",       "N/mm",    "N",
                                        "mm/s",       "mm/MPa",  "MPa/mm",    "1/MPa",   "s",
                                        "MPa.mm^0.5", "W/(m K)", "MJ/(m3 K)", "degrees", "K"};
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (const char *at = NOT_NULL(rb_unit_list(kinds[k])); at; at = strchr(at, ',')) {
            char text[60];
            double value;
            int plain = 1;
            at += strspn(at, ", ");
            if (strncmp(at, "or over", 7) == 0)
                break;
            snprintf(text, sizeof text, "2%s%.*s", strncmp(at, "1/", 2) == 0 ? " " : "",
                     (int)strcspn(at, ","), at);
            if (rb_unit_read(text, kinds[k], &value, &plain, &message) != RB_OK || plain)
                fail_msg("%s: %s", text, message.text);
            rb_message why = {.text = ""};
            const char *other = kinds[(k + 1) % (sizeof kinds / sizeof *kinds)];
            assert_int_equal(rb_unit_read(text, other, &value, &plain, &why), RB_EINVAL);
        }
    /* every system's own unit is one of its quantity */
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        for (rb_units system = RB_UNITS_MM; system <= RB_UNITS_INCH; system++) {
            rb_unit_factor f;
            double value;
            int plain = 1;
            char text[60];
            snprintf(text, sizeof text, "3 %s", rb_unit_name(system, kinds[k]));
            CHECK_OK(rb_unit_read(text, kinds[k], &value, &plain, &message));
            rb_unit_of_system(system, kinds[k], &f);
            CHECK_REL(value, rb_unit_times(&f, 3.0), 1e-15, "%s", text);
            CHECK_REL(value, rb_unit_stored(system, kinds[k], 3.0), 1e-15, "%s", text);
        }
}

TEST(what_is_no_unit_of_the_quantity_is_refused)
{
    static const char *const bad[][2] = {
        {"5mm", "mm2"},        {"5Nm", "N/mm"},    {"5mPa", "MPa"},
        {"5 2mm", "mm"},       {"5g/J", "1/MPa"},  {"5mg/Nm", "1/MPa"},
        {"5//mm", "1/MPa"},    {"5mm)", "mm"},     {"5(mm", "mm"},
        {"5m^0.3", "mm"},      {"5m^", "mm"},      {"5rad", "-"},
        {"1/2", "-"},          {"5 kN m", "N/mm"}, {"5MN", "N/mm"},
        {"5lightyears", "mm"}, {"5inchs", "mm"},   {"5mm in", "mm"},
        {"1e400mm", "mm"},     {"5°C", "K"},       {"1e-98 1e100N/mm", "N/mm"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) {
        double value;
        int plain;
        rb_message why = {.text = ""};
        if (rb_unit_read(bad[k][0], bad[k][1], &value, &plain, &why) == RB_OK)
            fail_msg("%s is %g %s", bad[k][0], value, bad[k][1]);
    }
    double value;
    int plain;
    CHECK_SAYS(rb_unit_read("5g/J", "1/MPa", &value, &plain, &message), RB_EINVAL,
               "mm3/(N m), mm3/Nm, m3/(N m), mm3/J, um3/J, 1/psi, in2/lbf; got '5g/J', whose mass");
}

/* As people type them. */
TEST(units_have_several_spellings)
{
    static const struct {
        const char *text, *unit;
        double value;
    } cases[] = {{"50W/mK", "W/(m K)", 50},
                 {"50 W/(m K)", "W/(m K)", 50},
                 {"50W/m/K", "W/(m K)", 50},
                 {"50W/(m*K)", "W/(m K)", 50},
                 {"50W/(m·K)", "W/(m K)", 50},
                 {"0.05W/(mm K)", "W/(m K)", 50},
                 {"3.6MJ/(m3 K)", "MJ/(m3 K)", 3.6},
                 {"3.6MJ/m^3/K", "MJ/(m3 K)", 3.6},
                 {"3600 kJ/m3K", "MJ/(m3 K)", 3.6},
                 {"210 GPa", "MPa", 210000},
                 {"5N/mm^2", "MPa", 5},
                 {"5N/mm²", "MPa", 5},
                 {"7kN/m", "N/mm", 7},
                 {"1e-97 1e99N/mm", "N/mm", 100},
                 {"7 kN / m", "N/mm", 7},
                 {"3µm", "mm", 0.003},
                 {"2N/mm^3", "MPa/mm", 2},
                 {"2N/mm³", "MPa/mm", 2},
                 {"20K", "K", 20}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        double value = 0.0;
        int plain = 1;
        CHECK_OK(rb_unit_read(cases[k].text, cases[k].unit, &value, &plain, NULL));
        CHECK_REL(value, cases[k].value, 1e-15, "%s", cases[k].text);
        assert_int_equal(plain, 0);
    }
    double value;
    int plain;
    CHECK_SAYS(rb_unit_read("1,5", "MPa", &value, &plain, &message), RB_EINVAL,
               "a decimal point, 1.5;");
    CHECK_STATUS(rb_unit_read("5 W/(m K)", "MPa", &value, &plain, &message), RB_EINVAL);
    CHECK_STATUS(rb_unit_read("5 mm", "MPa", &value, &plain, &message), RB_EINVAL);
}

/* Numbers of lines for people: only those with a unit, or which share that of the next one. */
TEST(lines_say_their_numbers_in_the_system)
{
    static const struct {
        rb_units system;
        const char *line, *wanted;
    } lines[] = {
        {RB_UNITS_INCH, "zone: 76.2 mm is wider than 50.8 mm", "zone: 3 in is wider than 2 in"},
        {RB_UNITS_INCH, "touches between -48.26 and 48.26 mm at most",
         "touches between -1.9 and 1.9 in at most"},
        {RB_UNITS_INCH, "1 of 3 from 25.4 to 50.8 mm; and more", "1 of 3 from 1 to 2 in; and more"},
        {RB_UNITS_INCH, "the point (0, -25.4) mm lies", "the point (0, -1) in lies"},
        {RB_UNITS_INCH, "A's 25.4 mm, got '25.4 mm' on 3, 25.4 mm.",
         "A's 1 in, got '25.4 mm' on 3, 1 in."},
        {RB_UNITS_INCH, "h.txt:4: Q = 350.253670493 N/mm, mu = 0.3",
         "h.txt:4: Q = 2000 lbf/in, mu = 0.3"},
        {RB_UNITS_INCH, "25.4 mm2, 3 MPa.mm^0.5, x2 25.4 mmm, 5 MJ/(m3 K)",
         "0.03937 in2, 3 MPa.mm^0.5, x2 25.4 mmm, 5 MJ/(m3 K)"},
        {RB_UNITS_SI, "Q = 70 N/mm at 5 MPa, -1e-3 mm", "Q = 70000 N/m at 5e+06 Pa, -1e-06 m"},
        {RB_UNITS_INCH, "give --load 52.53805057 N/mm", "give --load 300 lbf/in"},
        {RB_UNITS_MM, "zone: 76.2000001 mm", "zone: 76.2000001 mm"}};
    for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
        char line[200];
        for (int again = 0; again < 2; again++) { /* what is said stays */
            snprintf(line, sizeof line, "%s", again ? lines[k].wanted : lines[k].line);
            rb_unit_translate(lines[k].system, line, sizeof line);
            assert_string_equal(line, lines[k].wanted);
        }
    }
}

TEST(refusals_are_in_the_units_of_the_case)
{
    static const char *const inch =
        "--units inch --support halfplane --similar --young 30e6 --poisson "
        "0.3 --radius 2 --load 1000 --mu 0.3 --quiet";
    static const struct {
        const char *more, *part;
        int code;
    } cases[] = {{"--force 400", "--force: Q = 400 lbf/in: friction carries", 64},
                 {"--zone 3", "--zone: 3 in is wider than the radius, 2 in", 64},
                 {"--moment 1e9", "at M/P = 1e+06 in", 64}};
    char arguments[300];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        snprintf(arguments, sizeof arguments, "%s %s", inch, cases[k].more);
        check_refused(arguments, cases[k].code, cases[k].part);
    }
    snprintf(arguments, sizeof arguments,
             "crack %s --crack-length 0.1in --paris 1e-12,3 --grow-to 0.05in", inch);
    check_refused(arguments, 64, "length of the crack, 0.1 in, got 0.05 in");
}

RUN_TESTS(enter_folder, leave_folder)
