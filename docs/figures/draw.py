"""Draws the figures of the theory pages from their equations.

usage: python3 docs/figures/draw.py PIRCA [--check]    (PIRCA: the program, which generates the walls of one figure and draws another)

Writes the .svg files beside this script. With --check it writes nothing, and exits with 1 where a file is not what it would write.
Needs Python alone. Colours are those of Okabe and Ito, as in all figures of the project; lines differ by their dashes and are named
where they end, so that a print in grey can be read.
"""

import json
import math
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
BLUE, ORANGE, GREEN, PINK, BLACK, GREY = "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000", "#8A8A8A"
DASHES = ["", "7 3", "2 3", "9 3 2 3"]
STONES = ["#DDE7EE", "#F1DFD0", "#D5EBE3", "#ECECEC"]


class Drawing:
    """An SVG figure with a name for those who do not see it."""

    def __init__(self, width, height, name):
        self.width, self.height, self.name, self.parts = width, height, name, []

    def line(self, points, colour=BLACK, width=1.0, dash="", fill="none"):
        at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        dashes = f' stroke-dasharray="{dash}"' if dash else ""
        self.parts.append(f'<polyline points="{at}" fill="{fill}" stroke="{colour}" stroke-width="{width}"{dashes}/>')

    def area(self, points, fill, colour=BLACK, width=1.0):
        at = " ".join(f"{x:.1f},{y:.1f}" for x, y in points)
        self.parts.append(f'<polygon points="{at}" fill="{fill}" stroke="{colour}" stroke-width="{width}"/>')

    def dot(self, x, y, colour=BLACK, radius=4.5):
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius}" fill="{colour}"/>')

    def text(self, x, y, words, size=14, anchor="start", colour=BLACK, turned=False, bold=False):
        turn = f' transform="rotate(-90 {x:.1f} {y:.1f})"' if turned else ""
        weight = ' font-weight="bold"' if bold else ""
        words = words.replace("&", "&amp;").replace("<", "&lt;")
        self.parts.append(
            f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" text-anchor="{anchor}" fill="{colour}"{turn}{weight}>{words}</text>'
        )

    def arrow(self, start, end, colour=BLACK, width=1.6, dash=""):
        (x, y), (u, v) = start, end
        length = math.hypot(u - x, v - y)
        a, b = (u - x) / length, (v - y) / length
        self.line([start, (u - 6 * a, v - 6 * b)], colour, width, dash)
        self.area([end, (u - 9 * a - 4 * b, v - 9 * b + 4 * a), (u - 9 * a + 4 * b, v - 9 * b - 4 * a)], colour, colour, 0.5)

    def svg(self):
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{self.width}" height="{self.height}" '
            f'viewBox="0 0 {self.width} {self.height}" role="img" font-family="DejaVu Sans, Verdana, sans-serif">'
        )
        paper = f'<rect width="{self.width}" height="{self.height}" fill="#FFFFFF"/>'
        return "\n".join([head, f"<title>{self.name}</title>", paper, *self.parts, "</svg>\n"])


class Axes:
    """A plot within a drawing."""

    def __init__(self, drawing, box, x_range, y_range, labels, ticks, log_x=False):
        self.drawing, self.box, self.log_x = drawing, box, log_x
        self.x_range, self.y_range = [self.scale(x) for x in x_range], y_range
        left, top, right, bottom = box
        for value, words in ticks[1]:
            y = self.at(x_range[0], value)[1]
            drawing.line([(left, y), (right, y)], "#D7D7D7")
            drawing.text(left - 8, y + 5, words, 13, "end")
        for value, words in ticks[0]:
            x = self.at(value, y_range[0])[0]
            drawing.line([(x, bottom), (x, bottom + 5)])
            drawing.text(x, bottom + 20, words, 13, "middle")
        drawing.line([(left, top), (left, bottom), (right, bottom)])
        drawing.text((left + right) / 2, bottom + 42, labels[0], 14, "middle")
        drawing.text(left - 46, (top + bottom) / 2, labels[1], 14, "middle", turned=True)

    def scale(self, x):
        return math.log10(x) if self.log_x else x

    def at(self, x, y):
        left, top, right, bottom = self.box
        (a, b), (c, d) = self.x_range, self.y_range
        return left + (self.scale(x) - a) / (b - a) * (right - left), bottom - (y - c) / (d - c) * (bottom - top)

    def curve(self, points, colour, dash="", width=2.0):
        self.drawing.line([self.at(x, y) for x, y in points], colour, width, dash)

    def name(self, x, y, words, colour=BLACK, anchor="start", up=0):
        at = self.at(x, y)
        self.drawing.text(at[0] + (6 if anchor == "start" else -6 if anchor == "end" else 0), at[1] + 5 - up, words, 13, anchor, colour)


