# SPDX-License-Identifier: GPL-2.0-or-later
"""All comparisons; `run' starts it with the folder of the results and the commands that it found. See main first."""
import json
import os
import subprocess
import sys
from contenders import Contender, Gone, Worker, side_by_side

here = os.path.dirname(os.path.abspath(__file__))
goals = []

pleiades = [float(x) for x in """
 0.37061391439705127 3.2372840920572332 -3.2225590324183235 0.6597091455775308 0.34255817071565797
 1.5621721014006311 -0.70030929222124949 -3.9434375855173922 -3.2713809739725499 5.225081843456544
 -2.5906124349774693 1.1982136933922747 -0.24296823449358235 1.0914492404289797 3.4170038063143147
 1.3545845016255011 -2.5900655978107756 2.0250537347142412 -1.1558151001604491 -0.80729881702230222
 0.59523963542087188 -3.7412449612340084 0.37734596857506292 0.93868588695510791 0.36679222272005696
 -0.34740463538084942 2.3449154481809371 -1.947020434263292""".split()]
pendulum = [-0.56847466401595018878, -0.52639372793240469833, 6.0783848857619648548, -9.6813606817088787581]
ring_modulator = dict(zip(["y%d" % k for k in range(1, 16)], [float(x) for x in """
 -0.02339057358486745 -0.007367485485540825 0.2582956709291169 -0.406446572128345 -0.4039455665149794 0.2607966765422943
 0.1106761861269975 2.939904342435596e-07 -2.840029933642329e-08 0.0007267198267264553 0.000792948719696084
 -0.0007255283495698965 -0.0007941401968526521 7.088495416976114e-05 2.390059075236570e-05""".split()]))


def decades(first, last, each=1):
    """10^first, .., 10^last, EACH numbers a decade."""
    return [10 ** (k / each) for k in range(first * each, last * each - 1, -1)]


def table(title, columns, rows):
    print(f"\n### {title}\n")
    print("|", " | ".join(columns), "|")
    print("|---" + "|--:" * (len(columns) - 1) + "|")
    for row in rows:
        print("|", " | ".join(row), "|")
    sys.stdout.flush()


def goal(text, value, most):
    goals.append(f"* {'met' if value <= most else 'not met'}: {text} at most {most:g}: {value:.3g}")


def contender_table(title, rows, last):
    """ROWS: (contender, quotient as text), the quickest first."""
    table(title, ["", "tolerance", "scale", "error", "evaluations", "milliseconds", last],
          [[c.title, f"{c.tolerance:.1g}", f"{c.scale:g}", f"{c.error:.1e}", str(c.evaluations),
            f"{1e3 * c.seconds:.4g}", quotient] for c, quotient in sorted(rows, key=lambda row: row[0].seconds)])


def contest(title, ours, peers, goal_texts, seconds=10.0):
    """Times of OURS beside each of PEERS, the quickest first. GOAL_TEXTS: title of a peer -> (text, most)."""
    rows = [(ours, "")]
    for peer in peers:
        try:
            low, middle, high = side_by_side(ours, peer, seconds)
        except Gone as fault:
            print(f"\n{peer.title} ended at {fault}.")
            continue
        rows.append((peer, f"{middle:.3g} ({low:.3g} .. {high:.3g})"))
        if peer.title in goal_texts:
            goal(f"{goal_texts[peer.title][0]}, our time over that of {peer.title}", middle, goal_texts[peer.title][1])
    contender_table(title, rows, "our time over it")


def equal_error(title, contenders, reference, most, goal_texts, seconds=10.0):
    """OURS, the first of CONTENDERS, beside the others, all with an error of at most MOST."""
    there = []
    for contender in contenders:
        try:
            if contender.reach(reference, most):
                there.append(contender)
            else:
                print(f"\n{contender.title} does not reach an error of {most:g} there ({title}).")
        except Gone as fault:
            print(f"\n{contender.title} ended at {fault}.")
    if there and there[0] is contenders[0]:
        contest(f"{title}, error at most {most:g}", there[0], there[1:], goal_texts, seconds)


# Scenes.

def opened(ours, scene, size):
    """The names of the states, the start and the span."""
    answer = " ".join(ours.ask("open", scene, size)).split(";")
    return [part.split() for part in answer]


def in_c(ours, tools, scene, start, span):
    """A worker for SUNDIALS on the C of a scene, or None."""
    if not tools["sundials"]:
        return None
    source, program = (os.path.join(tools["results"], scene + end) for end in (".c", ".sundials"))
    ours.ask("export", scene, source)
    command = ["gcc", "-O2", f"-DRATES={scene}", "-o", program, os.path.join(here, "sundials.c"), source,
               *tools["sundials"], "-lm"]
    if subprocess.run(command).returncode:
        print("\nSUNDIALS is there, but its peer does not compile with it.")
        return None
    return Worker([program, str(len(start)), *span, *start])


