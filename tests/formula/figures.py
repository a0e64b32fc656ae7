"""Tables and sentences of docs/*.md: a comment <!-- figures: ... --> above names what prints their numbers.  A page is
refused if it has a number of two digits with a point, or of four, without one, unless it stands in code, in the literature, or in
a formula that a function of this folder evaluates.

    rows NAME            a section of tests/figures, which looks for its rows on the page
    formula CHAPTER.TAG  a function of this folder
    by build/tests/TEST  a test that compares the numbers: they stand in its source
    prints COMMAND       it is run, and prints the numbers; after ROLLBEM_TEST_ALL=1 it is run only where that is set
    bench COMMAND        ratios of one run of a program of tools/bench, a script of tools/scripts or a target of make,
                         which depend a little on the machine: not compared.  The program must exist and must have the
                         words of each row of the table up to a colon; seconds of more than one digit are refused.
    in FILE [FUNCTION...] numbers that a test compares, or that the program has as constants: they stand there
    rows in FILE [FUNCTION...] the same, and those of each row of the table stand there one behind the other
    from SOURCE          literature; theory.md: numbers of sections, whose headings stand there
    OPTIONS | EXPRESSION; EXPRESSION ...
                         run by the program, OPTIONS with a command before them or not; an expression has
                         the names of the summary in JSON, of a crack those of its contact, too, and the other objects, as
                         parameters["mu"]["value"] of a fit; of what is refused `name = number` of its line; without
                         OPTIONS it is arithmetic.  N in 1 2: before it stands for two lines with {N}.  Each value must
                         stand in the table or the paragraph below.
    turns                before such lines: an eighth of them is run each day, all with ROLLBEM_TEST_ALL.

In the suite, which sets ROLLBEM_TEST_TURN, the program is run for an eighth of the tables and paragraphs of each page.
But for rows, formulas and ratios each number must be met by one of them, or stand in the comment."""
import ast
import builtins
import functools
import glob
import json
import math
import os
import re
import subprocess
import sys

FIGURE = re.compile(r"(?<![\w.])[-+]?(?:\d+\.\d+|\.\d+|\d+)(?:e[-+]?\d+)?(?![\w])")
COMMENT = re.compile(r"^ *<!-- figures: (.*?) -->\n", re.S | re.M)
COMMENTS = re.compile(r"(?: *<!-- figures: (?:(?!-->).)*? -->\s*)+\Z", re.S)
BLOCK = re.compile(r"(?:^ *\|.*\n?)+|(?:^ *[^ \n|].*\n?)+", re.M)  # a table or a paragraph
OTHER_PAGES = ["README.md", "python/README.md", "examples/fem/README.md", "examples/fem/wall-study.md", "docs/course/README.md", "docs/course/lecturers.md", "docs/site/index.md"]  # test_course reads the lessons
everything, turn = "ROLLBEM_TEST_ALL" in os.environ, int(os.environ.get("ROLLBEM_TEST_TURN", 0))
turns_at_once = int(os.environ.get("ROLLBEM_TEST_TURNS", 1))
DAYS = 8
in_suite = "ROLLBEM_TEST_TURN" in os.environ and not everything


def unit(word):
    digits, _, exponent = word.partition("e")
    return 10.0**(int(exponent or 0) - (len(digits.split(".")[1]) if "." in digits else 0))


def is_measured(word):
    """Two digits with a point, three of a whole number of thousands."""
    digits = re.sub(r"^[-+]?[0.]*|\.|e.*", "", word)
    return len(digits) >= 2 if "." in word or "e" in word else len(digits) >= 4 and len(digits.rstrip("0")) >= 3


def commands(comment):
    for line in comment.strip().split("\n"):
        loop = re.match(r" *(\w+) in ([^:]*): (.*)", line)
        for word in loop[2].split() if loop else [None]:
            yield loop[3].replace("{" + loop[1] + "}", word) if loop else line


@functools.cache
def summary(options):
    printed = subprocess.run([os.environ.get("ROLLBEM", "build/rollbem"), *options.split(), "--json", "--quiet"],
                             capture_output=True, text=True)
    if not printed.stdout:
        assert " = " in printed.stderr, f"{options}: {printed.stderr}"
        return {name: float(x) for name, x in re.findall(r"(\w+) = ([-+.\de]*\d)", printed.stderr)}
    root = json.loads(printed.stdout)
    parts = {name: x for name, x in root.items() if isinstance(x, dict)}
    return parts | {name: x for name, x in [*root.get("contact", {}).items(), *root.get("summary", {}).items(), *root.items()] if isinstance(x, (int, float))}


