#!/bin/sh
# SPDX-License-Identifier: GPL-2.0-or-later
# Adding a public function takes five things: a face line, a register entry, the mathematics, a manual entry, a test. Adding a
# kind of archive takes one form, and a rule for what it has. Here both are added to a copy; the calls, the options and their
# errors, saving, the dialog, the messages and the help follow.

here=$(CDPATH= cd -- "$(dirname -- "$0")" && pwd -P)
. "$here/../tools/find"
. "$here/check"
find_maxima || exit 1
repository=$PWD/copy
mkdir "$repository" && cp -r "$here/../tools" "$here/../src" "$here/../doc" "$here/../tests" "$here"/../*.mac "$repository"
cp "$here/../examples/spherical_pendulum.txt" pendulum.txt
MAXIMA=$maxima
XDG_CACHE_HOME=$PWD/cache
export MAXIMA XDG_CACHE_HOME

# --- a function: face, register, mathematics, manual, test ---

sed -i 's/"FirstIntegrals",/"FirstIntegrals", "TotalEnergy",/' "$repository/linmodel.mac"

cat >>"$repository/src/forms/register.lisp" <<'END'
(core-public "TotalEnergy" :forms '(("lagrangian" "Lagrangian" "coordinates")) :options '("expanded")
                           :kinds *forms-kinds*)
(core-rule "TotalEnergy" :any "forms/total_energy" "forms_total_energy"
  "Lagrangian" "coordinates" '("expanded" nil))
END

cat >"$repository/src/forms/total_energy.mac" <<'END'
/* The energy sum q_i' dL/dq_i' - L. */

