/* SPDX-License-Identifier: GPL-2.0-or-later
   What the peers in C share: the rates that ExportProgram wrote, compiled with -DRATES=name, and the lines that
   are answered as ours.lisp says.
     peer N T0 T1 X1 .. XN      then lines  SCENE METHOD TOLERANCE SCALE REPEATS
   Each line is answered by: seconds of the process for one run, evaluations, the state at T1. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

void RATES(const double *point, double *rates);

static int n;
static long evaluations;
static double *point; /* time and states */

static void rates_at(double t, const double *x, double *rates) {
  point[0] = t;
  memcpy(point + 1, x, n * sizeof(double));
  evaluations++;
  RATES(point, rates);
}

static void stop(const char *what) {
  printf("failed: %s\n", what);
  exit(1);
}

static double own_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

/* The integration of a peer: STATE at FROM becomes that at TO; nonzero where it does not come there. */
static int integrate(const char *method, double from, double to, double *state, double tolerance, double scale);

static void serve(char **words) {
  char line[200], method[50];
  double tolerance, scale;
  int repeats, failed;
  double *state = malloc(n * sizeof(double));
  while (fgets(line, sizeof line, stdin)) {
    if (sscanf(line, "%*s %49s %lf %lf %d", method, &tolerance, &scale, &repeats) != 4) stop("a line");
    double begin = own_seconds();
    for (int k = failed = 0; k < repeats && !failed; k++) {
      evaluations = 0;
      for (int i = 0; i < n; i++) state[i] = strtod(words[4 + i], NULL);
      failed = integrate(method, atof(words[2]), atof(words[3]), state, tolerance, scale);
    }
    printf("bench %.9g %ld", failed ? -1. : (own_seconds() - begin) / repeats, evaluations);
    for (int i = 0; i < n; i++) printf(" %.17g", state[i]);
    putchar('\n');
    fflush(stdout);
  }
  free(state);
}

static void read_size(int count, char **words) {
  if (count < 4 || count != 4 + (n = atoi(words[1]))) stop("usage");
  point = malloc((n + 1) * sizeof(double));
}
