"""Opens every page of the manual in a real browser, without a network.

usage: check_manual.py CHROMIUM BOOK   (CHROMIUM: the browser's program; BOOK: the folder that docs/build.py made; needs the package
                                        of requirements.txt)

Of every page: nothing is fetched, the console is silent, it fits the width of a small screen, every picture is there and has
words for those who do not see it, and every equation is drawn. The search finds a word.

Exits with 1 and a message when something is not what was expected.
"""

import pathlib
import sys

from check_pages import SCREENS, fail, opened
from playwright.sync_api import sync_playwright

# Of a picture: whether it was drawn, and has words. Of an equation: whether it takes up room.
PICTURES = "[...document.querySelectorAll('main img')].filter(own => !own.naturalWidth || !own.alt).map(own => own.src)"
EQUATIONS = "[...document.querySelectorAll('main math')].map(own => own.getBoundingClientRect().height)"


def check(browser, path):
    """The number of equations on the page."""
    width, height = SCREENS["phone"]
    page, heard = opened(browser, path, width, height)
    wide = page.evaluate("document.querySelector('main').scrollWidth")
    if wide > width:
        fail(f"{path}: {wide} pixels wide, where {width} are seen")
    pictures, equations = page.evaluate(PICTURES), page.evaluate(EQUATIONS)
    if pictures:
        fail(f"{path}: {pictures[0]} is not there, or has no words")
    if any(height < 5 for height in equations):
        fail(f"{path}: an equation is not drawn")
    if heard:
        fail(f"{path}: {'; '.join(heard)}")
    page.close()
    return len(equations)


def check_search(browser, path):
    page, heard = opened(browser, path, *SCREENS["desk"])
    page.keyboard.press("s")
    page.locator("#mdbook-searchbar").press_sequentially("multiplier")
    page.locator("#mdbook-searchresults li").first.wait_for(state="visible", timeout=5000)
    if heard:
        fail(f"{path}: {'; '.join(heard)}")
    page.close()


def main():
    program, book = sys.argv[1], pathlib.Path(sys.argv[2])
    pages = sorted(path for path in book.rglob("*.html") if path.name not in ("toc.html", "print.html"))
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=program, args=["--no-sandbox"])
        equations = sum(check(browser, path) for path in pages)
        check_search(browser, book / "index.html")
        browser.close()
    if len(pages) < 30 or equations < 100:
        fail(f"{book} has {len(pages)} pages with {equations} equations, where the manual has more")
    print(f"{len(pages)} pages of the manual are silent and whole; {equations} equations are drawn")


if __name__ == "__main__":
    main()
