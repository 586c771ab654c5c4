"""Writes the page about a collection of cases, for collection.py."""

import datetime
import pathlib
import re
import shlex
import subprocess
import tomllib
from collections import Counter

REPOSITORY = pathlib.Path(__file__).resolve().parent.parent
WIDTH = 120


# ---- judgements ----

def read_judgements(file):
    """Returns the entries of the table of judgements; none where there is no such file."""
    return tomllib.loads(file.read_text(encoding="utf-8"))["case"] if file.is_file() else []


def names_end_with(names, ends):
    """Returns True if each path ends with the one of the same place in `ends`, folder by folder."""
    parts = [pathlib.PurePath(n).parts for n in names]
    wanted = [pathlib.PurePath(e).parts for e in ends]
    return len(parts) == len(wanted) and all(p[-len(w):] == w for p, w in zip(parts, wanted))


def judgement_of(result, judgements):
    """Returns the entry that judges a case without a mesh: its files are the same, and so is what lamina says. An entry
    of a mended case does not judge it if it is refused again."""
    for entry in judgements:
        if entry["judgement"] != "mended" and names_end_with(result.names, entry["files"]) \
                and entry.get("says", "") in result.reason:
            return entry
    return None


# ---- text ----

def escaped(text):
    """Returns a text that is safe in a cell of a Markdown table."""
    text = "".join(c if c.isprintable() else "\\x%02x" % ord(c) for c in text)
    text = text if len(text) <= 400 else text[:400] + "..."
    return re.sub(r"([|<`*_])", r"\\\1", text)


def file_names(result):
    """Returns the files of a case for a cell of a table."""
    fine = [re.sub(r"[`|]|[^ -~]", "?", name) for name in result.names]
    return "<br>".join(f"`{name}`" for name in fine)


