/* rollbem page: the page that it finds, the case that it carries, and its refusals. */
#include "cli_run.h"

static const char page[] = "<p>before</p><script type=\"application/json\" "
                           "id=\"carried\">null</script><p>after</p>"
                           "<script type=\"application/json\" id=\"limits\">"
                           "{\"left_out\":[\"accuracy\",\"error\"],"
                           "\"largest\":{\"contact-elements\":400}}</script>\n";

TEST(the_page_carries_the_case)
{
    write_file("page.html", page);
    write_file("case.ini", "[friction]\nmu = 0.25\n[body-a]\nsupport = halfplane\n");
    assert_int_equal(rollbem("page case.ini --page page.html --load 500 --output made.html"), 0);
    assert_string_equal(out, "");
    slurp("made.html", out, sizeof out);
    char *from = strstr(out, "id=\"carried\">");
    char *to = strstr(out, "</script>");
    assert_memory_equal(out, "<p>before</p>", 13);
    assert_string_equal(to, strstr(page, "</script><p>after</p>"));
    *to = '\0';
    held_json *all = NOT_NULL(json_loads(from + 13, 0, NULL));
    assert_int_equal(json_object_size(all), 3);
    assert_string_equal(json_string_value(json_object_get(all, "mu")), "0.25");
    assert_string_equal(json_string_value(json_object_get(all, "load")), "500");
    assert_string_equal(json_string_value(json_object_get(all, "support")), "halfplane");

    CHECK_RUN(rollbem("page --page page.html"), 0, out, "id=\"carried\">{}</script>");
}

/* Neither beside the program nor where make install puts it; then there. */
TEST(an_installed_program_finds_its_page)
{
    write_file("page.html", page);
    assert_int_equal(shell("mkdir -p tree/bin && cp \"$R\" tree/bin/rollbem"), 0);
    assert_int_equal(shell("tree/bin/rollbem page --mu 0.2"), 66);
    assert_string_equal(out, "");
    assert_non_null(strstr(err, "share/rollbem"));
    assert_ptr_equal(strchr(err, '\n'), err + strlen(err) - 1);
    assert_int_equal(shell("mkdir -p tree/share/rollbem && cp page.html "
                           "tree/share/rollbem/rollbem.html"),
                     0);
    CHECK_RUN(shell("tree/bin/rollbem page --mu 0.2"), 0, out, "{\"mu\":\"0.2");
    assert_int_equal(shell("sed s/before/beside/ page.html > tree/bin/rollbem.html"), 0);
    assert_int_equal(shell("tree/bin/rollbem page"), 0);
    assert_non_null(strstr(out, "beside")); /* the nearer one */
}

TEST(what_no_page_can_be_made_of_is_refused)
{
    write_file("page.html", page);
    write_file("other.html", "<p>nothing</p>");
    write_file("filled.html", "<script type=\"application/json\" id=\"carried\">{}"
                              "</script><script type=\"application/json\" "
                              "id=\"limits\">{}</script>");
    write_file("endless.html", "<script type=\"application/json\" id=\"carried\">null</script>");
    write_file("strange.html", "<script type=\"application/json\" id=\"carried\">null"
                               "</script><script type=\"application/json\" "
                               "id=\"limits\">{\"left_out\": [1]}</script>");
    write_file("gap.tsv", "-1 0.1\n0 0\n1 0.1\n");
    check_refused("page --page none.html", 66, "none.html");
    check_refused("page --page other.html", 65, "other.html: expected the page");
    check_refused("page --page filled.html", 65, "filled.html: expected the page");
    check_refused("page --page endless.html", 65, "endless.html: expected the page");
    assert_int_equal(rollbem("page --page strange.html --mu 0.1"), 0);
    check_refused("page --page page.html --mu -1", 64, "--mu");
    check_refused("page --page page.html --gap gap.tsv", 64, "--gap: names a file");
    check_refused("page --page page.html --error", 64, "--error: not in the page");
    check_refused("page --page page.html --accuracy 1e-3", 64, "--accuracy: not in the page");
    check_refused("page --page page.html --contact-elements 401", 64,
                  "--contact-elements: the page goes up to 400, use the program for 401");
    assert_int_equal(rollbem("page --page page.html --contact-elements 400 --output at.html"), 0);
    check_refused("page --page page.html --output page.html", 64, "overwritten");
    check_refused("page --page page.html --output no/folder.html", 73, "no/folder.html");
}

RUN_TESTS(enter_folder, leave_folder)