def those(*contenders):
    return [contender for contender in contenders if contender.worker]


def ring_modulator_row(ours, tools):
    scene, scales = "ring_modulator", (1.0, 1e-3)
    names, start, span = opened(ours, scene, "0.001")
    equal_error("Ring modulator, a circuit of 15 states, to t = 0.001", those(
        Contender("Radau of this package", ours, scene, "radau", decades(-3, -8, 2), scales, names),
        Contender("CVODE on C", in_c(ours, tools, scene, start, span), scene, "cvode", decades(-6, -11, 2), scales, names),
        Contender("LSODA of SciPy", tools["scipy"], scene, "LSODA", decades(-6, -10), scales)),
        ring_modulator, 1e-4,
        {"LSODA of SciPy": ("ring modulator", 0.1), "CVODE on C": ("ring modulator", 1)}, seconds=15)


def explicit_row(ours, tools, title, scene, size, reference, errors):
    names, start, span = opened(ours, scene, size)
    peer = in_c(ours, tools, scene, start, span)
    for most in errors:
        equal_error(title, those(
            Contender("DOP853 of this package", ours, scene, "dop853", decades(-5, -13, 2)),
            Contender("heyoka", tools["heyoka"], scene, "taylor", decades(-4, -15)),
            Contender("ARKODE of order 8 on C", peer, scene, "arkode", decades(-5, -13, 2)),
            Contender("CVODE on C", peer, scene, "cvode", decades(-6, -14)),
            Contender("DOP853 of SciPy", tools["scipy"], scene, "DOP853", decades(-5, -13, 2))),
            reference, most, {title_of_peer: (f"{title}, error at most {most:g}", limit) for title_of_peer, limit in
                              (("heyoka", 3), ("ARKODE of order 8 on C", 0.2), ("DOP853 of SciPy", 0.02))}, seconds=4)


def ladder_row(ours, tools, sections, most):
    if not tools["scipy"]:
        return
    opened(ours, "ladder", sections)
    scene, title = f"ladder{sections}", f"Linear ladder, {sections} sections, {2 * sections} states, to t = 200"
    reference = [float(x) for x in tools["scipy"].ask(scene, "DOP853", 3e-14, 1, 1)[2:]]
    alone = Contender("DOP853 of this package, the run alone", ours, "ladder", "dop853", decades(-4, -11, 2))
    peer = Contender("DOP853 of SciPy", tools["scipy"], scene, "DOP853", decades(-4, -11, 2))
    if not all([contender.reach(reference, most) for contender in (alone, peer)]):
        return
    rows = []
    for words, method in (("the run alone", "dop853"), ("the program made and run", "made-dop853"),
                          ("Simulate, from the archive on", "whole-dop853")):
        mine = Contender("DOP853 of this package, " + words, ours, "ladder", method, ())
        mine.tolerance, mine.error, mine.evaluations = alone.tolerance, alone.error, alone.evaluations
        quotients = side_by_side(mine, peer, 5)
        rows.append((mine, "{1:.3g} ({0:.3g} .. {2:.3g})".format(*quotients)))
        if method == "made-dop853":
            goal(f"{title}, program made in the time, our time over that of SciPy", quotients[1], 0.6)
    contender_table(f"{title}, error at most {most:g}", rows + [(peer, "")], "over SciPy's time")


def drift_row(ours, tools, title, scenes, size, most, allowed):
    """Times with which the energy drifts by at most MOST; SCENES are the names by us and by the peer."""
    opened(ours, scenes[0], size)
    contenders = those(
        Contender("Gauss of this package", ours, scenes[0], "gauss", decades(-10, -13, 4)),
        Contender("heyoka", tools["heyoka"], scenes[1], "taylor", decades(-11, -16, 4)))
    there = []
    for contender in contenders:
        look = "drift" if contender.method == "taylor" else "drift-gauss"
        drift = Contender("", contender.worker, contender.scene, look, ())
        for tolerance in contender.tolerances:
            contender.error = drift.run(tolerance, 1.0)[2][0]
            if contender.error <= most:
                contender.tolerance = tolerance
                contender.seconds, contender.evaluations, _ = contender.run(tolerance, 1.0)
                there.append(contender)
                break
        else:
            print(f"\n{contender.title}: no tolerance with a drift of at most {most:g} ({title}).")
    if there and there[0] is contenders[0]:
        goal(f"drift of the energy, {title}", there[0].error, most)
        contest(f"{title}, drift of the energy at most {most:g} (in the column of the error)", there[0], there[1:],
                {"heyoka": (title, allowed)} if allowed else {})


