"""Tables and sentences of docs/*.md: a comment <!-- figures: ... --> above names what prints their numbers.

    rows NAME            a section of tests/figures, which looks for its rows on the page
    formula CHAPTER.TAG  a function of this folder
    by COMMAND           what takes too long, or needs what is not here: not run, but it must exist
    OPTIONS | EXPRESSION; EXPRESSION ...
                         run by the program, OPTIONS with a command before them or not; an expression has
                         the names of the summary in JSON, of a crack those of its contact, too.  N in 1 2:
                         before it stands for two lines with {N}.  Each value must stand in the table or
                         the paragraph below, and each figure of the table must be one of them.
    turns                before such lines: a quarter of them is run each day, all with ROLLBEM_TEST_ALL."""
import glob
import json
import math
import os
import re
import subprocess
import sys

FIGURE = re.compile(r"(?<![\w.])[-+]?(?:\d+\.\d+|\.\d+|\d+)(?:e[-+]?\d+)?(?![\w])")
COMMENT = re.compile(r"^ *<!-- figures: (.*?) -->\n", re.S | re.M)
everything, turn = "ROLLBEM_TEST_ALL" in os.environ, int(os.environ.get("ROLLBEM_TEST_TURN", 0))


def unit(word):
    digits, _, exponent = word.partition("e")
    return 10.0**(int(exponent or 0) - (len(digits.split(".")[1]) if "." in digits else 0))


def is_measured(word):
    digits = re.sub(r"^[-+]?[0.]*|\.|e.*", "", word)
    return len(digits) >= (2 if "." in word or "e" in word else 4)


def block_below(text, at):
    """The table that begins there, or the paragraph."""
    lines = text[at:].lstrip("\n").split("\n")
    table = lines[0].lstrip().startswith("|")
    for k, line in enumerate(lines):
        if (table and not line.lstrip().startswith("|")) or not line.strip():
            break
    return "\n".join(lines[:k])


def commands(comment):
    for line in comment.strip().split("\n"):
        loop = re.match(r" *(\w+) in ([^:]*): (.*)", line)
        for word in loop[2].split() if loop else [None]:
            yield loop[3].replace("{" + loop[1] + "}", word) if loop else line


def summary(options):
    printed = subprocess.run([os.environ.get("ROLLBEM", "build/rollbem"), *options.split(), "--json", "--quiet"],
                             capture_output=True, text=True)
    assert printed.stdout, f"{options}: {printed.stderr}"
    root = json.loads(printed.stdout)
    return {name: x for name, x in [*root.get("contact", {}).items(), *root["summary"].items()] if isinstance(x, (int, float))}


def check(page, comment, block):
    """What is wrong, as lines."""
    kind, _, rest = comment.strip().partition(" ")
    if kind == "rows":
        return [] if rest in open("tests/figures").read() else [f"tests/figures has no {rest!r}"]
    if kind == "formula":
        chapter, _, tag = rest.partition(".")
        return [] if f"def {tag}(" in open(f"tests/formula/{chapter}.py").read() else [f"no {rest}"]
    if kind == "by":
        places = [re.sub(r"build/bench/(\w+).*", r"tools/bench/\1.c", rest), re.sub(r"build/tests/(\w+).*", r"tests/\1.c", rest), rest.split()[0]]
        return [] if any(os.path.exists(p) for p in places) or rest.startswith(("make ", "CONTACT")) else [f"{rest}: not here"]
    turns = kind.split("\n")[0] == "turns"
    wrong, lines = [], list(commands(comment.replace("turns\n", "", 1) if turns else comment))
    shown = [w for w in FIGURE.findall(block) if is_measured(w)]
    met, near, ran = set(), set(), 0
    for k, line in enumerate(lines):
        if turns and not everything and k % 4 != turn % 4:
            continue
        ran += 1
        options, _, expressions = line.partition("|")
        names = {**vars(math), **summary(options)}
        for expression in expressions.split(";"):
            x = eval(expression, names)
            alike = [w for w in FIGURE.findall(block) if abs(abs(x) - abs(float(w))) <= 0.6*unit(w) and abs(float(w)) >= 0.05*abs(x)
                     and (is_measured(w) or abs(float(w)) < 1)]
            met.update(alike)
            near.update(w for w in shown if w not in alike and abs(abs(x) - abs(float(w))) < 2e-3*abs(x))
            if not alike:
                wrong.append(f"{line.strip()}: {expression.strip()} is {x:.6g}, which the page does not show")
    given = set(FIGURE.findall(comment))
    if ran == len(lines):  # one of two places that show a value may be wrong
        wrong += [f"{w} is nearly what a command prints" for w in near - met - given]
    if ran == len(lines) and block.lstrip().startswith("|"):
        wrong += [f"{w} is printed by no command" for w in shown if w not in met and w not in given]
    return wrong


def has_numbers(table):
    cells = [cell.strip() for row in table.split("\n")[2:] for cell in row.split("|")[1:-1]]
    return sum(bool(re.fullmatch(r"[-+~<>\d.e%,;/ ms()k]+", c)) and any(map(is_measured, FIGURE.findall(c))) for c in cells) >= 4


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


def broken_courses(text):
    """The shorter courses of docs/course/lecturers.md that do not hold what their lessons assume."""
    assumes = {row[1].split()[0].lstrip("["): re.findall(r"\d+", re.sub(r"\(.*?\)", "", row[2]).split(" or ")[0])
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
for page in sys.argv[1:] or sorted(glob.glob("docs/*.md")):
    text, wrong, checks = open(page).read(), [], 0
    commented = set()
    for m in COMMENT.finditer(text):
        block = block_below(text, m.end())
        commented.add(block)
        checks += 1
        wrong += check(page, m[1], block)
    for m in re.finditer(r"(?:^ *\|.*\n)+", text, re.M):
        table = m[0].rstrip("\n")
        if has_numbers(table) and table.lstrip() not in {c.lstrip() for c in commented}:
            wrong.append("a table without a command: " + table.split("\n")[0])
    wrong += untested(page, text) if "theory" in page else []
    for line in wrong:
        print(f"{page}: {line}")
    if checks or wrong:
        failed += bool(wrong)
        print("[  FAILED  ]" if wrong else "[       OK ]", page)
raise SystemExit(failed)
