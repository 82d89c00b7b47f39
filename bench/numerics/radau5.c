/* SPDX-License-Identifier: GPL-2.0-or-later
   A peer, see worker.h: RADAU5 of Hairer and Wanner, as the library of R's package deSolve holds it, full matrices and
   its own differences. Of that library nothing else is called, see run. */

#include "worker.h"

typedef void rates_function(int *n, double *t, double *x, double *rates, double *reals, int *integers);
typedef void other_function(void); /* Jacobian, mass, output: not called */

void radau5_(int *n, rates_function *rates, double *t, double *x, double *to, double *step, double *relative,
             double *absolute, int *vectors, other_function *jacobian, int *has_jacobian, int *lower, int *upper,
             other_function *mass, int *has_mass, int *mass_lower, int *mass_upper, other_function *output,
             int *has_output, double *work, int *size_of_work, int *integer_work, int *size_of_integer_work,
             double *reals, int *integers, int *status);

static void rates_of(int *size, double *t, double *x, double *rates, double *reals, int *integers) {
  (void)size, (void)reals, (void)integers;
  rates_at(*t, x, rates);
}

static void other(void) {}

static int integrate(const char *method, double from, double to, double *state, double tolerance, double scale) {
  int no = 0, full = n, status = 0, size = 4 * n * n + 12 * n + 20, integer_size = 3 * n + 20, integers = 0;
  double t = from, step = 0, relative = tolerance, absolute = tolerance * scale, reals = 0;
  double *work = calloc(size, sizeof(double));
  int *integer_work = calloc(integer_size, sizeof(int));
  (void)method;
  integer_work[1] = 100000000; /* steps */
  radau5_(&n, rates_of, &t, state, &to, &step, &relative, &absolute, &no, other, &no, &full, &full, other, &no, &full,
          &full, other, &no, work, &size, integer_work, &integer_size, &reals, &integers, &status);
  free(work);
  free(integer_work);
  return status < 0 || t != to;
}

int main(int count, char **words) {
  read_size(count, words);
  serve(words);
  return 0;
}
