// SPDX-License-Identifier: GPL-2.0-or-later
// A peer: accelerations of a spatial chain by ABA, the articulated-body algorithm, as the library of Pinocchio
// holds it (PINOCCHIO_ENABLE_TEMPLATE_INSTANTIATION).
//     peer N Q1 .. V1 ..     N bodies as in scenes.mac, each on a universal joint, and their state
// Lines  SCENE METHOD 0 1 REPEATS  are answered by: seconds of the process for one call, REPEATS, the accelerations.

#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <string>
#include <pinocchio/multibody.hpp>
#include <pinocchio/algorithm/aba.hpp>

using namespace pinocchio;

static Model chain(int n) {
  Model model;
  JointIndex parent = 0;
  for (int k = 1; k <= n; k++) {
    SE3 placement(Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, k == 1 ? 0. : 2. / 3));
    parent = model.addJoint(parent, JointModelUniversal(Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitX()), placement,
                            std::to_string(k));
    // The moments of inertia in scenes.mac are about the joints.
    double mass = 1 + k / 7., centre = 1 / 3., steiner = mass * centre * centre;
    Eigen::Matrix3d inertia = Eigen::Vector3d(k / 5. - steiner, k / 6. - steiner, k / 8.).asDiagonal();
    model.appendBodyToJoint(parent, Inertia(mass, Eigen::Vector3d(0, 0, centre), inertia), SE3::Identity());
  }
  model.gravity.linear() = Eigen::Vector3d(0, 0, -9.81);
  return model;
}

static double own_seconds() {
  timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

int main(int count, char **words) {
  int n = count > 1 ? std::atoi(words[1]) : 0;
  if (n < 1 || count != 2 + 4 * n) return 1;
  Model model = chain(n);
  Data data(model);
  Eigen::VectorXd q(2 * n), v(2 * n), force = Eigen::VectorXd::Zero(2 * n);
  for (int i = 0; i < 2 * n; i++) {
    q[i] = std::atof(words[2 + i]);
    v[i] = std::atof(words[2 + 2 * n + i]);
  }
  Eigen::Ref<const Eigen::VectorXd> angles(q), velocities(v), forces(force);
  std::string scene, method, tolerance, scale;
  long repeats;
  while (std::cin >> scene >> method >> tolerance >> scale >> repeats) {
    double begin = own_seconds();
    for (long k = 0; k < repeats; k++) aba(model, data, angles, velocities, forces, Convention::LOCAL);
    std::printf("bench %.9g %ld", (own_seconds() - begin) / repeats, repeats);
    for (int i = 0; i < 2 * n; i++) std::printf(" %.17g", data.ddq[i]);
    std::printf("\n");
    std::fflush(stdout);
  }
}
