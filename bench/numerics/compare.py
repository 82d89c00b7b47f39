# SPDX-License-Identifier: GPL-2.0-or-later
"""All comparisons; `run' starts it with the folder of the results and the commands that it found. See main first."""
import json
import os
import re
import subprocess
import sys
from contenders import Contender, Gone, Worker, side_by_side
from netlist import netlist
from tables import contest, curve_lines, equal_error, goal, goals, load, missed, sweep_all, table, told

here = os.path.dirname(os.path.abspath(__file__))

# Ends of the runs, from the Test Set for IVP Solvers (Bari) and from Taylor series of 30 digits.
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


van_der_pol = {"x": 1.7061677321704650085, "v": -8.9280970102481654778e-4}
robertson = {"a": 2.083340149701294230575e-08, "b": 8.333360770334783400659e-14, "c": 0.9999999791665151693794}


def decades(first, last, each=1):
    """10^first, .., 10^last, EACH numbers a decade."""
    return [10 ** (k / each) for k in range(first * each, last * each - 1, -1)]


# Scenes.

def opened(ours, scene, size):
    """The names of the states, the start and the span."""
    answer = " ".join(ours.ask("open", scene, size)).split(";")
    return [part.split() for part in answer]


class Exported:
    """The C of a scene, as ExportProgram writes it, and the peers that run it, each compiled when it is asked for."""

    def __init__(self, ours, tools, scene, name, start, span):
        self.tools, self.name, self.start, self.span = tools, name, start, span
        self.path = os.path.join(tools["results"], name)
        ours.ask("export", scene, self.path + ".c")
        subprocess.run(["gcc", "-O2", "-fPIC", "-c", "-o", self.path + ".o", self.path + ".c"], check=True)

    def program(self, peer):
        """A worker of sundials.c or radau5.c on it, or None."""
        if not self.tools[peer]:
            return None
        command = ["gcc", "-O2", f"-DRATES={self.name}", "-o", f"{self.path}.{peer}", os.path.join(here, peer + ".c"),
                   self.path + ".o", *self.tools[peer], "-lm"]
        if subprocess.run(command).returncode:
            print(f"\n{peer}.c does not compile with what is there.")
            return None
        return Worker([f"{self.path}.{peer}", str(len(self.start)), *self.span, *self.start])

    def in_python(self):
        """A worker of scipy_peer.py on it, or None."""
        if not self.tools["python"] or not self.tools["scipy"]:
            return None
        subprocess.run(["gcc", "-shared", "-o", self.path + ".so", self.path + ".o", "-lm"], check=True)
        return Worker([self.tools["python"], os.path.join(here, "scipy_peer.py"), self.path + ".so", self.name, *self.span,
                       *self.start], here)


def in_spice(tools, archive, end):
    """A worker of ngspice on the netlist of ARCHIVE, and the names of its states in their order; None, [] without it."""
    if not tools["ngspice"]:
        return None, []
    peer = os.path.join(here, "ngspice_peer.py")
    return Worker(["python3", peer, tools["ngspice"], archive, str(end)], here), [name for name, _ in netlist(archive)[1]]


def those(*contenders):
    return [contender for contender in contenders if contender.worker]


def scipy_contenders(tools, on_c, scene, name, methods, tolerances, scales):
    """METHODS: (method, title), on the exported C and as a function in Python."""
    return [Contender(f"{title}, {words}", worker, where, method, tolerances, scales)
            for method, title in methods
            for worker, where, words in ((on_c, name, "on C"), (tools["scipy"], scene, "function in Python"))]


def keep_curves(tools, title, contenders):
    with open(os.path.join(tools["results"], "curves"), "a", encoding="ascii") as file:
        file.write(curve_lines(title, contenders))


def compared(tools, title, contenders, reference, errors, goals_at, floor=1.0, seconds=2.5):
    """Curves of all contenders, and a table for each of ERRORS; GOALS_AT(error) is title of a peer -> (text, most)."""
    there = sweep_all(contenders, lambda contender, _, __, state: contender.error_of(state, reference, floor), min(errors))
    keep_curves(tools, title, there)
    for error in errors:
        equal_error(title, there, error, goals_at(error), seconds=seconds)