def numbers(values):
    return [(value, f"{value:g}") for value in values]


def between(low, high, count):
    return [low + (high - low) * k / count for k in range(count + 1)]


# --- A block on a bed of springs: docs/theory/collapse-angle.md.

WIDTH, CENTROID, WEIGHT = 0.15, 0.1875, 889.0  # m, m, N/m


def tilt(kn, turn):
    """The tilt (deg) at which the block is in balance with its bed turned by so much (rad), and whether the joint has opened."""
    off, opened = 0.0, False
    for _ in range(200):
        # At balance the line of action passes at atan(off / h), which is the tilt and the turn together.
        normal = WEIGHT * math.cos(math.atan(off / CENTROID))
        opened = 2 * normal / (kn * turn) < WIDTH**2
        off = WIDTH / 2 - math.sqrt(2 * normal / (kn * turn)) / 3 if opened else kn * turn * WIDTH**3 / (12 * normal)
    return math.degrees(math.atan(off / CENTROID) - turn), opened


def limit_point():
    drawing = Drawing(780, 400, "Tilt over rotation of a block on beds of four stiffnesses")
    axes = Axes(
        drawing, (70, 20, 600, 340), (0, 0.06), (0, 24), ("rotation of the block on its bed (rad)", "tilt (deg)"),
        (numbers([0, 0.02, 0.04, 0.06]), numbers([0, 5, 10, 15, 20])),
    )
    rigid = math.degrees(math.atan(WIDTH / 2 / CENTROID))
    axes.curve([(0, rigid), (0.06, rigid)], GREY, "5 4", 1.5)
    axes.name(0.06, rigid, f"rigid: {rigid:.3f} deg")
    for k, (kn, words) in enumerate([(1.75e8, "1.75e8"), (7.5e7, "7.5e7"), (5e7, "5e7"), (2.5e7, "2.5e7")]):
        colour = [BLUE, ORANGE, GREEN, PINK][k]
        points = [(turn, tilt(kn, turn)[0]) for turn in between(1e-5, 0.06, 600)]
        axes.curve([(0, 0)] + points, colour, DASHES[k])
        turn, top = max(points, key=lambda point: point[1])
        fine = between(turn - 2e-4, turn + 2e-4, 400)
        top = max(tilt(kn, own)[0] for own in fine)
        drawing.dot(*axes.at(turn, top), colour)
        y = 96 + 24 * k
        drawing.line([(612, y), (642, y)], colour, 2, DASHES[k])
        drawing.text(648, y + 5, f"{words}: {top:.3f}", 13)
    drawing.text(612, 76, "kn (Pa/m): highest (deg)", 12)
    return drawing


# --- The joint law: docs/theory/joint-law.md.


def joint():
    drawing = Drawing(760, 330, "A joint that has opened on one side")
    turn = math.radians(4)
    left, right, bed = 150, 430, 190

    def moved(x, y):
        return right + (x - right) * math.cos(turn) + (y - bed) * math.sin(turn), bed + 9 - (x - right) * -math.sin(turn) + (y - bed) * math.cos(turn)

    drawing.area([(left - 40, bed), (right + 60, bed), (right + 60, bed + 45), (left - 40, bed + 45)], "#ECECEC")
    drawing.area([moved(left, bed), moved(right, bed), moved(right, bed - 140), moved(left, bed - 140)], "#DDE7EE")
    drawing.line([(left - 40, bed), (right + 60, bed)], BLACK, 2)
    touch = right - 9 / math.tan(turn)
    drawing.area([(touch, bed), (right, bed), (right, bed + 62)], "#F1DFD0", ORANGE, 1.5)
    for k in range(1, 6):
        x = touch + (right - touch) * k / 5
        drawing.arrow((x, bed + 62 * k / 5), (x, bed + 2), ORANGE, 1.3)
    middle = touch + (right - touch) * 2 / 3
    drawing.arrow((middle, bed + 105), (middle, bed + 66), BLACK, 2.4)
    drawing.text(middle - 8, bed + 122, "resultant", 14, "middle")
    drawing.text(right + 12, bed + 64, "pressure kn u", 14, colour=BLACK)
    drawing.line([(touch, bed + 70), (touch, bed + 88)], GREY)
    drawing.line([(right, bed + 70), (right, bed + 88)], GREY)
    drawing.text(touch - 8, bed + 84, "pressed part", 14, "end")
    drawing.text(left + 30, bed - 70, "block, turned on its bed", 14)
    drawing.line([(left + 15, bed - 8), (left - 15, bed - 30)], GREY)
    drawing.text(left - 12, bed - 50, "gap g, linear", 14, "end")
    drawing.text(left - 12, bed - 32, "along the joint", 14, "end")
    drawing.text(right + 70, bed + 28, "block below", 14)
    return drawing