def wrapped(text):
    """Returns the lines of a paragraph."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > WIDTH:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return lines


def pair(both):
    """Returns a figure of all rays or cells, and of those in the open."""
    return " / ".join(f"{value:.1f}" for value in both)


def summary(results):
    """Returns the counts of outcomes in a sentence without an end."""
    counts = Counter(result.outcome for result in results)
    return f"{len(results)} cases: {counts['valid']} valid, {counts['refused']} refused, {counts['failed']} failed"


# ---- parts of the page ----

def badness(result):
    """Returns a key that sorts the worst case first: failed, refused, then meshes with more kinds of warnings, more
    first heights lost, fewer cells in the open, smaller angles."""
    figures = result.figures
    if figures is None:
        return (0 if result.outcome == "failed" else 1, 0, 0, 0, 0, result.names)
    return (2, -len(set(figures.warnings)), -figures.first_lost / max(1, figures.wall_edges), figures.cells[1],
            figures.min_angle, result.names)


def row(result):
    """Returns the row of the table for one case."""
    names = file_names(result) + (" *" if result.own_options else "")
    figures = result.figures
    if figures is None:
        outcome = result.outcome if result.outcome == "refused" else f"**{result.outcome}**"
        return f"| {names} | {outcome} | | | | | | | | {result.seconds:.1f} |"
    first = f"{figures.first_lost} of {figures.wall_edges}" if figures.first_lost else "all kept"
    warnings = ", ".join(f"{code} ({n})" if n > 1 else code for code, n in sorted(Counter(figures.warnings).items()))
    below = f", **{figures.below_bound} below**" if figures.below_bound else ""
    exempt = f", {figures.exempt} exempt" if figures.exempt else ""
    return (f"| {names} | valid | {figures.triangles} | {pair(figures.rays)} | {pair(figures.cells)} | {first} "
            f"| {warnings.replace('_', ' ')} | {figures.min_angle:.1f}{exempt}{below} "
            f"| {figures.refused} / {figures.oversized} | {result.seconds:.1f} |")


COLUMNS = ["| files | outcome | triangles | rays | cells | first lost | warnings | angle | unmet | time |",
           "| --- | --- | ---: | ---: | ---: | ---: | --- | ---: | ---: | ---: |"]


def legend(settings):
    """Returns what the columns of the large table mean."""
    reference = "reference" if settings.own else "../docs/reference"
    return [
        "- *rays*: per cent of the rays that carry all requested layers; first of all rays, then of those in the open,",
        f"  where nothing lies in front of the wall ([report]({reference}/report.md#the-report))",
        "- *cells*: per cent of the requested layer cells that were made; all, and in the open",
        "- *first lost*: wall edges without a cell of the first height, of all wall edges",
        f"- *warnings*: [codes]({reference}/checks.md#warnings), with their number where it is above one",
        "- *angle*: smallest angle of the isotropic region in degrees, by `lamina check` on the file; *exempt*:",
        "  triangles below the bound that a sharp corner excuses; *below*: those that nothing excuses",
        "- *unmet*: points refused / triangles larger than the size field asks for",
        "- *time*: seconds of `lamina mesh` on one thread, with other cases at the same time",
        "- a star marks cases that are meshed with options of their own, from the `case.json` beside them",
    ]


def said(command):
    """Returns the standard output of a command; an empty text where there is none."""
    try:
        return subprocess.run(command, capture_output=True, text=True, check=False).stdout.strip()
    except OSError:
        return ""


def head(left_out, settings):
    """Returns the title, and the paragraph that says how the page was made."""
    version = said([settings.program, "--version"])
    commit = said(["git", "-C", REPOSITORY, "describe", "--always"])
    words = [] if settings.own else [str(settings.folder)] + ["--together"] * settings.together
    words += ["--exact"] * settings.exact
    words += ["--only", settings.only] if settings.only else []
    words += ["--", *settings.options] if settings.options else []
    others = "these options hold besides" if settings.options else "all other options are the defaults"
    exact = " `tools/exact_check.py` checked each mesh, too." if settings.exact else ""
    text = (f"`./dev {shlex.join(['collection', *words])}` made this page on {datetime.date.today()} with "
            f"{version or 'lamina'}{', commit ' if commit else ''}{commit}. The first height is "
            f"{settings.first_height:g} chords unless the options say otherwise; {others}. Each case had one thread "
            f"and {settings.limit:g} seconds.{exact}")
    skipped = ", ".join(f"{n} of `{ending}`" for ending, n in sorted(left_out.items()))
    lines = [f"# Every section of the {'collection' if settings.own else 'folder'}, meshed", "", *wrapped(text)]
    if skipped:
        lines += ["", *wrapped(f"Files that are no coordinates by their ending were left out: {skipped}.")]
    return lines


def totals(results, judgements):
    """Returns the counts of outcomes, judgements and warnings."""
    valid = [result.figures for result in results if result.figures]
    judged = Counter((judgement_of(r, judgements) or {"judgement": "not judged"})["judgement"]
                     for r in results if r.outcome == "refused")
    lines = ["", "## Totals", "", f"{summary(results)}.", ""]
    lines += ["| of the refusals | cases |", "| --- | ---: |"]
    lines += [f"| {name} | {n} |" for name, n in sorted(judged.items())] or ["| none | 0 |"]
    cases = Counter(code for figures in valid for code in set(figures.warnings))
    number = Counter(code for figures in valid for code in figures.warnings)
    lines += ["", "| warning | cases | warnings |", "| --- | ---: | ---: |"]
    lines += [f"| no warning | {sum(not f.warnings for f in valid)} | 0 |"]
    lines += [f"| `{code}` | {n} | {number[code]} |" for code, n in sorted(cases.items(), key=lambda e: (-e[1], e[0]))]
    lines += ["", "| of the valid meshes | cases | sum |", "| --- | ---: | ---: |",
              f"| triangles | {len(valid)} | {sum(f.triangles for f in valid)} |"]
    for title, value in (("first heights lost (wall edges)", lambda f: f.first_lost),
                         ("angles below the bound, not exempt", lambda f: f.below_bound),
                         ("angles below the bound, exempt", lambda f: f.exempt),
                         ("points refused", lambda f: f.refused), ("triangles too large", lambda f: f.oversized)):
        lines.append(f"| {title} | {sum(value(f) > 0 for f in valid)} | {sum(map(value, valid))} |")
    complete = sum(f.rays[1] == 100 for f in valid)
    lines.append(f"| every ray in the open carries all layers | {complete} | |")
    return lines


# What layers are judged by: a title, and what says whether a layer meets it. Those of the area ratio judge layers that end
# where cells are as high as wide.
AREA_TARGETS = (
    ("area ratio, 1st percentile at least 0.5", lambda f: f.transition[0] >= 0.5),
    ("area ratio, median 0.8 to 1.25", lambda f: 0.8 <= f.transition[1] <= 1.25),
    ("area ratio, 99th percentile at most 2", lambda f: f.transition[2] <= 2),
)
LAYER_TARGETS = (
    ("no angle above 150 degrees", lambda f: f.max_angle <= 150),
    ("99.9 % of first heights within 1 %", lambda f: f.first_off <= 0.001 * f.first_cells),
)


def targets_of(figures):
    """Returns the targets that a layer is judged by."""
    return AREA_TARGETS + LAYER_TARGETS if figures.transition else LAYER_TARGETS


def meets_all(figures):
    """Returns whether a layer meets all targets that it is judged by."""
    return all(meets(figures) for _, meets in targets_of(figures))


def layers(results):
    """Returns the tables that say which layers meet their targets, and which do not, apart for single sections and for
    configurations of several elements."""
    judged = [result for result in results if result.figures and result.figures.layer]
    if not judged:
        return []
    single = [r.figures.layer for r in judged if r.figures.layer.elements == 1]
    several = [r.figures.layer for r in judged if r.figures.layer.elements > 1]
    lines = ["", "## Layers", "", *wrapped(
        "The area ratio is that between the last cell of a column and the triangle beyond it, where layers end as soon as "
        "cells are as high as wide."), "",
        "| target | single sections | several elements |", "| --- | ---: | ---: |"]

    def add_row(title, count):
        lines.append(f"| {title} | {count(single)} | {count(several)} |")

    for title, meets in AREA_TARGETS + LAYER_TARGETS:
        def met(group, title=title, meets=meets):
            of = [f for f in group if title in dict(targets_of(f))]
            return f"{sum(map(meets, of))} of {len(of)}"
        add_row(title, met)
    add_row("all of these", lambda group: f"{sum(map(meets_all, group))} of {len(group)}")
    for title, part, whole in (("first heights more than 1 % off", "first_off", "first_cells"),
                               ("wall vertices between edges above 1.25", "wall_uneven", "first_cells"),
                               ("columns whose ends differ by a third of a cell", "ends_uneven", "columns")):
        def total(group, part=part, whole=whole):
            return f"{sum(getattr(f, part) for f in group)} of {sum(getattr(f, whole) for f in group)}"
        add_row(title, total)
    lines += ["", "| does not meet all | angle | area ratio | first heights off |", "| --- | ---: | ---: | ---: |"]
    for result in judged:
        figures = result.figures.layer
        if not meets_all(figures):
            ratio = " / ".join(f"{value:.2f}" for value in figures.transition)
            star = " *" if result.own_options else ""
            lines.append(f"| {file_names(result)}{star} | {figures.max_angle:.1f} | {ratio} "
                         f"| {figures.first_off} of {figures.first_cells} |")
    return lines


def without_mesh(results, judgements):
    """Returns the table of the cases that have no mesh, each with its reason and its judgement."""
    rows = []
    for result in results:
        if result.figures:
            continue
        entry = judgement_of(result, judgements)
        verdict = f"{entry['judgement']}: {escaped(entry['reason'])}" if entry else "**not judged**"
        rows.append(f"| {file_names(result)} | {result.outcome} | {escaped(result.reason)} | {verdict} |")
    if not rows:
        return []
    return ["", "## Cases without a mesh", "", "| files | outcome | what lamina says | judgement |",
            "| --- | --- | --- | --- |", *rows]


def mended(results, judgements):
    """Returns the table of the cases that once were refused wrongly, and what becomes of them now."""
    rows = []
    for entry in (e for e in judgements if e["judgement"] == "mended"):
        for result in (r for r in results if names_end_with(r.names, entry["files"])):
            now = "valid" if result.figures else f"**{result.outcome}** again"
            rows.append(f"| {file_names(result)} | {escaped(entry['reason'])} | {now} |")
    if not rows:
        return []
    return ["", "## Refusals that were wrong, and are mended", "",
            "| files | what was wrong, and what lamina does now | now |", "| --- | --- | --- |", *rows]


def page(results, left_out, judgements, settings):
    """Returns the whole page."""
    ordered = sorted(results, key=badness)
    lines = head(left_out, settings)
    lines += totals(results, judgements)
    lines += layers(results)
    lines += without_mesh(ordered, judgements)
    lines += mended(results, judgements)
    lines += ["", "## All cases, the worst first", "", *wrapped(
        "Failed and refused cases come first; then meshes with more kinds of warnings, with a larger share of first "
        "heights lost, with fewer cells in the open, with smaller angles."), "", *legend(settings), "", *COLUMNS,
        *map(row, ordered)]
    return "\n".join(lines) + "\n"