def numbers_in(place):
    """The numbers of a file in their order, or of functions and tables of it; none of what is not there."""
    file, *names = place.split()
    text = open(file).read() if os.path.exists(file) else ""
    if names:
        found = [re.search(rf"^[^\n;]*\b{name}\b[^;]*?\{{.*?^\}}", text, re.S | re.M) for name in names]
        text = " ".join(m[0] for m in found if m)
    return [abs(float(x)) for x in re.findall(r"(?<![\w.])(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?", text)]


def named(rest):
    """The numbers that a test compares (build/tests/test_bem_system, _disc: two of them), or those of sections."""
    if rest == "theory.md":
        return {float(x) for page in glob.glob("docs/theory*.md") for x in re.findall(r"^#+ (\d\.\d+)", open(page).read(), re.M)}
    first, *others = re.findall(r"\b_?[a-z]\w+", rest.partition("build/tests/test")[2])
    return set().union(*(set(numbers_in(f"tests/test{name}.c")) for name in [first, *others]))


@functools.cache
def numbers_printed(command):
    """The numbers of each line that a command prints; none where it is run on some days only, and not today."""
    wanted = re.sub(r"^ROLLBEM_TEST_ALL=1 ", "", command)
    if wanted != command and not everything:
        return None
    build = os.path.dirname(os.environ.get("ROLLBEM", "build/rollbem"))
    done = subprocess.run(wanted.replace("build/", build + "/"), shell=True, capture_output=True, text=True,
                          env={**os.environ, "B": build, "CMOCKA_MESSAGE_OUTPUT": "STDOUT"})
    return [[abs(float(x)) for x in FIGURE.findall(line)] for line in done.stdout.split("\n")]


def sources(command):
    """The text of a bench with its headers, of a script, or of what a target of make runs."""
    target = re.match(r"make (\w+)", command)
    if target:
        line = re.search(rf"^{target[1]}:.*\n(?:\t.*\n)*", open("Makefile").read(), re.M)
        files = re.findall(r"tools/scripts/[\w-]+", line[0]) if line else []
        folders = [name for _, names, _ in os.walk("src") for name in names]
        return " ".join([line[0] if line else "", *(open(file).read() for file in files), *folders, "all of these"])
    file = re.sub(r"build/bench/(\w+)", r"tools/bench/\1.c", command.split()[0])
    if not os.path.exists(file):
        return ""
    text = open(file).read()
    headers = [os.path.join(os.path.dirname(file), name) for name in re.findall(r'#include "(\w+\.h)"', text)]
    return " ".join([text, *(open(name).read() for name in headers if os.path.exists(name))])


TIME = re.compile(r"(?<![\w.])(\d+\.\d+|\.\d+|\d+)(?:e-?\d+)? (?:n|m|micro)?s(?:econds)?\b")


def not_of_bench(command, block):
    """What is wrong with ratios that a bench measures."""
    text = sources(command) and sources(command) + command
    rows = re.findall(r"^ *\|([^|]*)\|", block, re.M)[2:]
    unknown = {w for row in rows for w in re.findall(r"[A-Za-z]{3,}", re.split("[:(]", row)[0]) if w not in text}
    return ([f"{command}: not here"] if not text else [f"{command} prints no row with {w!r}" for w in sorted(unknown)]) + [
        f"{command}: {m[0]}, not a ratio" for m in TIME.finditer(block) if len(m[1].strip("0").replace(".", "").lstrip("0")) > 1] + (
        [] if re.search(r"/|ratio|times|%|power|twice|half|more|less", block) else [f"{command}: no ratio"])


def missing(kind, rest):
    """What is wrong with a line that names a section or a function."""
    if kind == "rows" and not rest.startswith("in "):
        return [] if rest in open("tests/figures").read() else [f"tests/figures has no {rest!r}"]
    if kind == "formula":
        chapter, _, tag = rest.partition(".")
        return [] if f"def {tag}(" in open(f"tests/formula/{chapter}.py").read() else [f"no {rest}"]
    test = re.sub(r"build/tests/(\w+).*", r"tests/\1.c", rest)
    return [] if kind != "by" or test != rest and os.path.exists(test) else [f"by {rest}: no test"]


def is_in(word, numbers, digits=0.5001):
    return any(abs(x - abs(float(word))) <= digits*unit(word) for x in numbers)