def closure(law, sigma):
    """Closure (m) at a stress (Pa)."""
    kn, first, most = 5e7, 1e7, 2e-4
    if law == "linear":
        return sigma / kn
    if law == "hyperbolic":
        return sigma / kn + most * sigma / (first * most + sigma)
    # Stiffening with m = 1/3 or 1, by adding up du = d sigma / k.
    floor, unit, power = 5e6, {"third": 3e8, "one": 5e9}[law], {"third": 1 / 3, "one": 1.0}[law]
    steps = 4000
    total = 0.0
    for k in range(steps):
        s = sigma * (k + 0.5) / steps
        total += sigma / steps / min(kn, max(floor, unit * (s / 1e6) ** power))
    return total


def normal_laws():
    drawing = Drawing(760, 380, "Four normal laws: stress over closure")
    axes = Axes(
        drawing, (70, 20, 560, 320), (0, 0.6), (0, 20), ("closure u (mm)", "stress (kPa)"),
        (numbers([0, 0.2, 0.4, 0.6]), numbers([0, 5, 10, 15, 20])),
    )
    laws = [
        ("linear", "linear"), ("hyperbolic", "hyperbolic"), ("third", "stiffening, m 1/3"), ("one", "stiffening, m 1"),
    ]
    for k, (law, words) in enumerate(laws):
        colour = [BLUE, ORANGE, GREEN, PINK][k]
        points = [(1000 * closure(law, s), s / 1000) for s in between(0, 20000, 100)]
        axes.curve([point for point in points if point[0] <= 0.6], colour, DASHES[k])
        y = 110 + 24 * k
        drawing.line([(572, y), (606, y)], colour, 2, DASHES[k])
        drawing.text(612, y + 5, words, 13)
    for k, words in enumerate(["kn 5e7 Pa/m in all", "kni 1e7 Pa/m, Vm 0.2 mm", "k1 3e8 (1/3), 5e9 (1) Pa/m", "floor 5e6 Pa/m"]):
        drawing.text(572, 230 + 18 * k, words, 11)
    return drawing


def shear():
    drawing = Drawing(760, 340, "Shear traction over displacement, and the envelope")
    # ks 2.5e7 Pa/m under 20 kPa at 35 deg, no cohesion; weakening to half over 1 mm.
    ks, peak = 2.5e4, 20 * math.tan(math.radians(35))  # kPa/mm, kPa
    bend = peak / ks
    axes = Axes(
        drawing, (70, 20, 350, 280), (0, 2), (0, 18), ("relative displacement (mm)", "shear traction (kPa)"),
        (numbers([0, 0.5, 1, 1.5, 2]), numbers([0, 5, 10, 15])),
    )
    axes.curve([(0, 0), (bend, peak), (2, peak)], BLUE)
    axes.curve([(bend, peak), (bend + 1, peak / 2), (2, peak / 2)], ORANGE, DASHES[1])
    axes.name(0.9, peak, "constant friction", up=14)
    axes.name(1.05, peak / 2, "weakening to half", up=12)
    axes = Axes(
        drawing, (450, 20, 730, 280), (-2, 20), (0, 18), ("normal stress (kPa)", "shear strength (kPa)"),
        (numbers([0, 5, 10, 15, 20]), numbers([0, 5, 10, 15])),
    )
    slope = math.tan(math.radians(35))
    axes.curve([(0, 0), (20, 20 * slope)], BLUE)
    axes.curve([(0, 3), (20, 3 + 20 * slope)], GREEN, DASHES[2])
    axes.name(9, 9 * slope, "dry: slope tan phi", up=-16)
    axes.name(1, 11, "with cohesion c")
    return drawing


# --- Solvers, generator, statistics, diagnosis.