def chain_row(ours, tools):
    rows, per_body, operations = [], {}, {}
    for bodies in (20, 50, 100, 200):
        _, start, _ = opened(ours, "chain", bodies)
        mine = Contender("this package", ours, "chain", "rates", ())
        made = Contender("", ours, "chain", "made", ()).run(0, 1)[0]
        if tools["pinocchio"]:
            peer = Contender("ABA of Pinocchio", Worker([tools["pinocchio"], str(bodies), *start]), "chain", "aba", ())
            quotients = side_by_side(mine, peer, 5, 0.03)
            if bodies == 20:
                own, other = (contender.run(0, 1, 1)[2] for contender in (mine, peer))
                assert all(abs(a - b) < 1e-8 * (1 + abs(b)) for a, b in zip(own[2 * bodies:], other, strict=True))
            goal(f"q'' of a spatial chain of {bodies} bodies, our time over Pinocchio's", quotients[1], 1.5)
            peer.worker.end()
            told = ["{:.3g}".format(1e6 * peer.seconds), "{1:.3g} ({0:.3g} .. {2:.3g})".format(*quotients)]
        else:
            mine.seconds, told = mine.run(0, 1, 2000)[0], ["", ""]
        per_body[bodies] = mine.seconds / bodies
        operations[bodies] = int(ours.ask("operations", "chain")[0]) / bodies
        rows.append([str(bodies), f"{1e6 * mine.seconds:.3g}", *told, f"{1e9 * per_body[bodies]:.0f}",
                     f"{operations[bodies]:.0f}", f"{made:.2f}"])
    table("q'' of a spatial chain, bodies of two degrees of freedom each",
          ["bodies", "microseconds", "ABA of Pinocchio", "our time over it", "nanoseconds a body", "operations a body",
           "compiled in seconds"], rows)
    goal("q'' of a spatial chain, time a body of 200 bodies over that of 20", per_body[200] / per_body[20], 1.5)
    goal("q'' of a spatial chain, operations a body of 200 bodies over those of 100", operations[200] / operations[100],
         1.05)


def programs_row(_, tools):
    """The lines of bench_numerics_programs.mac as a table."""
    program = os.path.join(here, "..", "bench_numerics_programs.mac")
    found = subprocess.run([tools["maxima"], "--very-quiet", "-b", program], stdin=subprocess.DEVNULL,
                           capture_output=True, text=True).stdout
    rows = []
    for line in found.splitlines():
        if " nodes: " in line and " compiled " in line:
            title, _, rest = line.partition(" compiled ")
            nodes, _, rest = rest.partition(" nodes: ")
            ours, c, quotient, gcc = rest.split(", ")
            quotient, _, made = quotient.partition("; made in ")
            rows.append([title.strip(), nodes.strip(), ours.split()[0], c.split()[1],
                         quotient.removeprefix("quotient").strip(), made.split()[0], gcc.split()[1]])
    table("Right sides, compiled, beside the C of ExportProgram by gcc -O2",
          ["", "operations", "microseconds", "C", "our time over it", "compiled in seconds", "gcc"], rows)
    for title, nodes, _, _, quotient, made, gcc in rows:
        goal(f"right side, {title}, {nodes} operations, our time over C", float(quotient.split()[0]),
             1.2 if int(nodes) > 1000 else 2)
        goal(f"compiling {title}, our seconds over those of gcc", float(made) / float(gcc), 1)


def main():
    tools = json.load(sys.stdin)
    for name in ("scipy", "heyoka"):
        tools[name] = Worker([tools["python"], os.path.join(here, name + "_peer.py")], here) if tools[name] else None
    rest = "Double pendulum from (pi/2, pi/2) at rest"
    rows = (
        (programs_row,),
        (ring_modulator_row,),
        (explicit_row, rest + " to t = 10", "pendulum", 10, pendulum, (1e-6, 1e-10)),
        (explicit_row, "Pleiades to t = 3", "pleiades", 3, pleiades, (1e-6, 1e-10)),
        (ladder_row, 100, 1e-9),
        (ladder_row, 1000, 1e-9),
        (drift_row, "Double pendulum from (.3, .2) at rest to t = 10^4", ("small_pendulum", "small_pendulum"), 10000,
         1e-14, 2),
        (drift_row, rest + " to t = 300", ("pendulum", "tumbling_pendulum"), 300, 1e-13, None),
        (chain_row,))
    wanted = tools["rows"].split() or range(len(rows))
    for number in wanted:
        ours = Worker([tools["maxima"], "--very-quiet", "--batch-string=" + tools["batch"]])
        try:
            row, *more = rows[int(number)]
            row(ours, tools, *more)
            ours.end()
        except Gone as fault:
            print(f"\nRow {number} ended early, at: {fault}")
    print("\n### Goals\n")
    print("\n".join(goals))


main()
