# SPDX-License-Identifier: GPL-2.0-or-later
"""A peer: ngspice, as a shared library, on the netlist of the archive of a circuit. Methods: trap and gear, of order 2 both;
the relative tolerance is `reltol', the absolute ones from it and the scale; what it counts are points.
    ngspice_peer.py LIBRARY ARCHIVE END
The states stand in the order of the archive; netlist.py names them."""
import ctypes
import sys
from netlist import netlist
from served import serve


class Vector(ctypes.Structure):
    _fields_ = [("name", ctypes.c_char_p), ("kind", ctypes.c_int), ("flags", ctypes.c_short),
                ("real", ctypes.POINTER(ctypes.c_double)), ("complex", ctypes.c_void_p), ("length", ctypes.c_int)]


told = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_char_p, ctypes.c_int, ctypes.c_void_p)(lambda *_: 0)
left = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_int, ctypes.c_bool, ctypes.c_bool, ctypes.c_int, ctypes.c_void_p)(lambda *_: 0)
ngspice = ctypes.CDLL(sys.argv[1])
ngspice.ngGet_Vec_Info.restype = ctypes.POINTER(Vector)
ngspice.ngSpice_Init(told, told, left, None, None, None, None)
lines, states = netlist(sys.argv[2])
end = float(sys.argv[3])
open_circuit = None


def command(text):
    return ngspice.ngSpice_Command(text.encode())


def last(name):
    """The last number of a vector, of a difference of voltages, too."""
    if name.startswith("v(") and "," in name:
        return sum(sign * last(f"v({node})") for sign, node in zip((1, -1), name[2:-1].split(",")) if node != "0")
    vector = ngspice.ngGet_Vec_Info(name.encode()).contents
    return vector.real[vector.length - 1]


def saved():
    """The vectors that are kept: nodes and currents of the states."""
    names = set()
    for _, name in states:
        names |= ({f"v({node})" for node in name[2:-1].split(",") if node != "0"} if name.startswith("v(") else {name})
    return [".save " + name for name in sorted(names)]


def open_with(method, tolerance, scale):
    global open_circuit
    if open_circuit == (method, tolerance, scale):
        return
    if open_circuit:
        command("remcirc")
    options = (f".options method={method} trtol=1 reltol={tolerance!r} vntol={scale*tolerance!r} "
               f"abstol={scale*tolerance!r} chgtol=1e-25 gmin=1e-18 itl4=100")
    text = ["circuit", *lines, options, *saved(), ".end"]
    ngspice.ngSpice_Circ((ctypes.c_char_p * (len(text) + 1))(*[line.encode() for line in text], None))
    open_circuit = method, tolerance, scale


def run(_, method, tolerance, scale):
    open_with(method, tolerance, scale)
    command(f"tran {end/1000!r} {end!r} 0 {end/50!r} uic")
    time = ngspice.ngGet_Vec_Info(b"time")
    points = time.contents.length if time else 0
    reached = points and abs(time.contents.real[points - 1] - end) <= 1e-9 * end
    answer = (points, [last(name) for _, name in states]) if reached else None
    command("destroy all")
    return answer


serve(run)