def three_solvers():
    """Angles of the table in studies/tilting-block/README.md, regular arms; and that of rigid joints."""
    drawing = Drawing(760, 360, "One wall by elastic joints of three stiffnesses and by limit analysis")
    axes = Axes(
        drawing, (70, 20, 600, 300), (3e7, 2e9), (0, 20), ("normal stiffness of the joints kn (Pa/m)", "collapse angle (deg)"),
        ([(5e7, "5e7"), (1.75e8, "1.75e8"), (1e9, "1e9")], numbers([0, 5, 10, 15, 20])), log_x=True,
    )
    axes.curve([(3e7, 16.9), (2e9, 16.9)], GREY, "5 4", 1.5)
    axes.name(2e9, 16.9, "limit analysis: 16.9")
    points = [(5e7, 11.0), (1.75e8, 13.3), (1e9, 15.0)]
    axes.curve(points, BLUE)
    for kn, angle in points:
        drawing.dot(*axes.at(kn, angle), BLUE)
        axes.name(kn, angle, f"{angle:.1f}", up=-18, anchor="middle")
    axes.name(1.1e9, 15.0, "implicit", up=-4)
    return drawing


def front(wall):
    """The faces of a wall that look to the front, as polygons of x and z (m), in the order of the stones."""
    shown = []
    for block in wall["blocks"]:
        corners = block["vertices"]
        for face in block["faces"]:
            points = [corners[k] for k in face]
            # Components of twice the area vector, which points outwards; a bed that leans looks up more than to the front.
            edges = list(zip(points, points[1:] + points[:1]))
            y, z = (sum(p[a] * q[b] - p[b] * q[a] for p, q in edges) for a, b in ((2, 0), (0, 1)))
            if y > abs(z):
                shown.append([(p[0], p[2]) for p in points])
    return shown