def stiff_row(ours, tools, title, scene, size, reference, errors, scales, tolerances, floor, texts, archive=None):
    names, start, span = opened(ours, scene, size)
    exported = Exported(ours, tools, scene, scene, start, span)
    sundials, on_c = exported.program("sundials"), exported.in_python()
    spice, spice_names = in_spice(tools, archive, span[1]) if archive else (None, [])
    contenders = those(
        Contender("Radau of this package", ours, scene, "radau", tolerances, scales, names),
        Contender("RADAU5 of Hairer and Wanner on C", exported.program("radau5"), scene, "radau5", tolerances, scales, names),
        Contender("CVODE (BDF) on C", sundials, scene, "cvode", tolerances, scales, names),
        *(Contender(f"ngspice ({method}), its own elements", spice, scene, method, decades(-2, -7), (1e-3,), spice_names)
          for method in ("gear", "trap")),
        *scipy_contenders(tools, on_c, scene, scene, (("LSODA", "LSODA of SciPy"),), decades(-5, -13), scales[-1:]),
        *scipy_contenders(tools, on_c, scene, scene, (("Radau", "Radau of SciPy"),), decades(-3, -12), scales[-1:]))
    for contender in contenders:
        if contender.worker is on_c:
            contender.names = names
    compared(tools, title, contenders, reference, errors, lambda error: {
        peer: (f"{text}, error {error:g}", most) for peer, text, most, where in texts if error == where}, floor)


def explicit_row(ours, tools, title, scene, size, reference, errors):
    names, start, span = opened(ours, scene, size)
    exported = Exported(ours, tools, scene, scene, start, span)
    sundials, tolerances = exported.program("sundials"), decades(-2, -14, 2)
    methods = (("DOP853", "DOP853 of SciPy"), ("ode-dop853", "Hairer's DOP853 by scipy.integrate.ode"))
    contenders = those(
        Contender("DOP853 of this package", ours, scene, "dop853", tolerances[:-1]),
        Contender("heyoka", tools["heyoka"], scene, "taylor", decades(-3, -15)),
        Contender("ARKODE of order 8 on C", sundials, scene, "arkode", tolerances),
        Contender("CVODE (Adams) on C", sundials, scene, "adams", tolerances),
        *scipy_contenders(tools, exported.in_python(), scene, scene, methods, tolerances, (1.0,)))
    compared(tools, title, contenders, reference, errors, lambda error: {
        peer: (f"{title}, error {error:g}", most) for peer, most in (
            ("heyoka", 3), ("ARKODE of order 8 on C", 0.2), ("DOP853 of SciPy, function in Python", 0.02))})


def ladder_reference(tools, on_c, name, names):
    """Two runs at the least tolerances, the one's rates in Python, the other's in C, must agree."""
    one = [float(x) for x in tools["scipy"].ask(name, "DOP853", 3e-14, 1, 1)[2:]]
    other = [float(x) for x in on_c.ask(name, "ode-dop853", 1e-14, 1, 1)[2:]]
    print(f"\nReference of {name}: two runs at 3e-14 and 1e-14 differ by "
          f"{max(abs(a - b) for a, b in zip(one, other, strict=True)):.1e}.")
    return dict(zip(names, one, strict=True))


def ladder_row(ours, tools, sections, error, coarse):
    if not tools["scipy"]:
        return
    names, start, span = opened(ours, "ladder", sections)
    name, title = f"ladder{sections}", f"Linear ladder, {sections} sections, {2 * sections} states, to t = 200"
    exported = Exported(ours, tools, "ladder", name, start, span)
    on_c = exported.in_python()
    reference = ladder_reference(tools, on_c, name, names)
    archive = os.path.join(tools["results"], name + ".txt")
    spice, spice_names = in_spice(tools, archive, 200)
    tolerances = decades(-2, -12, 2 if sections < 1000 else 1)
    methods = (("DOP853", "DOP853 of SciPy"), ("ode-dop853", "Hairer's DOP853 by scipy.integrate.ode"))
    contenders = those(
        Contender("DOP853 of this package, the run alone", ours, "ladder", "dop853", tolerances),
        Contender("ARKODE of order 8 on C", exported.program("sundials"), name, "arkode", tolerances),
        *(Contender(f"ngspice ({method}), its own elements", spice, name, method, decades(-2, -6), (1.0,), spice_names)
          for method in ("gear", "trap")),
        *scipy_contenders(tools, on_c, name, name, methods, tolerances, (1.0,)))
    compared(tools, title, contenders, reference, (coarse, error), lambda _: {})
    whole_of_ladder(title, ours, contenders, error)


