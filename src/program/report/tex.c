/* The texts of a TikZ picture.  gnuplot's terminal tikz leaves its enhanced text, with indices _i,
 * powers ^{i} and groups such as {/:Bold word}, and UTF-8 as they are; LaTeX wants its own
 * commands. */
#include "program/report/internal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* What texts have beside ASCII, and what LaTeX reads otherwise than it is meant. */
static const struct {
    const char *text, *tex;
} signs[] = {{"θ", "$\\theta$"},
             {"μ", "$\\mu$"},
             {"µ", "$\\mu$"}, /* of units: another character */
             {"ν", "$\\nu$"},
             {"ξ", "$\\xi$"},
             {"σ", "$\\sigma$"},
             {"τ", "$\\tau$"},
             {"Δ", "$\\Delta$"},
             {"°", "$^\\circ$"},
             {"±", "$\\pm$"},
             {"·", "$\\cdot$"},
             {"×", "$\\times$"},
             {"−", "$-$"},
             {"≤", "$\\le$"},
             {"≥", "$\\ge$"},
             {"←", "$\\leftarrow$"},
             {"→", "$\\to$"},
             {"…", "\\ldots{}"},
             {"<", "$<$"},
             {">", "$>$"},
             {"|", "$|$"},
             {"\\", "\\textbackslash{}"},
             {"~", "\\textasciitilde{}"},
             {"#", "\\#"},
             {"$", "\\$"},
             {"%", "\\%"},
             {"&", "\\&"},
             {"_", "\\_"},
             {"{", "\\{"},
             {"}", "\\}"},
             {"^", "\\^{}"}};

/* The character at `text`, of one to four bytes; returns its end. */
static const char *write_character(FILE *out, const char *text)
{
    for (size_t k = 0; k < sizeof signs / sizeof *signs; k++) {
        const size_t n = strlen(signs[k].text);
        if (strncmp(text, signs[k].text, n) == 0) {
            fputs(signs[k].tex, out);
            return text + n;
        }
    }
    fputc(*text++, out);
    while (((unsigned char)*text & 0xc0) == 0x80) /* the rest of UTF-8 */
        fputc(*text++, out);
    return text;
}

static int is_sign_of_number(const char *begin, const char *at)
{
    return *at == '-' && at[1] >= '0' && at[1] <= '9' && (at == begin || strchr(" =({[", at[-1]));
}

static const char *write_text(FILE *out, const char *text);

/* What follows an opening brace; returns what follows its closing one. */
static const char *write_group(FILE *out, const char *text)
{
    double size;
    int head = 0;

    if (sscanf(text, "/*%lf%n", &size, &head) == 1 && head > 0)
        fprintf(out, "\\scalebox{%g}{", size);
    else if (strncmp(text, "/:Bold", 6) == 0) {
        head = 6;
        fputs("\\textbf{", out);
    } else
        fputs("{", out);
    text = write_text(out, text + head + (head && text[head] == ' '));
    fputs("}", out);
    return *text ? text + 1 : text;
}

/* Up to the brace that closes the group in which it stands, or its end. */
static const char *write_text(FILE *out, const char *text)
{
    const char *begin = text;

    while (*text && *text != '}') {
        if ((*text == '_' || *text == '^') && text[1]) {
            fputs(*text == '_' ? "\\textsubscript{" : "\\textsuperscript{", out);
            text = text[1] == '{' ? write_group(out, text + 2) : write_character(out, text + 1);
            fputs("}", out);
        } else if (*text == '{')
            text = write_group(out, text + 1);
        else if (*text == '\\' && text[1])
            text = write_character(out, text + 1);
        else if (is_sign_of_number(begin, text)) {
            fputs("$-$", out);
            text++;
        } else
            text = write_character(out, text);
    }
    return text;
}

/* The text of a node is the last pair of braces of its line; gnuplot's own numbers are formulas of
 * TeX already. */
static void write_node(FILE *out, char *line)
{
    char *place = strstr(line, " at ("), *text = place ? strstr(place, ") {") : NULL,
         *end = strrchr(line, '}');

    if (!text || text[3] == '$' || end < text) {
        fputs(line, out);
        return;
    }
    text += 3;
    fprintf(out, "%.*s", (int)(text - line), line);
    *end = '\0';
    while (*text) { /* a brace that closes nothing is left out */
        text = (char *)write_text(out, text);
        text += *text == '}';
    }
    fprintf(out, "}%s", end + 1);
}

rb_status rb_report_tex(FILE *picture, FILE *out)
{
    char *line = NULL;
    size_t capacity = 0;
    int after_program = 0;

    fputs("% Needs \\usepackage{gnuplot-lua-tikz}, which comes with gnuplot.\n", out);
    errno = 0;
    while (getline(&line, &capacity, picture) > 0) {
        if (strncmp(line, "\\node", 5) == 0)
            write_node(out, line);
        else if (!after_program) /* the line below it is the date */
            fputs(line, out);
        after_program = strncmp(line, "%% generated with", 17) == 0;
    }
    free(line);
    return errno == ENOMEM ? RB_ENOMEM : ferror(picture) || ferror(out) ? RB_EWRITE : RB_OK;
}