def arrangements(program):
    drawing = Drawing(760, 290, "Four walls: stack bond, running bond, random courses, random cuts")
    asked = [
        ("stack bond (continuous)", ["--arm", "continuous"]), ("running bond (discontinuous)", ["--arm", "discontinuous"]),
        ("random courses (coursed)", ["--arm", "irregular", "--member", "0"]),
        ("random cuts (cut)", ["--variant", "cut", "--arm", "irregular", "--member", "0"]),
    ]
    for k, (words, which) in enumerate(asked):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "wall.json"
            study = HERE.parent.parent / "studies/joint-arrangement"
            subprocess.run([program, "wall", study, *which, "--out", path], check=True, capture_output=True)
            faces = front(json.loads(path.read_text()))
        low, high = min(x for face in faces for x, _ in face), max(x for face in faces for x, _ in face)
        top = max(z for face in faces for _, z in face)
        scale = 350 / (high - low)
        left, bottom = 15 + 375 * (k % 2), 125 + 145 * (k // 2)
        for number, face in enumerate(faces):
            drawing.area([(left + scale * (x - low), bottom - scale * z) for x, z in face], STONES[number % 4], BLACK, 0.8)
        drawing.text(left, bottom - scale * top - 10, words, 14)
    return drawing


def falling_wall(program):
    """The last state of a fall, in true size, as the program draws it."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        study = HERE.parent.parent / "studies/arrangements"
        asked = ["--arm", "headers", "--out", folder / "wall.svg", "--frames", folder / "frames"]
        subprocess.run([program, "wall", study, *asked], check=True, capture_output=True)
        return max((folder / "frames").glob("frame-*.svg")).read_text()


def quantile(density, low, high, p):
    """The value that a share p of a density lies below, by Simpson's rule and halving."""

    def below(x):
        points = between(low, x, 600)
        width = (x - low) / 600
        return width / 3 * sum(density(t) * (1 if k in (0, 600) else 4 if k % 2 else 2) for k, t in enumerate(points))

    a, b = low, high
    for _ in range(50):
        middle = (a + b) / 2
        a, b = (middle, b) if below(middle) < p else (a, middle)
    return (a + b) / 2


def student(freedom, p):
    size = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(freedom * math.pi)
    return quantile(lambda t: size * (1 + t * t / freedom) ** (-(freedom + 1) / 2), 0.0, 40.0, p - 0.5)


def chi_square(freedom, p):
    half = freedom / 2

    def density(x):
        return math.exp((half - 1) * math.log(x) - x / 2 - half * math.log(2) - math.lgamma(half)) if x > 0 else 0.0

    return quantile(density, 1e-9, freedom + 12 * math.sqrt(2 * freedom) + 12, p)


def intervals():
    drawing = Drawing(760, 380, "Half width of 95 % intervals over the number of walls")
    axes = Axes(
        drawing, (70, 20, 580, 320), (5, 200), (0, 1.3), ("number of walls n", "half width of the 95 % interval"),
        (numbers([5, 10, 20, 50, 100, 200]), numbers([0, 0.25, 0.5, 0.75, 1, 1.25])), log_x=True,
    )
    sizes = [5, 6, 7, 8, 10, 12, 15, 20, 25, 30, 40, 50, 70, 100, 140, 200]
    mean = [(n, student(n - 1, 0.975) / math.sqrt(n)) for n in sizes]
    sigma = [
        (n, (math.sqrt((n - 1) / chi_square(n - 1, 0.025)) - math.sqrt((n - 1) / chi_square(n - 1, 0.975))) / 2) for n in sizes
    ]
    axes.curve(mean, BLUE)
    axes.curve(sigma, ORANGE, DASHES[1])
    for n in (10, 30, 100):
        value = dict(mean)[n]
        drawing.dot(*axes.at(n, value), BLUE)
        axes.name(n, value, f"{value:.2f}", up=14)
    axes.name(200, mean[-1][1], "mean, over s", up=6)
    axes.name(200, sigma[-1][1], "s, over itself", up=-10)
    return drawing


def diagnosis():
    drawing = Drawing(760, 470, "Stages of a diagnosis")

    def box(x, y, width, title, lines, fill="#FFFFFF"):
        height = 30 + 18 * len(lines)
        drawing.area([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], fill, BLACK, 1.2)
        drawing.text(x + width / 2, y + 20, title, 14, "middle", bold=True)
        for k, words in enumerate(lines):
            drawing.text(x + width / 2, y + 40 + 18 * k, words, 12, "middle")
        return x, y, width, height

    box(20, 20, 210, "measured.csv", ["readings, errors"], "#F1DFD0")
    box(275, 20, 210, "base model", ["joints within their priors"], "#DDE7EE")
    box(530, 20, 210, "catalogue of causes", ["each at many strengths"], "#DDE7EE")
    box(275, 115, 465, "simulated campaigns", ["same specimens, readings and errors"], "#DDE7EE")
    box(20, 210, 340, "is anything off?", ["discrepancy beyond joints, scatter, errors"])
    box(400, 210, 340, "which cause?", ["ranking by networks, evidence of all readings"])
    box(400, 305, 340, "is it good enough?", ["posterior predictive check, false alarm"])
    box(20, 400, 200, "nothing_found", ["p at least 0.05"], "#ECECEC")
    box(245, 400, 240, "ambiguous, unexplained", ["several causes fit, or none"], "#ECECEC")
    box(510, 400, 230, "named", ["one cause passes all checks"], "#D5EBE3")
    drawing.arrow((125, 68), (125, 207))
    drawing.arrow((380, 68), (380, 112))
    drawing.arrow((635, 68), (635, 112))
    drawing.arrow((310, 163), (310, 207))
    drawing.arrow((570, 163), (570, 207))
    drawing.arrow((360, 234), (397, 234))
    drawing.text(378, 226, "yes", 12, "middle")
    drawing.arrow((120, 258), (120, 397))
    drawing.text(128, 330, "no", 12)
    drawing.arrow((570, 258), (570, 302))
    drawing.arrow((625, 353), (625, 397))
    drawing.text(633, 380, "yes", 12)
    drawing.arrow((450, 353), (420, 397))
    drawing.text(414, 380, "no", 12, "end")
    return drawing


def main():
    program = str(pathlib.Path(sys.argv[1]).resolve())
    drawn = {
        "limit-point": limit_point(), "joint": joint(), "normal-laws": normal_laws(), "shear": shear(),
        "three-solvers": three_solvers(), "arrangements": arrangements(program), "intervals": intervals(), "diagnosis": diagnosis(),
    }
    texts = {name: drawing.svg() for name, drawing in drawn.items()} | {"falling-wall": falling_wall(program)}
    wrong = []
    for name, text in texts.items():
        path = HERE / f"{name}.svg"
        if "--check" not in sys.argv:
            path.write_text(text)
        elif not path.is_file() or path.read_text() != text:
            wrong.append(f"{path.name} is not what {pathlib.Path(__file__).name} draws: run it without --check")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
