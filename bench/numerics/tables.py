# SPDX-License-Identifier: GPL-2.0-or-later
"""What is printed: tables of contenders at equal error, the quickest first, and the goals with what was measured."""
import os
import sys
from contenders import Gone, patience, side_by_side

goals = []


def table(title, columns, rows):
    if title:
        print(f"\n### {title}\n")
    print("|", " | ".join(columns), "|")
    print("|---" + "|--:" * (len(columns) - 1) + "|")
    for row in rows:
        print("|", " | ".join(row), "|")
    sys.stdout.flush()


def load():
    """The load of the last minute, of all that the machine does."""
    return f"{os.getloadavg()[0]:.1f}"


def goal(text, value, most):
    goals.append(f"* {'met' if value <= most else 'not met'}: {text} at most {most:g}: {value:.3g}")


def missed(text):
    goals.append("* not measured: " + text)


def told(quotients):
    low, middle, high, pairs = quotients
    return f"{middle:.3g} ({low:.3g} .. {high:.3g}), {pairs}"


def settings(contender):
    """The tolerances between which the error lies, and the scale where it is not 1."""
    scale = contender.ends[0].scale
    return " .. ".join(f"{point.tolerance:.1g}" for point in contender.ends) + (f", scale {scale:g}" if scale != 1 else "")


def standing(contender, quotient):
    return (contender.seconds, [contender.title, settings(contender), str(contender.evaluations()),
                                f"{1e3 * contender.seconds:.4g}", quotient])


def contest(title, ours, peers, goal_texts, seconds=5.0, last="our time over it (quartiles), pairs"):
    """Times of OURS beside each of PEERS, the quickest first. GOAL_TEXTS: title of a peer -> (text, most)."""
    rows, notes, before = [standing(ours, "")], [], load()
    for peer in peers:
        if peer.slow():
            rows.append(standing(peer, "a run alone"))
            continue
        try:
            quotients = side_by_side(ours, peer, seconds)
        except Gone as fault:
            notes.append(f"{peer.title} ended at {fault}.")
            continue
        rows.append(standing(peer, told(quotients)))
        if peer.title in goal_texts:
            text, most = goal_texts[peer.title]
            goal(f"{text}, our time over that of {peer.title}", quotients[1], most)
    rows[0] = standing(ours, "")
    table(title, ["", "tolerances", "evaluations", "milliseconds", last], [row for _, row in sorted(rows)])
    print(f"\nLoad of the machine: {before} before, {load()} after.")
    for note in notes:
        print("\n" + note)


def sweep_all(contenders, error_of_state, least):
    """Those that answer; a sentence for each of the others is printed."""
    there = []
    for contender in contenders:
        try:
            contender.sweep(error_of_state, least)
            there.append(contender)
        except Gone as fault:
            print(f"\n{contender.title} ended at {fault}.")
    return there


def curve_lines(title, contenders):
    """Each curve as it was swept, a line a point, tabs between."""
    return "".join("\t".join([title, contender.title, f"{point.tolerance:.3g}", f"{point.scale:g}", f"{point.error:.2e}",
                              f"{point.evaluations}", f"{point.seconds:.3e}"]) + "\n"
                   for contender in contenders for curve in contender.curves for point in curve)


def equal_error(title, contenders, error, goal_texts, words="error {:g}", seconds=5.0):
    """OURS, the first of CONTENDERS that were swept, beside the others where their curves have ERROR."""
    standing_there = [contender for contender in contenders if contender.stand_at(error)]
    absent = [contender for contender in contenders if contender not in standing_there]
    if standing_there and standing_there[0] is contenders[0]:
        contest(f"{title}, " + words.format(error), contenders[0], standing_there[1:], goal_texts, seconds)
    else:
        print(f"\n### {title}, " + words.format(error))
    for contender in absent:
        best = contender.best()
        print(f"\nNo ratio: {contender.title} " + (
            f"has no such error on its curve; its least is {best.error:.1e} (tolerance {best.tolerance:.1g}, "
            f"{1e3 * best.seconds:.4g} ms)" + (
                f", where its curve had taken {patience:g} s." if contender.long_p() else ".")
            if best else "does not reach the end."))
        if contender.title in goal_texts:
            missed(f"{goal_texts[contender.title][0]} over that of {contender.title}: no such error on both curves")
