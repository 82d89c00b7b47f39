# SPDX-License-Identifier: GPL-2.0-or-later
# tools/demo and tools/test need no make; these are their short names, and what is not run each time.

.PHONY: demo test bench bench-peers bench-numerics bench-analysis bench-circuits bench-verdicts report report-full report-references fuzz test-maxima doc dist

demo:
	@tools/demo

test:
	@tools/test

# Times of the examples and of a start with the packages loaded.
bench:
	@bench/run

# Chains by SymPy, symengine, CasADi (by pip into the user's cache) and by us, side by side, under ten minutes; then
# bench-numerics, bench-analysis and bench-circuits. doc/bench.md holds what they print.
bench-peers:
	@bench/peers/run
	@bench/numerics/run
	@bench/analysis/run
	@bench/circuits/run

# Runs by us and by SciPy, heyoka, RADAU5, SUNDIALS, ngspice, Pinocchio and gcc (into the user's cache), side by side. About
# half an hour.
bench-numerics:
	@bench/numerics/run

# Minors, characteristic polynomials, counts of roots and verdicts on chains by us, python-flint and SymPy, side by side. Three minutes.
bench-analysis:
	@bench/analysis/run

# State equations of ladders by us and by Lcapy, side by side; graphs of many branches, the ring modulator. Four minutes.
bench-circuits:
	@bench/circuits/run

# Verdicts on stability by doubles, bigfloats and exactly, beside the truth: a page and a plot. Three minutes.
bench-verdicts:
	@bench/verdicts/run

# The report of the package on itself: doc/numbers.md, doc/methods.md, doc/verdicts.md. Under five minutes; report-full within the hour.
report:
	@bench/report/run
	@bench/verdicts/run doc

report-full:
	@bench/report/run full

# What its errors are measured against; only where a scene has changed.
report-references:
	@bench/report/run references

# The adversaries: random cases that try to refute what is claimed, of which the tests run a few.
fuzz:
	@tools/fuzz

# Maxima's own test suite, with the packages loaded and without: the results must be the same.
test-maxima:
	@tools/test-maxima

# The manual that `? name` shows, from its texinfo source.
doc:
	@tools/doc

# The release of the last commit, as dynarch-VERSION.tar.gz in this folder.
dist:
	@tools/dist
