/* SPDX-License-Identifier: GPL-2.0-or-later
   A peer: CVODE (BDF, dense, its own differences) and ARKODE (explicit, order 8) of SUNDIALS on the rates
   that ExportProgram wrote, compiled with -DRATES=name.
     peer N T0 T1 X1 .. XN      then lines  SCENE METHOD TOLERANCE SCALE REPEATS
   Each line is answered by: seconds of the process for one run, evaluations, the state at T1. */

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

void RATES(const double *point, double *rates);

static int n;
static long evaluations;
static double *point; /* time and states */

static int rates_of(sunrealtype t, N_Vector x, N_Vector rates, void *data) {
  point[0] = t;
  memcpy(point + 1, N_VGetArrayPointer(x), n * sizeof(double));
  evaluations++;
  RATES(point, N_VGetArrayPointer(rates));
  return 0;
}

static void stop(const char *what) {
  printf("failed: %s\n", what);
  exit(1);
}

static int with_cvode(SUNContext context, double from, double to, N_Vector x, double tolerance, double scale) {
  double t = from;
  void *memory = CVodeCreate(CV_BDF, context);
  SUNMatrix matrix = SUNDenseMatrix(n, n, context);
  SUNLinearSolver solver = SUNLinSol_Dense(x, matrix, context);
  int flag = CVodeInit(memory, rates_of, from, x) || CVodeSStolerances(memory, tolerance, tolerance * scale) ||
             CVodeSetLinearSolver(memory, solver, matrix) || CVodeSetMaxNumSteps(memory, 100000000) ||
             CVodeSetStopTime(memory, to);
  if (flag) stop("CVODE");
  flag = CVode(memory, to, x, &t, CV_NORMAL);
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  return flag < 0 || t != to;
}

static int with_arkode(SUNContext context, double from, double to, N_Vector x, double tolerance, double scale) {
  double t = from;
  void *memory = ERKStepCreate(rates_of, from, x, context);
  int flag = ERKStepSStolerances(memory, tolerance, tolerance * scale) || ERKStepSetOrder(memory, 8) ||
             ERKStepSetMaxNumSteps(memory, 100000000) || ERKStepSetStopTime(memory, to);
  if (flag) stop("ARKODE");
  flag = ERKStepEvolve(memory, to, x, &t, ARK_NORMAL);
  ERKStepFree(&memory);
  return flag < 0 || t != to;
}

static double own_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

int main(int count, char **words) {
  SUNContext context;
  char line[200], method[50];
  double tolerance, scale, *state;
  int repeats, failed;
  if (count < 4 || count != 4 + (n = atoi(words[1]))) stop("usage");
  if (SUNContext_Create(0, &context)) stop("SUNContext_Create");
  N_Vector x = N_VNew_Serial(n, context);
  state = N_VGetArrayPointer(x);
  point = malloc((n + 1) * sizeof(double));
  while (fgets(line, sizeof line, stdin)) {
    if (sscanf(line, "%*s %49s %lf %lf %d", method, &tolerance, &scale, &repeats) != 4) stop("a line");
    double begin = own_seconds();
    for (int k = failed = 0; k < repeats; k++) {
      evaluations = 0;
      for (int i = 0; i < n; i++) state[i] = strtod(words[4 + i], NULL);
      failed |= (strcmp(method, "cvode") ? with_arkode : with_cvode)(context, atof(words[2]), atof(words[3]), x,
                                                                     tolerance, scale);
    }
    printf("bench %.9g %ld", failed ? -1. : (own_seconds() - begin) / repeats, evaluations);
    for (int i = 0; i < n; i++) printf(" %.17g", state[i]);
    putchar('\n');
    fflush(stdout);
  }
  return 0;
}