def whole_of_ladder(title, ours, contenders, error):
    """What a person waits for: the program made, or all that Simulate does, beside the run of SciPy."""
    peer = next(contender for contender in contenders if contender.title == "DOP853 of SciPy, function in Python")
    if not (contenders[0].stand_at(error) and peer.stand_at(error)):
        return missed(title + ", program made in the time: no such error on both curves")
    rows = []
    for words, method in (("the program made and run", "made-dop853"), ("Simulate, from the archive on", "whole-dop853")):
        mine = Contender("DOP853 of this package, " + words, ours, "ladder", method)
        mine.ends, mine.share, mine.seconds = contenders[0].ends, contenders[0].share, 1.0
        quotients = side_by_side(mine, peer)
        rows.append([mine.title, f"{1e3 * mine.seconds:.4g}", f"{1e3 * peer.seconds:.4g}", told(quotients)])
        if method == "made-dop853":
            goal(f"{title}, program made in the time, error {error:g}, our time over that of SciPy", quotients[1], 0.6)
    table(f"{title}, error {error:g}, what a person waits for",
          ["", "milliseconds", "the run of SciPy", "over it (quartiles), pairs"], rows)


def drift_row(ours, tools, title, scenes, size, drift, allowed):
    """Times at which the energy drifts by DRIFT; SCENES are the names by us and by the peer."""
    opened(ours, scenes[0], size)
    contenders = those(
        Contender("Gauss of this package", ours, scenes[0], "gauss", decades(-8, -13, 2)),
        Contender("heyoka", tools["heyoka"], scenes[1], "taylor", decades(-12, -16, 2)))

    def drift_of(contender, tolerance, scale, _):
        look = "drift" if contender.method == "taylor" else "drift-gauss"
        return Contender("", contender.worker, contender.scene, look).run(tolerance, scale)[2][0]

    there = sweep_all(contenders, drift_of, drift)
    keep_curves(tools, title, there)
    if there and there[0].best():
        goal(f"least drift of the energy, {title}", there[0].best().error, drift)
    equal_error(title, there, drift, {"heyoka": (title, allowed)} if allowed else {}, "drift of the energy {:g}")


def chain_beside_pinocchio(mine, tools, bodies, start):
    """Pinocchio's microseconds and the quotient, as text; both must find the same accelerations."""
    if not tools["pinocchio"]:
        mine.seconds = mine.run(0, 1, 2000)[0]
        return ["", ""]
    peer = Contender("ABA of Pinocchio", Worker([tools["pinocchio"], str(bodies), *start]), "chain", "aba")
    quotients = side_by_side(mine, peer, 5, 0.03)
    own, other = (contender.run(0, 1, 1)[2] for contender in (mine, peer))
    assert bodies > 20 or all(abs(a - b) < 1e-8 * (1 + abs(b)) for a, b in zip(own[2 * bodies:], other, strict=True))
    goal(f"q'' of a spatial chain of {bodies} bodies, our time over Pinocchio's", quotients[1], 1.5)
    peer.worker.end()
    return [f"{1e6 * peer.seconds:.3g}", told(quotients)]


def chain_row(ours, tools):
    rows, per_body, operations = [], {}, {}
    for bodies in (20, 50, 100, 200):
        _, start, _ = opened(ours, "chain", bodies)
        mine = Contender("this package", ours, "chain", "rates")
        made = Contender("", ours, "chain", "made").run(0, 1)[0]
        beside = chain_beside_pinocchio(mine, tools, bodies, start)
        per_body[bodies] = mine.seconds / bodies
        operations[bodies] = int(ours.ask("operations", "chain")[0]) / bodies
        rows.append([str(bodies), f"{1e6 * mine.seconds:.3g}", *beside, f"{1e9 * per_body[bodies]:.0f}",
                     f"{operations[bodies]:.0f}", f"{made:.2f}"])
    table("q'' of a spatial chain, bodies of two degrees of freedom each",
          ["bodies", "microseconds", "ABA of Pinocchio", "our time over it (quartiles), pairs", "nanoseconds a body",
           "operations a body", "compiled in seconds"], rows)
    goal("q'' of a spatial chain, time a body of 200 bodies over that of 20", per_body[200] / per_body[20], 1.5)
    goal("q'' of a spatial chain, operations a body of 200 bodies over those of 100", operations[200] / operations[100],
         1.05)


