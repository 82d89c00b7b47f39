/* SPDX-License-Identifier: GPL-2.0-or-later
   A peer, see worker.h: CVODE (BDF, dense, its own differences; Adams, with iterations of the fixed point) and ARKODE
   (explicit, order 8) of SUNDIALS. */

#include "worker.h"
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

static const long most_steps = 100000000;
static SUNContext context;

static int rates_of(sunrealtype t, N_Vector x, N_Vector rates, void *data) {
  (void)data;
  rates_at(t, N_VGetArrayPointer(x), N_VGetArrayPointer(rates));
  return 0;
}

static int with_cvode(int kind, double from, double to, N_Vector x, double tolerance, double scale) {
  double t = from;
  void *memory = CVodeCreate(kind, context);
  SUNMatrix matrix = NULL;
  SUNLinearSolver linear = NULL;
  SUNNonlinearSolver nonlinear = NULL;
  int flag = CVodeInit(memory, rates_of, from, x) || CVodeSStolerances(memory, tolerance, tolerance * scale) ||
             CVodeSetMaxNumSteps(memory, most_steps) || CVodeSetStopTime(memory, to);
  if (kind == CV_BDF) {
    matrix = SUNDenseMatrix(n, n, context);
    linear = SUNLinSol_Dense(x, matrix, context);
    flag = flag || CVodeSetLinearSolver(memory, linear, matrix);
  } else {
    nonlinear = SUNNonlinSol_FixedPoint(x, 0, context);
    flag = flag || CVodeSetNonlinearSolver(memory, nonlinear);
  }
  if (flag) stop("CVODE");
  flag = CVode(memory, to, x, &t, CV_NORMAL);
  CVodeFree(&memory);
  if (linear) SUNLinSolFree(linear);
  if (matrix) SUNMatDestroy(matrix);
  if (nonlinear) SUNNonlinSolFree(nonlinear);
  return flag < 0 || t != to;
}

static int with_arkode(double from, double to, N_Vector x, double tolerance, double scale) {
  double t = from;
  void *memory = ERKStepCreate(rates_of, from, x, context);
  int flag = ERKStepSStolerances(memory, tolerance, tolerance * scale) || ERKStepSetOrder(memory, 8) ||
             ERKStepSetMaxNumSteps(memory, most_steps) || ERKStepSetStopTime(memory, to);
  if (flag) stop("ARKODE");
  flag = ERKStepEvolve(memory, to, x, &t, ARK_NORMAL);
  ERKStepFree(&memory);
  return flag < 0 || t != to;
}

static int integrate(const char *method, double from, double to, double *state, double tolerance, double scale) {
  N_Vector x = N_VMake_Serial(n, state, context);
  int failed = !strcmp(method, "arkode") ? with_arkode(from, to, x, tolerance, scale)
                                         : with_cvode(strcmp(method, "adams") ? CV_BDF : CV_ADAMS, from, to, x,
                                                      tolerance, scale);
  N_VDestroy(x);
  return failed;
}

int main(int count, char **words) {
  read_size(count, words);
  if (SUNContext_Create(0, &context)) stop("SUNContext_Create");
  serve(words);
  return 0;
}
