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


# What layers are judged by. Those of the area ratio judge layers that end where cells are as high as wide.
AREA_TARGETS = (lambda f: f.transition[0] >= 0.5, lambda f: 0.8 <= f.transition[1] <= 1.25,
                lambda f: f.transition[2] <= 2)
LAYER_TARGETS = (lambda f: f.max_angle <= 150, lambda f: f.first_off <= 0.001 * f.first_cells)


def meets_all(figures):
    """Returns whether a layer meets all targets that it is judged by."""
    return all(meets(figures) for meets in (AREA_TARGETS if figures.transition else ()) + LAYER_TARGETS)


def layer_note(figures):
    """Returns what a layer that misses a target has, for the notes of its case; an empty text for others."""
    if not figures or meets_all(figures):
        return ""
    ratio = f", area ratio {' / '.join(f'{value:.2f}' for value in figures.transition)}" if figures.transition else ""
    return (f"layer: largest angle {figures.max_angle:.1f}{ratio}, {figures.first_off} of {figures.first_cells} first "
            "heights off")


def keeps_jacobian(figures):
    """Returns whether the smallest scaled Jacobian of curved cells is within 5 % of that of the straight ones."""
    return figures.least >= 0.95 * figures.straight


def curved_note(figures):
    """Returns what curved cells have that are worse than straight ones, for the notes of their case."""
    if not figures or keeps_jacobian(figures) and not figures.reduced:
        return ""
    return (f"curved: scaled Jacobian {figures.least:.3f}, straight {figures.straight:.3f}, at ({figures.at[0]:.4g}, "
            f"{figures.at[1]:.4g}), {figures.reduced} of {figures.wall_edges} wall edges reduced")


def notes(result, judgements):
    """Returns what is to be said of a case: reason and judgement where there is no mesh, else what its mesh lacks."""
    figures = result.figures
    if figures is None:
        entry = judgement_of(result, judgements)
        verdict = f"{entry['judgement']}: {escaped(entry['reason'])}" if entry else "**not judged**"
        return f"{escaped(result.reason)}<br>{verdict}"
    counts = ((figures.first_lost, f"{figures.first_lost} of {figures.wall_edges} first heights lost"),
              (figures.exempt, f"{figures.exempt} angles exempt"),
              (figures.below_bound, f"**{figures.below_bound} angles below the bound**"),
              (figures.refused, f"{figures.refused} points refused"),
              (figures.oversized, f"{figures.oversized} triangles too large"))
    warnings = ", ".join(f"`{code}`" + (f" ({n})" if n > 1 else "")
                         for code, n in sorted(Counter(figures.warnings).items()))
    return "; ".join(filter(None, [warnings, *(text for number, text in counts if number), layer_note(figures.layer),
                                   curved_note(figures.curved)]))


def row(result, judgements):
    """Returns the row of the table for one case."""
    names = file_names(result) + (" *" if result.own_options else "")
    figures = result.figures
    cells = ["", "", "", ""]
    if figures:
        cells = [f"{figures.triangles}", pair(figures.rays), pair(figures.cells), f"{figures.min_angle:.1f}"]
    outcome = f"**{result.outcome}**" if result.outcome == "failed" else result.outcome
    mended = [entry for entry in judgements
              if entry["judgement"] == "mended" and names_end_with(result.names, entry["files"])]
    said_of_it = [notes(result, judgements)]
    if mended:
        said_of_it.append(f"{'once' if figures else '**again**'} refused: {escaped(mended[0]['reason'])}")
    return f"| {names} | {outcome} | {' | '.join(cells)} | {'<br>'.join(filter(None, said_of_it))} |"


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
        lines += ["", *wrapped(f"Files left out by their ending: {skipped}.")]
    return lines


def totals(results, judgements):
    """Returns the lines that count outcomes, judgements and what meshes lack."""
    judged = Counter((judgement_of(r, judgements) or {"judgement": "not judged"})["judgement"]
                     for r in results if r.outcome == "refused")
    text = f"{summary(results)}."
    if judged:
        text += f" Of the refusals {', '.join(f'{n} are {name}' for name, n in sorted(judged.items()))}."
    valid = [result.figures for result in results if result.figures]
    if not valid:
        return ["", *wrapped(text)]
    text += (f" The meshes have {sum(f.triangles for f in valid):,} triangles, {sum(f.first_lost for f in valid)} wall "
             f"edges without a first height, {sum(f.below_bound for f in valid)} angles below the bound that no sharp "
             f"corner excuses, and {sum(f.oversized for f in valid)} triangles larger than asked. "
             f"{sum(not f.warnings for f in valid)} have no warning. In {sum(f.rays[1] == 100 for f in valid)} every "
             "ray in the open carries all layers.")
    return ["", *wrapped(text), *layer_totals([figures.layer for figures in valid if figures.layer]),
            *curved_totals([figures.curved for figures in valid if figures.curved])]


def layer_totals(judged):
    """Returns the lines that say how many layers meet their targets, apart for single sections and several elements."""
    if not judged:
        return []
    single = [figures for figures in judged if figures.elements == 1]
    several = [figures for figures in judged if figures.elements > 1]
    return ["", *wrapped(
        f"The layers of {sum(map(meets_all, single))} of {len(single)} single sections and of "
        f"{sum(map(meets_all, several))} of {len(several)} configurations meet all targets: no angle above 150 "
        "degrees, 99.9 % of the first heights within 1 %, and, where layers end at isotropy, an area ratio to the "
        "triangles beyond of at least 0.5 (1st percentile), 0.8 to 1.25 (median) and at most 2 (99th).")]


def curved_totals(judged):
    """Returns the lines that compare curved cells with the straight ones of the same corners."""
    if not judged:
        return []
    kept = sum(map(keeps_jacobian, judged))
    return ["", *wrapped(
        f"Curved cells: {sum(f.cells for f in judged):,}, all proved valid. Their smallest scaled Jacobian is within "
        f"5 % of that of the straight cells in {kept} of {len(judged)} cases ({100 * kept / len(judged):.1f} %), and "
        f"{min(f.least for f in judged):.4f} at least. {sum(f.reduced for f in judged)} of "
        f"{sum(f.wall_edges for f in judged):,} wall edges bend less than the wall.")]


def legend(settings):
    """Returns the lines that say what the columns of the table mean."""
    reference = "reference" if settings.own else "../docs/reference"
    return ["", *wrapped(
        "The worst cases come first. *Rays*: per cent with all requested layers; *cells*: per cent of the requested "
        f"ones; both also [in the open]({reference}/report.md#layer). *Angle*: the smallest of the isotropic region. "
        f"Notes hold [warnings]({reference}/checks.md#warnings), why there is no mesh and whether that is right, and "
        "the figures of layers that miss a target. A star marks options of the case's own.")]


COLUMNS = ["| files | outcome | triangles | rays | cells | angle | notes |",
           "| --- | --- | ---: | ---: | ---: | ---: | --- |"]


def page(results, left_out, judgements, settings):
    """Returns the whole page: some sentences, and a table with a row for each case."""
    lines = [*head(left_out, settings), *totals(results, judgements), *legend(settings), "", *COLUMNS]
    return "\n".join(lines + [row(result, judgements) for result in sorted(results, key=badness)]) + "\n"
