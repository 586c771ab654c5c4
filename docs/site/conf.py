"""The documentation as a site: `./dev site`. The pages stay those that a code host shows.

The lists of links in the pages of CONTENTS are the table of contents: each section of such a page becomes a part of
the menu. Links to files that are no pages lead to copies of these files. Notebooks are shown as they were run. The site
alone has the reference of Python: a page for each public name, made of its docstring.
"""

import pathlib
import re

import lamina

project = "lamina"
author = "the lamina authors"
extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx_copybutton"]
root_doc = "docs/README"
include_patterns = ["docs/**", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "packaging/README.md", "web/README.md",
                    "src/**/README.md"]
exclude_patterns = ["docs/site", "docs/Doxyfile"]
source_suffix = {".md": "myst-nb", ".ipynb": "myst-nb", ".rst": "restructuredtext"}
nitpicky = True

nb_execution_mode = "off"

# The anchors of headings are those of code hosts.
myst_heading_anchors = 4

# Members stand in the order of the source, with their types where the signature is.
autodoc_member_order = "bysource"
autodoc_typehints = "none"
add_module_names = False
# What is copied leaves prompts and results out.
copybutton_prompt_text = ">>> |\\.\\.\\. |\\$ "
copybutton_prompt_is_regexp = True

html_theme = "furo"
html_title = "lamina"
html_static_path = []
html_show_sourcelink = False
html_copy_source = False
html_show_search_summary = False  # needs a server
html_permalinks_icon = "#"
# Nothing comes from elsewhere, so the site works without a network.
html_theme_options = {"footer_icons": []}

CONTENTS = {"docs/README", "docs/decisions/README"}


def menu_of(text, page):
    """Returns the tables of contents that the lists of links in a page amount to."""
    menu = ""
    for section in re.split(r"(?m)^## ", text):
        targets = re.findall(r"(?m)^- \[[^\]]*\]\(([^)#]+)\.(?:md|ipynb)\)", section)
        caption = section.partition("\n")[0] if page == root_doc else ""
        if targets:
            menu += "\n```{toctree}\n:hidden:\n" + (f":caption: {caption}\n" if caption else "") + "\n"
            menu += "\n".join(targets) + "\n```\n"
    return menu


REFERENCE = "docs/python-reference"


def add_menu(app, page, source):
    if page in CONTENTS:
        source[0] += menu_of(source[0], page)
    if page == root_doc:
        source[0] += f"\n```{{toctree}}\n:hidden:\n:caption: Names of Python\n\n/{REFERENCE}/index\n```\n"


def directive_of(name):
    """Returns what autodoc describes a public class or function with."""
    value = getattr(lamina, name)
    if isinstance(value, type):
        return f".. autoclass:: lamina.{name}\n   :members:\n   :undoc-members:\n"
    return f".. autofunction:: lamina.{name}\n"


def write_reference(app):
    """Writes a page for each public name of Python, which are no pages of the repository, beside a list of them."""
    folder = pathlib.Path(app.srcdir, REFERENCE)
    names = [name for name in lamina.__all__ if callable(getattr(lamina, name))]
    pages = {name: f"{name}\n{'=' * len(name)}\n\n{directive_of(name)}" for name in names}
    listed = "".join(f"   {name}\n" for name in names)
    pages["index"] = (f"Python reference\n================\n\n.. automodule:: lamina\n\n"
                      f".. toctree::\n   :maxdepth: 1\n\n{listed}")
    folder.mkdir(exist_ok=True)
    for name, text in pages.items():
        page = folder / f"{name}.rst"
        if not page.exists() or page.read_text() != text:
            page.write_text(text)


def as_text(app, what, name, of, options, lines):
    """Makes docstrings what Sphinx reads: plain text with code in single backquotes, underlined headings and indented
    drawings."""
    for i, line in enumerate(lines):
        if line.endswith(":") and lines[i + 1:i + 2] == [""] and lines[i + 2].startswith("    "):
            lines[i] = line = line + ":"
        if i > 0 and re.fullmatch("-{3,}", line):
            lines[i - 1:i + 1] = [f".. rubric:: {lines[i - 1]}", ""]
            continue
        if not line.lstrip().startswith((">>>", "...")):
            lines[i] = re.sub(r"(?<!`)`([^`]+)`(?!`)", r"``\1``", line)


def write_front_page(app, exception):
    """Leads from index.html to the first page."""
    if exception is None:
        pathlib.Path(app.outdir, "index.html").write_text(
            '<!doctype html><meta charset="utf-8"><title>lamina</title>'
            f'<meta http-equiv="refresh" content="0; url={root_doc}.html"><a href="{root_doc}.html">lamina</a>\n')


def setup(app):
    app.connect("builder-inited", write_reference)
    app.connect("autodoc-process-docstring", as_text)
    app.connect("source-read", add_menu)
    app.connect("build-finished", write_front_page)