def check(comment, block, shown, today=True):
    """What is wrong, as lines; shown: the figures of the block that need something that prints them; today: 0 where the
    program is not run for it."""
    turns = comment.startswith("turns\n")
    wrong, lines = [], list(commands(comment.replace("turns\n", "", 1)))
    met, near, ran, all_named = set(), set(), 0, False
    for k, line in enumerate(lines):
        kind, _, rest = line.strip().partition(" ")
        compares = rest.startswith(("build/tests/", "theory.md"))
        if kind == "rows" and rest.startswith("in "):
            there = numbers_in(rest[3:])
            for row in block.split("\n"):
                words = FIGURE.findall(row) if set(FIGURE.findall(row)) & set(shown) else []
                runs = range(len(there) - len(words) + 1)
                met.update(words if any(all(is_in(w, [x]) for w, x in zip(words, there[k:])) for k in runs) else [])
        elif kind in ("rows", "formula", "by"):
            wrong += missing(kind, rest)
            all_named |= not compares
        elif kind == "bench":
            wrong += not_of_bench(rest, block)
            all_named = True
        elif kind == "from" and not compares:
            all_named |= not any(map(is_measured, FIGURE.findall(rest)))
        if kind == "prints":
            there = numbers_printed(rest)
            all_named |= there is None
            for cell in re.split("[|]", block):  # one line has all numbers of a cell
                words = [w for w in FIGURE.findall(cell) if w in shown]
                met.update(words if any(all(is_in(w, of, 0.6) for w in words) for of in there or []) else [])
        elif kind == "in" or compares:
            there = numbers_in(rest) if kind == "in" else named(rest)
            alike = {w for w in shown if is_in(w, there)}
            wrong += [] if alike or compares else [f"nothing here is {line.strip()}"]
            met |= alike
        elif kind in ("rows", "formula", "by", "bench", "from", "prints"):
            pass
        elif turns and not everything and (k - turn) % DAYS >= turns_at_once or not today and line.partition("|")[0].strip():
            continue
        else:
            options, _, expressions = line.partition("|")
            names = {**vars(math), **vars(builtins), **(summary(options) if options.strip() else {})}
            for expression in expressions.split(";"):
                x = eval(expression, names)
                alike = [w for w in FIGURE.findall(block) if abs(abs(x) - abs(float(w))) <= 0.6*unit(w) and abs(float(w)) >= 0.05*abs(x)
                         and (is_measured(w) or abs(float(w)) < 1)]
                met.update(alike)
                near.update(w for w in shown if w not in alike and abs(abs(x) - abs(float(w))) < 2e-3*abs(x))
                if not alike:
                    wrong.append(f"{line.strip()}: {expression.strip()} is {x:.6g}, which the page does not show")
        ran += 1
    given = set(FIGURE.findall(comment))
    if ran == len(lines):  # one of two places that show a value may be wrong
        wrong += [f"{w} is nearly what a command prints" for w in sorted(near - met - given)]
        wrong += [] if all_named else [f"{w} is printed by no command" for w in shown if w not in met and w not in given]
    return wrong


SECTION = r"(?:[345]\.\d\d?)"
NEED_NONE = [(r"^ *```.*?^ *```|<!--.*?-->", re.S | re.M), (r"(?<=\n\n)(?:    .*\n)+", 0),
             (rf"(?:[sS]ections?|\.md[`)]?,?|of|in|and|see|to|\])\s+{SECTION}(?=[\s).,;:\]])(?! (?:[mnkM]?m|[mn]?s|%|MPa|GB|times)\b)", 0),
             (r"\]\([^)]*\)|`[^`]*`|https?://\S+|(?:version |VTK |Siconos |GPL-)\d\S*", 0), (rf"(?<=[(,])\s*{SECTION}(?=[),;])", 0),
             (r"^\d+\. [A-Z]\..*\n(?:    ?.*\n)*|^#+ .*", re.M), (r"\b(?:1[89]|20)\d\d\b", 0)]


def founded(text):
    """The page without what needs no command: code, comments, links, literature, headings, numbers of sections, years, and
    what the functions of this folder evaluate."""
    for pattern, flags in NEED_NONE + [(literal, 0) for literal in evaluated]:
        text = re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m[0]), text, flags=flags)
    return text


def literals():
    for file in glob.glob("tests/formula/*.py"):
        for node in ast.walk(ast.parse(open(file).read())):
            if isinstance(node, ast.Constant) and isinstance(node.value, str) and 5 < len(node.value) < 400 and re.search(r"\d", node.value):
                yield r"\s+".join(map(re.escape, node.value.split()))


evaluated = sorted(set(literals()), key=len, reverse=True)


