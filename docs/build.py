"""Builds the manual: one folder of pages that needs no network.

usage: python3 docs/build.py [FOLDER]    (default target/book; begin with FOLDER/index.html)

Needs the packages of docs/requirements.txt. Pages lie where readers of the repository expect them, and the manual has those that
docs/SUMMARY.md lists, with all files that they link to, in the same folders. So every link is the same here and there. Equations
between dollars become MathML.

Exits with 1 and what is wrong, where mdBook warns, an equation cannot be read, a link leads nowhere, or a page would load anything
from a network.
"""

import html.parser
import pathlib
import posixpath
import re
import shutil
import subprocess
import sys
import tempfile
import urllib.parse

import math_core

ROOT = pathlib.Path(__file__).resolve().parent.parent
LINK = re.compile(r"\]\(([^)\s]+)\)")
# Code first, so that a dollar in it is none of ours.
CODE_OR_MATH = re.compile(r"^```.*?^```$|`[^`\n]*`|\$\$(?P<block>.+?)\$\$|\$(?P<inline>[^$\n]+)\$", re.M | re.S)
COLOUR = "\x1b\\[[0-9;]*m"
# What Markdown would take for itself within a line.
MARKS = {"|": "&#124;", "*": "&#42;", "_": "&#95;", "\\": "&#92;", "[": "&#91;"}
# What a browser loads by itself when it opens a page, by the name of the attribute.
LOADED = {"src": None, "href": {"link"}, "poster": None, "data": {"object"}}


def fail(faults):
    sys.exit("\n".join(f"docs/build.py: {fault}" for fault in faults))


def links(text):
    """The files that a page links to, as paths from its folder."""
    prose = re.sub(r"^```.*?^```$|`[^`\n]*`", "", text, flags=re.M | re.S)
    targets = (urllib.parse.unquote(link.split("#")[0]) for link in LINK.findall(prose))
    return [target for target in targets if target and not re.match(r"[a-z]+:", target)]


def with_equations(path, text, converter):
    def convert(found):
        latex = found["block"] or found["inline"]
        if latex is None:
            return found[0]
        try:
            mathml = converter.convert_with_local_state(latex, displaystyle=found["block"] is not None)
        except math_core.LatexError as error:
            fail([f"{path}: {latex.strip()}: {re.sub(COLOUR, '', str(error)).strip()}"])
        if found["block"]:
            return f'<div class="equation">\n{mathml}\n</div>'
        return re.sub(r"[|*_\\\[](?![^<]*>)", lambda mark: MARKS[mark[0]], mathml)

    return CODE_OR_MATH.sub(convert, text)


def lay_out(source):
    """Copies the pages of the summary and all that they link to."""
    converter, faults = math_core.LatexToMathML(), []
    summary = (ROOT / "docs/SUMMARY.md").read_text()
    summary = LINK.sub(lambda link: f"]({posixpath.normpath(posixpath.join('docs', link[1]))})", summary)
    (source / "SUMMARY.md").write_text(summary)
    pages = set(LINK.findall(summary))
    for page in sorted(pages):
        if not (ROOT / page).is_file():
            faults.append(f"docs/SUMMARY.md: {page} is not there")
            continue
        text = (ROOT / page).read_text()
        (source / page).parent.mkdir(parents=True, exist_ok=True)
        (source / page).write_text(with_equations(page, text, converter))
        for link in links(text):
            target = posixpath.normpath(posixpath.join(posixpath.dirname(page), link))
            if target in pages:
                continue
            if target.startswith("..") or not (ROOT / target).exists():
                faults.append(f"{page}: {link} is no file of the repository")
            elif target.endswith(".md"):
                faults.append(f"{page}: {link} is no page of docs/SUMMARY.md")
            elif (ROOT / target).is_dir():
                shutil.copytree(ROOT / target, source / target, dirs_exist_ok=True)
            else:
                (source / target).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / target, source / target)
    shutil.copy(ROOT / "docs/manual.css", source / "docs/manual.css")
    if faults:
        fail(faults)


class Page(html.parser.HTMLParser):
    """The places in a page, what it leads to, and what it loads."""

    def __init__(self, text):
        super().__init__()
        self.places, self.leads, self.loads = {""}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name") and value:
                self.places.add(value)
            elif name in LOADED and (LOADED[name] is None or tag in LOADED[name]):
                self.loads.append(value or "")
            elif name == "href" and tag == "a":
                self.leads.append(value or "")


def check(book):
    """Every link leads to a place that is there, and nothing is loaded from elsewhere."""
    pages = {path: Page(path.read_text()) for path in sorted(book.rglob("*.html"))}
    faults = []
    for path, page in pages.items():
        here = path.relative_to(book)
        faults += [f"{here} loads {url}" for url in page.loads if re.match(r"([a-z]+:)?//", url)]
        for url in page.leads + page.loads:
            to, _, place = urllib.parse.unquote(url).partition("#")
            if re.match(r"([a-z]+:|//)", to):
                continue
            target = (path.parent / to).resolve() if to else path
            if not target.exists():
                faults.append(f"{here}: {url} leads to no file")
            elif target in pages and place not in pages[target].places:
                faults.append(f"{here}: {url} leads to no place of {target.relative_to(book)}")
    for path in book.rglob("*.css"):
        if re.search(r"(@import|url\()\s*[\"']?(https?:)?//", path.read_text()):
            faults.append(f"{path.relative_to(book)} loads from a network")
    return len(pages), faults


def main():
    book = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "target/book").resolve()
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder)
        lay_out(source)
        shutil.copy(ROOT / "docs/book.toml", source)
        program = shutil.which("mdbook", path=pathlib.Path(sys.executable).parent) or "mdbook"
        ran = subprocess.run([program, "build", "--dest-dir", book, source], capture_output=True, text=True)
    said = [line.strip() for line in (ran.stdout + ran.stderr).splitlines() if re.search(r"\b(WARN|ERROR)\b", line)]
    if ran.returncode or said:
        fail(said or [ran.stderr])
    count, faults = check(book)
    if faults:
        fail(faults)
    print(f"{count} pages in {book}, all links lead somewhere, nothing is loaded from a network")


if __name__ == "__main__":
    main()
