"""Opens the pages that pirca writes in a real browser, without a network.

usage: check_pages.py CHROMIUM RUN WALL VERDICT CAPACITY COMPARE SENSITIVITY PLAN DETECTABILITY READINGS PLATE TYPES
        (CHROMIUM: the browser's program; RUN: report.html of a run with three random walls or more; WALL, VERDICT, ...: report.html of
        analyse, diagnose, capacity, compare, sensitivity, plan-tests, detectability, readings, homogenise and run (of types of elements); needs the package of
        requirements.txt)

Of every page: nothing is fetched, the console is silent, no script of a name runs, the words that must be there are seen, all that a
figure shows has a name for those who do not see it, the page is no larger than it may be, and it fits the width of A4 and of a small
screen. Of the run's page besides: a mark, reached and pressed by the keyboard alone, leads to its wall and unfolds the table that holds
it; and on paper the inputs are unfolded. Walls in three dimensions are
drawn, move with their slider, turn by keys, and change with what colours them. Every figure has marks on it: a blank one would have a single colour.

Exits with 1 and a message when something is not what was expected.
"""

import pathlib
import sys

from playwright.sync_api import sync_playwright

# A page beyond this is slow to open and to send (bytes).
LARGEST = 5_000_000
# Draws in three dimensions without a graphics card. With less the page is blank and nothing is said.
SOFTWARE = ["--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
SCREENS = {"desk": (1280, 900), "phone": (390, 844), "A4": (794, 1123)}


def fail(words):
    sys.exit(f"check_pages: {words}")


def opened(browser, path, width, height):
    """The page, which must be silent and fetch nothing."""
    page = browser.new_page(viewport={"width": width, "height": height})
    heard = []
    page.on("console", lambda message: heard.append(f"console: {message.text}"))
    page.on("pageerror", lambda error: heard.append(f"error: {error}"))
    page.on("dialog", lambda dialog: (heard.append(f"dialog: {dialog.message}"), dialog.dismiss()))
    page.on(
        "request",
        lambda request: None if request.url.startswith(("file:", "data:")) else heard.append(f"fetched: {request.url}"),
    )
    page.goto(path.resolve().as_uri())
    return page, heard


def check(browser, path, words):
    size = path.stat().st_size
    if size > LARGEST:
        fail(f"{path} has {size} bytes, allowed are {LARGEST}")
    for screen, (width, height) in SCREENS.items():
        page, heard = opened(browser, path, width, height)
        for wanted in words:
            # The title of a drawing has the words of its caption, and is not seen.
            if page.get_by_text(wanted).filter(visible=True).count() == 0:
                fail(f"{path}, {screen}: \"{wanted}\" is not seen")
        wide = page.evaluate("document.documentElement.scrollWidth")
        if wide > width:
            fail(f"{path}, {screen}: {wide} pixels wide, where {width} are seen")
        if heard:
            fail(f"{path}, {screen}: {'; '.join(heard)}")
        page.close()
    page, heard = opened(browser, path, *SCREENS["desk"])
    figures = page.locator("figure:not(.solid)")
    for number in range(figures.count()):
        drawing = figures.nth(number).locator("> svg")
        picture = drawing.screenshot()
        # A sketch of a cause is small.
        least = 4000 if drawing.bounding_box()["width"] > 400 else 1500
        if len(picture) < least:
            fail(f"{path}: figure {number} is blank ({len(picture)} bytes as PNG)")
    count = figures.count()
    page.close()
    return count


def check_names(browser, path):
    page, _ = opened(browser, path, *SCREENS["desk"])
    nameless = page.evaluate(
        """[...document.querySelectorAll("figure svg")].filter(svg => (svg.getAttribute("aria-labelledby") || "").split(" ")
           .some(id => !document.getElementById(id) || !document.getElementById(id).textContent)).length"""
    )
    if nameless:
        fail(f"{path}: {nameless} figures have no name for a reader of screens")
    page.close()


def check_marks(browser, path):
    """By the keyboard: to the first mark that leads to a row, which is folded away, and in."""
    page, heard = opened(browser, path, *SCREENS["desk"])
    page.evaluate("document.querySelectorAll('details').forEach(part => { part.open = false; })")
    marks = page.locator("svg a[href^='#wall-']")
    for _ in range(400):
        page.keyboard.press("Tab")
        to = page.evaluate("document.activeElement.getAttribute('href') || ''")
        if to.startswith("#wall-"):
            break
    else:
        fail(f"{path}: the keyboard reaches none of {marks.count()} marks")
    if page.locator(to).is_visible():
        fail(f"{path}: {to} was not folded away")
    page.keyboard.press("Enter")
    page.locator(to).wait_for(state="visible", timeout=3000)
    drawn = page.locator("svg a[href^='#figure-']")
    if drawn.count() < 3:
        fail(f"{path}: {drawn.count()} marks lead to drawings, not 3")
    for number in range(3):
        if page.locator(drawn.nth(number).get_attribute("href")).count() != 1:
            fail(f"{path}: a mark leads to no drawing")
    if heard:
        fail(f"{path}: {'; '.join(heard)}")
    page.close()


def check_solid(browser, path, walls):
    """Walls in three dimensions: something is drawn, it moves with the slider, keys turn it, colours and walls can be chosen."""
    page, heard = opened(browser, path, *SCREENS["desk"])
    solid = page.locator("figure.solid")
    canvas, slider, said = solid.locator("canvas"), solid.locator("[name=state]"), solid.locator(".said")
    canvas.scroll_into_view_if_needed()
    seen = {"at the end": canvas.screenshot()}
    last = int(slider.get_attribute("max"))
    end = said.text_content()
    for name, state in [("halfway", last // 2), ("at rest", 0)]:
        slider.fill(str(state))
        seen[name] = canvas.screenshot()
    if said.text_content() == end:
        fail(f"{path}: the slider does not say that it moved: {end}")
    canvas.focus()
    for key in ["ArrowRight", "ArrowRight", "ArrowUp", "+"]:
        page.keyboard.press(key)
    seen["turned"] = canvas.screenshot()
    slider.fill(str(last))
    for measure in ["movement", "opening", "stress"]:
        solid.locator("[name=measure]").select_option(measure)
        seen[measure] = canvas.screenshot()
        if not solid.locator(".bar").is_visible():
            fail(f"{path}: the colours of {measure} have no bar")
    choices = solid.locator("[name=wall] option").count()
    if choices != (walls if walls > 1 else 0):
        fail(f"{path}: {choices} walls can be chosen, not {walls}")
    for wall in range(1, walls):
        solid.locator("[name=wall]").select_option(str(wall))
        seen[f"wall {wall}"] = canvas.screenshot()
    if len(set(seen.values())) < len(seen):
        same = [name for name, picture in seen.items() if list(seen.values()).count(picture) > 1]
        fail(f"{path}: in three dimensions these look alike: {', '.join(same)}")
    # A blank canvas of this size has some three thousand bytes.
    if min(map(len, seen.values())) < 8_000:
        fail(f"{path}: the wall in three dimensions is blank: { {name: len(picture) for name, picture in seen.items()} } bytes as PNG")
    solid.locator("[name=play]").click()
    page.wait_for_function("document.querySelector('figure.solid [name=state]').valueAsNumber > 1", timeout=20_000)
    if heard:
        fail(f"{path}: {'; '.join(heard)}")
    page.close()


def check_charts(browser, path):
    """Figures whose values can be read off: a button puts a chart in their place, which tells the values under the pointer."""
    page, heard = opened(browser, path, *SCREENS["desk"])
    charted = page.locator("figure.charted")
    if not charted.count():
        fail(f"{path}: no figure can be read off")
    for number in range(charted.count()):
        figure = charted.nth(number)
        figure.locator("button.read").click()
        over = figure.locator(".u-over")
        over.scroll_into_view_if_needed()
        over.hover()
        read = figure.locator(".u-legend .u-value").all_text_contents()
        if figure.locator("> svg").is_visible() or not any(value.strip("- ") for value in read):
            fail(f"{path}: nothing is read off chart {number}: {read}")
        if len(figure.locator(".chart").screenshot()) < 4000:
            fail(f"{path}: chart {number} is blank")
        figure.locator("button.read").click()
        if not figure.locator("> svg").is_visible():
            fail(f"{path}: the drawing of chart {number} does not come back")
    if heard:
        fail(f"{path}: {'; '.join(heard)}")
    page.close()


def check_without(browser, path):
    """A browser that draws nothing in three dimensions says so, and shows the rest."""
    page = browser.new_page()
    page.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    page.goto(path.resolve().as_uri())
    if not page.get_by_text("This browser shows nothing in three dimensions").is_visible():
        fail(f"{path}: without WebGL nothing is said")
    page.close()


def check_paper(browser, path):
    """What paper shows: the inputs unfolded."""
    page, _ = opened(browser, path, *SCREENS["A4"])
    paper = page.pdf(prefer_css_page_size=True)
    if len(paper) < 20_000:
        fail(f"{path}: {len(paper)} bytes of PDF hold hardly anything")
    if page.locator("details.printed:not([open])").count():
        fail(f"{path}: inputs are folded away on paper")
    page.close()


def main():
    if len(sys.argv) != 13:
        sys.exit(__doc__)
    chromium, (run, wall, verdict, *answers) = sys.argv[1], map(pathlib.Path, sys.argv[2:])
    capacity, compare, sensitivity, plan, detectability, readings, plate, types = answers
    shared = ["Limits of validity", "Provenance", "For a paper"]
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox", *SOFTWARE])
        found = []
        for path, words in [
            (run, ["Result", "Wall and inputs", "Statistics", "The walls", "Limits of validity", "Provenance", "For a paper"]),
            (wall, ["Result", "The wall from three sides, before the load", "Blocks and joints", "Inputs", "Limits of validity", "Provenance"]),
            (verdict, ["What is wrong", "Measured beside simulated", "Causes", "How often such verdicts are right", *shared]),
            (capacity, ["Result", "Answers", "Values that these walls support", "Wall and inputs", *shared]),
            (compare, ["Result", "Arms, the best first", "Every pair of arms", "Wall and inputs", *shared]),
            (sensitivity, ["Result", "Shares of the variance in %", "Wall and inputs", *shared]),
            (plan, ["Result", "Characteristic value of 3 specimens", "Wall and inputs", *shared]),
            (detectability, ["Result", "What each mechanism was", "Wall and inputs", *shared]),
            (readings, ["Result", "Statements", "Readings, the best ones first", "Wall and inputs", *shared]),
            (plate, ["Result", "Stiffness at kn of the arm", "Size of the cells", "Wall and inputs", *shared]),
            (types, ["Result", "Types of elements", "Wall and inputs", *shared]),
        ]:
            found.append(f"{path}: {check(browser, path, words)} figures")
            check_names(browser, path)
        for path, walls in [(run, 3), (wall, 1)]:
            check_solid(browser, path, walls)
            check_without(browser, path)
        for path in [run, capacity, compare]:
            check_charts(browser, path)
        check_marks(browser, run)
        for path in [run, verdict, *answers]:
            check_paper(browser, path)
        browser.close()
    print("\n".join(found))


if __name__ == "__main__":
    main()
