"""The documentation as a site: `./dev site`. The pages stay those that a code host shows.

The lists of links in the pages of CONTENTS are the table of contents: each section of such a page becomes a part of
the menu. Links to files that are no pages lead to copies of these files.
"""

import pathlib
import re

project = "lamina"
author = "the lamina authors"
extensions = ["myst_parser"]
root_doc = "docs/README"
include_patterns = ["docs/**", "README.md", "CONTRIBUTING.md", "CHANGELOG.md", "packaging/README.md", "web/README.md",
                    "src/**/README.md"]
exclude_patterns = ["docs/site", "docs/Doxyfile"]
source_suffix = {".md": "markdown"}
nitpicky = True

# The anchors of headings are those of code hosts.
myst_heading_anchors = 4

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
        targets = re.findall(r"(?m)^- \[[^\]]*\]\(([^)#]+)\.md\)", section)
        caption = section.partition("\n")[0] if page == root_doc else ""
        if targets:
            menu += "\n```{toctree}\n:hidden:\n" + (f":caption: {caption}\n" if caption else "") + "\n"
            menu += "\n".join(targets) + "\n```\n"
    return menu


def add_menu(app, page, source):
    if page in CONTENTS:
        source[0] += menu_of(source[0], page)


def write_front_page(app, exception):
    """Leads from index.html to the first page."""
    if exception is None:
        pathlib.Path(app.outdir, "index.html").write_text(
            '<!doctype html><meta charset="utf-8"><title>lamina</title>'
            f'<meta http-equiv="refresh" content="0; url={root_doc}.html"><a href="{root_doc}.html">lamina</a>\n')


def setup(app):
    app.connect("source-read", add_menu)
    app.connect("build-finished", write_front_page)
