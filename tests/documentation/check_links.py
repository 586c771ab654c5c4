#!/usr/bin/env python3
"""Checks the links between the pages, and of a built site.

usage: check_links.py SOURCE [SITE]

Without SITE: each relative link and picture of each Markdown file of SOURCE leads to a file, and to a heading where it
names one; each source that a page names exists; each page of docs/ is in the menu, which is docs/README.md; each picture of docs/images is shown somewhere.
With SITE: each link and picture of the HTML pages in that folder leads to a file there, and none is loaded from
elsewhere, so that the site works without a network. The exit status is 1 where something is wrong.
"""

import html.parser
import pathlib
import re
import sys
import urllib.parse

LEFT_OUT = {"build", "out", ".git", "node_modules"}


def anchors_of(text):
    """Returns the anchors that code hosts give to the headings of a page."""
    anchors, seen = set(), {}
    for title in re.findall(r"(?m)^#{1,6} (.*)$", re.sub(r"(?ms)^```.*?^```$", "", text)):
        title = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title)
        anchor = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        anchors.add(anchor if anchor not in seen else f"{anchor}-{seen[anchor]}")
        seen[anchor] = seen.get(anchor, 0) + 1
    return anchors


def pages_of(source):
    return [page for page in sorted(source.rglob("*.md")) if not LEFT_OUT & set(page.relative_to(source).parts)]


def links_of(text):
    """Returns the targets of the links and pictures of a page that do not lead elsewhere."""
    text = re.sub(r"(?ms)^```.*?^```$", "", text)
    text = re.sub(r"`[^`]*`", "", text)
    targets = re.findall(r"\]\(<?([^)>\s]+)>?\)", text) + re.findall(r'(?:src|href|srcset)="([^"]+)"', text)
    return [target for target in targets if not re.match(r"[a-z]+:", target)]


def sources_of(text):
    """Returns the files and folders of code that a page names: `src/...`, but for patterns and placeholders."""
    return re.findall(r"`((?:src|include|tests|tools|cmake|python|bench)/[a-z0-9_./]+)`", text)


def check_pages(source):
    problems, linked = [], {}
    pages = pages_of(source)
    for page in pages:
        for target in links_of(page.read_text()):
            path, _, anchor = target.partition("#")
            file = (page.parent / urllib.parse.unquote(path)).resolve() if path else page.resolve()
            linked.setdefault(page.resolve(), set()).add(file)
            if not file.exists():
                problems.append(f"{page}: {target}: no such file")
            elif anchor and file.suffix == ".md" and anchor not in anchors_of(file.read_text()):
                problems.append(f"{page}: {target}: no such heading")
        problems += [f"{page}: {name}: no such file" for name in sources_of(page.read_text())
                     if not (source / name).exists()]
    docs = source / "docs"
    menu = linked.get((docs / "README.md").resolve(), set())
    shown = set().union(*linked.values())
    for page in pages:
        if docs in page.parents and "decisions" not in page.parts and page.name != "README.md" \
                and page.resolve() not in menu:
            problems.append(f"{page}: not in the menu, docs/README.md")
    for picture in sorted((docs / "images").iterdir()):
        if picture.suffix != ".dot" and picture.resolve() not in shown:
            problems.append(f"{picture}: shown nowhere")
    return problems, sum(map(len, linked.values()))


class Loaded(html.parser.HTMLParser):
    """Gathers what a page of HTML loads, and where it leads."""

    def __init__(self):
        super().__init__()
        self.loads, self.leads, self.anchors = [], [], set()

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if attributes.get("id"):
            self.anchors.add(attributes["id"])
        if tag == "a":
            self.leads.append(attributes.get("href") or "")
        elif tag in ("img", "script", "iframe", "source"):
            self.loads.append(attributes.get("src") or attributes.get("srcset") or "")
        elif tag == "link" and "stylesheet" in (attributes.get("rel") or ""):
            self.loads.append(attributes.get("href") or "")


def check_site(site):
    problems, count, parsed = [], 0, {}
    for page in sorted(site.rglob("*.html")):
        parsed[page.resolve()] = Loaded()
        parsed[page.resolve()].feed(page.read_text())
    for page, found in parsed.items():
        for target in found.loads:
            if re.match(r"(https?:)?//", target):
                problems.append(f"{page}: loads {target} from elsewhere")
        for target in found.loads + found.leads:
            if not target or re.match(r"[a-z]+:|//", target):
                continue
            count += 1
            path, _, anchor = target.partition("#")
            file = (page.parent / urllib.parse.unquote(path.partition("?")[0])).resolve() if path else page
            if not file.exists():
                problems.append(f"{page}: {target}: no such file")
            elif anchor and file in parsed and urllib.parse.unquote(anchor) not in parsed[file].anchors:
                problems.append(f"{page}: {target}: no such place")
    for style in site.rglob("*.css"):
        if re.search(r"@import[^;]*//|url\(['\"]?(https?:)?//", style.read_text()):
            problems.append(f"{style}: loads from elsewhere")
    return problems, count


def main():
    source, *site = (pathlib.Path(name).resolve() for name in sys.argv[1:])
    problems, count = check_site(site[0]) if site else check_pages(source)
    if count < 100:
        problems.append(f"only {count} links were found")
    print("\n".join(problems))
    print(f"{count} links, {len(problems)} problems")
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