GREEK = "alpha|beta|gamma|delta|epsilon|eta|theta|kappa|lambda|mu|nu|xi|pi|rho|sigma|tau"
# tags whose test has another name
ELSEWHERE = {"B15": "stress_maxima", "B17": "max_pressure", "L4": "default_mesh", "V5": "rolling_relax", "V7": "rolling_relax",
             "F4": "rolling_laws", "F5": "rolling_laws", "I1": "rolling_interlayer", "W2": "rolling_wear", "D2": "sensitivity",
             "D5": "fit", "D7": "slopes", "K2": "contact", "U1": "bulk", "U2": "bulk", "U3": "tilt", "E2": "ellipse",
             "B18": "given_tractions", "B19": "stress_maxima", "L6": "stack", "L7": "stack", "L8": "stack"}


def untested(page, text):
    """The tags of a page that neither a function here nor a program of tests/ names."""
    here = " ".join(re.findall(r"def (tag_\w+)", " ".join(open(f).read() for f in glob.glob("tests/formula/*.py"))))
    for tag in sorted(set(re.findall(r"^(?:\*\*)?\(([A-Z]\d+)\)", text, re.M))):
        if not re.search(rf"_{tag}(?![0-9])", here) and tag not in ELSEWHERE and not any(
                re.search(rf"\b{tag}\b", open(f).read()) for f in glob.glob("tests/test_*.c")):
            yield f"({tag}) has no test"


def unlisted(page, text):
    """Letters of displayed formulas that docs/glossary.md does not have."""
    listed = " ".join(row.split("|")[1] for row in re.findall(r"^\|.*", open("docs/glossary.md").read().partition("## Symbols")[2], re.M))
    for formula in re.findall(r"```math\n(.*?)```", text, re.S):
        formula = re.sub(r"\\(?:text|operatorname|mathrm|begin|end|var(?=epsilon))(?:\{[^}]*\})?", r" \\ ", formula).replace("\\ epsilon", r"\epsilon")
        for greek, letter in re.findall(rf"\\({GREEK})\b|(?<![\\A-Za-z_{{])([A-Za-z])(?![A-Za-z])", formula):
            if not re.search(rf"(?<![A-Za-z]){greek or letter}(?![A-Za-z])", listed):
                yield f"docs/glossary.md does not have {greek or letter}"


def broken_courses(text):
    """The shorter courses of docs/course/lecturers.md that do not hold what their lessons assume."""
    assumes = {row[1].split()[0].lstrip("["): re.findall(r"\d+", re.split(" or |;", re.sub(r"\(.*?\)", "", row[2]))[0])
               for row in (line.split("|")[1:] for line in re.findall(r"^\| \d+ \|.*", text, re.M))}
    for course in re.findall(r"^- (?:One|Two|Four) afternoon.*?(?=^- |\n\n)", text, re.M | re.S):
        have = re.findall(r"(?<![-\w/])\d+(?![-\w])", re.sub(r"\]\(.*?\)", "]", course))
        for k, lesson in enumerate(have):
            missing = [a for a in assumes[lesson] if a not in have[:k] and not (lesson == "3" and "half-plane" in course)]
            if missing:
                yield f"lecturers: lesson {lesson} without {missing}: {course[:40]}"


failed = 0
wrong = list(broken_courses(open("docs/course/lecturers.md").read()))
if wrong:
    failed = 1
    print("\n".join(wrong))
print("[  FAILED  ]" if wrong else "[       OK ]", "docs/course/lecturers.md")
for page in sys.argv[1:] or sorted(glob.glob("docs/*.md") + OTHER_PAGES):
    text, wrong, checks = open(page).read(), [], 0
    visible = founded(text)
    for block in BLOCK.finditer(COMMENT.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)):
        above = COMMENTS.search(text[:block.start()])
        shown = [w for w in FIGURE.findall(visible[block.start():block.end()]) if is_measured(w)]
        if above:
            checks += 1
            wrong += check("\n".join(COMMENT.findall(above[0])), block[0], shown, not in_suite or -(checks + turn) % DAYS < turns_at_once)
        elif shown:
            wrong.append(f"line {text.count(chr(10), 0, block.start()) + 1}: no command for {' '.join(shown)}")
    wrong += [*untested(page, text), *sorted(set(unlisted(page, text)))] if "theory" in page else []
    for line in wrong:
        print(f"{page}: {line}")
    if checks or wrong:
        failed += bool(wrong)
        print("[  FAILED  ]" if wrong else "[       OK ]", page)
raise SystemExit(failed)
