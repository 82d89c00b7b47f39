# SPDX-License-Identifier: GPL-2.0-or-later
"""The curves that compare.py kept, error over seconds of CPU, a panel a scene, as an SVG by gnuplot.
    picture.py CURVES PICTURE"""
import subprocess
import sys
from collections import defaultdict

curves, picture = sys.argv[1:]
scenes = defaultdict(lambda: defaultdict(list))
with open(curves, encoding="ascii") as file:
    for line in file:
        scene, contender, _, scale, error, _, seconds = line.rstrip("\n").split("\t")
        if float(error) < 1:
            scenes[scene][contender].append((scale, seconds, error))
contenders = sorted({contender for scene in scenes.values() for contender in scene})
families = ["heyoka", "ARKODE", "CVODE", "RADAU5", "DOP853 of SciPy", "Hairer's DOP853", "LSODA", "Radau of SciPy", "ngspice"]
colours = ["#d62728", "#1f77b4", "#17becf", "#9467bd", "#2ca02c", "#ff7f0e", "#8c564b", "#e377c2", "#7f7f7f"]


def style(title):
    """Black for this package, a colour for each family of peers, dashes for functions in Python and gear."""
    colour = next((colour for family, colour in zip(families, colours) if title.startswith(family)), "#000000")
    dashes = 2 if "Python" in title or "gear" in title else 1
    return f'linecolor rgb "{colour}" dashtype {dashes} pointtype {5 + 2 * dashes} linewidth {3 if colour == "#000000" else 1}'


def block(points):
    """Lines of a curve; a curve of another scale begins after an empty line."""
    lines, before = [], points[0][0]
    for scale, seconds, error in points:
        lines += [""] if scale != before else []
        lines.append(f"{seconds} {error}")
        before = scale
    return "\n".join(lines)


def panel(number, scene):
    data = [f"$curve{number}_{contenders.index(title)} << EOD\n{block(points)}\nEOD\n"
            for title, points in scenes[scene].items()]
    plots = ", ".join(f"$curve{number}_{place} using 1:2 with linespoints {style(title)} title \"{title}\""
                      for title, place in sorted((title, contenders.index(title)) for title in scenes[scene]))
    return "".join(data) + f'set title "{scene}" noenhanced\nplot {plots}\n'


rows = (len(scenes) + 1) // 2
script = f"""set terminal svg size 1300,{560 * rows} dynamic background "white"
set output "{picture}"
set logscale xy
set format xy "10^{{%T}}"
set grid
set key below maxcols 2
set xlabel "seconds of CPU"
set ylabel "error"
set multiplot layout {rows},2
""" + "".join(panel(number, scene) for number, scene in enumerate(scenes))
if scenes:
    subprocess.run(["gnuplot"], input=script, text=True, check=True)