program_line = re.compile(r"(.*?) +compiled +(\d+) nodes: +(\S+) us, C +(\S+) us, quotient +(.*?); made in +(\S+) s, gcc +(\S+) s; "
                          r"(\d+) bytes")


def programs_row(_, tools):
    """The lines of bench_numerics_programs.mac as a table."""
    program = os.path.join(here, "..", "bench_numerics_programs.mac")
    found = subprocess.run([tools["maxima"], "--very-quiet", "-b", program], stdin=subprocess.DEVNULL,
                           capture_output=True, text=True).stdout
    rows = [list(line) for line in program_line.findall(found)]
    table("Right sides, compiled, beside the C of ExportProgram by gcc -O2",
          ["", "operations", "microseconds", "C", "our time over it", "compiled in seconds", "gcc", "bytes consed a call"],
          rows)
    for size, most in (("above 1000", 1.2), ("of at most 1000", 2)):
        goal(f"right sides {size} operations, our time over that of C, the worst of them",
             max(float(row[4].split()[0]) for row in rows if (int(row[1]) > 1000) == (size == "above 1000")), most)
    goal("compiling, our seconds over those of gcc, the worst of them", max(float(row[5]) / float(row[6]) for row in rows), 1)
    goal("right sides, bytes consed a call, the most of them", max(int(row[7]) for row in rows), 0)


rest = "Double pendulum from (pi/2, pi/2) at rest"
ring = (("LSODA of SciPy, function in Python", "ring modulator", 0.1, 1e-4), ("CVODE (BDF) on C", "ring modulator", 1, 1e-4))
comparisons = (
    (programs_row,),
    (explicit_row, rest + " to t = 10", "pendulum", 10, pendulum, (1e-6, 1e-10)),
    (explicit_row, "Pleiades to t = 3", "pleiades", 3, pleiades, (1e-6, 1e-10)),
    (ladder_row, 100, 1e-9, 1e-4),
    (ladder_row, 1000, 1e-9, 1e-4),
    (drift_row, "Double pendulum from (.3, .2) at rest to t = 10^4", ("small_pendulum", "small_pendulum"), 10000, 1e-14, 2),
    (drift_row, rest + " to t = 300", ("pendulum", "tumbling_pendulum"), 300, 1e-13, None),
    (chain_row,),
    (stiff_row, "Van der Pol, mu = 1000, to t = 2000", "vanderpol", 2000, van_der_pol, (1e-6, 1e-10), (1.0,),
     decades(-3, -13, 2), 1.0, ()),
    (stiff_row, "Robertson to t = 10^11", "robertson", "100000000000", robertson, (1e-5, 1e-8), (1e-8, 1e-14),
     decades(-2, -12, 2), 1e-30, ()),
    (stiff_row, "Ring modulator, a circuit of 15 states, to t = 0.001", "ring_modulator", "0.001", ring_modulator, (1e-2, 1e-4),
     (1.0, 1e-3), decades(-2, -11, 2), 1.0, ring, os.path.join(here, "..", "..", "examples", "ring_modulator.txt")))


def main():
    tools = json.load(sys.stdin)
    for name in ("scipy", "heyoka"):
        tools[name] = Worker([tools["python"], os.path.join(here, name + "_peer.py")], here) if tools[name] else None
    open(os.path.join(tools["results"], "curves"), "w", encoding="ascii").close()
    for number in tools["rows"].split() or range(len(comparisons)):
        ours = Worker([tools["maxima"], "--very-quiet", "--batch-string=" + tools["batch"]])
        try:
            row, *more = comparisons[int(number)]
            row(ours, tools, *more)
            ours.end()
        except Gone as fault:
            print(f"\nRow {number} ended early, at: {fault}")
    print("\n### Goals\n")
    print("\n".join(goals))


main()
