#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Adversaries against faults: each line plants one in a copy, a sign, a factor or a rank, and the adversary must find it among the
# cases that it runs by itself, fewer than a thousand.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/../tools/find"
. "$here/check"
find_maxima || exit 1
original=$(dirname -- "$here")
XDG_CACHE_HOME=$PWD/cache MAXIMA=$maxima
export XDG_CACHE_HOME MAXIMA

# name cases seed | file | what stands there | the fault
faults() {
  cat <<'END'
normal_forms 150 11|src/analysis/neutral_hamiltonian.mac|inverse: if b = 0 then l1|inverse: if b = 0 then -l1
normal_forms 150 11|src/analysis/neutral_resonance.mac|- 108\*c|- 27*c
normal_forms 150 11|src/analysis/normal_form.lisp|(cons number 2) beta|(cons number 1) beta
normal_forms 150 11|src/analysis/neutral_double.mac|algebra_inverse_times(J, -M|algebra_inverse_times(J, M
leaf_coordinates 40 3|src/analysis/leaf_coordinates.mac|analysis_series_about(H, x, point, 4)|analysis_series_about(H, x, point, 3)
letters 300 5|src/analysis/real_formulas.mac|'unknown then analysis_sign_by_norm(e)|'unknown then 'neg
covered 200 3|src/analysis/covered_cases.mac|if known = 'neg then sign: -sign|if known = 'neg then sign: sign
covered 200 3|src/analysis/covered_cases.mac|and forms_vanishes(analysis_gap(c) + analysis_gap(d))|and is(op(c) = op(d))
damped 60 3|src/analysis/stability_by_energy.mac|['nz, 'neg, 'zero\])|['nz, 'neg, 'zero, 'unknown])
damped 60 3|src/analysis/lyapunov_test.mac|\[append(analysis_slopes_of(rate, x), zeros), X, x\]|[append(x, zeros), X, x]
positions 60 3|src/analysis/singular_coordinates.mac|and analysis_nothing_moves(eqs, q, special, line, n) then seen: false|and analysis_nothing_moves(eqs, q, special, line, n) then true
pencils 300 7|src/analysis/paired_blocks.mac|\[\[-b, 2\*a\], -direction(at_a)|[[-b, 2*a], direction(at_a)
pencils 300 7|src/analysis/paired_blocks.mac|rest(corners)))),$|[]))),
borders 40 3|src/analysis/motion_values.mac|lhs(eq) = analysis_put_where(where, rhs(eq))|eq
stabilizable 100 5|src/analysis/stabilization.mac|-analysis_gap(d)|-analysis_difference(d)
reasons 300 5|src/circuits/tree.mac|      circuits_structure_cuts(structure),$|      circuits_structure_loops(structure),
reasons 300 5|src/circuits/tree.mac|        circuits_structure_loops(structure),$|        circuits_structure_cuts(structure),
branches 1000 3|src/numerics/followed_branch.lisp|for share in '(0.25d0 0.5d0 0.75d0 1d0)|for share in '()
left_impulses 800 3|src/forms/impulses_left_out.lisp|(notany (lambda (other) (among other slope)) names)|(not (among name slope))
left_impulses 800 3|src/forms/impulses_left_out.lisp|(when (forms-jumps-there-p by-sign place)|(when nil
products 1000 5|src/algebra/sign_by_parts.lisp|(member (cdr row) '($pos $neg))|(member (cdr row) '($pos $neg $pz $nz))
signs 1000 5|src/algebra/known_signs.lisp|(eq facts (knowledge-facts last)))|t)
places 200 3|src/analysis/vanishing_in_places.mac|then is(algebra_zerop(e) # false)|then false
places 600 3|src/analysis/vanishing_in_places.mac|'abs then \[first(parts), -first(parts)\]|'abs then [-first(parts)]
impulses 100 7|src/numerics/run_course.lisp|(share (\* 10 |(share (* 1d12 
impulses 100 7|src/algebra/program_nodes.lisp|(algebra-slope (algebra-twice-impulse x))|(algebra-slope 0)
leaves 40 41|src/algebra/matrices.lisp|($algebra_dot column image)|($algebra_dot image image)
leaves 40 41|src/analysis/variation.mac|integrals # \[\] then$|false then
polynomial_integrals 60 5|src/algebra/invariants.lisp|degree from most downto least|degree from most above least
polynomial_integrals 60 5|src/algebra/invariants.lisp|(>= k count)|(> k count)
ideals 32 3|src/algebra/components.lisp|loop for factor in factors$|loop for factor in (butlast factors)
ideals 32 3|src/algebra/components.lisp|(algebra-divided-rest p (first a))|(algebra-divided-rest p (first b))
ideals 32 3|src/algebra/components.lisp|(last ordered of-apart)|nil
ideals 32 3|src/algebra/components.lisp|maximize (logcount unknowns)|maximize (1+ (logcount unknowns))
END
}

# the adversary's last line in a copy, with the fault if there is one
outcome() { # NAME CASES SEED [FILE OLD NEW]
  rm -rf copy && mkdir copy && cp -r "$original/tools" "$original/src" "$original/tests" "$original"/*.mac copy
  if [ $# -gt 3 ]; then
    sed -i "s|$5|$6|" "copy/$4"
    cmp -s "copy/$4" "$original/$4" && { echo "nothing of $4 changed"; return; }
  fi
  copy/tools/fuzz "$1" "$2" "$3" >said 2>&1 </dev/null && echo held || echo "found"
}

faults >list
command -v Singular >/dev/null || sed -i '/^ideals /d' list # it judges them
cut -d'|' -f1 list | sort -u >names
while read -r name cases seed; do
  check "$name holds without a fault" "$(outcome "$name" "$cases" "$seed")" held
done <names
while IFS='|' read -r run file old new; do
  # shellcheck disable=SC2086
  check "$run: $new" "$(outcome $run "$file" "$old" "$new")" found
done <list
summary