forms_total_energy(L, q, expanded) := block([rates, names, plain, energy],
  rates: map(lambda([x], 'diff(x, 't)), q),
  names: makelist(concat('%r, i), i, 1, length(q)),
  plain: subst(map("=", rates, names), L),
  energy: sum(names[i]*diff(plain, names[i]), i, 1, length(q)) - plain,
  if expanded then energy: expand(energy),
  subst(map("=", names, rates), energy))$
END

cat >entry <<'END'
@deffn {Function} TotalEnergy (@var{system})
@deffnx {Function} TotalEnergy (@var{L}, [@var{q1}, @var{q2}, @dots{}])
The energy of a system.

@example
(%i1) TotalEnergy('diff(x,t)^2/2 - x^2/2, [x]);
(%o1) ('diff(x,t,1))^2/2+x^2/2
@end example
@end deffn

END
sed -i '/^@deffn {Function} Quadratics/{
r entry
N
}' "$repository/doc/linmodel.texi"

cat >"$repository/tests/rtest_forms_total_energy.mac" <<'END'
load("linmodel")$
"LINMODEL"$
TotalEnergy(m*'diff(x,t)^2/2 - x^2/2 + f*'diff(x,t), [x]) - m*'diff(x,t)^2/2 - x^2/2;
0$
END

session() { # INPUT: what Maxima says to it
  timeout -k 5 300 "$repository/tools/maxima" --very-quiet --batch-string="$1" </dev/null 2>&1
}
says() { grep -c -- "$1" log; }

session 'load("linmodel")$ display2d: false$ linel: 1000$
  print("law", ratsimp(TotalEnergy("pendulum.txt") - KineticEnergy("pendulum.txt") + ForceFunction("pendulum.txt")))$
  print("given", TotalEnergy(%pi*'\''diff(x,t)^2 - x, [x]))$
  print("again", length(sconcat(TotalEnergy("pendulum.txt", expanded = true))) > 20)$
  TotalEnergy("pendulum.txt", expandd = true)$
  TotalEnergy("pendulum.txt", expanded = 3)$
  TotalEnergy([kind = poisson, algebra = e(3), hamiltonian = M1])$
  TotalEnergy(x, [x], 3)$' >log
check "on an archive" "$(says '^law 0')" 1
check "on expressions" "$(says "^given .*pi.*+x")" 1
check "its result is saved" "$(grep -c '^\[result TotalEnergy\]' pendulum.txt)" 1
check "that of another option beside it" "$(grep -c '^options = "expanded = true"' pendulum.txt)" 1
check "a misspelt option" "$(says '^TotalEnergy: there is no option expandd; did you mean expanded?')" 1
check "the type of an option" "$(says '^TotalEnergy: the option expanded is true or false, found 3')" 1
check "another kind of archive" "$(says '^TotalEnergy: Lagrangian is for mechanical archives, and this description is of kind poisson')" 1
check "another form" "$(says '^TotalEnergy: call it as TotalEnergy("archive.txt"), or as TotalEnergy(Lagrangian, coordinates)')" 1

printf 'load("linmodel")$\nTotalEnergy();\nwhat\n' | timeout -k 5 300 "$repository/tools/maxima" --very-quiet >log 2>&1
check "the dialog asks" "$(says '^TotalEnergy: description of a system')" 1
check "for the kinds that have a Lagrangian" "$(says '^Kind of system (mechanical, lagrangian, circuit)')" 1

suite() { session "batch(\"$repository/tests/$1\", test)\$" | grep -c 'tests passed'; }
check "its own suite" "$(suite rtest_forms_total_energy.mac)" 1
check "the suite of the register" "$(suite rtest_core_register.mac)" 1
if command -v makeinfo >/dev/null; then
  "$repository/tools/doc" >log 2>&1
  printf 'load("linmodel")$\n? TotalEnergy\n' | timeout -k 5 300 "$repository/tools/maxima" --very-quiet >log 2>&1
  check "its help" "$(says ' -- Function: TotalEnergy (<system>)')" 1
fi

# --- a kind: one form, and a rule for the quantity that it has ---

cat >>"$repository/src/archive/register.lisp" <<'END'
(core-kind "oscillator" "a mass on a spring"
  :first '(("coordinates" :names :required "the elongation" "Coordinate"))
  :keys '(("inertia" :expression :required "the mass" "Mass")
          ("stiffness" :expression "1" "force over elongation" "Stiffness"))
  :gives '("Lagrangian"))
END
cat >>"$repository/src/forms/register.lisp" <<'END'
(core-rule "Lagrangian" '("oscillator") "forms/total_energy" "forms_oscillator"
  "coordinates" "inertia" "stiffness")
END
cat >>"$repository/src/forms/total_energy.mac" <<'END'

forms_oscillator(q, m, k) := m*'diff(first(q), 't)^2/2 - k*first(q)^2/2$
END
printf 'dynarch = 1\nkind = oscillator\n\n[system]\ncoordinates = [x]\nparameters = [m > 0, k > 0]\ninertia = m\nstiffness = k\n' >spring.txt

session 'load("linmodel")$ load("analysis")$ display2d: false$ linel: 1000$
  print("equations", LagrangeEquations("spring.txt"))$
  print("energy", TotalEnergy("spring.txt"))$
  print("verdict", Stability("spring.txt", [x = 0]))$
  LagrangeEquations([kind = oscillator, coordinates = [x]])$
  LagrangeEquations([kind = oscillator, coordinates = [x], inertia = m, stifness = 2, parameters = [m > 0]], save = false)$
  LagrangeEquations([kind = pendulum])$
  MassForm([kind = mechanical, stiffness = 2])$' >log
check "functions work on the kind" "$(says "^equations \[m\*'diff(x,t,2)+k\*x = 0\]")" 1
check "the new function too" "$(says "^energy .*k.x^2")" 1
check "and those of another package" "$(says '^verdict .*stable')" 1
check "a key that is missing" "$(says 'system: the key inertia is missing; give inertia = an expression')" 1
check "a misspelt key" "$(says 'unknown key stifness; did you mean stiffness?')" 1
check "a key of it elsewhere" "$(says 'unknown key stiffness; it is a key of the kind oscillator')" 1
check "the kinds there are" "$(says 'kind must be mechanical, lagrangian, circuit, equations, poisson or oscillator, found pendulum')" 1

printf 'load("linmodel")$\nLagrangeEquations();\noscillator\n[x]\n[m > 0]\n\n\n?\nm\n.\nspring\n\n\n' |
  timeout -k 5 300 "$repository/tools/maxima" --very-quiet >log 2>&1
check "the dialog asks its keys" "$(says '^system: Mass (needed; ? explains)')" 1
check "and explains them" "$(says 'inertia: the mass. Type an expression.')" 1
check "and writes the file" "$(grep -c '^inertia = m' oscillator.txt)" 1
check "the table of keys has it" "$("$repository/tools/keys-table" | grep -c '^| `stiffness` | oscillator |')" 1

summary
