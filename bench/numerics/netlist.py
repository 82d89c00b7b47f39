# SPDX-License-Identifier: GPL-2.0-or-later
"""The archive of a circuit as a netlist of SPICE: branches that count from the first node (sign = passive), numbers from
the key `values', transformers as a controlled voltage and a controlled current, laws as sources of behaviour."""
import math
import re


class Archive:
    def __init__(self, path):
        with open(path, encoding="ascii") as file:
            text = re.sub(r"#.*", "", file.read().split("\n[result")[0])
        heads = re.split(r"^\[(\w+)\]\s*$", text, flags=re.M)
        self.sections = dict(zip(heads[1::2], heads[2::2]))
        if "sign = generator" in text or "graph =" in text:
            raise ValueError(path + ": only passive circuits with branches are written")
        self.values = {name: plain(value) for name, value in self.list_of("values")}
        self.laws = {}
        for left, body in self.list_of("laws"):
            name, argument = re.fullmatch(r"(\w+)\((\w+)\)", left).groups()
            self.laws[name] = argument, body

    def list_of(self, key):
        """(left, right) of each equation of a list in the section [system]."""
        found = re.search(rf"^{key} = \[(.*?)\]\s*$", self.sections.get("system", ""), flags=re.M | re.S)
        return [[side.strip() for side in item.split("=")] for item in commas(found[1])] if found else []

    def rows(self, section):
        return [line.split() for line in self.sections.get(section, "").splitlines() if line.strip()]

    def start(self, state):
        return plain(dict(map(tuple, self.list_of("start"))).get(state, "0"))

    def expression(self, text, argument, quantity):
        """TEXT with numbers for parameters and QUANTITY for ARGUMENT, in the words of ngspice."""
        known = dict({name: repr(value) for name, value in self.values.items()}, **{argument: quantity, "pi": repr(math.pi)})
        words = lambda word: known.get(word[0], word[0])  # noqa: E731
        return re.sub(r"(?<![\w.])[A-Za-z_]\w*", words, text.replace("%pi", "pi"))

    def number(self, text):
        return float(eval(self.expression(text, "", ""), {"__builtins__": {}}))

    def applied(self, text, quantity):
        """A law applied, as in `Uin(t)', or an expression in t."""
        called = re.fullmatch(r"(\w+)\(t\)", text) if text.split("(")[0] in self.laws else None
        if text in self.laws or called:
            argument, body = self.laws[called[1] if called else text]
            return self.expression(body, argument, quantity)
        return self.expression(text, "t", quantity)


def plain(text):
    return float(eval(text, {"__builtins__": {}}))


def commas(text):
    """The items of a list, commas inside of brackets apart."""
    items, depth = [""], 0
    for letter in text:
        depth += (letter in "([") - (letter in ")]")
        if letter == "," and not depth:
            items.append("")
        else:
            items[-1] += letter
    return items


def branch_lines(archive, k, row):
    """The lines of branch K, and (state, vector of ngspice, sign) where it carries one."""
    a, _, b, kind, value, *label = row
    ends, between = f"{a} {b}", f"v({a},{b})"
    if kind == "R":
        return [f"R{k} {ends} {archive.number(value)!r}"], None
    if kind == "L":
        return [f"L{k} {ends} {archive.number(value)!r} ic={archive.start(label[0])!r}"], (label[0], f"l{k}#branch")
    if kind == "C":
        return [f"C{k} {ends} {archive.number(value)!r} ic={archive.start(label[0])!r}"], (label[0], between)
    if kind == "E":
        wave = re.fullmatch(r"(?:([-+.\de]+)\*)?sin\(([^()t]*)\*t\)", archive.applied(value, "t"))
        if wave:
            amplitude, rate = plain(wave[1] or "1"), plain(wave[2])
            return [f"V{k} {ends} sin(0 {amplitude!r} {rate/(2*math.pi)!r})"], None
        return [f"B{k} {ends} v={archive.applied(value, 'time')}"], None
    if kind == "RU":
        return [f"B{k} {ends} i={archive.applied(value, between)}"], None
    raise ValueError(f"branches {kind} are not written")


def transformer_lines(archive, k, row):
    """u_ab = ratio*u_cd, i_ab = -i_cd/ratio"""
    a, _, b, _, c, _, d, _, ratio = row
    share = 1/archive.number(ratio)
    return [f"E{k} {c} m{k} {a} {b} {share!r}", f"Vm{k} m{k} {d} 0", f"F{k} {a} {b} Vm{k} {-share!r}"]


def netlist(path):
    """Lines without options, and (state, vector) in the order of the archive."""
    archive, lines, states = Archive(path), [], []
    for k, row in enumerate(archive.rows("branches"), 1):
        written, state = branch_lines(archive, k, row)
        lines += written
        states += [state] if state else []
    for k, row in enumerate(archive.rows("transformers"), 1):
        lines += transformer_lines(archive, k, row)
    return lines, states
